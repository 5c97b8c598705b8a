// uPlot, in a part of its own: the first picture of a scene does not wait for it.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";

export { uPlot };
