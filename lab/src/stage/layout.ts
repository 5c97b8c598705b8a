// Which arrows the stage shows, as data: the drawing, the pictures that are saved and the tests all use this list.
import type { App } from "../app.ts";
import type { Impact } from "../engine/types.ts";
import { fmt } from "../words/index.ts";
import { impulseLetter } from "../settings.ts";
import type { Arrow, Quantity } from "./arrows.ts";
import type { Camera } from "./camera.ts";

/** Beyond this many bodies arrows would hide everything. */
export const MOST_ARROWS = 40;

/** Pixels per m/s, per kg m/s and per N s: the largest of the scene gets a fair share of the stage. */
export function scales(app: App, camera: Camera): Record<"v" | "p" | "J", number> {
  const room = 0.24 * Math.min(camera.width, camera.height * 1.6);
  let [v, p, J] = [0, 0, 0];
  const { start, description, instant, frame } = app;
  const count = Math.min(description.bodies.length, MOST_ARROWS);
  for (let k = 0; k < count; k++) {
    for (const f of [start, frame]) {
      const speed = Math.hypot(...f.velocity(k));
      v = Math.max(v, speed);
      p = Math.max(p, speed * (description.bodies[k].mass ?? 0));
    }
  }
  for (const impact of instant) {
    J = Math.max(J, Math.hypot(impact.impulse, ...impact.friction_impulse));
    impact.after.forEach((motion, side) => {
      const speed = Math.hypot(...motion.velocity);
      const k = description.bodies.findIndex((b) => b.name === impact.bodies[side]);
      v = Math.max(v, speed, Math.hypot(...impact.before[side].velocity));
      p = Math.max(p, speed * (description.bodies[k]?.mass ?? 0));
    });
  }
  const each = (x: number) => (x > 0 ? room / x : 0);
  // Many contacts at one instant would hide the bodies.
  return { v: each(v), p: each(p), J: each(J) * (instant.length > 4 ? 0.45 : 1) };
}

/** All arrows of the stage as it stands, in pixels. */
export function arrows(app: App, camera: Camera): Arrow[] {
  const all: Arrow[] = [];
  const { show, frame, description } = app;
  const scale = scales(app, camera);
  const count = description.bodies.length;
  const at = app.atImpact && app.impact ? app.impact : null;
  const hidden = app.predicting;
  const flat = (w: number[]): [number, number] => [w[0], -(w[1] ?? 0)];
  const add = (quantity: Quantity, name: string, point: number[], w: number[], k: number, dashed: boolean, label?: string, lift = 0, who?: string) => {
    const [x, y] = camera.to(point);
    const [dx, dy] = flat(w);
    // On the line, arrows of different kinds stand above one another.
    const from: [number, number] = [x, y + lift];
    all.push({ quantity, name, from, to: [from[0] + dx * k, from[1] + dy * k], dashed, label: show.values ? label : undefined, who });
  };
  if (count > MOST_ARROWS) return all;
  const line = description.dim === 1;
  const lift = (body: number, floor: number) => (line ? -(description.bodies[body].radius * camera.scale + floor) : 0);
  description.bodies.forEach((body, k) => {
    const side = at ? at.bodies.indexOf(body.name) : -1;
    const position = frame.position(k);
    let velocity = frame.velocity(k);
    const mass = body.mass;
    const who = count > 1 && count <= 8 ? initials(body.name) : undefined;
    if (at && side >= 0) {
      const { before, after } = at;
      const was = before[side].velocity;
      const is = after[side].velocity;
      const index = side + 1;
      if (show.v) {
        // At the impact both bodies have two arrows at nearly one place: a lane for each.
        const lane = floor(app, side);
        if (app.stage !== "after") add("v", `v${index}`, position, was, scale.v, app.stage === "at", speed("v", was), lift(k, lane), who);
        if (app.stage !== "before" && !hidden) add("v", `v${index}-after`, position, is, scale.v, false, speed("v′", is), lift(k, app.stage === "at" ? lane + 23 : lane), who);
        // What the learner says so far.
        const said = app.predicting ? app.answers.find((answer) => answer.body === k) : undefined;
        if (said?.velocity.every((x) => !Number.isNaN(x))) add("cm", `answer${index}`, position, said.velocity, scale.v, false, `${speed("v′", said.velocity) || "v′ = 0"} ?`, lift(k, lane + 23), who);
      }
      if (show.p && mass !== null) {
        const w = app.stage === "before" || hidden ? was : is;
        add("p", app.stage === "before" ? `p${index}` : `p${index}-after`, position, w.map((x) => x * mass), scale.p, false, amount(app.settings.momentum, w, mass), lift(k, app.stage === "at" ? 108 : 40), who);
      }
      return;
    }
    if (hidden && app.chosen > 0 && frame.time >= app.marks[app.chosen - 1]) velocity = [0];
    if (body.fixed && velocity.every((x) => x === 0)) return;
    if (show.v) add("v", `v:${body.name}`, position, velocity, scale.v, false, count <= 8 ? speed("v", velocity) : undefined, lift(k, 14), who);
    if (show.p && mass !== null) add("p", `p:${body.name}`, position, velocity.map((x) => x * mass), scale.p, false, count <= 8 ? amount(app.settings.momentum, velocity, mass) : undefined, lift(k, 36), who);
  });
  if (at && app.stage !== "before") {
    for (const impact of app.instant) contact(app, camera, impact, scale, add, hidden);
  }
  return all;
}

