// Files out of the page: impacts and samples as CSV, the scene as TOML, the stage as PNG and SVG, a worksheet to print.
import type { App } from "./app.ts";
import type { Impact } from "./engine/types.ts";
import { impulseLetter } from "./settings.ts";
import { pieces } from "./stage/arrows.ts";
import type { Stage } from "./stage/stage.ts";
import { inks } from "./stage/stage.ts";
import { t } from "./words/index.ts";

const AXES = ["x", "y", "z"];

export function download(name: string, content: Blob | string, type = "text/plain"): void {
  const blob = content instanceof Blob ? content : new Blob([content], { type });
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** A name for files: the title without what file systems dislike. */
export function fileName(app: App): string {
  const title = (app.builtin ?? app.description.title) || "scene";
  return title.toLowerCase().normalize("NFKD").replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "") || "scene";
}

function quote(text: string): string {
  return /[",\n\r]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/** One row for each impact, units in the heads, numbers with every digit (RFC 4180, decimal points). */
export async function impactsCsv(app: App): Promise<string> {
  const lines: Impact[] = [];
  for (let from = 1; from <= app.survey.kept; from += 500) lines.push(...(await app.client.lines(from, 500)));
  const { dim } = app;
  const axes = AXES.slice(0, dim);
  const spins = dim === 1 ? [] : dim === 2 ? [""] : AXES;
  const J = impulseLetter(app.settings);
  const e = app.settings.restitution;
  const head = ["n", "t (s)", "first", "second", ...axes.map((a) => `${a} (m)`), ...axes.map((a) => `n_${a}`), "u (m/s)", "u' (m/s)", e, `${J} (N s)`, ...axes.map((a) => `${J}_t${a} (N s)`)];
  for (const prime of ["", "'"]) {
    for (const body of ["1", "2"]) {
      head.push(...axes.map((a) => `v${body}${prime}_${a} (m/s)`), ...spins.map((a) => `w${body}${prime}${a ? `_${a}` : ""} (rad/s)`));
    }
  }
  head.push("lost (J)", "together");
  const rows = lines.map((l) => [
    l.n,
    l.time,
    ...l.bodies,
    ...l.point,
    ...l.normal,
    l.approach,
    l.departure,
    l.restitution,
    l.impulse,
    ...l.friction_impulse,
    ...[...l.before, ...l.after].flatMap((m) => [...m.velocity, ...m.spin]),
    l.lost,
    l.together,
  ]);
  return [head, ...rows].map((row) => row.map((x) => quote(String(x))).join(",")).join("\r\n") + "\r\n";
}

/** One row for each sample: time, energies, momenta. */
export async function samplesCsv(app: App): Promise<string> {
  const data = await app.client.samples(400);
  const stride = data[0];
  const p = app.settings.momentum;
  const axes = AXES.slice(0, app.dim);
  const bodies = app.description.bodies.slice(0, (stride - 8) / 4);
  const head = ["t (s)", "K (J)", "U (J)", "lost (J)", "work (J)", ...axes.map((a) => `${p}_${a} (kg m/s)`), ...bodies.flatMap((b) => [...axes.map((a) => `${p}_${a} ${b.name} (kg m/s)`), `K ${b.name} (J)`])];
  const rows: string[] = [];
  for (let at = 1; at + stride <= data.length; at += stride) {
    const row = Array.from(data.subarray(at, at + stride));
    const cells = [...row.slice(0, 5), ...row.slice(5, 5 + app.dim)];
    bodies.forEach((_, k) => cells.push(...row.slice(8 + 4 * k, 8 + 4 * k + app.dim), row[8 + 4 * k + 3]));
    rows.push(cells.join(","));
  }
  return [head.map(quote).join(","), ...rows].join("\r\n") + "\r\n";
}

/** What the tab shows, as a picture at twice its size, and, of a flat stage, as a drawing. */
export interface Picture {
  png(): Promise<Blob>;
  svg?(): string;
}

/** A picture of this size in pixels of the page, painted at twice that. */
export function picture(width: number, height: number, paint: (c: CanvasRenderingContext2D, ratio: number) => void): Promise<Blob> {
  const canvas = document.createElement("canvas");
  canvas.width = Math.round(width * 2);
  canvas.height = Math.round(height * 2);
  paint(canvas.getContext("2d")!, 2);
  return new Promise((resolve, reject) => canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("no image"))), "image/png"));
}

