// The one scene on the page: what it is, where it stands, which impact is looked at. Panels listen; physics is the engine's.
import { type Client, type Opened } from "./engine/client.ts";
import { type Problem, SceneError } from "./engine/module.ts";
import { type Chain, type Description, Frame, type Impact, type Ledger, type SceneDocument, type Survey } from "./engine/types.ts";
import { builtin } from "./gallery.ts";
import { learn } from "./math.ts";
import { letters, type Settings } from "./settings.ts";

export type Topic = "scene" | "frame" | "survey" | "impact" | "show" | "play" | "problems" | "predict" | "answer" | "stage";
export type StageAt = "before" | "at" | "after";

export interface Show {
  v: boolean;
  p: boolean;
  J: boolean;
  nt: boolean;
  cm: boolean;
  trail: boolean;
  grid: boolean;
  values: boolean;
  spin: boolean;
}

export const SPEEDS = [1 / 64, 1 / 16, 1 / 4, 1, 4, 16];

export class App {
  readonly client: Client;
  settings: Settings;
  description!: Description;
  document!: SceneDocument;
  frame!: Frame;
  /** The frame at time 0. */
  start!: Frame;
  survey: Survey = { done: false, time: 0, impacts: 0, kept: 0, stopped: null, report: null };
  marks: Float64Array = new Float64Array();
  /** The impact that is looked at, from 1; 0 if there is none. */
  chosen = 0;
  stage: StageAt = "after";
  impact: Impact | null = null;
  /** All lines of the instant of `impact`. */
  instant: Impact[] = [];
  chain: Chain | null = null;
  /** The words are on their way. */
  chaining = false;
  ledger: Ledger | null = null;
  /** The ledger since the start instead of that of the impact. */
  whole = false;
  problems: Problem[] = [];
  playing = false;
  speed = 3;
  show: Show = { v: true, p: false, J: true, nt: true, cm: false, trail: false, grid: false, values: true, spin: true };
  /** Results are hidden until the learner has answered. */
  predicting = false;
  /** What the learner says so far: of each body that is asked about, by its number and its side of the impact, the velocity after. */
  answers: { body: number; side: number; velocity: number[] }[] = [];
  /** Controls that a teacher's link has frozen. */
  locked = new Set<string>();
  /** The fragment of the address that stands for the open scene. */
  address = "";
  /** The name of the built-in scene, while it is unchanged. */
  builtin: string | null = null;

  private listeners = new Map<Topic, Set<() => void>>();
  /** Scenes are opened one after the other: of two at once the page would show the one and the engine run the other. */
  private lane: Promise<unknown> = Promise.resolve();
  private opening = 0;
  /** The scene that the page shows. */
  private taken = 0;
  private news: { id: number; survey: Survey; marks: Float64Array } | null = null;
  private loads = 0;
  private loading = 0;
  private wanted: { text: string } | null = null;
  private editing: Promise<void> | null = null;
  private stands = true;
  private looking = 0;
  /** The time that is being gone to, and the way there: of several that were begun, the last. */
  private heading = 0;
  private way: Promise<void> = Promise.resolve();
  private clock = 0;

  constructor(client: Client, settings: Settings) {
    this.client = client;
    this.settings = settings;
    client.onSurvey = (survey, marks, id) => {
      // The engine may have opened a scene that the page passes over.
      this.news = { id, survey, marks };
      if (id !== this.taken) return;
      this.survey = survey;
      this.marks = marks;
      // News of the first scene may come before its first frame.
      if (!this.frame) return;
      if (this.chosen === 0 && marks.length > 0) this.chosen = 1;
      this.tell("survey");
      // Whoever is on the way to a time goes on to it.
      if (this.chosen > 0 && !this.impact) void this.look(this.stands || this.playing ? this.frame.time : this.heading);
    };
  }

  on(topic: Topic, listener: () => void): void {
    const set = this.listeners.get(topic) ?? new Set();
    set.add(listener);
    this.listeners.set(topic, set);
  }

