// Balls that turn in space: a belt and two spots on each sphere, and how far each has turned.
import { BufferAttribute, Quaternion, SphereGeometry, Vector3 } from "three";
import type { Frame } from "../engine/types.ts";

/** A gap of more than this between two frames (s of the scene) is a jump, over which nobody saw it turn. */
const LONGEST = 0.5;

/** A unit sphere whose belt and poles are darker than the colour of its ball. */
export function markedSphere(): SphereGeometry {
  const sphere = new SphereGeometry(1, 72, 48);
  const place = sphere.getAttribute("position");
  const colours = new Float32Array(3 * place.count);
  for (let k = 0; k < place.count; k++) {
    const [x, y] = [place.getX(k), place.getY(k)];
    colours.fill(Math.abs(y) < 0.1 || Math.abs(x) > 0.95 ? 0.4 : 1, 3 * k, 3 * k + 3);
  }
  sphere.setAttribute("color", new BufferAttribute(colours, 3));
  return sphere;
}

/** The engine knows spins, not angles: a ball is round. So they are summed from frame to frame. */
export class Turned {
  private of: Quaternion[] = [];
  private time = 0;
  private axis = new Vector3();
  private step = new Quaternion();

  pass(frame: Frame): void {
    const dt = frame.time - this.time;
    if (frame.time === 0 || this.of.length !== frame.count) this.of = Array.from({ length: frame.count }, () => new Quaternion());
    this.time = frame.time;
    if (frame.time === 0 || dt === 0 || Math.abs(dt) > LONGEST) return;
    for (let k = 0; k < frame.count; k++) {
      const [x, y, z] = frame.spin(k);
      const rate = Math.hypot(x, y, z);
      if (rate === 0) continue;
      this.axis.set(x / rate, y / rate, z / rate);
      this.of[k].premultiply(this.step.setFromAxisAngle(this.axis, rate * dt)).normalize();
    }
  }

  body(k: number): Quaternion {
    return this.of[k];
  }
}