/** The flat stage. */
export function flat(app: App, stage: Stage): Picture {
  return { png: () => picture(stage.camera.width, stage.camera.height, (c, ratio) => stage.paint(c, ratio)), svg: () => svg(app, stage) };
}

const escape = (text: string) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll('"', "&quot;");

/** The stage as lines: bodies, segments and arrows as they stand. */
function svg(app: App, stage: Stage): string {
  const { camera } = stage;
  const ink = inks();
  const r = (x: number) => String(Math.round(x * 100) / 100);
  const parts = [`<rect width="100%" height="100%" fill="${ink.paper}"/>`];
  for (const wall of app.description.walls) {
    if (wall.kind === "segment") {
      const [a, b] = wall.numbers.map((p) => camera.to(p.map((x, c) => x + wall.velocity[c] * app.frame.time)));
      parts.push(`<line x1="${r(a[0])}" y1="${r(a[1])}" x2="${r(b[0])}" y2="${r(b[1])}" stroke="${ink.wall}" stroke-width="3"/>`);
    } else if (wall.kind === "plane") {
      const [point, normal] = wall.numbers;
      const length = Math.hypot(...normal);
      const [x, y] = camera.to(point.map((x, c) => x + wall.velocity[c] * app.frame.time));
      const [tx, ty] = app.dim === 1 ? [0, 60] : [(-normal[1] / length) * 3000, (-normal[0] / length) * 3000];
      parts.push(`<line x1="${r(x - tx)}" y1="${r(y - ty)}" x2="${r(x + tx)}" y2="${r(y + ty)}" stroke="${ink.wall}" stroke-width="2.5"/>`);
    }
  }
  app.description.bodies.forEach((body, k) => {
    const [x, y] = camera.to(app.frame.position(k));
    parts.push(`<circle cx="${r(x)}" cy="${r(y)}" r="${r(body.radius * camera.scale)}" fill="${body.fixed ? ink.wall : ink.bodies[k % 6]}" stroke="${ink.ink}" stroke-opacity=".55"><title>${escape(body.name)}</title></circle>`);
  });
  for (const arrow of stage.drawn) {
    const colour = ink.colour(arrow.quantity);
    const [x0, y0] = arrow.from;
    const [x1, y1] = arrow.to;
    const length = Math.hypot(x1 - x0, y1 - y0);
    if (length < 0.5) continue;
    const [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length];
    const width = { v: 2.2, p: 5, J: 6, n: 1.6, t: 1.6, cm: 2 }[arrow.quantity];
    const head = Math.min(6 + 2.2 * width, length * 0.7);
    const half = head * 0.5;
    parts.push(
      `<line x1="${r(x0)}" y1="${r(y0)}" x2="${r(x1 - ux * head * 0.86)}" y2="${r(y1 - uy * head * 0.86)}" stroke="${colour}" stroke-width="${width}"${arrow.dashed ? ' stroke-dasharray="6 4"' : ""}/>`,
      `<path d="M${r(x1)} ${r(y1)}L${r(x1 - ux * head - uy * half)} ${r(y1 - uy * head + ux * half)}L${r(x1 - ux * head + uy * half)} ${r(y1 - uy * head - ux * half)}z" fill="${colour}"/>`,
    );
    if (arrow.label && arrow.place) {
      const [x, y] = arrow.place;
      const words = pieces(arrow.label, arrow.who).map((p) => (p.low ? `<tspan font-size="11" dy="4">${escape(p.text)}</tspan><tspan dy="-4">\u200b</tspan>` : escape(p.text)));
      parts.push(`<text x="${r(x)}" y="${r(y + 5)}" fill="${colour}" font-family="'Source Sans 3', system-ui, sans-serif" font-weight="600" font-size="14">${words.join("")}</text>`);
    }
  }
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${r(camera.width)} ${r(camera.height)}" width="${r(camera.width)}" height="${r(camera.height)}"><title>${escape(app.description.title || t("title"))}</title>${parts.join("")}</svg>\n`;
}
