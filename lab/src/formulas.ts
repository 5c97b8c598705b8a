// KaTeX with its letters, in a part of its own: the first picture of a scene does not wait for it.
import katex from "katex";
import "katex/dist/katex.min.css";

export { katex };