/** On the line, how far above its ball the velocity of one side of the impact is drawn (px). */
export function floor(app: App, side: number): number {
  return 14 + (app.stage === "at" || app.predicting ? 46 : 26) * (1 - side);
}

type Add = (quantity: Quantity, name: string, point: number[], w: number[], k: number, dashed: boolean, label?: string, lift?: number, who?: string) => void;

/** The impulse pair, and the velocities split along and across the normal. */
function contact(app: App, camera: Camera, impact: Impact, scale: Record<"v" | "p" | "J", number>, add: Add, hidden: boolean): void {
  const { show, description, frame } = app;
  const line = description.dim === 1;
  const n = impact.normal;
  const main = impact === app.impact;
  if (show.J && !hidden) {
    const on = impact.normal.map((x, k) => x * impact.impulse + (impact.friction_impulse[k] ?? 0));
    const drop = line ? Math.max(...description.bodies.map((b) => b.radius)) * camera.scale + 22 : 0;
    const text = `${impulseLetter(app.settings)} = ${fmt(Math.hypot(...on))} N s`;
    // Equal and opposite, from the point of contact: -J on the first, +J on the second.
    add("J", "Fh1", impact.point, on.map((x) => -x), scale.J, false, undefined, drop);
    add("J", "Fh2", impact.point, on, scale.J, false, main ? text : undefined, drop);
  }
  if (show.nt && main && !line) {
    impact.bodies.forEach((name, side) => {
      const k = description.bodies.findIndex((b) => b.name === name);
      if (k < 0 || description.bodies[k].fixed) return;
      const motion = app.stage === "at" && hidden ? impact.before[side] : app.stage === "at" ? impact.before[side] : impact.after[side];
      if (app.stage === "after" && hidden) return;
      const v = motion.velocity;
      const along = v.reduce((sum, x, c) => sum + x * n[c], 0);
      const part = n.map((x) => x * along);
      const mark = app.stage === "after" ? "-after" : "";
      const position = frame.position(k);
      add("n", `vp${side + 1}${mark}`, position, part, scale.v, true);
      add("t", `${description.dim === 2 ? "vn" : "vt"}${side + 1}${mark}`, position, v.map((x, c) => x - part[c]), scale.v, true);
    });
  }
}

/** A name short enough for a ball or a letter below the line: A, ball-12 as 12, cue, object as O. */
export function initials(name: string): string {
  return name.length <= 3 ? name : (name.match(/\d+$/)?.[0] ?? name[0].toUpperCase());
}

function speed(letter: string, v: number[]): string {
  const x = v.length === 1 ? v[0] : Math.hypot(...v);
  return x === 0 ? "" : `${letter} = ${fmt(x)} m/s`;
}

function amount(letter: string, v: number[], mass: number): string {
  const x = v.length === 1 ? v[0] * mass : Math.hypot(...v) * mass;
  return x === 0 ? "" : `${letter} = ${fmt(x)} kg m/s`;
}