  tell(topic: Topic): void {
    this.listeners.get(topic)?.forEach((listener) => listener());
  }

  /** Forgets all listeners: the page is built anew. */
  deafen(): void {
    this.listeners.clear();
  }

  get dim(): number {
    return this.description.dim;
  }

  /** Everything on the page is of this scene, this time and this impact. */
  get settled(): boolean {
    return this.stands && this.opening === 0;
  }

  /** When the history ends, as far as it is known. */
  get end(): number {
    if (!this.survey.done) return Math.max(this.survey.time, this.description.until.time ?? 0);
    // A long way after the last impact is not worth a line on which all impacts are at one end.
    const last = this.marks.at(-1) ?? 0;
    return last > 0 && this.survey.time > 8 * last ? Number((1.5 * last).toPrecision(2)) : this.survey.time;
  }

  /** True if the stage stands exactly at the chosen impact. */
  get atImpact(): boolean {
    return this.chosen > 0 && !this.playing && this.frame.time === this.marks[this.chosen - 1];
  }

  /** Seconds of the scene in a second of the clock, at ×1. */
  get rate(): number {
    const end = this.end;
    if (end <= 0 || (end >= 0.8 && end <= 40)) return 1;
    const raw = end / 8;
    const power = 10 ** Math.floor(Math.log10(raw));
    const lead = raw / power;
    return (lead < 2 ? 1 : lead < 5 ? 2 : 5) * power;
  }

  /** A step of the clock for the step keys (s). */
  get step(): number {
    return this.rate / 30;
  }

  private inTurn<T>(job: () => Promise<T>): Promise<T> {
    this.opening++;
    const mine = this.lane.then(job).finally(() => this.opening--);
    this.lane = mine.catch(() => {});
    return mine;
  }

  /** Opens a built-in scene; false if another was asked for meanwhile. */
  async loadBuiltin(name: string): Promise<boolean> {
    const text = builtin(name);
    return text !== null && this.load(text, name);
  }

  /** Opens a scene; false if another was asked for meanwhile. */
  async load(text: string, builtin: string | null = null): Promise<boolean> {
    const turn = ++this.loads;
    this.pause();
    this.loading++;
    try {
      return await this.inTurn(async () => {
        if (turn !== this.loads) return false;
        const opened = await this.client.open(text);
        // What was changed meanwhile was the scene before.
        this.wanted = null;
        this.builtin = builtin;
        this.chosen = 0;
        this.stage = "after";
        this.whole = false;
        this.take(opened);
        this.document = structuredClone(opened.description.document);
        this.frame = this.start;
        this.impact = null;
        this.chain = null;
        this.ledger = null;
        this.instant = [];
        this.tell("problems");
        this.tell("scene");
        await this.look(0);
        return turn === this.loads;
      });
    } finally {
      this.loading--;
    }
  }

  private take(opened: Opened): void {
    this.taken = opened.id;
    this.description = opened.description;
    const { survey, marks } = this.news?.id === opened.id ? this.news : opened;
    this.survey = survey;
    this.marks = marks;
    this.start = new Frame(opened.start, this.dim);
    this.problems = [];
    if (this.chosen === 0 && this.marks.length > 0) this.chosen = 1;
    if (this.chosen > this.marks.length && this.survey.done) this.chosen = this.marks.length;
  }

  /** Changes the scene. Impossible ones are told, and the last possible one stays open. */
  edit(change: (document: SceneDocument) => void): Promise<void> {
    const next = structuredClone(this.document);
    change(next);
    this.document = next;
    this.builtin = null;
    this.wanted = { text: JSON.stringify(next) };
    this.editing ??= this.inTurn(() => this.change()).finally(() => (this.editing = null));
    return this.editing;
  }

