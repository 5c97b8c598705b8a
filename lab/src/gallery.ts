// The built-in scenes of the engine, one idea each. The build makes the list from the files in `scenes/`.
import list from "carom:scenes";
import type { SceneDocument } from "./engine/types.ts";

export interface Builtin {
  name: string;
  title: string;
  dim: number;
  /** The first paragraph of the file's own comment. */
  about: string;
  document: SceneDocument;
}

export const builtins: Builtin[] = list;

/** The text of a built-in scene; null if there is none of that name. */
export function builtin(name: string): string | null {
  const found = builtins.find((b) => b.name === name);
  return found ? JSON.stringify(found.document) : null;
}
