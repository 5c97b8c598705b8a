// The built-in scenes of the engine as the page has them: JSON, with the words of each file about itself. For vite and the tests.
import { readFileSync } from "node:fs";
import { parse } from "smol-toml";

const root = new URL("../", import.meta.url);

/** All of them, in the order of `carom scenes`: name, title, dim, about, and the scene as a document. */
export function scenes() {
  const list = readFileSync(new URL("crates/carom-scene/src/builtin.rs", root), "utf8");
  const names = [.../ALL: &\[Builtin\] = builtins!\[([^\]]*)\]/.exec(list)[1].matchAll(/"([^"]+)"/g)].map((m) => m[1]);
  return names.map((name) => {
    const text = readFileSync(new URL(`scenes/${name}.toml`, root), "utf8");
    const document = parse(text);
    return { name, title: document.title ?? name, dim: document.world.dim, about: about(text), document };
  });
}

/** The first paragraph of the file's own comment. */
function about(text) {
  const comment = [];
  for (const line of text.split("\n")) {
    if (!line.startsWith("#")) break;
    const words = line.replace(/^#\s?/, "");
    if (words === "" && comment.length > 0) break;
    comment.push(words);
  }
  return comment.join(" ");
}
