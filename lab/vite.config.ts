import { createHash } from "node:crypto";
import { existsSync, readFileSync } from "node:fs";
import { defineConfig, type Plugin } from "vite";

/** Every browser that runs the page reads woff2: KaTeX's older fonts stay out of it. */
const woff2Only: Plugin = {
  name: "woff2-only",
  enforce: "pre",
  transform(code, id) {
    if (!id.includes("katex") || !id.endsWith(".css")) return null;
    return code.replace(/,\s*url\([^)]*\.(?:woff|ttf)\)\s*format\(["']?(?:woff|truetype)["']?\)/g, "");
  },
};

/** The service worker, with the names of all files that it keeps. */
const offline: Plugin = {
  name: "offline",
  generateBundle(_, bundle) {
    const files = ["./", "./icon.svg", "./carom.wasm", ...Object.keys(bundle).filter((name) => !name.endsWith(".html")).map((name) => `./${name}`)].sort();
    const hash = createHash("sha256").update(files.join());
    if (existsSync("public/carom.wasm")) hash.update(readFileSync("public/carom.wasm"));
    const source = readFileSync("src/offline.template.js", "utf8")
      .replace("__NAME__", `carom-lab-${hash.digest("hex").slice(0, 12)}`)
      .replace("__FILES__", JSON.stringify(files));
    this.emitFile({ type: "asset", fileName: "worker-offline.js", source });
  },
};

// Static files with relative addresses: the page works from any folder, in an iframe, and from the binary.
export default defineConfig({
  base: "./",
  plugins: [woff2Only, offline],
  worker: { format: "es" },
  build: { target: "es2022", outDir: "dist", assetsInlineLimit: 0, chunkSizeWarningLimit: 900, modulePreload: { polyfill: false } },
});
