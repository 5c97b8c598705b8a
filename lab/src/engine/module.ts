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

export class Engine {
  private exports: Exports;
  private utf8 = new TextDecoder();
  private bytes = new TextEncoder();

  constructor(instance: WebAssembly.Instance) {
    this.exports = instance.exports as unknown as Exports;
  }

  static async load(source: WebAssembly.Module | BufferSource): Promise<Engine> {
    const module = source instanceof WebAssembly.Module ? source : await WebAssembly.compile(source as BufferSource);
    return new Engine(await WebAssembly.instantiate(module, {}));
  }

  private send(text: string): void {
    const bytes = this.bytes.encode(text);
    const at = this.exports.input(bytes.length);
    new Uint8Array(this.exports.memory.buffer, at, bytes.length).set(bytes);
  }

  private text(): string {
    const at = this.exports.output();
    return this.utf8.decode(new Uint8Array(this.exports.memory.buffer, at, this.exports.output_len()));
  }

  private json<T>(): T {
    return JSON.parse(this.text()) as T;
  }

  /** A copy: the view on the module's memory ends with the next call. */
  private numbers(): Float64Array {
    const length = this.exports.numbers_len();
    return new Float64Array(this.exports.memory.buffer, this.exports.numbers(), length).slice();
  }

  builtins(): { name: string; title: string; text: string }[] {
    this.exports.list_builtins();
    return this.json();
  }

  /** Opens a scene: TOML, JSON or the name of a built-in one. */
  open<T>(text: string): T {
    this.send(text);
    if (this.exports.open_scene() === 0) throw new SceneError(this.json<Problem[]>());
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

  explain<T>(n: number, language: string, letters: string): T | null {
    this.send(`${language} ${letters}`);
    this.exports.explain(n);
    return this.json();
  }

  /** The text that `carom explain --format json` prints for this impact, or "null". */
  explainNumbers(n: number): string {
    this.exports.explain_numbers(n);
    return this.text();
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

  /** The open scene: "json" as short as possible, "toml" likewise, "full" TOML with every default. */
  write(form: "json" | "toml" | "full"): string {
    this.exports.write_scene(form === "json" ? 0 : form === "toml" ? 1 : 2);
    return this.text();
  }
}
