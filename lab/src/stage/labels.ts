// Where labels stand: beside the tips of their arrows, off other labels, arrows and balls, and inside the picture.

/** Left, top, right, bottom. */
export type Box = [number, number, number, number];

/** A label that wants a place: how wide it is, and the arrow that it belongs to. */
export interface Wish {
  /** The same label is known by it from frame to frame. */
  name: string;
  width: number;
  from: readonly [number, number];
  to: readonly [number, number];
}

/** What labels keep off. */
export interface Ground {
  width: number;
  height: number;
  arrows: readonly { from: readonly [number, number]; to: readonly [number, number] }[];
  /** Centre and radius. */
  discs: readonly (readonly [number, number, number])[];
  boxes: readonly Box[];
}

/** Half the height of a line of text (px). */
const HALF = 9;
/** What a pixel of distance from where a label would best stand costs, and what it costs to cover things. */
const COST = { far: 0.6, label: 30, letter: 30, arrow: 3, disc: 3, move: 14 };

/** The left end and the middle height of every label. `last` remembers which place each took, so that labels do not jump to and fro. */
export function places(wishes: readonly Wish[], ground: Ground, last: Map<string, number>): [number, number][] {
  const taken: Box[] = [];
  const known = new Map(last);
  last.clear();
  return wishes.map((wish) => {
    let [best, least, chosen]: [Box, number, number] = [[0, 0, 0, 0], Infinity, 0];
    candidates(wish).forEach(([x, y, spare], k) => {
      // Inside the picture, whole.
      const left = Math.min(Math.max(x - wish.width / 2, 5), ground.width - wish.width - 5);
      const middle = Math.min(Math.max(y, HALF + 3), ground.height - HALF - 3);
      const box: Box = [left - 3, middle - HALF, left + wish.width + 3, middle + HALF];
      let cost = COST.far * (spare + Math.abs(left + wish.width / 2 - x) + Math.abs(middle - y)) + (known.get(wish.name) === k ? -COST.move : 0);
      for (const other of taken) cost += COST.label * reach(box, other);
      for (const other of ground.boxes) cost += COST.letter * reach(box, other);
      for (const arrow of ground.arrows) cost += COST.arrow * inside(box, arrow.from, arrow.to);
      for (const [cx, cy, r] of ground.discs) cost += COST.disc * reach(box, [cx - 0.8 * r, cy - 0.8 * r, cx + 0.8 * r, cy + 0.8 * r]);
      if (cost < least) [best, least, chosen] = [box, cost, k];
    });
    last.set(wish.name, chosen);
    taken.push(best);
    return [best[0] + 3, (best[1] + best[3]) / 2];
  });
}

/** Middles of places for a label, and how far each is from the best: beyond the tip; beside it; beside the shaft; round the tip. */
function candidates({ width, from, to }: Wish): [number, number, number][] {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(dx, dy);
  const [ux, uy] = length > 0.5 ? [dx / length, dy / length] : [1, 0];
  const half = width / 2;
  /** From a point, so far in a direction that the label only just leaves it. */
  const off = (x: number, y: number, ax: number, ay: number, gap: number): [number, number] => {
    const along = Math.min(Math.abs(ax) > 1e-6 ? half / Math.abs(ax) : Infinity, Math.abs(ay) > 1e-6 ? HALF / Math.abs(ay) : Infinity);
    return [x + ax * (along + gap), y + ay * (along + gap)];
  };
  const all: [number, number, number][] = [];
  const add = ([x, y]: [number, number], spare: number) => all.push([x, y, spare]);
  // Of an arrow that lies, the label stands a little above its tip.
  const lies = Math.abs(uy) < 0.5;
  const [tx, ty] = off(to[0], to[1], ux, uy, 7);
  if (lies) add([tx, ty - 9], 0);
  add([tx, ty], lies ? 4 : 0);
  for (const side of [-1, 1]) {
    add(off(to[0] - ux * 10, to[1] - uy * 10, -uy * side, ux * side, 8), 10);
    add(off(from[0] + dx / 2, from[1] + dy / 2, -uy * side, ux * side, 9), 16);
  }
  for (const gap of [12, 30, 52]) {
    for (let turn = 0; turn < 8; turn++) add(off(to[0], to[1], Math.cos((turn * Math.PI) / 4), Math.sin((turn * Math.PI) / 4), gap), 12 + gap);
  }
  return all;
}

/** How deep two boxes lie in one another (px): the side of the square as large as what they share; 0 if they do not meet. */
function reach(a: Box, b: Box): number {
  const [x, y] = [Math.min(a[2], b[2]) - Math.max(a[0], b[0]), Math.min(a[3], b[3]) - Math.max(a[1], b[1])];
  return x > 0 && y > 0 ? Math.sqrt(x * y) : 0;
}

/** How much of a line lies in a box (px). */
function inside(box: Box, from: readonly [number, number], to: readonly [number, number]): number {
  const d = [to[0] - from[0], to[1] - from[1]];
  let [enter, leave] = [0, 1];
  for (const axis of [0, 1] as const) {
    if (Math.abs(d[axis]) < 1e-9) {
      if (from[axis] < box[axis] || from[axis] > box[axis + 2]) return 0;
      continue;
    }
    const [a, b] = [(box[axis] - from[axis]) / d[axis], (box[axis + 2] - from[axis]) / d[axis]];
    enter = Math.max(enter, Math.min(a, b));
    leave = Math.min(leave, Math.max(a, b));
  }
  return leave > enter ? (leave - enter) * Math.hypot(d[0], d[1]) : 0;
}
