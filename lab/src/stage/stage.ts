// The stage: the scene at one time on a canvas, with its arrows.
import type { App } from "../app.ts";
import { h } from "../dom.ts";
import type { Impact } from "../engine/types.ts";
import { fmt, t } from "../words/index.ts";
import { type Arrow, breadth, draw as drawArrow, write } from "./arrows.ts";
import { clusters } from "./clusters.ts";
import { drawBodies, drawNames, drawWalls, type Ink } from "./bodies.ts";
import { Camera, extent } from "./camera.ts";
import { handles } from "./handles.ts";
import { type Box, places, type Wish } from "./labels.ts";
import { arrows, initials, MOST_ARROWS } from "./layout.ts";
import { drawMarks, drawSpin, Turns, turning } from "./spin.ts";

const FONT = '"Source Sans 3 Variable", system-ui, sans-serif';

export class Stage {
  readonly element: HTMLElement;
  readonly canvas: HTMLCanvasElement;
  readonly camera = new Camera();
  /** What was drawn last. */
  drawn: Arrow[] = [];
  /** The name of the letter that an equation points at. */
  hot = "";
  /** The names of bodies that touch and move as one. */
  clusters: string[][] = [];
  /** Where the next two will touch: middles and radii (px). */
  ghosts: [number, number, number][] = [];
  private app: App;
  private pending = false;
  private moved = false;
  private scenes = 0;
  private trail: [number, number][][] = [];
  private turns = new Turns();
  /** The fastest spin of the scene that has been seen (rad/s): the longest arrow. */
  private fastest = 0;
  /** Which of its places each label took. */
  private stood = new Map<string, number>();
  private overlay: { place(): void };

  constructor(app: App) {
    this.app = app;
    this.canvas = h("canvas", { class: "stage-canvas", role: "img", aria: { label: t("stage.label"), describedby: "stage-summary" } });
    const fit = h("button", { class: "stage-fit quiet", onclick: () => this.fit(), title: t("stage.fit") }, t("stage.fit"));
    this.element = h("div", { class: "stage" }, this.canvas, fit);
    this.overlay = handles(app, this);
    new ResizeObserver(() => this.resize()).observe(this.element);
    // A canvas does not wait for its letters.
    void document.fonts.load(`600 14px ${FONT}`).then(() => this.redraw());
    this.listen();
  }

