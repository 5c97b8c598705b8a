// The built-in scenes of the engine, one idea each, and what the lab says of them.
import type { App } from "./app.ts";

export interface Builtin {
  name: string;
  title: string;
  text: string;
  dim: number;
  /** The first paragraph of the file's own comment. */
  about: string;
}

export async function builtins(app: App): Promise<Builtin[]> {
  const all = await app.client.builtins();
  return all.map((b) => {
    const lines = b.text.split("\n");
    const comment: string[] = [];
    for (const line of lines) {
      if (!line.startsWith("#")) break;
      const words = line.replace(/^#\s?/, "");
      if (words === "" && comment.length > 0) break;
      comment.push(words);
    }
    const dim = Number(/^\s*dim\s*=\s*(\d)/m.exec(b.text)?.[1] ?? 2);
    return { ...b, dim, about: comment.join(" ") };
  });
}
