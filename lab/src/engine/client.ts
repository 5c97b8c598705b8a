// The engine as the page sees it: every verb a promise, and news of the survey.
import type { Problem } from "./module.ts";
import { SceneError } from "./module.ts";
import type { Chain, Description, Impact, Ledger, Report, Survey } from "./types.ts";

export interface Opened {
  description: Description;
  survey: Survey;
  marks: Float64Array;
}

interface Waiting {
  resolve(value: unknown): void;
  reject(error: unknown): void;
}

export class Client {
  private worker: Worker;
  private waiting = new Map<number, Waiting>();
  private next = 1;
  /** Called whenever the survey of the open scene has come further. */
  onSurvey: (survey: Survey, marks: Float64Array) => void = () => {};

  private constructor(worker: Worker) {
    this.worker = worker;
    worker.onmessage = (event) => this.hear(event.data);
  }

  /** Compiles once and shares the module: further workers start at once. */
  static module: Promise<WebAssembly.Module> | null = null;

  static async start(): Promise<Client> {
    Client.module ??= compile();
    const worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
    const client = new Client(worker);
    worker.postMessage({ module: await Client.module });
    return client;
  }

  private hear(message: Record<string, unknown>): void {
    if (message.survey) {
      this.onSurvey(message.survey as Survey, message.marks as Float64Array);
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

  open(text: string, survey = true): Promise<Opened> {
    return this.call("open", text, survey);
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
  /** True if the engine knows friction. */
  rough(): Promise<boolean> {
    return this.call("rough");
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
  explain(n: number, language: string, letters: string): Promise<Chain | null> {
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
  write(form: "json" | "toml" | "full"): Promise<string> {
    return this.call("write", form);
  }
  builtins(): Promise<{ name: string; title: string; text: string }[]> {
    return this.call("builtins");
  }
  stop(): void {
    this.worker.terminate();
  }
}

async function compile(): Promise<WebAssembly.Module> {
  const response = await fetch("./carom.wasm", { credentials: "same-origin" });
  if (!response.ok) throw new Error(`carom.wasm: ${response.status}`);
  const type = response.headers.get("content-type") ?? "";
  // Some simple servers do not know the type; then it is compiled from its bytes.
  if (type.startsWith("application/wasm")) return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}
