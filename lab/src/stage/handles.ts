// What can be taken hold of: balls and the tips of their velocities, as elements over the canvas. So mouse, finger and keyboard
// are one thing, and the order of Tab is that of the bodies.
import type { App } from "../app.ts";
import { h } from "../dom.ts";
import { t, vector } from "../words/index.ts";
import { scales } from "./layout.ts";
import type { Stage } from "./stage.ts";

/** More bodies than this are moved by the table only. */
const MOST = 12;

interface Handle {
  body: number;
  kind: "ball" | "tip";
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

  const value = (handle: Handle): number[] => {
    const body = app.document.body![handle.body];
    return handle.kind === "ball" ? body.position : (body.velocity ?? new Array(app.dim).fill(0));
  };

  const change = (handle: Handle, next: number[]) => {
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

  app.on("scene", build);
  return {
    place() {
      build();
      // Bodies are placed for the start; on the way they are where the engine says.
      const shown = app.frame.time === 0 && !app.playing;
      layer.hidden = !shown;
      if (!shown || all.length === 0) return;
      scale = scales(app, stage.camera).v || 40;
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
        const size = handle.kind === "ball" ? 2 * r : 28;
        handle.element.style.left = `${x - size / 2}px`;
        handle.element.style.top = `${y - size / 2}px`;
        handle.element.style.width = handle.element.style.height = `${size}px`;
        const name = body.name ?? `${handle.body + 1}`;
        const what = t(handle.kind === "ball" ? "stage.position" : "stage.velocity", { name, value: vector(value(handle), 4) });
        if (handle.element.getAttribute("aria-label") !== what) handle.element.setAttribute("aria-label", what);
      }
    },
  };
}

/** Without the dust that sums of hundredths gather. */
function tidy(x: number): number {
  return Number(x.toPrecision(12));
}
