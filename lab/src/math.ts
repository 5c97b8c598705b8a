// LaTeX of the engine as elements, set once for each text. Letters carry their names as `data-q`, can be pointed at and focused.
import katex from "katex";
import "katex/dist/katex.min.css";

const set = new Map<string, HTMLElement>();
const MOST = 3000;

export function math(tex: string): HTMLElement {
  let known = set.get(tex);
  if (!known) {
    known = document.createElement("span");
    known.className = "math";
    katex.render(tex, known, { throwOnError: false, trust: (context) => context.command === "\\htmlData", strict: false, output: "htmlAndMathml" });
    if (set.size > MOST) set.clear();
    set.set(tex, known);
  }
  return known.cloneNode(true) as HTMLElement;
}