  private listen(): void {
    const { app } = this;
    app.on("scene", () => {
      // A scene is looked at as a whole when it is opened; while it is changed, the view must not move under the hand.
      if (++this.scenes === 1 && !this.moved) this.aim();
      this.trail = [];
      this.fastest = 0;
      this.redraw();
    });
    app.on("survey", () => {
      if (!this.moved && this.scenes <= 1) void this.aimByImpacts();
    });
    app.on("frame", () => this.turns.pass(app.frame));
    for (const topic of ["frame", "impact", "show", "stage", "problems", "predict", "answer", "play"] as const) app.on(topic, () => this.redraw());
    this.canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.camera.zoom(Math.exp(-event.deltaY * 0.0015), event.offsetX, event.offsetY);
      this.moved = true;
      this.redraw();
    }, { passive: false });
    const fingers = new Map<number, [number, number]>();
    this.canvas.addEventListener("pointerdown", (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, [event.offsetX, event.offsetY]);
    });
    this.canvas.addEventListener("pointermove", (event) => {
      const last = fingers.get(event.pointerId);
      if (!last) return;
      const now: [number, number] = [event.offsetX, event.offsetY];
      const others = [...fingers].filter(([id]) => id !== event.pointerId).map(([, p]) => p);
      if (others.length === 1) {
        const [o] = others;
        const before = Math.hypot(last[0] - o[0], last[1] - o[1]);
        const after = Math.hypot(now[0] - o[0], now[1] - o[1]);
        if (before > 5) this.camera.zoom(after / before, (now[0] + o[0]) / 2, (now[1] + o[1]) / 2);
      } else if (others.length === 0) {
        this.camera.x -= (now[0] - last[0]) / this.camera.scale;
        this.camera.y += (now[1] - last[1]) / this.camera.scale;
      }
      this.moved = true;
      fingers.set(event.pointerId, now);
      this.redraw();
    });
    for (const end of ["pointerup", "pointercancel"] as const) this.canvas.addEventListener(end, (event) => fingers.delete(event.pointerId));
  }

  /** Back to the view that shows the whole scene. */
  fit(): void {
    this.moved = false;
    this.aim();
    void this.aimByImpacts();
    this.redraw();
  }

  private aim(impacts: Impact[] = []): void {
    if (!this.app.description) return;
    this.camera.fit(extent(this.app.description, this.app.start, impacts));
    if (this.app.dim === 1) this.camera.y = 0;
  }

  private async aimByImpacts(): Promise<void> {
    if (this.app.description.corners) return;
    const lines = await this.app.client.lines(1, 60);
    if (this.moved) return;
    this.aim(lines);
    this.redraw();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.element;
    if (clientWidth === 0 || clientHeight === 0) return;
    const ratio = Math.min(2, devicePixelRatio || 1);
    this.canvas.width = Math.round(clientWidth * ratio);
    this.canvas.height = Math.round(clientHeight * ratio);
    const first = this.camera.width === 1;
    this.camera.width = clientWidth;
    this.camera.height = clientHeight;
    if (!this.moved || first) this.fit();
    this.redraw();
  }

  redraw(): void {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      if (!this.app.description || !this.app.frame) return;
      const context = this.canvas.getContext("2d", { alpha: false, willReadFrequently: true });
      if (!context) return;
      const ratio = this.canvas.width / this.camera.width;
      this.paint(context, ratio);
      this.overlay.place();
    });
  }

  /** Draws everything, at `ratio` pixels of the canvas per pixel of the page. */
  paint(c: CanvasRenderingContext2D, ratio: number): void {
    const { app, camera } = this;
    const d = app.description;
    const ink = inks();
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.fillStyle = ink.paper;
    c.fillRect(0, 0, camera.width, camera.height);
    if (app.show.grid) grid(c, camera, ink);
    if (d.dim === 1) lane(c, camera, ink);
    drawWalls(c, camera, d, app.frame.time, ink);
    if (app.show.trail) this.drawTrails(c, ink);
    this.drawGhosts(c, ink);
    drawBodies(c, camera, d, app.frame, ink);
    const spins = d.dim === 2 && app.show.spin && app.frame.count <= 200 ? this.drawSpins(c, ink) : [];
    this.drawClusters(c, ink);
    this.drawOverlaps(c, ink);
    const letters: Box[] = [];
    if (app.atImpact && app.impact && app.show.nt && app.stage !== "before") this.drawContact(c, ink, letters);
    this.drawn = arrows(app, camera);
    for (const arrow of this.drawn) drawArrow(c, arrow, ink.colour(arrow.quantity), ink.paper, arrow.name === this.hot);
    drawNames(c, camera, d, app.frame, ink);
    this.drawLabels(c, ink, spins, letters);
    if (app.show.cm) this.drawCentre(c, ink);
    if (d.dim > 1 || app.show.grid) ruler(c, camera, ink);
  }

  /** Where the two that meet next will touch. */
  private drawGhosts(c: CanvasRenderingContext2D, ink: Inks): void {
    const { app, camera } = this;
    const { impact, frame, description } = app;
    this.ghosts = [];
    if (!impact || app.playing || app.problems.length > 0 || frame.count > MOST_ARROWS || frame.time >= impact.time) return;
    c.save();
    c.setLineDash([3, 4]);
    c.lineWidth = 1.5;
    c.strokeStyle = ink.ink;
    c.globalAlpha = 0.4;
    impact.bodies.forEach((name, side) => {
      const body = description.bodies.find((b) => b.name === name);
      if (!body || body.fixed) return;
      const away = (side === 0 ? -1 : 1) * body.radius;
      const [x, y] = camera.to(impact.point.map((p, k) => p + away * impact.normal[k]));
      const r = body.radius * camera.scale;
      this.ghosts.push([x, y, r]);
      c.beginPath();
      c.arc(x, y, r, 0, 2 * Math.PI);
      c.stroke();
    });
    c.restore();
  }

  /** What is written beside arrows and spins. */
  private drawLabels(c: CanvasRenderingContext2D, ink: Inks, spins: { wish: Wish; label: string; who?: string }[], letters: Box[]): void {
    const { app, camera } = this;
    const written = this.drawn.filter((arrow) => arrow.label);
    const wishes = written.map((arrow): Wish => ({ name: arrow.name, width: breadth(c, arrow.label!, arrow.who), from: arrow.from, to: arrow.to }));
    const discs = app.frame.count <= MOST_ARROWS ? app.description.bodies.map((body, k): [number, number, number] => [...camera.to(app.frame.position(k)), body.radius * camera.scale]) : [];
    // The button that fits the view stands in its corner.
    const boxes: Box[] = [...letters, [camera.width - 70, 0, camera.width, 38]];
    const ground = { width: camera.width, height: camera.height, arrows: this.drawn, discs, boxes };
    const at = places([...wishes, ...spins.map((s) => s.wish)], ground, this.stood);
    written.forEach((arrow, k) => write(c, arrow.label!, arrow.who, (arrow.place = at[k]), ink.colour(arrow.quantity), ink.paper));
    spins.forEach((s, k) => write(c, s.label, s.who, at[written.length + k], ink.colour("v"), ink.paper));
  }

  /** Marks that go round, and the spins as arrows: at an impact those before or after it. Their labels are written with those of arrows. */
  private drawSpins(c: CanvasRenderingContext2D, ink: Inks): { wish: Wish; label: string; who?: string }[] {
    const { app, camera } = this;
    const { frame, description, impact } = app;
    const at = app.atImpact && impact ? impact : null;
    if (!turning(frame) && !turning(app.start) && !at?.before.some((m) => m.spin.some((w) => w !== 0))) return [];
    drawMarks(c, camera, description, frame, this.turns, "#10151c");
    if (frame.count > MOST_ARROWS || !app.show.v) return [];
    const spins = description.bodies.map((body, k) => {
      const side = at ? at.bodies.indexOf(body.name) : -1;
      if (at && side >= 0 && (app.stage === "before" || app.predicting)) return at.before[side].spin[0] ?? 0;
      if (at && side >= 0) return at.after[side].spin[0] ?? 0;
      return frame.spin(k)[0] ?? 0;
    });
    this.fastest = Math.max(this.fastest, ...spins.map(Math.abs), ...(at ? at.before.map((m) => Math.abs(m.spin[0] ?? 0)) : []));
    const middle = description.bodies.reduce((sum, _, k) => sum + camera.to(frame.position(k))[0], 0) / frame.count;
    const labels: { wish: Wish; label: string; who?: string }[] = [];
    spins.forEach((spin, k) => {
      // Rounding is no spin.
      if (Math.abs(spin) < 1e-9 * this.fastest || description.bodies[k].fixed) return;
      const [x, y] = camera.to(frame.position(k));
      const r = Math.max(3, description.bodies[k].radius * camera.scale);
      drawSpin(c, x, y, r, spin, Math.abs(spin) / this.fastest, ink.colour("v"), ink.paper);
      if (!app.show.values || frame.count > 8) return;
      const label = `ω = ${fmt(spin)} rad/s`;
      const who = frame.count > 1 ? initials(description.bodies[k].name) : undefined;
      // At the outer side, where arrows seldom are.
      const to: [number, number] = [x + (x < middle ? -1 : 1) * (r + 9), y + 9];
      labels.push({ label, who, wish: { name: `spin:${k}`, width: breadth(c, label, who), from: [x, y + 9], to } });
    });
    return labels;
  }

  /** The point of contact, the line of centres and the tangent. */
  private drawContact(c: CanvasRenderingContext2D, ink: Inks, taken: Box[]): void {
    const { app, camera } = this;
    const impact = app.impact!;
    if (app.dim === 1) return;
    const [x, y] = camera.to(impact.point);
    const [nx, ny] = [impact.normal[0], -(impact.normal[1] ?? 0)];
    // Beyond the arrows of the impulse.
    const reach = 0.24 * Math.min(camera.width, 1.6 * camera.height) + 24;
    c.save();
    c.strokeStyle = ink.colour("n");
    c.lineWidth = 1.25;
    c.setLineDash([2, 5]);
    for (const [dx, dy] of [[nx, ny], [-ny, nx]]) {
      c.beginPath();
      c.moveTo(x - dx * reach, y - dy * reach);
      c.lineTo(x + dx * reach, y + dy * reach);
      c.stroke();
    }
    c.setLineDash([]);
    c.fillStyle = ink.colour("n");
    c.font = `italic 600 16px KaTeX_Main, Georgia, serif`;
    c.textAlign = "center";
    c.textBaseline = "middle";
    const inside = (at: number, size: number) => Math.min(Math.max(at, 14), size - 14);
    const letter = (text: string, dx: number, dy: number) => {
      const [left, top] = [inside(x + dx * (reach + 12), camera.width), inside(y + dy * (reach + 12), camera.height)];
      c.fillText(text, left, top);
      taken.push([left - 8, top - 8, left + 8, top + 8]);
    };
    letter("n", nx, ny);
    letter("t", -ny, nx);
    c.beginPath();
    c.arc(x, y, 3, 0, 7);
    c.fill();
    c.restore();
  }

  private drawOverlaps(c: CanvasRenderingContext2D, ink: Inks): void {
    const { app, camera } = this;
    // Where the scene is impossible the engine has none to show: the bodies stand where they were dragged to.
    if (app.problems.length === 0) return;
    const told = new Set(app.problems.map((problem) => Number(/^body\[(\d+)\]/.exec(problem.key)?.[1]) - 1));
    app.document.body?.forEach((body, k) => {
      const stood = app.start.count > k && body.position.every((x, axis) => x === app.start.position(k)[axis]);
      if (stood && !told.has(k)) return;
      const [x, y] = camera.to(body.position);
      c.save();
      c.globalAlpha = 0.5;
      c.fillStyle = ink.bodies[k % ink.bodies.length];
      c.beginPath();
      c.arc(x, y, body.radius * camera.scale, 0, 7);
      if (!stood) c.fill();
      c.globalAlpha = 1;
      c.strokeStyle = ink.colour("p");
      c.lineWidth = 3;
      c.setLineDash([5, 4]);
      c.beginPath();
      c.arc(x, y, body.radius * camera.scale + 3, 0, 7);
      c.stroke();
      c.restore();
    });
  }

  /** What has become one, by an inelastic collapse or a single impact with e = 0, is ringed and told. */
  private drawClusters(c: CanvasRenderingContext2D, ink: Inks): void {
    const { app, camera } = this;
    const { frame, description } = app;
    const found = app.predicting || (app.atImpact && app.stage !== "after") ? [] : clusters(description, app.start, frame);
    this.clusters = found.map((cluster) => cluster.map((k) => description.bodies[k].name));
    c.save();
    c.strokeStyle = ink.colour("cm");
    c.fillStyle = ink.colour("cm");
    c.lineWidth = 2;
    c.font = `600 13px ${FONT}`;
    c.textAlign = "center";
    c.textBaseline = "top";
    for (const cluster of found) {
      let [sum, low] = [0, 0];
      c.setLineDash([4, 4]);
      for (const k of cluster) {
        const [x, y] = camera.to(frame.position(k));
        const r = description.bodies[k].radius * camera.scale;
        c.beginPath();
        c.arc(x, y, r + 4, 0, 2 * Math.PI);
        c.stroke();
        sum += x;
        low = Math.max(low, y + r);
      }
      c.setLineDash([]);
      const names = cluster.length <= 6 ? this.clusters[found.indexOf(cluster)].join(", ") : String(cluster.length);
      const text = t("stage.cluster", { names });
      const half = c.measureText(text).width / 2 + 6;
      // Below the pair of impulses, where there is one.
      const drop = app.atImpact && description.dim === 1 ? 46 : 10;
      c.lineWidth = 4;
      c.strokeStyle = ink.paper;
      const x = Math.min(Math.max(sum / cluster.length, half), camera.width - half);
      c.strokeText(text, x, low + drop);
      c.fillText(text, x, low + drop);
      c.strokeStyle = ink.colour("cm");
      c.lineWidth = 2;
    }
    c.restore();
  }

  private drawCentre(c: CanvasRenderingContext2D, ink: Inks): void {
    const { app, camera } = this;
    const { frame, description } = app;
    let mass = 0;
    const sum = new Array(description.dim).fill(0);
    description.bodies.forEach((body, k) => {
      if (body.fixed || body.mass === null) return;
      mass += body.mass;
      frame.position(k).forEach((x, i) => (sum[i] += body.mass! * x));
    });
    if (mass === 0) return;
    const [x, y] = camera.to(sum.map((s) => s / mass));
    c.save();
    c.strokeStyle = ink.colour("cm");
    c.lineWidth = 3;
    c.beginPath();
    for (const [dx, dy] of [[7, 7], [7, -7]]) {
      c.moveTo(x - dx, y - dy);
      c.lineTo(x + dx, y + dy);
    }
    c.stroke();
    c.fillStyle = ink.colour("cm");
    c.font = `600 13px ${FONT}`;
    c.textAlign = "left";
    c.fillText(t("stage.cm"), x + 11, y - 9);
    c.restore();
  }

  private drawTrails(c: CanvasRenderingContext2D, ink: Inks): void {
    const { app, camera } = this;
    const { frame } = app;
    if (frame.count > 200) return;
    if (frame.time === 0) this.trail = [];
    c.save();
    c.lineWidth = 1.5;
    c.globalAlpha = 0.6;
    for (let k = 0; k < frame.count; k++) {
      const points = (this.trail[k] ??= []);
      const p = frame.position(k);
      const last = points[points.length - 1];
      if (!last || last[0] !== p[0] || last[1] !== (p[1] ?? 0)) points.push([p[0], p[1] ?? 0]);
      if (points.length > 4000) points.splice(0, 1000);
      c.strokeStyle = ink.bodies[k % 6];
      c.beginPath();
      points.forEach((point, i) => {
        const [x, y] = camera.to(point);
        if (i === 0) c.moveTo(x, y);
        else c.lineTo(x, y);
      });
      c.stroke();
    }
    c.restore();
  }
}

