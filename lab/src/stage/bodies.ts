// Bodies and walls.
import type { Description, Frame, Wall } from "../engine/types.ts";
import type { Camera } from "./camera.ts";
import { initials } from "./layout.ts";

export interface Ink {
  paper: string;
  ink: string;
  faint: string;
  wall: string;
  bodies: string[];
}

/** The colour of the k-th body: calm tints, told apart by their letters as well. */
export function tint(ink: Ink, k: number): string {
  return ink.bodies[k % ink.bodies.length];
}

export function drawBodies(c: CanvasRenderingContext2D, camera: Camera, d: Description, frame: Frame, ink: Ink): void {
  if (frame.count > 200) {
    drawMany(c, camera, d, frame, ink);
    return;
  }
  for (let k = 0; k < frame.count; k++) {
    const body = d.bodies[k];
    const [x, y] = camera.to(frame.position(k));
    const r = Math.max(1.5, body.radius * camera.scale);
    disc(c, x, y, r, body.fixed ? ink.wall : tint(ink, k), ink, body.fixed);
  }
}

/** The names, over the arrows that begin in the middle of a ball. */
export function drawNames(c: CanvasRenderingContext2D, camera: Camera, d: Description, frame: Frame, ink: Ink): void {
  if (frame.count > 200) return;
  c.save();
  c.textAlign = "center";
  c.textBaseline = "middle";
  c.lineWidth = 5;
  c.lineJoin = "round";
  for (let k = 0; k < frame.count; k++) {
    const body = d.bodies[k];
    const r = body.radius * camera.scale;
    if (r <= 9) continue;
    const [x, y] = camera.to(frame.position(k));
    c.font = `600 ${Math.min(20, Math.max(11, r * 0.75))}px "Source Sans 3 Variable", system-ui, sans-serif`;
    const name = r > 40 ? body.name : initials(body.name);
    if (c.measureText(name).width >= 1.8 * r) continue;
    c.strokeStyle = body.fixed ? ink.wall : tint(ink, k);
    c.fillStyle = body.fixed ? ink.paper : "#10151c";
    c.strokeText(name, x, y + 0.5);
    c.fillText(name, x, y + 0.5);
  }
  c.restore();
}

function disc(c: CanvasRenderingContext2D, x: number, y: number, r: number, colour: string, ink: Ink, fixed: boolean): void {
  c.beginPath();
  c.arc(x, y, r, 0, 2 * Math.PI);
  c.fillStyle = colour;
  c.fill();
  c.lineWidth = Math.min(2, Math.max(0.75, r * 0.08));
  c.strokeStyle = ink.ink;
  c.globalAlpha = fixed ? 1 : 0.55;
  c.stroke();
  c.globalAlpha = 1;
}

/** Discs by the thousand, written into the pixels: a few milliseconds for five thousand. Faster discs are warmer. */
export function drawMany(c: CanvasRenderingContext2D, camera: Camera, d: Description, frame: Frame, ink: Ink): void {
  const bands = 6;
  const data = frame.data;
  const { stride, dim } = frame;
  let square = 0;
  for (let k = 0; k < frame.count; k++) {
    const at = 16 + k * stride + dim;
    for (let j = 0; j < dim; j++) square += data[at + j] ** 2;
  }
  const rms = Math.sqrt(square / Math.max(1, frame.count)) || 1;
  const ratio = c.getTransform().a;
  const { width, height } = c.canvas;
  const image = c.getImageData(0, 0, width, height);
  const pixels = new Uint32Array(image.data.buffer);
  const colours = Array.from({ length: bands }, (_, band) => packed(ink.bodies[6 + band] ?? ink.ink));
  for (let k = 0; k < frame.count; k++) {
    const at = 16 + k * stride;
    const x = (camera.width / 2 + (data[at] - camera.x) * camera.scale) * ratio;
    const y = (camera.height / 2 - ((dim > 1 ? data[at + 1] : 0) - camera.y) * camera.scale) * ratio;
    let v = 0;
    for (let j = 0; j < dim; j++) v += data[at + dim + j] ** 2;
    const band = Math.min(bands - 1, Math.floor((Math.sqrt(v) / rms) * 3));
    fillDisc(pixels, width, height, x, y, Math.max(0.9, d.bodies[k].radius * camera.scale * ratio), colours[band]);
  }
  c.putImageData(image, 0, 0);
}

/** A colour such as #2c5f8a as the pixel of an image: red in the lowest byte. */
function packed(hex: string): number {
  const n = parseInt(hex.slice(1), 16);
  return (0xff000000 | ((n & 0xff) << 16) | (n & 0xff00) | (n >> 16)) >>> 0;
}

