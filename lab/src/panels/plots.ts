// Momentum and energy over time. The lines of energy are stacked, so that their sum is a flat line.
import type uPlot from "uplot";
import type { App } from "../app.ts";
import { h } from "../dom.ts";
import { inks } from "../stage/stage.ts";
import { fmt, t } from "../words/index.ts";

const AXES = ["x", "y", "z"];
const SAMPLES = 240;
/** Longer histories are plotted when asked for: a run anew takes its time. */
const MOST_IMPACTS = 30_000;

export interface Plots {
  element: HTMLElement;
  /** What is plotted, for the tests: time, total momentum, kinetic, potential and lost energy. */
  data(): { time: number[]; momentum: number[]; stacked: number[] };
}

let Plot: typeof uPlot | null = null;

export function plots(app: App): Plots {
  const axisPick = h("select", { aria: { label: t("plots.axis") } });
  const momentum = h("div", { class: "plot" });
  const energy = h("div", { class: "plot" });
  const note = h("p", { class: "quiet-text" });
  const element = h("section", { class: "panel plots", data: { panel: "plots" }, aria: { label: t("plots.title") } }, h("div", { class: "panel-head" }, h("h2", {}, t("plots.title")), axisPick), momentum, energy, note);
  let drawn: uPlot[] = [];
  let rows: Float64Array | null = null;
  let axis = 0;
  let wanted = 0;
  let shown = { time: [] as number[], momentum: [] as number[], stacked: [] as number[] };

  const load = async () => {
    if (!app.survey.done || app.survey.impacts > MOST_IMPACTS) {
      rows = null;
      note.textContent = app.survey.done ? t("plots.long") : "";
      draw();
      return;
    }
    note.textContent = "";
    const turn = ++wanted;
    const [next, module] = await Promise.all([app.client.samples(SAMPLES), import("./uplot.ts")]);
    Plot = module.uPlot;
    if (turn !== wanted) return;
    rows = next;
    draw();
  };
  let timer = 0;
  const later = () => {
    clearTimeout(timer);
    timer = window.setTimeout(() => void load(), 120);
  };

  const draw = () => {
    drawn.forEach((p) => p.destroy());
    drawn = [];
    momentum.replaceChildren();
    energy.replaceChildren();
    axisPick.replaceChildren(...AXES.slice(0, app.dim).map((a, k) => h("option", { value: String(k), selected: k === axis }, `${app.settings.momentum} ${app.dim === 1 ? "" : a}`)));
    axisPick.hidden = app.dim === 1;
    if (!Plot || !rows || rows.length < 2 || element.clientWidth === 0) return;
    const stride = rows[0];
    const count = (rows.length - 1) / stride;
    const column = (c: number) => Array.from({ length: count }, (_, k) => rows![1 + k * stride + c]);
    const time = column(0);
    const bodies = Math.min(app.description.bodies.length, (stride - 8) / 4);
    const ink = inks();
    const total = column(5 + axis);
    const hideAfter = app.predicting && app.marks.length > 0 ? app.marks[0] : Infinity;
    const hide = (v: number[]) => (hideAfter === Infinity ? v : v.map((x, k) => (time[k] > hideAfter || (time[k] === hideAfter && time[k - 1] === hideAfter) ? (null as unknown as number) : x)));
    const series: uPlot.Series[] = [{ label: t("plots.time") }];
    const data: number[][] = [time];
    for (let b = 0; b < bodies; b++) {
      if (app.description.bodies[b].fixed) continue;
      data.push(hide(column(8 + 4 * b + axis)));
      series.push({ label: app.description.bodies[b].name, stroke: ink.bodies[b % 6], width: 2, dash: b % 2 ? [6, 3] : undefined, points: { show: false } });
    }
    data.push(hide(total));
    series.push({ label: t("plots.total"), stroke: ink.ink, width: 2.5, points: { show: false } });
    const [kinetic, potential, lost] = [column(1), column(2), column(3)];
    const work = column(4);
    const lowest = Math.min(...potential, 0);
    const up = potential.map((x) => x - lowest);
    const first = kinetic;
    const second = kinetic.map((x, k) => x + up[k]);
    const third = second.map((x, k) => x + lost[k] - work[k]);
    shown = { time, momentum: total, stacked: third };
    const gravity = up.some((x) => x > 0);
    const size = { width: Math.max(200, element.clientWidth - 24), height: Math.max(110, Math.min(190, (element.clientHeight - 90) / 2)) };
    const letter = app.settings.momentum;
    drawn.push(new Plot({ ...common(size, `${letter}${app.dim > 1 ? ` ${AXES[axis]}` : ""} / kg m/s`), series }, data as uPlot.AlignedData, momentum));
    const areas: uPlot.Series[] = [{ label: t("plots.time") }];
    const stack: number[][] = [time, hide(third)];
    areas.push({ label: t("plots.lost"), stroke: ink.colour("p"), width: 2, points: { show: false } });
    if (gravity) {
      stack.push(hide(second));
      areas.push({ label: t("plots.potential"), stroke: ink.colour("t"), width: 1.5, points: { show: false } });
    }
    stack.push(hide(first));
    areas.push({ label: t("plots.kinetic"), stroke: ink.colour("v"), fill: tinted(ink.colour("v")), width: 2, points: { show: false } });
    const bands = stack.slice(2).map((_, k): uPlot.Band => ({ series: [k + 1, k + 2], fill: tinted(k === 0 ? ink.colour("p") : ink.colour("t")) }));
    drawn.push(new Plot({ ...common(size, "E / J", true), series: areas, bands }, stack as uPlot.AlignedData, energy));
    cursor();
  };

  const common = (size: { width: number; height: number }, label: string, zero = false): Omit<uPlot.Options, "series"> => {
    const style = getComputedStyle(document.documentElement);
    const line = style.getPropertyValue("--grid");
    const text = style.getPropertyValue("--soft");
    const ax = (extra: object): uPlot.Axis => ({ stroke: text, grid: { stroke: line, width: 1 }, ticks: { stroke: line, width: 1, size: 4 }, font: '12px "Source Sans 3 Variable", system-ui', ...extra });
    return {
      ...size,
      scales: { x: { time: false, range: [0, Math.max(app.end, 1e-12)] }, y: { range: (_u, low, high) => (zero ? [0, high * 1.08 || 1] : padded(low, high)) } },
      axes: [ax({ size: 26, values: (_: uPlot, v: number[]) => v.map((x) => short(x)) }), ax({ label, labelSize: 18, labelFont: 'italic 13px "Source Sans 3 Variable", system-ui', size: 44, values: (_: uPlot, v: number[]) => v.map((x) => short(x)) })],
      legend: { show: true, live: false },
      cursor: { show: true, drag: { x: false, y: false }, points: { show: false }, y: false },
      hooks: {
        ready: [
          (u) => {
            // A line of its own over the plot: it moves with every frame, and the plot need not be drawn again for it.
            u.over.append(h("div", { class: "plot-now" }));
            place(u);
            u.over.addEventListener("click", (event) => void app.seek(u.posToVal(event.clientX - u.over.getBoundingClientRect().left, "x")));
          },
        ],
      },
    };
  };

  const place = (p: uPlot) => {
    const line = p.over.querySelector<HTMLElement>(".plot-now");
    if (line) line.style.transform = `translateX(${p.valToPos(app.frame.time, "x")}px)`;
  };
  const cursor = () => drawn.forEach(place);
  axisPick.addEventListener("change", () => {
    axis = Number(axisPick.value);
    draw();
  });
  app.on("scene", () => {
    axis = Math.min(axis, app.dim - 1);
    later();
  });
  app.on("survey", later);
  app.on("predict", draw);
  app.on("frame", cursor);
  let width = 0;
  new ResizeObserver(() => {
    if (Math.abs(element.clientWidth - width) < 4) return;
    width = element.clientWidth;
    draw();
  }).observe(element);
  return { element, data: () => shown };
}

function short(x: number): string {
  return Math.abs(x) < 1e-12 ? "0" : fmt(x, 3).replace(/([.,]\d*?)0+(?=$|×)/, "$1").replace(/[.,](?=$|×)/, "");
}

function padded(low: number, high: number): [number, number] {
  const pad = 0.12 * Math.max(high - low, 0.1 * Math.max(Math.abs(high), Math.abs(low)), 1e-9);
  return [Math.min(low - pad, 0), Math.max(high + pad, 0)];
}

function tinted(colour: string): string {
  return `color-mix(in srgb, ${colour} 22%, transparent)`;
}
