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
  /** Whose it is: a small letter in the label. */
  who?: string;
  /** Where its label was written: the left end and the middle height. */
  place?: [number, number];
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

/** The pieces of a label: of "v′ = 1.00 m/s" about A those of v with A below the line, then the rest. */
export function pieces(label: string, who: string | undefined): { text: string; low: boolean }[] {
  if (!who) return [{ text: label, low: false }];
  return [{ text: label.slice(0, 1), low: false }, { text: who, low: true }, { text: label.slice(1), low: false }];
}

/** The letters of labels, and those below the line. */
export const LETTERS = '600 14px "Source Sans 3 Variable", system-ui, sans-serif';
const LOW = '600 11px "Source Sans 3 Variable", system-ui, sans-serif';

/** How wide a label is (px). */
export function breadth(c: CanvasRenderingContext2D, label: string, who?: string): number {
  return pieces(label, who).reduce((sum, piece) => {
    c.font = piece.low ? LOW : LETTERS;
    return sum + c.measureText(piece.text).width;
  }, 0);
}

/** Writes a label from its left end, on a rim of paper. */
export function write(c: CanvasRenderingContext2D, label: string, who: string | undefined, [x, y]: [number, number], colour: string, paper: string): void {
  c.save();
  c.textAlign = "left";
  c.textBaseline = "middle";
  c.lineWidth = 4;
  c.lineJoin = "round";
  c.strokeStyle = paper;
  c.fillStyle = colour;
  for (const draw of ["strokeText", "fillText"] as const) {
    let at = x;
    for (const piece of pieces(label, who)) {
      c.font = piece.low ? LOW : LETTERS;
      c[draw](piece.text, at, piece.low ? y + 4 : y);
      at += c.measureText(piece.text).width;
    }
  }
  c.restore();
}