  private async change(): Promise<void> {
    // What the engine has opened and the page has passed over: of many changes in a row, only the last is shown.
    let passed: Opened | null = null;
    const show = async (opened: Opened) => {
      passed = null;
      // Where the page stands, or is going to.
      const time = this.stands || this.playing ? this.frame.time : this.heading;
      const stays = this.chosen > 0 && !this.playing && time === this.marks[this.chosen - 1];
      this.take(opened);
      await this.look(stays && this.chosen > 0 && this.marks.length >= this.chosen ? this.marks[this.chosen - 1] : Math.min(time, this.survey.time));
    };
    while (this.wanted) {
      const { text } = this.wanted;
      this.wanted = null;
      try {
        const opened = await this.client.open(text);
        passed = opened;
        if (this.wanted || this.loading > 0) continue;
        await show(opened);
        this.tell("problems");
        this.tell("scene");
      } catch (error) {
        if (!(error instanceof SceneError)) throw error;
        if (this.loading > 0) continue;
        this.pause();
        // The last possible scene is the one that the engine has open.
        if (passed) await show(passed);
        this.problems = error.problems;
        this.tell("problems");
      }
    }
  }

  /** Goes to a time, and reads what there is to know of the chosen impact. Done when the page stands there, or where it was sent
   * meanwhile. */
  async look(time: number): Promise<void> {
    this.heading = time;
    this.stands = false;
    this.way = this.go(time, ++this.looking);
    let way;
    do await (way = this.way);
    while (way !== this.way);
  }

  private async go(time: number, turn: number): Promise<void> {
    const frame = await this.client.seek(time);
    if (turn !== this.looking || !frame) return;
    this.frame = new Frame(frame, this.dim);
    await this.study();
  }

  /** Reads the chosen impact anew: its line and its ledger, then its chain. Done with the chain, but for the first: the page does not wait
   * for the words to be loaded. */
  async study(): Promise<void> {
    const n = this.chosen;
    const turn = this.looking;
    if (n === 0) {
      this.impact = null;
      this.instant = [];
      this.chain = null;
      const ledger = await this.client.ledger(0);
      if (turn !== this.looking) return;
      this.ledger = ledger;
      this.arrived();
      return;
    }
    // What is still to be loaded for the words waits until the page is seen.
    const spoken = this.client.speaks;
    const explained = spoken ? this.explain(n) : null;
    const [lines, ledger] = await Promise.all([this.client.lines(Math.max(1, n - 24), 49), this.client.ledger(this.whole ? 0 : n)]);
    if (turn !== this.looking) return;
    this.chaining = !spoken;
    const take = () => {
      this.impact = lines.find((line) => line.n === n) ?? null;
      this.instant = this.impact ? lines.filter((line) => line.time === this.impact!.time) : [];
      this.ledger = ledger;
    };
    const chain = async () => {
      const chain = await (explained ?? seen().then(() => this.explain(n)));
      if (turn !== this.looking) return;
      take();
      this.chain = chain;
      this.chaining = false;
      this.arrived();
    };
    if (!this.chaining) return chain();
    take();
    this.chain = null;
    this.tell("frame");
    this.tell("impact");
    void chain();
  }

  /** The chain of an impact in the language of the page, and what sets it. */
  private async explain(n: number): Promise<Chain | null> {
    const { language } = this.settings;
    const [chain] = await Promise.all([this.client.explain(n, language, letters(this.settings)), learn()]);
    // The language was changed meanwhile: what was asked for is in the old one.
    return language === this.settings.language ? chain : this.explain(n);
  }

  private arrived(): void {
    this.tell("frame");
    this.tell("impact");
    this.stands = true;
  }

  /** Goes to the n-th impact and stops at contact. */
  async toImpact(n: number, stage: StageAt = this.stage): Promise<void> {
    if (n < 1 || n > this.marks.length) return;
    this.pause();
    this.chosen = n;
    this.stage = stage;
    await this.look(this.marks[n - 1]);
    this.tell("stage");
  }

  /** The next impact after now; 0 if there is none. */
  get nextImpact(): number {
    const time = this.frame.time;
    if (this.atImpact) {
      // The other contacts of this instant have been seen with it.
      let n = this.chosen;
      while (n < this.marks.length && this.marks[n] === time) n++;
      return n < this.marks.length ? n + 1 : 0;
    }
    const k = upper(this.marks, time);
    // Standing at time 0, an impact at time 0 is still to come.
    if (time === 0 && this.marks[0] === 0) return 1;
    return k < this.marks.length ? k + 1 : 0;
  }