/** Row by row; the two ends of a row are mixed with what is there, by how much of the pixel the disc covers. */
function fillDisc(pixels: Uint32Array, width: number, height: number, x: number, y: number, r: number, colour: number): void {
  const top = Math.max(0, Math.floor(y - r));
  const bottom = Math.min(height - 1, Math.ceil(y + r));
  for (let row = top; row <= bottom; row++) {
    const dy = row + 0.5 - y;
    const square = r * r - dy * dy;
    if (square <= 0) continue;
    const half = Math.sqrt(square);
    const [from, to] = [x - half, x + half];
    const [first, last] = [Math.floor(from), Math.floor(to)];
    for (let column = Math.max(0, first); column <= Math.min(width - 1, last); column++) {
      const share = Math.min(1, Math.min(column + 1, to) - Math.max(column, from));
      const at = row * width + column;
      pixels[at] = share >= 0.99 ? colour : mix(pixels[at], colour, share);
    }
  }
}

function mix(under: number, over: number, share: number): number {
  const part = (shift: number) => Math.round(((under >>> shift) & 255) * (1 - share) + ((over >>> shift) & 255) * share) << shift;
  return (0xff000000 | part(16) | part(8) | part(0)) >>> 0;
}

export function drawWalls(c: CanvasRenderingContext2D, camera: Camera, d: Description, time: number, ink: Ink): void {
  c.save();
  c.strokeStyle = ink.wall;
  c.fillStyle = ink.wall;
  c.lineCap = "round";
  for (const wall of d.walls) drawWall(c, camera, wall, time, d.dim, ink);
  if (d.corners && d.periodic.length > 0 && d.dim > 1) {
    const [a, b] = [camera.to(d.corners[0]), camera.to(d.corners[1])];
    c.setLineDash([8, 6]);
    c.lineWidth = 1.5;
    c.strokeRect(a[0], b[1], b[0] - a[0], a[1] - b[1]);
  }
  c.restore();
}

function drawWall(c: CanvasRenderingContext2D, camera: Camera, wall: Wall, time: number, dim: number, ink: Ink): void {
  const shift = (p: number[]) => p.map((x, k) => x + (wall.velocity[k] ?? 0) * time);
  c.lineWidth = 3;
  if (wall.kind === "plane") {
    const at = camera.to(shift(wall.numbers[0]));
    const n = dim === 1 ? [Math.sign(wall.numbers[1][0]), 0] : unit(wall.numbers[1]);
    // In the picture y points down.
    const [nx, ny] = [n[0], -n[1]];
    const reach = 2 * (camera.width + camera.height) + Math.hypot(at[0], at[1]);
    if (dim === 1) {
      hatched(c, at, [nx, ny], Math.min(70, camera.height * 0.3), ink);
      return;
    }
    hatched(c, at, [nx, ny], reach, ink);
  } else if (wall.kind === "segment") {
    const [a, b] = wall.numbers.map((p) => camera.to(shift(p)));
    c.beginPath();
    c.moveTo(a[0], a[1]);
    c.lineTo(b[0], b[1]);
    c.stroke();
  } else if (wall.kind === "arc") {
    const [x, y] = camera.to(shift(wall.numbers[0]));
    const [radius, from, to] = wall.numbers[1];
    c.beginPath();
    c.arc(x, y, radius * camera.scale, -to, -from);
    c.stroke();
  }
}

function unit(v: number[]): number[] {
  const length = Math.hypot(...v) || 1;
  return v.map((x) => x / length);
}

/** A plane: its line, and hatching on the side where nothing can be. */
function hatched(c: CanvasRenderingContext2D, at: [number, number], n: [number, number], reach: number, ink: Ink): void {
  const [tx, ty] = [-n[1], n[0]];
  const depth = 14;
  c.save();
  c.beginPath();
  c.moveTo(at[0] - tx * reach, at[1] - ty * reach);
  c.lineTo(at[0] + tx * reach, at[1] + ty * reach);
  c.lineTo(at[0] + tx * reach - n[0] * 4000, at[1] + ty * reach - n[1] * 4000);
  c.lineTo(at[0] - tx * reach - n[0] * 4000, at[1] - ty * reach - n[1] * 4000);
  c.closePath();
  c.save();
  c.clip();
  c.globalAlpha = 0.16;
  c.fillStyle = ink.wall;
  c.fillRect(-1e4, -1e4, 3e4, 3e4);
  c.restore();
  c.lineWidth = 1;
  c.globalAlpha = 0.55;
  c.beginPath();
  // Hatches stand still when the picture moves along the wall.
  const pitch = 11;
  const shift = (at[0] * tx + at[1] * ty) % pitch;
  const count = Math.min(400, Math.ceil(reach / pitch));
  for (let k = -count; k <= count; k++) {
    const s = k * pitch - shift;
    const [x, y] = [at[0] + tx * s, at[1] + ty * s];
    c.moveTo(x, y);
    c.lineTo(x - n[0] * depth - tx * depth * 0.7, y - n[1] * depth - ty * depth * 0.7);
  }
  c.stroke();
  c.globalAlpha = 1;
  c.lineWidth = 2.5;
  c.beginPath();
  c.moveTo(at[0] - tx * reach, at[1] - ty * reach);
  c.lineTo(at[0] + tx * reach, at[1] + ty * reach);
  c.stroke();
  c.restore();
}