export interface Inks extends Ink {
  colour(quantity: string): string;
}

/** The colours of the theme, read once per change of it. */
let known: { theme: string; inks: Inks } | null = null;
export function inks(): Inks {
  const theme = document.documentElement.dataset.theme ?? "light";
  if (known?.theme === theme) return known.inks;
  const style = getComputedStyle(document.documentElement);
  const read = (name: string) => style.getPropertyValue(`--${name}`).trim();
  const colours = new Map(["v", "p", "J", "n", "t", "cm"].map((q) => [q, read(`q-${q}`)]));
  const inks: Inks = {
    paper: read("stage"),
    ink: read("ink"),
    faint: read("grid"),
    wall: read("wall"),
    bodies: [...Array(12).keys()].map((k) => read(`body-${k}`)),
    colour: (q) => colours.get(q) ?? read("ink"),
  };
  known = { theme, inks };
  return inks;
}

/** A round length that is about `most` pixels or less. */
function round(camera: Camera, most: number): number {
  const raw = most / camera.scale;
  const power = 10 ** Math.floor(Math.log10(raw));
  const lead = raw / power;
  return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power;
}

function grid(c: CanvasRenderingContext2D, camera: Camera, ink: Ink): void {
  const step = round(camera, 90);
  const [x0, y1] = camera.from(0, 0);
  const [x1, y0] = camera.from(camera.width, camera.height);
  c.strokeStyle = ink.faint;
  c.lineWidth = 1;
  c.beginPath();
  for (let x = Math.ceil(x0 / step) * step; x <= x1; x += step) {
    const [px] = camera.to([x, 0]);
    c.moveTo(px, 0);
    c.lineTo(px, camera.height);
  }
  for (let y = Math.ceil(y0 / step) * step; y <= y1; y += step) {
    const [, py] = camera.to([0, y]);
    c.moveTo(0, py);
    c.lineTo(camera.width, py);
  }
  c.stroke();
}

