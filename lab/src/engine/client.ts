// The engine as the page sees it: every verb a promise, and news of the survey.
import type { Problem } from "./module.ts";
import { dimensionOf, SceneError } from "./module.ts";
import type { Chain, Description, Impact, Ledger, Report, Survey } from "./types.ts";

/** What the engine is made of: a module a dimension, the one that explains, and the one that writes scenes. */
export type Part = "1d" | "2d" | "3d" | "words" | "files";

export interface Opened {
  /** The number of this scene among all that were opened. */
  id: number;
  description: Description;
  survey: Survey;
  marks: Float64Array;
  /** The frame at time 0. */
  start: Float64Array;
}

interface Waiting {
  resolve(value: unknown): void;
  reject(error: unknown): void;
}

export class Client {
  private worker: Worker;
  private waiting = new Map<number, Waiting>();
  private next = 1;
  /** Called whenever the survey of a scene, of which the number is told, has come further. */
  onSurvey: (survey: Survey, marks: Float64Array, id: number) => void = () => {};

  private constructor(worker: Worker) {
    this.worker = worker;
    worker.onmessage = (event) => this.hear(event.data);
  }

  /** An engine a dimension, the words and the files, each compiled once and shared: further workers start at once. */
  private static modules = new Map<Part, Promise<WebAssembly.Module>>();
  /** The modules that this worker has. */
  private has = new Set<Part>();

  /** Starts fetching a module. */
  static fetch(part: Part): Promise<WebAssembly.Module> {
    let module = Client.modules.get(part);
    if (!module) {
      module = compile(part);
      Client.modules.set(part, module);
      // A network that failed may be back the next time.
      module.catch(() => Client.modules.delete(part));
    }
    return module;
  }

  static start(): Client {
    return new Client(new Worker(new URL("./worker.ts", import.meta.url), { type: "module" }));
  }

  /** The worker has this module. */
  private async equip(part: Part): Promise<void> {
    if (this.has.has(part)) return;
    const module = await Client.fetch(part);
    if (this.has.has(part)) return;
    this.has.add(part);
    this.worker.postMessage({ module, part });
  }

  private hear(message: Record<string, unknown>): void {
    if (message.survey) {
      this.onSurvey(message.survey as Survey, message.marks as Float64Array, message.of as number);
      return;
    }
    const waiting = this.waiting.get(message.id as number);
    if (!waiting) return;
    this.waiting.delete(message.id as number);
    if (message.error !== undefined) {
      const problems = message.problems as Problem[] | null;
      waiting.reject(problems ? new SceneError(problems) : new Error(message.error as string));
    } else {
      waiting.resolve(message.result);
    }
  }

  private call<T>(verb: string, ...args: unknown[]): Promise<T> {
    const id = this.next++;
    return new Promise<T>((resolve, reject) => {
      this.waiting.set(id, { resolve: resolve as (value: unknown) => void, reject });
      this.worker.postMessage({ id, verb, args });
    });
  }

  /** Opens a scene (JSON) in the module of its dimension. */
  async open(text: string, survey = true): Promise<Opened> {
    // What says no dimension is refused by any module, with its reason.
    const dim = dimensionOf(text) ?? 1;
    await this.equip(`${dim as 1 | 2 | 3}d`);
    const opened = await this.call<Opened>("open", text, survey, dim);
    // The document that the page edits is what was opened.
    opened.description.document = JSON.parse(text);
    return opened;
  }
  /** The frame at a time; null if a later call made it needless. */
  seek(time: number): Promise<Float64Array | null> {
    return this.call("seek", time);
  }
  advanceToNext(horizon: number): Promise<{ time: number | null; frame: Float64Array }> {
    return this.call("next", horizon);
  }
  live(time: number, budget: number): Promise<Float64Array> {
    return this.call("live", time, budget);
  }
  /** Runs ahead no further. */
  rest(): Promise<boolean> {
    return this.call("rest");
  }
  frame(): Promise<Float64Array> {
    return this.call("frame");
  }
  lines(from: number, count: number): Promise<Impact[]> {
    return this.call("lines", from, count);
  }
  /** The words are there. */
  get speaks(): boolean {
    return this.has.has("words");
  }
  async explain(n: number, language: string, letters: string): Promise<Chain | null> {
    await this.equip("words");
    return this.call("explain", n, language, letters);
  }
  ledger(n: number): Promise<Ledger | null> {
    return this.call("ledger", n);
  }
  samples(count: number): Promise<Float64Array> {
    return this.call("samples", count);
  }
  reverse(): Promise<boolean> {
    return this.call("reverse");
  }
  report(): Promise<Report> {
    return this.call("report");
  }
  async write(form: "json" | "toml" | "full"): Promise<string> {
    await this.equip("files");
    return this.call("write", form);
  }
  stop(): void {
    this.worker.terminate();
  }
}

async function compile(part: Part): Promise<WebAssembly.Module> {
  const name = `carom-${part}.wasm`;
  const response = await fetch(`./${name}`, { credentials: "same-origin" });
  if (!response.ok) throw new Error(`${name}: ${response.status}`);
  const type = response.headers.get("content-type") ?? "";
  // Some simple servers do not know the type; then it is compiled from its bytes.
  if (type.startsWith("application/wasm")) return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}
