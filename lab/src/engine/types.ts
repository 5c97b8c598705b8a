// What the engine says, as the page reads it.

export interface Body {
  name: string;
  mass: number | null;
  radius: number;
  fixed: boolean;
  inertia: number;
  material: string;
  own: number | null;
}

export interface Wall {
  label: string;
  kind: "plane" | "segment" | "arc" | "triangle";
  numbers: number[][];
  velocity: number[];
}

export interface Description {
  dim: 1 | 2 | 3;
  title: string;
  gravity: number[];
  bodies: Body[];
  walls: Wall[];
  corners: [number[], number[]] | null;
  periodic: number[];
  together: "reflect" | "sequential" | "lcp";
  law: string;
  until: { time: number | null; impacts: number | null; rest: boolean };
  notes: string[];
  document: SceneDocument;
}

/** A scene file, as JSON. */
export interface SceneDocument {
  carom: number;
  title?: string;
  world?: { dim?: number; gravity?: number[]; boundary?: Record<string, unknown> };
  material?: Record<string, Material>;
  pair?: (Material & { materials: [string, string] })[];
  body?: BodyDocument[];
  wall?: Record<string, unknown>[];
  group?: Record<string, unknown>[];
  run?: { until?: { time?: number; impacts?: number; rest?: boolean }; seed?: number; together?: string; law?: string; rest_speed?: number };
  [key: string]: unknown;
}

export interface Material {
  restitution?: number | { curve: number[][] };
  friction?: number | { curve: number[][] };
  tangential?: number;
  [key: string]: unknown;
}

export interface BodyDocument {
  name?: string;
  mass?: number;
  density?: number;
  fixed?: boolean;
  radius: number;
  position: number[];
  velocity?: number[];
  spin?: number[];
  material?: string;
  [key: string]: unknown;
}

export interface Motion {
  velocity: number[];
  spin: number[];
}

/** One contact that exchanged an impulse: a line of `carom events`. */
export interface Impact {
  n: number;
  time: number;
  bodies: [string, string];
  point: number[];
  normal: number[];
  approach: number;
  departure: number;
  restitution: number;
  impulse: number;
  friction_impulse: number[];
  before: [Motion, Motion];
  after: [Motion, Motion];
  lost: number;
  together: number;
}

export interface Survey {
  done: boolean;
  time: number;
  impacts: number;
  kept: number;
  stopped: string | null;
  report: Report | null;
}

export interface Report {
  stopped: string;
  time: number;
  impacts: number;
  digest: string;
  audit: { pass: boolean; capped: number; overlap: number; momentum: { drift: number }; energy: { drift: number; lost: number } };
}

export type Bit = { w: string } | { m: string };

export interface Side {
  rel: string;
  tex: string;
  kind: "letters" | "numbers" | "value";
}

export interface Row {
  sides: Side[];
  tick: boolean;
}

export type Item =
  | { kind: "prose" | "note"; text: Bit[] }
  | { kind: "points"; points: Bit[][] }
  | { kind: "choices"; choices: { holds: boolean; when: Bit[]; then: Bit[] }[] }
  | { kind: "rows"; rows: Row[] }
  | { kind: "table"; head: Bit[][]; rows: Bit[][][]; left: boolean[] }
  | { kind: "matrices"; matrices: string[] }
  | { kind: "checks"; checks: { holds: boolean; name: Bit[]; row: Row }[] };

/** The chain of `carom explain` for one impact. */
export interface Chain {
  language: string;
  title: string;
  brief: Row[];
  opening: Item[];
  steps: { number: number | null; title: Bit[]; items: Item[] }[];
  special: string[];
  values: [string, number[]][];
}

export interface LedgerRow {
  name: string;
  before: number[];
  change: number[];
  after: number[];
}

export interface Ledger {
  time: number;
  rows: LedgerRow[];
  others: LedgerRow | null;
  outside: LedgerRow;
  has_outside: boolean;
  total: LedgerRow;
  closes: boolean;
  energy: {
    before: number;
    after: number;
    kinetic: [number | null, number];
    potential: [number | null, number];
    lost: number;
    work: number;
    closes: boolean;
  };
}

/** The numbers before the bodies in a frame. */
export const HEADER = 16;

/** A view on one frame of the engine. */
export class Frame {
  data: Float64Array;
  dim: number;
  stride: number;
  count: number;

  constructor(data: Float64Array, dim: number) {
    this.data = data;
    this.dim = dim;
    this.count = data[9];
    this.stride = data[10];
  }
  get time(): number {
    return this.data[0];
  }
  get impacts(): number {
    return this.data[1];
  }
  get kinetic(): number {
    return this.data[2];
  }
  get potential(): number {
    return this.data[3];
  }
  get lost(): number {
    return this.data[4];
  }
  get digest(): string {
    const half = (x: number) => x.toString(16).padStart(8, "0");
    return half(this.data[11]) + half(this.data[12]);
  }
  position(k: number): number[] {
    const at = HEADER + k * this.stride;
    return Array.from(this.data.subarray(at, at + this.dim));
  }
  velocity(k: number): number[] {
    const at = HEADER + k * this.stride + this.dim;
    return Array.from(this.data.subarray(at, at + this.dim));
  }
  spin(k: number): number[] {
    const at = HEADER + k * this.stride + 2 * this.dim;
    return Array.from(this.data.subarray(at, at + this.stride - 2 * this.dim - 1));
  }
  flag(k: number): number {
    return this.data[HEADER + (k + 1) * this.stride - 1];
  }
}