/** The line of a scene on a line, with ticks. */
function lane(c: CanvasRenderingContext2D, camera: Camera, ink: Ink): void {
  const step = round(camera, 110);
  const [x0] = camera.from(0, 0);
  const [x1] = camera.from(camera.width, 0);
  const [, y] = camera.to([0, 0]);
  c.save();
  c.strokeStyle = ink.faint;
  c.fillStyle = ink.ink;
  c.lineWidth = 2;
  c.beginPath();
  c.moveTo(0, y);
  c.lineTo(camera.width, y);
  c.stroke();
  c.font = `500 13px ${FONT}`;
  c.textAlign = "center";
  c.textBaseline = "top";
  const base = camera.height - 30;
  c.lineWidth = 1;
  c.beginPath();
  c.moveTo(0, base);
  c.lineTo(camera.width, base);
  for (let k = Math.ceil(x0 / step); k * step <= x1; k++) {
    const [px] = camera.to([k * step]);
    c.moveTo(px, base - 5);
    c.lineTo(px, base + 5);
    c.globalAlpha = 0.75;
    const text = fmt(k * step, 3).replace(/([.,]\d*?)0+$/, "$1").replace(/[.,]$/, "");
    if (px > 20 && px < camera.width - 20) c.fillText(k === 0 ? "0" : text, px, base + 8);
    c.globalAlpha = 1;
  }
  c.strokeStyle = ink.wall;
  c.stroke();
  c.textAlign = "right";
  c.fillText("x / m", camera.width - 8, base - 22);
  c.restore();
}

function ruler(c: CanvasRenderingContext2D, camera: Camera, ink: Ink): void {
  const length = round(camera, 120);
  const wide = length * camera.scale;
  const [x, y] = [16, camera.height - 16];
  c.save();
  c.strokeStyle = ink.ink;
  c.globalAlpha = 0.75;
  c.lineWidth = 1.5;
  c.beginPath();
  c.moveTo(x, y - 5);
  c.lineTo(x, y);
  c.lineTo(x + wide, y);
  c.lineTo(x + wide, y - 5);
  c.stroke();
  c.fillStyle = ink.ink;
  c.font = `500 13px ${FONT}`;
  c.textBaseline = "bottom";
  c.textAlign = "center";
  c.fillText(`${fmt(length, 1)} m`, x + wide / 2, y - 3);
  c.restore();
}
