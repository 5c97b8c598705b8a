import { createHash } from "node:crypto";
import { existsSync, readFileSync } from "node:fs";
import { defineConfig, type Plugin } from "vite";
import { scenes } from "./scenes.mjs";

/** Every browser that runs the page reads woff2: KaTeX's older fonts stay out of it. */
const woff2Only: Plugin = {
  name: "woff2-only",
  enforce: "pre",
  transform(code, id) {
    if (!id.includes("katex") || !id.endsWith(".css")) return null;
    return code.replace(/,\s*url\([^)]*\.(?:woff|ttf)\)\s*format\(["']?(?:woff|truetype)["']?\)/g, "");
  },
};

const ENGINES = ["carom-1d.wasm", "carom-2d.wasm", "carom-3d.wasm", "carom-words.wasm"];

/** The built-in scenes, from their files. */
const builtins: Plugin = {
  name: "scenes",
  resolveId: (id) => (id === "carom:scenes" ? "\0carom:scenes" : null),
  load: (id) => (id === "\0carom:scenes" ? `export default ${JSON.stringify(scenes())};` : null),
};

/** The service worker, with the names of all files that it keeps. */
const offline: Plugin = {
  name: "offline",
  generateBundle(_, bundle) {
    const files = ["./", "./icon.svg", ...ENGINES.map((name) => `./${name}`), ...Object.keys(bundle).filter((name) => !name.endsWith(".html")).map((name) => `./${name}`)].sort();
    const hash = createHash("sha256").update(files.join());
    for (const name of ENGINES) if (existsSync(`public/${name}`)) hash.update(readFileSync(`public/${name}`));
    const source = readFileSync("src/offline.template.js", "utf8")
      .replace("__NAME__", `carom-lab-${hash.digest("hex").slice(0, 12)}`)
      .replace("__FILES__", JSON.stringify(files));
    this.emitFile({ type: "asset", fileName: "worker-offline.js", source });
  },
};

// Static files with relative addresses: the page works from any folder, in an iframe, and from the binary.
export default defineConfig({
  base: "./",
  plugins: [woff2Only, builtins, offline],
  worker: { format: "es" },
  build: { target: "es2022", outDir: "dist", assetsInlineLimit: 0, chunkSizeWarningLimit: 900, modulePreload: { polyfill: false } },
});
