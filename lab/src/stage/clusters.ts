// Bodies that touch and move as one: what is left of an inelastic collapse, or of an impact with e = 0.
import type { Description, Frame } from "../engine/types.ts";

/** Beyond this many bodies nobody looks for clusters one by one. */
const MOST = 40;
/** Gaps that count as contact, in radii, and differences of velocity that count as none, in parts of the fastest. */
const NEAR = 1e-6;

/** The numbers of the bodies of each cluster, in order. What touched from the start is none, nor what gravity heaps up. */
export function clusters(d: Description, start: Frame, frame: Frame): number[][] {
  const n = frame.count;
  // Where no energy was lost nothing sticks, though it may stand beside another.
  if (!(frame.lost > 1e-12 * (start.kinetic + Math.abs(start.potential)))) return [];
  if (n > MOST || d.gravity.some((g) => g !== 0)) return [];
  const places = Array.from({ length: n }, (_, k) => frame.position(k));
  const speeds = Array.from({ length: n }, (_, k) => frame.velocity(k));
  const fastest = Math.max(...speeds.map((v, k) => Math.max(Math.hypot(...v), Math.hypot(...start.velocity(k)))), 0);
  const of = places.map((_, k) => k);
  const find = (k: number): number => (of[k] === k ? k : (of[k] = find(of[k])));
  for (let a = 0; a < n; a++) {
    if (d.bodies[a].fixed) continue;
    for (let b = a + 1; b < n; b++) {
      if (d.bodies[b].fixed) continue;
      const reach = d.bodies[a].radius + d.bodies[b].radius;
      const gap = distance(places[a], places[b]) - reach;
      if (distance(start.position(a), start.position(b)) - reach <= NEAR * reach) continue;
      const apart = distance(speeds[a], speeds[b]);
      if (Math.abs(gap) <= NEAR * reach && apart <= NEAR * fastest) of[find(b)] = find(a);
    }
  }
  const groups = new Map<number, number[]>();
  for (let k = 0; k < n; k++) groups.set(find(k), [...(groups.get(find(k)) ?? []), k]);
  return [...groups.values()].filter((group) => group.length > 1);
}

function distance(a: number[], b: number[]): number {
  return Math.hypot(...a.map((x, c) => x - b[c]));
}
