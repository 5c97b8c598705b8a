// From metres to pixels: y points up, one scale for both axes.
import type { Description, Frame, Impact } from "../engine/types.ts";

export interface Box {
  min: [number, number];
  max: [number, number];
}

export class Camera {
  width = 1;
  height = 1;
  scale = 100;
  x = 0;
  y = 0;

  /** The picture position of a point; on the line, y is 0. */
  to(p: readonly number[]): [number, number] {
    return [this.width / 2 + (p[0] - this.x) * this.scale, this.height / 2 - ((p[1] ?? 0) - this.y) * this.scale];
  }

  from(x: number, y: number): [number, number] {
    return [this.x + (x - this.width / 2) / this.scale, this.y - (y - this.height / 2) / this.scale];
  }

  fit(box: Box): void {
    const wide = Math.max(box.max[0] - box.min[0], 1e-9);
    const high = Math.max(box.max[1] - box.min[1], 1e-9);
    const margin = Math.min(64, this.width * 0.08);
    this.scale = Math.min((this.width - 2 * margin) / wide, (this.height - 2 * margin) / high);
    this.x = (box.min[0] + box.max[0]) / 2;
    this.y = (box.min[1] + box.max[1]) / 2;
  }

  /** Zooms so that the point under (x, y) stays. */
  zoom(factor: number, x: number, y: number): void {
    const before = this.from(x, y);
    this.scale = Math.min(Math.max(this.scale * factor, 1e-6), 1e9);
    const after = this.from(x, y);
    this.x += before[0] - after[0];
    this.y += before[1] - after[1];
  }
}

/** What should be seen: the box, or the bodies from the start to the end, without those that fly off. */
export function extent(d: Description, start: Frame, impacts: Impact[]): Box {
  if (d.corners) {
    const [min, max] = d.corners.map((corner) => [corner[0], corner[1] ?? 0]);
    // Of a shaft, that part in which something is.
    const high = max[1] - min[1];
    const wide = max[0] - min[0];
    const top = Math.max(...d.bodies.map((body, k) => (start.position(k)[1] ?? 0) + body.radius));
    if (high > 3 * wide) max[1] = Math.min(max[1], Math.max(top + 0.5 * wide, min[1] + 2 * wide));
    return { min: [min[0], min[1]], max: [max[0], max[1]] };
  }
  const box: Box = { min: [Infinity, Infinity], max: [-Infinity, -Infinity] };
  const grow = (x: number, y: number, r: number) => {
    box.min = [Math.min(box.min[0], x - r), Math.min(box.min[1], y - r)];
    box.max = [Math.max(box.max[0], x + r), Math.max(box.max[1], y + r)];
  };
  d.bodies.forEach((body, k) => {
    const p = start.position(k);
    grow(p[0], p[1] ?? 0, body.radius);
  });
  const mean = d.bodies.reduce((sum, b) => sum + b.radius, 0) / Math.max(1, d.bodies.length);
  // With room for the arrows there.
  const around = Math.max(1.5 * mean, 0.2 * Math.max(box.max[0] - box.min[0], box.max[1] - box.min[1]));
  for (const impact of impacts) grow(impact.point[0], impact.point[1] ?? 0, around);
  for (const wall of d.walls) {
    if (wall.kind === "segment") for (const p of wall.numbers) grow(p[0], p[1], 0);
    if (wall.kind === "arc") grow(wall.numbers[0][0], wall.numbers[0][1], wall.numbers[1][0]);
    // A plane is seen where a body is near it.
    if (wall.kind === "plane") {
      const [point, normal] = wall.numbers;
      const length = Math.hypot(...normal);
      const centre = [(box.min[0] + box.max[0]) / 2, (box.min[1] + box.max[1]) / 2];
      const gap = normal.reduce((sum, n, k) => sum + n * (centre[k] - point[k]), 0) / length;
      const foot = normal.map((n, k) => centre[k] - (gap * n) / length);
      grow(foot[0], foot[1] ?? 0, 0.3 * mean);
    }
  }
  // A single ball needs air around it.
  const size = Math.max(box.max[0] - box.min[0], box.max[1] - box.min[1], 8 * mean);
  const pad = 0.06 * size;
  return { min: [box.min[0] - pad, box.min[1] - pad], max: [box.max[0] + pad, box.max[1] + pad] };
}
