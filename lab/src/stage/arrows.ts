// Arrows: each quantity has a colour and a shape of its own, so that neither has to do alone.

export type Quantity = "v" | "p" | "J" | "n" | "t" | "cm";

export interface Arrow {
  quantity: Quantity;
  /** The letter that it stands for in the equations: "v1-after". */
  name: string;
  from: [number, number];
  to: [number, number];
  dashed: boolean;
  label?: string;
}

const WIDTH: Record<Quantity, number> = { v: 2.2, p: 5, J: 6, n: 1.6, t: 1.6, cm: 2 };

/** Draws one arrow. `hot`: pointed at from an equation. */
export function draw(c: CanvasRenderingContext2D, arrow: Arrow, colour: string, paper: string, hot: boolean): void {
  const [x0, y0] = arrow.from;
  const [x1, y1] = arrow.to;
  const length = Math.hypot(x1 - x0, y1 - y0);
  if (!(length > 0.5)) return;
  const width = WIDTH[arrow.quantity] * (hot ? 1.5 : 1);
  const [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length];
  const head = Math.min(6 + 2.2 * width, length * 0.7);
  const half = head * (arrow.quantity === "v" || arrow.quantity === "n" || arrow.quantity === "t" ? 0.42 : 0.55);
  const neck: [number, number] = [x1 - ux * head * 0.86, y1 - uy * head * 0.86];
  c.save();
  c.lineCap = "butt";
  c.lineJoin = "round";
  c.setLineDash(arrow.dashed ? [6, 4] : []);
  const stroke = (colour: string, width: number) => {
    c.strokeStyle = colour;
    c.lineWidth = width;
    c.beginPath();
    c.moveTo(x0, y0);
    c.lineTo(neck[0], neck[1]);
    c.stroke();
  };
  // A rim of paper keeps arrows apart where they cross bodies.
  c.globalAlpha = 0.85;
  stroke(paper, width + 3);
  c.globalAlpha = 1;
  stroke(colour, width);
  // J is a double line.
  if (arrow.quantity === "J") stroke(paper, width - 4);
  c.setLineDash([]);
  c.fillStyle = colour;
  c.strokeStyle = colour;
  c.beginPath();
  c.moveTo(x1, y1);
  c.lineTo(x1 - ux * head - uy * half, y1 - uy * head + ux * half);
  if (arrow.quantity === "v") c.lineTo(x1 - ux * head * 0.7, y1 - uy * head * 0.7);
  c.lineTo(x1 - ux * head + uy * half, y1 - uy * head - ux * half);
  c.closePath();
  if (arrow.quantity === "n" || arrow.quantity === "t") {
    c.lineWidth = 1.5;
    c.fillStyle = paper;
    c.fill();
    c.stroke();
  } else {
    c.fill();
  }
  c.restore();
}

/** Where a label stands: left, top, right, bottom. */
export type Box = [number, number, number, number];

/** A label beside the tip of an arrow, where none of those before it stands. */
export function label(c: CanvasRenderingContext2D, arrow: Arrow, colour: string, paper: string, width: number, height: number, taken: Box[]): void {
  if (!arrow.label) return;
  const [x0, y0] = arrow.from;
  const [x1, y1] = arrow.to;
  const length = Math.hypot(x1 - x0, y1 - y0) || 1;
  const [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length];
  const x = x1 + ux * 8 - uy * 2;
  const y = y1 + uy * 14;
  c.save();
  c.textAlign = ux > 0.35 ? "left" : ux < -0.35 ? "right" : "center";
  c.textBaseline = uy < -0.5 ? "bottom" : uy > 0.5 ? "top" : "middle";
  const up = Math.abs(uy) < 0.5 ? -9 : 0;
  // Inside the picture, whole.
  const wide = c.measureText(arrow.label).width;
  const before = c.textAlign === "left" ? 0 : c.textAlign === "right" ? wide : wide / 2;
  const left = Math.min(Math.max(x - before, 5), width - wide - 5);
  // Where a label had to give way to the edge, it would stand on its own arrow.
  const aside = Math.abs(uy) < 0.5 && Math.abs(left - (x - before)) > 3 ? -9 : 0;
  const inside = (top: number) => Math.min(Math.max(top, 18), height - 12);
  const box = ([left, top]: [number, number]): Box => [left - 4, top - 9, left + wide + 4, top + 9];
  const meets = (a: Box, b: Box) => a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
  // Beside the tip; or over the middle of an arrow that lies; or higher and higher above that.
  const lies = Math.abs(uy) < 0.5;
  const middle = Math.min(Math.max((x0 + x1) / 2 - wide / 2, 5), width - wide - 5);
  const places: [number, number][] = [[left, inside(y + up + aside)]];
  for (let turn = 0; turn < 8; turn++) places.push(lies ? [middle, inside((y0 + y1) / 2 - 14 - 8 * turn)] : [left, inside(y + up + aside - 8 * (turn + 1))]);
  const [best] = places.filter((place) => !taken.some((other) => meets(box(place), other)));
  const [at, top] = best ?? places[0];
  taken.push(box([at, top]));
  c.textAlign = "left";
  c.lineWidth = 4;
  c.strokeStyle = paper;
  c.fillStyle = colour;
  c.strokeText(arrow.label, at, top);
  c.fillText(arrow.label, at, top);
  c.restore();
}