  /** The last impact before now; 0 if there is none. */
  get previousImpact(): number {
    const time = this.frame.time;
    let k = upper(this.marks, time);
    while (k > 0 && this.marks[k - 1] >= time) k--;
    if (k === 0) return 0;
    while (k > 1 && this.marks[k - 2] === this.marks[k - 1]) k--;
    return k;
  }

  async next(): Promise<void> {
    if (this.nextImpact > 0) await this.toImpact(this.nextImpact);
  }

  async previous(): Promise<void> {
    if (this.previousImpact > 0) await this.toImpact(this.previousImpact);
  }

  async toStart(): Promise<void> {
    await this.seek(0);
  }

  async stepBy(steps: number): Promise<void> {
    await this.seek(this.frame.time + steps * this.step);
  }

  setStage(stage: StageAt): void {
    this.stage = stage;
    if (this.chosen > 0 && !this.atImpact) void this.toImpact(this.chosen, stage);
    this.tell("stage");
    this.tell("frame");
  }

  /** Goes to a time, and stays there. */
  async seek(time: number): Promise<void> {
    this.pause();
    const to = Math.min(Math.max(0, time), this.end);
    const passed = upper(this.marks, to);
    this.chosen = passed > 0 ? passed : this.marks.length > 0 ? 1 : 0;
    if (passed > 0 && this.marks[passed - 1] === to) {
      let first = passed;
      while (first > 1 && this.marks[first - 2] === to) first--;
      this.chosen = first;
    }
    this.stage = "after";
    await this.look(to);
    this.tell("stage");
  }

  play(): void {
    if (this.problems.length > 0 || this.playing || this.loading > 0) return;
    this.playing = true;
    this.tell("play");
    const from = this.frame.time >= this.end && this.survey.done ? 0 : this.frame.time;
    let time = from;
    let last = performance.now();
    const turn = ++this.clock;
    let waiting = false;
    let studied = 0;
    const tick = (now: number) => {
      if (!this.playing || turn !== this.clock) return;
      const dt = Math.min(0.1, (now - last) / 1000);
      last = now;
      if (!waiting) {
        time = Math.min(time + dt * SPEEDS[this.speed] * this.rate, this.end);
        waiting = true;
        void this.client.seek(time).then((frame) => {
          waiting = false;
          if (!frame || !this.playing || turn !== this.clock) return;
          this.frame = new Frame(frame, this.dim);
          const passed = upper(this.marks, time);
          const choose = passed > 0 ? passed : this.marks.length > 0 ? 1 : 0;
          // Impacts may come faster than equations can be read: a few a second are shown.
          if (choose !== this.chosen && performance.now() - studied > 180) {
            studied = performance.now();
            this.chosen = choose;
            this.looking++;
            void this.study();
          }
          this.tell("frame");
          if (time >= this.end && this.survey.done) this.pause();
        });
      }
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  pause(): void {
    if (!this.playing) return;
    this.playing = false;
    this.clock++;
    const passed = upper(this.marks, this.frame.time);
    this.chosen = passed > 0 ? passed : this.marks.length > 0 ? 1 : 0;
    this.looking++;
    this.tell("play");
    void this.study();
  }
}

/** The next picture has been drawn; or it is not going to be, where nobody looks. */
function seen(): Promise<void> {
  return new Promise((resolve) => {
    requestAnimationFrame(() => setTimeout(resolve, 0));
    setTimeout(resolve, 300);
  });
}

/** How many of the ascending times are not after `time`. */
export function upper(times: Float64Array, time: number): number {
  let [low, high] = [0, times.length];
  while (low < high) {
    const mid = (low + high) >> 1;
    if (times[mid] <= time) low = mid + 1;
    else high = mid;
  }
  return low;
}
