// The exports of carom-wasm as functions of strings and typed arrays. Runs in the worker and, for the tests, in Node.

type Exports = Record<string, (...args: number[]) => number> & { memory: WebAssembly.Memory };

export interface Problem {
  key: string;
  message: string;
  help: string | null;
  line: number | null;
  column: number | null;
}

/** What is wrong with a scene. */
export class SceneError extends Error {
  problems: Problem[];
  constructor(problems: Problem[]) {
    super(problems.map((p) => p.message).join("\n"));
    this.problems = problems;
  }
}

/** The scene is for the module of another dimension. */
export class OtherDimension extends Error {
  dim: number;
  constructor(dim: number) {
    super(`a scene in ${dim}D`);
    this.dim = dim;
  }
}

/** How many dimensions a scene says it has, where that is a number that there is a module for. */
export function dimensionOf(text: string): number | null {
  try {
    const dim = (JSON.parse(text) as { world?: { dim?: unknown } }).world?.dim;
    return dim === 1 || dim === 2 || dim === 3 ? dim : null;
  } catch {
    return null;
  }
}

/** Text and numbers in and out of a module. */
class Desk {
  protected exports: Exports;
  private utf8 = new TextDecoder();
  private bytes = new TextEncoder();

  constructor(instance: WebAssembly.Instance) {
    this.exports = instance.exports as unknown as Exports;
  }

  protected static async instance(source: WebAssembly.Module | BufferSource): Promise<WebAssembly.Instance> {
    const module = source instanceof WebAssembly.Module ? source : await WebAssembly.compile(source as BufferSource);
    return WebAssembly.instantiate(module, {});
  }

  protected send(text: string): void {
    const bytes = this.bytes.encode(text);
    const at = this.exports.input(bytes.length);
    new Uint8Array(this.exports.memory.buffer, at, bytes.length).set(bytes);
  }

  protected text(): string {
    const at = this.exports.output();
    return this.utf8.decode(new Uint8Array(this.exports.memory.buffer, at, this.exports.output_len()));
  }

  protected json<T>(): T {
    return JSON.parse(this.text()) as T;
  }

  /** A copy: the view on the module's memory ends with the next call. */
  protected numbers(): Float64Array {
    const length = this.exports.numbers_len();
    return new Float64Array(this.exports.memory.buffer, this.exports.numbers(), length).slice();
  }

}

/** What an engine asks the words about an impact. */
export interface Posed {
  numbers: Float64Array;
  names: string;
}

/** What an impact means, in the words of `carom explain`. */
export class Words extends Desk {
  static async load(source: WebAssembly.Module | BufferSource): Promise<Words> {
    return new Words(await Desk.instance(source));
  }

  /** The chain of an impact (JSON); null where it is none of the lecture's. */
  explain<T>(posed: Posed, language: string, letters: string): T | null {
    this.send(`${language} ${letters}\n${posed.names}`);
    const at = this.exports.numbers_in(posed.numbers.length);
    new Float64Array(this.exports.memory.buffer, at, posed.numbers.length).set(posed.numbers);
    this.exports.words_explain();
    return this.json();
  }
}

/** Scenes as files. */
export class Files extends Desk {
  static async load(source: WebAssembly.Module | BufferSource): Promise<Files> {
    return new Files(await Desk.instance(source));
  }

  /** A scene (JSON): "json" as short as possible, "toml" likewise, "full" TOML with every default. */
  write(scene: string, form: "json" | "toml" | "full"): string {
    this.send(scene);
    if (this.exports.write_scene(form === "json" ? 0 : form === "toml" ? 1 : 2) === 0) throw new SceneError(this.json<Problem[]>());
    return this.text();
  }
}

export class Engine extends Desk {
  static async load(source: WebAssembly.Module | BufferSource): Promise<Engine> {
    return new Engine(await Desk.instance(source));
  }

  /** Opens a scene (JSON). */
  open<T>(text: string): T {
    this.send(text);
    const verdict = this.exports.open_scene();
    if (verdict === 0) throw new SceneError(this.json<Problem[]>());
    if (verdict === 2) throw new OtherDimension(Number(this.text()));
    return this.json();
  }

  survey(impacts: number): boolean {
    return this.exports.survey(impacts) === 1;
  }

  surveyed<T>(): T {
    this.exports.surveyed();
    return this.json();
  }

  marks(): Float64Array {
    this.exports.marks();
    return this.numbers();
  }

  lines<T>(from: number, count: number): T[] {
    this.exports.lines(from, count);
    return this.json();
  }

  /** What the words have to know of an impact; null if it was not kept, or was not alone in its instant. */
  question(n: number): Posed | null {
    return this.exports.question(n) === 1 ? { numbers: this.numbers(), names: this.text() } : null;
  }

  ledger<T>(n: number): T | null {
    this.exports.ledger(n);
    return this.json();
  }

  seek(time: number): number {
    return this.exports.seek(time);
  }

  next(horizon: number): number {
    return this.exports.next(horizon);
  }

  frame(): Float64Array {
    this.exports.frame();
    return this.numbers();
  }

  samples(count: number): Float64Array {
    this.exports.samples(count);
    return this.numbers();
  }

  reverse(): boolean {
    return this.exports.reverse() === 1;
  }

  report<T>(): T {
    this.exports.report();
    return this.json();
  }
}
