// The engine in its own thread: answers calls in order, and runs ahead in pieces between them.
import { Engine, Files, SceneError, Words } from "./module.ts";
import type { Description, Survey } from "./types.ts";

/** How long the worker computes before it looks for messages again (ms). */
const SLICE = 12;
/** Impacts in one piece of the survey. */
const PIECE = 256;
/** The survey of a scene that never ends by itself stops here. */
const MOST_IMPACTS = 400_000;

interface Call {
  id: number;
  verb: string;
  args: unknown[];
}

/** The module of the open scene, and those of all dimensions that have been needed. */
let engine: Engine | null = null;
const engines = new Map<string, Engine>();
let words: Words | null = null;
let files: Files | null = null;
/** The open scene, and the call that opened it. */
let scene = "";
let opened = 0;
let surveying = false;
let told = 0;
const queue: Call[] = [];
let busy = false;
/** Modules that are being made ready. */
let loading = 0;

function post(message: unknown, transfer: Transferable[] = []): void {
  (self as unknown as { postMessage(m: unknown, t: Transferable[]): void }).postMessage(message, transfer);
}

function progress(force = false): void {
  if (!engine) return;
  const now = performance.now();
  if (!force && now - told < 100) return;
  told = now;
  const survey = engine.surveyed<Survey>();
  const marks = engine.marks();
  post({ survey, marks, of: opened }, [marks.buffer]);
}

/** A piece of the survey, then whatever was asked meanwhile. */
function work(): void {
  if (loading > 0) {
    busy = false;
    return;
  }
  answer();
  if (surveying && engine) {
    const until = performance.now() + SLICE;
    let done = false;
    while (!done && performance.now() < until) done = engine.survey(PIECE);
    if (done || engine.surveyed<Survey>().impacts > MOST_IMPACTS) {
      surveying = false;
      progress(true);
    } else {
      progress();
    }
  }
  busy = surveying || queue.length > 0;
  if (busy) setTimeout(work, 0);
}

function answer(): void {
  while (queue.length > 0) {
    const call = queue.shift()!;
    // Of many frames that were asked for, the last is the one that will be seen.
    if (call.verb === "seek" && queue.some((c) => c.verb === "seek")) {
      post({ id: call.id, result: null });
      continue;
    }
    try {
      const result = run(call);
      const transfer = result instanceof Float64Array ? [result.buffer] : [];
      post({ id: call.id, result }, transfer);
    } catch (error) {
      const problems = error instanceof SceneError ? error.problems : null;
      post({ id: call.id, error: String(error instanceof Error ? error.message : error), problems });
    }
  }
}

function run({ id, verb, args }: Call): unknown {
  const e = (verb === "open" && engines.get(`${args[2]}d`)) || engine!;
  switch (verb) {
    case "open": {
      // A scene that is refused leaves the one before open.
      const description = e.open<Description>(args[0] as string);
      engine = e;
      const start = e.frame();
      scene = args[0] as string;
      opened = id;
      surveying = args[1] as boolean;
      // Small scenes are known at once: a piece here saves a round trip.
      if (surveying) {
        const until = performance.now() + SLICE;
        let done;
        do done = e.survey(PIECE);
        while (!done && performance.now() < until);
        if (done) surveying = false;
      }
      return { id, description, survey: e.surveyed<Survey>(), marks: e.marks(), start };
    }
    case "seek":
      e.seek(args[0] as number);
      return e.frame();
    case "next": {
      const time = e.next(args[0] as number);
      return { time: Number.isNaN(time) ? null : time, frame: e.frame() };
    }
    case "rest":
      surveying = false;
      return true;
    case "frame":
      return e.frame();
    case "live": {
      // A gas goes on without an end: as far as this frame's time, but not longer than the page can wait.
      const [target, budget] = args as [number, number];
      const until = performance.now() + budget;
      let at = e.frame()[0];
      const steps = 8;
      const from = at;
      for (let k = 1; k <= steps && performance.now() < until; k++) at = e.seek(from + ((target - from) * k) / steps);
      return e.frame();
    }
    case "lines":
      return e.lines(args[0] as number, args[1] as number);
    case "explain": {
      const posed = e.question(args[0] as number);
      return posed === null ? null : words!.explain(posed, args[1] as string, args[2] as string);
    }
    case "ledger":
      return e.ledger(args[0] as number);
    case "samples":
      return e.samples(args[0] as number);
    case "reverse":
      return e.reverse();
    case "report":
      return e.report();
    case "write":
      return files!.write(scene, args[0] as "json" | "toml" | "full");
    default:
      throw new Error(`no verb ${verb}`);
  }
}

self.onmessage = async (event: MessageEvent) => {
  if (event.data.module) {
    // What was asked for meanwhile waits in the queue.
    const { module, part } = event.data as { module: WebAssembly.Module; part: string };
    loading++;
    if (part === "words") words = await Words.load(module);
    else if (part === "files") files = await Files.load(module);
    else engines.set(part, await Engine.load(module));
    loading--;
  } else {
    queue.push(event.data as Call);
  }
  if (!busy && loading === 0 && (queue.length > 0 || surveying)) {
    busy = true;
    work();
  }
};
