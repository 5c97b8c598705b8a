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

// Static files with relative addresses: the page works from any folder, in an iframe, and from the binary.
export default defineConfig({
  base: "./",
  plugins: [woff2Only],
  worker: { format: "es" },
  build: { target: "es2022", outDir: "dist", assetsInlineLimit: 0, chunkSizeWarningLimit: 900, modulePreload: { polyfill: false } },
});
