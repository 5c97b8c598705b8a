// LaTeX of the engine as elements, set once for each text. Letters carry their names as `data-q`, can be pointed at and focused.
import type Katex from "katex";

let katex: typeof Katex | null = null;
const set = new Map<string, HTMLElement>();
const MOST = 3000;

/** Loads what sets formulas: the page stands without it. */
export async function learn(): Promise<void> {
  katex ??= (await import("./formulas.ts")).katex;
}

/** The element of a formula, once that is loaded. */
export function math(tex: string): HTMLElement {
  let known = set.get(tex);
  if (!known) {
    known = document.createElement("span");
    known.className = "math";
    if (!katex) return known;
    katex.render(tex, known, { throwOnError: false, trust: (context) => context.command === "\\htmlData", strict: false, output: "htmlAndMathml" });
    if (set.size > MOST) set.clear();
    set.set(tex, known);
  }
  return known.cloneNode(true) as HTMLElement;
}
