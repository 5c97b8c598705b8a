// TypeScript modules of the page for Node 20, which does not read them itself: transformed by vite's own compiler.
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { transformWithOxc } from "vite";

const folder = mkdtempSync(join(tmpdir(), "carom-lab-"));
let count = 0;

/** Loads a module that imports nothing but types. */
export async function module(url) {
  const source = readFileSync(url, "utf8");
  const { code } = await transformWithOxc(source, url.pathname);
  const file = join(folder, `module-${count++}.mjs`);
  writeFileSync(file, code);
  return import(pathToFileURL(file).href);
}
