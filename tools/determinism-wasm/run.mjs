// Runs the worlds of digest.wasm under Node and prints them as the example `digest` does: node run.mjs FILE.wasm
import { readFileSync } from "node:fs";

const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]), {});
const { scenes, name, run, half } = instance.exports;
const number = (which) => (BigInt(half(which, 1) >>> 0) << 32n) | BigInt(half(which, 0) >>> 0);
const hex = (which) => number(which).toString(16).padStart(16, "0");
for (let scene = 0; scene < scenes(); scene++) {
  let text = "";
  for (let k = 0, byte; (byte = name(scene, k)) !== 0; k++) text += String.fromCharCode(byte);
  run(scene);
  console.log(`${text} ${hex(0)} ${hex(1)} ${number(2)}`);
}
