import { createHash } from "node:crypto";
import { existsSync, readFileSync } from "node:fs";
import { defineConfig, type Plugin } from "vite";
import { scenes } from "./scenes.mjs";

/** Of KaTeX's letters those that the chain uses, and only as woff2, which every browser that runs the page reads. */
const letters: Plugin = {
  name: "letters",
  enforce: "pre",
  transform(code, id) {
    if (!id.includes("katex") || !id.endsWith(".css")) return null;
    return code
      .replace(/,\s*url\([^)]*\.(?:woff|ttf)\)\s*format\(["']?(?:woff|truetype)["']?\)/g, "")
      .replace(/@font-face\{[^}]*?KaTeX_(?:AMS|Caligraphic|Fraktur|SansSerif|Script|Typewriter|Main-Italic|Main-BoldItalic)\b[^}]*\}/g, "");
  },
};

/** The engine of the scene that the address names is fetched with the first script. It is a file of its own: the page's policy allows no other. */
const preload: Plugin = {
  name: "preload",
  transformIndexHtml: () => [{ tag: "script", attrs: { src: "./preload.js" }, injectTo: "head" }],
  generateBundle() {
    const dims = Object.fromEntries(scenes().filter((s) => s.dim > 1).map((s) => [s.name, s.dim]));
    const source = `// Made by the build: fetches the engine of the scene that the address names. Of a scene in the address itself the page knows which.
const dims = ${JSON.stringify(dims)};
if (!/^#\\d/.test(location.hash)) {
  const link = document.createElement("link");
  const name = /^#([a-z0-9-]*)/.exec(location.hash)?.[1] ?? "";
  Object.assign(link, { rel: "preload", as: "fetch", type: "application/wasm", crossOrigin: "anonymous", href: \`./carom-\${Object.hasOwn(dims, name) ? dims[name] : 1}d.wasm\` });
  document.head.append(link);
}
`;
    this.emitFile({ type: "asset", fileName: "preload.js", source });
  },
};

const ENGINES = ["carom-1d.wasm", "carom-2d.wasm", "carom-3d.wasm", "carom-words.wasm", "carom-files.wasm"];

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
  plugins: [letters, builtins, preload, offline],
  worker: { format: "es" },
  build: { target: "es2022", outDir: "dist", assetsInlineLimit: 0, chunkSizeWarningLimit: 900, modulePreload: { polyfill: false } },
});
