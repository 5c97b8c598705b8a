// What can be taken hold of: balls and the tips of their velocities, as elements over the canvas. So mouse, finger and keyboard
// are one thing, and the order of Tab is that of the bodies.
import type { App } from "../app.ts";
import { h } from "../dom.ts";
import { t, vector } from "../words/index.ts";
import { floor, scales } from "./layout.ts";
import type { Stage } from "./stage.ts";

/** More bodies than this are moved by the table only. */
const MOST = 12;

interface Handle {
  body: number;
  /** A ball, the tip of its velocity at the start, or that of the velocity that the learner predicts. */
  kind: "ball" | "tip" | "answer";
  element: HTMLButtonElement;
}

export function handles(app: App, stage: Stage): { place(): void } {
  const layer = h("div", { class: "handles", role: "group", aria: { label: t("stage.handles") } });
  stage.element.append(layer);
  let all: Handle[] = [];
  let scale = 1;

  const build = () => {
    const own = app.description.bodies.filter((b) => b.own !== null).length;
    const wanted = app.dim < 3 && own > 0 && own <= MOST ? own : 0;
    if (all.length === 2 * wanted) return;
    all = [];
    layer.replaceChildren();
    for (let body = 0; body < wanted; body++) {
      for (const kind of ["ball", "tip"] as const) {
        const element = h("button", { class: `handle handle-${kind}`, data: { body, kind }, type: "button" });
        const handle: Handle = { body, kind, element };
        drag(handle);
        element.addEventListener("keydown", (event) => key(handle, event));
        all.push(handle);
        layer.append(element);
      }
    }
  };

  /** The tips of what is predicted. */
  let answers: Handle[] = [];
  const ask = () => {
    const wanted = app.predicting && app.atImpact && app.dim < 3 ? app.answers.map((answer) => answer.body) : [];
    if (wanted.length === answers.length && wanted.every((body, k) => answers[k].body === body)) return;
    answers.forEach((handle) => handle.element.remove());
    answers = wanted.map((body) => {
      const element = h("button", { class: "handle handle-tip handle-answer", data: { body, kind: "answer" }, type: "button" });
      const handle: Handle = { body, kind: "answer", element };
      drag(handle);
      element.addEventListener("keydown", (event) => key(handle, event));
      layer.append(element);
      return handle;
    });
  };
  const said = (handle: Handle) => app.answers.find((answer) => answer.body === handle.body)!;

  const value = (handle: Handle): number[] => {
    // Where nothing is said yet, the arrow begins as that before the impact.
    if (handle.kind === "answer") return said(handle).velocity.map((x, c) => (Number.isNaN(x) ? (app.impact?.before[said(handle).side].velocity[c] ?? 0) : x));
    const body = app.document.body![handle.body];
    return handle.kind === "ball" ? body.position : (body.velocity ?? new Array(app.dim).fill(0));
  };

  const change = (handle: Handle, next: number[]) => {
    if (handle.kind === "answer") {
      said(handle).velocity = next;
      app.tell("answer");
      return;
    }
    if (app.locked.has(handle.kind === "ball" ? "position" : "velocity")) return;
    void app.edit((document) => {
      const body = document.body![handle.body];
      if (handle.kind === "ball") body.position = next;
      else body.velocity = next;
    });
  };

  const key = (handle: Handle, event: KeyboardEvent) => {
    const step = event.shiftKey ? 0.1 : 0.01;
    const move: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const by = move[event.key];
    if (!by || event.altKey || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    change(handle, value(handle).map((x, k) => tidy(x + (by[k] ?? 0) * step)));
  };

  const drag = (handle: Handle) => {
    let from: { x: number; y: number; at: number[] } | null = null;
    const { element } = handle;
    element.addEventListener("pointerdown", (event) => {
      event.preventDefault();
      element.focus();
      element.setPointerCapture(event.pointerId);
      from = { x: event.clientX, y: event.clientY, at: value(handle).slice() };
    });
    element.addEventListener("pointermove", (event) => {
      if (!from) return;
      const k = handle.kind === "ball" ? stage.camera.scale : scale;
      const by = [(event.clientX - from.x) / k, -(event.clientY - from.y) / k];
      // To the pixel, and no further: 1.23, not 1.2345678.
      const grain = 10 ** Math.floor(Math.log10(1 / k));
      change(handle, from.at.map((x, c) => (by[c] === 0 || by[c] === undefined ? x : tidy(Math.round((x + by[c]) / grain) * grain))));
    });
    for (const end of ["pointerup", "pointercancel"] as const) element.addEventListener(end, () => (from = null));
  };

  /** Puts a handle where it is, and says what it holds. */
  const put = (handle: Handle, x: number, y: number, size: number, what: string) => {
    const { style } = handle.element;
    style.left = `${x - size / 2}px`;
    style.top = `${y - size / 2}px`;
    style.width = style.height = `${size}px`;
    if (handle.element.getAttribute("aria-label") !== what) handle.element.setAttribute("aria-label", what);
  };

  app.on("scene", build);
  return {
    place() {
      build();
      ask();
      // Bodies are placed for the start; on the way they are where the engine says.
      const shown = app.frame.time === 0 && !app.playing && answers.length === 0;
      layer.hidden = !shown && answers.length === 0;
      for (const { element } of all) element.hidden = !shown;
      scale = scales(app, stage.camera).v || 40;
      for (const handle of answers) {
        const v = value(handle);
        const [x, y] = stage.camera.to(app.frame.position(handle.body));
        const lift = app.dim === 1 ? app.description.bodies[handle.body].radius * stage.camera.scale + floor(app, said(handle).side) + 23 : 0;
        put(handle, x + v[0] * scale, y - (v[1] ?? 0) * scale - lift, 28, t("stage.answer", { name: app.description.bodies[handle.body].name, value: vector(v, 4) }));
      }
      if (!shown) return;
      for (const handle of all) {
        const body = app.document.body?.[handle.body];
        if (!body) continue;
        const position = body.position;
        let [x, y] = stage.camera.to(position);
        const r = Math.max(12, body.radius * stage.camera.scale);
        if (handle.kind === "tip") {
          const v = value(handle);
          const lift = app.dim === 1 ? r + 14 : 0;
          const still = v.every((c) => c === 0);
          x += v[0] * scale + (still ? r + 10 : 0);
          y -= (v[1] ?? 0) * scale + lift;
        }
        const name = body.name ?? `${handle.body + 1}`;
        put(handle, x, y, handle.kind === "ball" ? 2 * r : 28, t(handle.kind === "ball" ? "stage.position" : "stage.velocity", { name, value: vector(value(handle), 4) }));
      }
    },
  };
}

/** Without the dust that sums of hundredths gather. */
function tidy(x: number): number {
  return Number(x.toPrecision(12));
}
