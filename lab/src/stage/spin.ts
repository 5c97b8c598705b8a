// Bodies that turn: a mark on each that goes round with it, and an arrow round its rim as long as it spins fast.
import type { Description, Frame } from "../engine/types.ts";
import type { Camera } from "./camera.ts";

/** Angles are summed from frame to frame; a gap of more than this (s of the scene) is a jump, over which nobody saw it turn. */
const LONGEST = 0.5;

/** How far each body of a scene in the plane has turned. The engine knows spins, not angles: a ball is round. */
export class Turns {
  private angles: number[] = [];
  private spins: number[] = [];
  private time = 0;

  /** Takes the next frame that is shown; backwards as well. */
  pass(frame: Frame): void {
    const dt = frame.time - this.time;
    if (frame.time === 0 || this.angles.length !== frame.count) this.angles = new Array(frame.count).fill(0);
    for (let k = 0; k < frame.count; k++) {
      const now = frame.spin(k)[0] ?? 0;
      if (frame.time > 0 && Math.abs(dt) <= LONGEST) this.angles[k] += 0.5 * (now + (this.spins[k] ?? now)) * dt;
      this.spins[k] = now;
    }
    this.time = frame.time;
  }

  of(k: number): number {
    return this.angles[k] ?? 0;
  }
}

/** True if anything turns, now or at an impact: other scenes need no marks. */
export function turning(frame: Frame): boolean {
  for (let k = 0; k < frame.count; k++) if (frame.spin(k).some((w) => w !== 0)) return true;
  return false;
}

/** The marks of all bodies, in the colour of the outlines. */
export function drawMarks(c: CanvasRenderingContext2D, camera: Camera, d: Description, frame: Frame, turns: Turns, colour: string): void {
  c.save();
  c.strokeStyle = colour;
  c.fillStyle = colour;
  for (let k = 0; k < frame.count; k++) {
    const r = d.bodies[k].radius * camera.scale;
    if (r < 4 || d.bodies[k].fixed) continue;
    const [x, y] = camera.to(frame.position(k));
    const angle = -turns.of(k);
    c.globalAlpha = 0.6;
    c.lineWidth = Math.max(1.25, Math.min(3, r * 0.07));
    // Two strokes from the rim inwards leave the middle to the name.
    for (const side of [0, Math.PI]) {
      const [ux, uy] = [Math.cos(angle + side), Math.sin(angle + side)];
      c.beginPath();
      c.moveTo(x + ux * r * 0.96, y + uy * r * 0.96);
      c.lineTo(x + ux * r * 0.62, y + uy * r * 0.62);
      c.stroke();
    }
    c.globalAlpha = 1;
    c.beginPath();
    c.arc(x + Math.cos(angle) * r * 0.79, y + Math.sin(angle) * r * 0.79, Math.max(1.5, Math.min(5, r * 0.13)), 0, 2 * Math.PI);
    c.fill();
  }
  c.restore();
}

/** An arrow round a body, against the clock where the spin is positive. `share`: of the fastest spin that is seen, 0 to 1. */
export function drawSpin(c: CanvasRenderingContext2D, x: number, y: number, r: number, spin: number, share: number, colour: string, paper: string): void {
  if (spin === 0 || share <= 0) return;
  const way = spin > 0 ? -1 : 1; // y points down in the picture
  const reach = r + 7;
  const sweep = Math.max(0.35, Math.min(1, share) * 1.5 * Math.PI);
  const from = way < 0 ? -0.2 * Math.PI : 1.2 * Math.PI;
  const to = from + way * sweep;
  const head = 9;
  const end = to - way * Math.min(sweep * 0.6, (0.8 * head) / reach);
  c.save();
  for (const [width, ink] of [[5, paper], [2.2, colour]] as const) {
    c.strokeStyle = ink;
    c.lineWidth = width;
    c.beginPath();
    c.arc(x, y, reach, from, end, way < 0);
    c.stroke();
  }
  const [px, py] = [x + reach * Math.cos(to), y + reach * Math.sin(to)];
  const [tx, ty] = [-Math.sin(end + (to - end) / 2) * way, Math.cos(end + (to - end) / 2) * way];
  c.fillStyle = colour;
  c.beginPath();
  c.moveTo(px, py);
  c.lineTo(px - tx * head - ty * 4.5, py - ty * head + tx * 4.5);
  c.lineTo(px - tx * head + ty * 4.5, py - ty * head - tx * 4.5);
  c.closePath();
  c.fill();
  c.restore();
}
