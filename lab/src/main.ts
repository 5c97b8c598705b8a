// The page: starts the engine, opens the scene of the address, and puts the panels together.
import "./style/letters.css";
import "./style/base.css";
import "./style/panels.css";
import { announcer, summary } from "./announce.ts";
import { App } from "./app.ts";
import { fill, h } from "./dom.ts";
import { Client } from "./engine/client.ts";
import { SceneError } from "./engine/module.ts";
import { builtin, builtins } from "./gallery.ts";
import { keys } from "./keys.ts";
import { decode, encode, NewerLink } from "./link.ts";
import { bodies } from "./panels/bodies.ts";
import { gallery, help, toast } from "./panels/dialogs.ts";
import { equations } from "./panels/equations.ts";
import { header, type Tab } from "./panels/header.ts";
import { ledger } from "./panels/ledger.ts";
import { type Plots, plots } from "./panels/plots.ts";
import { predict } from "./panels/predict.ts";
import { show } from "./panels/show.ts";
import { transport } from "./panels/transport.ts";
import { flat, type Picture } from "./save.ts";
import { applyTheme, load as loadSettings, type Settings, store } from "./settings.ts";
import { Stage } from "./stage/stage.ts";
import { speak, t } from "./words/index.ts";

const DEFAULTS: Record<Tab, string> = { "1": "two-balls", "2": "oblique", "3": "space", gas: "gas" };

class Page {
  app!: App;
  stage: Stage | null = null;
  /** What the tab shows. */
  picture: Picture | null = null;
  plots: Plots | null = null;
  scenes = builtins;
  settings: Settings = loadSettings();
  tab: Tab = "1";
  /** The scene that was last open in a tab. */
  private kept = new Map<Tab, string>();
  private root = document.getElementById("app")!;
  private embed = new URLSearchParams(location.search).has("embed");
  private writing = 0;
  /** The document that the address stands for. */
  private written = "";
  private leave: (() => void) | null = null;
  private deaf: (() => void) | null = null;
  /** The fragment that is being opened. */
  private arriving: string | null = null;
  private query: MediaQueryList = matchMedia("(prefers-color-scheme: dark)");

  async start(): Promise<void> {
    applyTheme(this.settings);
    this.query.addEventListener("change", () => void this.change({}));
    document.body.classList.toggle("embed", this.embed);
    try {
      this.app = new App(Client.start(), this.settings);
      await speak(this.settings.language);
      await this.fromAddress(true);
    } catch (error) {
      fill(this.root, h("p", { class: "fatal", role: "alert" }, t("fatal.engine", { reason: String(error) })));
      return;
    }
    window.addEventListener("popstate", () => void this.fromAddress(false));
    window.addEventListener("hashchange", () => void this.fromAddress(false));
    document.documentElement.dataset.ready = "true";
    if ("serviceWorker" in navigator && import.meta.env.PROD) navigator.serviceWorker.register("./worker-offline.js").catch(() => {});
  }

  /** Opens what the address says: a scene in the fragment, the name of a built-in one, or the first of the lecture. */
  private async fromAddress(first: boolean): Promise<void> {
    const fragment = location.hash;
    // The browser tells of one change twice.
    if (!first && (this.arriving ?? `#${this.app.address}`) === fragment) return;
    this.arriving = fragment;
    clearTimeout(this.writing);
    const parameters = new URLSearchParams(fragment.includes("&") ? fragment.slice(fragment.indexOf("&")) : "");
    this.app.locked = new Set((parameters.get("lock") ?? "").split(",").filter(Boolean));
    const name = /^#([a-z][a-z0-9-]*)/.exec(fragment)?.[1];
    let text: string | null = null;
    try {
      text = await decode(fragment);
    } catch (error) {
      toast(error instanceof NewerLink ? t("link.newer", { version: error.message }) : t("link.broken"), true);
    }
    let opened;
    try {
      opened = text !== null ? await this.app.load(text) : await this.app.loadBuiltin(name && builtin(name) ? name : DEFAULTS["1"]);
    } catch (error) {
      toast(t("link.scene", { reason: error instanceof SceneError ? error.message : String(error) }), true);
      opened = await this.app.loadBuiltin(DEFAULTS["1"]);
    }
    if (this.arriving === fragment) this.arriving = null;
    if (!opened) return;
    this.app.address = fragment.slice(1);
    this.written = JSON.stringify(this.app.document);
    this.arrive();
  }

  /** The tab of the open scene is shown. */
  private arrive(): void {
    const { dim, bodies } = this.app.description;
    this.tab = bodies.length >= 400 && dim === 2 ? "gas" : (String(dim) as Tab);
    this.mount();
  }

  /** A scene by name, with an entry in the history of the browser. */
  private async open(name: string): Promise<void> {
    this.app.locked = new Set();
    if (!(await this.app.loadBuiltin(name))) return;
    this.app.address = name;
    history.pushState(null, "", `#${name}`);
    this.arrive();
  }

  private async toTab(tab: Tab): Promise<void> {
    if (tab === this.tab) return;
    this.kept.set(this.tab, this.app.address);
    const back = this.kept.get(tab);
    if (back !== undefined) {
      history.pushState(null, "", `#${back}`);
      await this.fromAddress(false);
      return;
    }
    await this.open(DEFAULTS[tab]);
  }

  private async change(settings: Partial<Settings>): Promise<void> {
    Object.assign(this.settings, settings);
    store(this.settings);
    await speak(this.settings.language);
    applyTheme(this.settings);
    this.mount();
    void this.app.study();
  }

  /** Builds the whole page anew: after a change of scene, language or letters. */
  private mount(): void {
    const { app } = this;
    const focused = (document.activeElement as HTMLElement | null)?.dataset;
    const again = focused?.language ? `[data-language="${focused.language}"]` : focused?.tab ? `[data-tab="${focused.tab}"]` : null;
    this.leave?.();
    this.deaf?.();
    this.leave = this.deaf = null;
    app.deafen();
    app.predicting = false;
    document.title = `${app.description.title || t("scene.own")} – Carom Lab`;
    const top = header({
      app,
      picture: () => this.picture,
      scenes: this.scenes,
      tab: this.tab,
      toTab: (tab) => void this.toTab(tab),
      toScene: (name) => void this.open(name),
      change: (s) => void this.change(s),
      help: () => this.help(),
      gallery: () => gallery(this.scenes, (name) => void this.open(name)),
      worksheet: () => void import("./panels/worksheet.ts").then((m) => m.worksheet(app, this.picture)),
      compare: () => void import("./panels/compare.ts").then((m) => m.compare(app)),
      toast,
    });
    if (this.tab === "gas") {
      this.stage = this.picture = null;
      const place = h("main", { class: "gas-tab" });
      fill(this.root, this.embed ? null : top, place);
      void app.client.rest();
      void import("./gas/gas.ts").then((m) => ({ leave: this.leave, picture: this.picture } = m.gas(place)));
      this.settle(again);
      return;
    }
    this.stage = new Stage(app);
    this.picture = app.dim === 3 ? null : flat(app, this.stage);
    const point = (name: string) => this.point(name);
    this.plots = plots(app);
    const panels = [predict(app), bodies(app), equations(app, point)];
    const below = [ledger(app), this.plots.element];
    const side = h("aside", { class: "side" }, panels);
    const stagePlace = h("div", { class: "stage-place" }, this.stage.element);
    if (app.dim === 3) {
      stagePlace.classList.add("space");
      void import("./space/space.ts").then((m) => ({ leave: this.leave, picture: this.picture } = m.space(app, stagePlace)));
    }
    const main = h("main", { class: "lab" }, h("div", { class: "left" }, stagePlace, transport(app), show(app), h("div", { class: "below" }, below)), side, this.phoneTabs());
    fill(this.root, this.embed ? null : top, main, announcer(app), summary(app), this.footer());
    this.listenForAddress();
    this.deaf = keys(app, stagePlace, () => this.help());
    for (const topic of ["problems", "scene", "survey", "frame", "impact", "play"] as const) app.tell(topic);
    this.settle(again);
  }

  private settle(again: string | null): void {
    if (again) document.querySelector<HTMLElement>(again)?.focus();
  }

  /** An equation points at an arrow and a cell. */
  private point(name: string): void {
    if (!this.stage || this.stage.hot === name) return;
    this.stage.hot = name;
    const quantity = /^v\d/.test(name) ? "v" : "";
    document.querySelectorAll(".hot").forEach((e) => e.classList.remove("hot"));
    if (name) document.querySelectorAll(`[data-q="${CSS.escape(name)}"]`).forEach((e) => e.classList.add("hot"));
    const side = /(\d)/.exec(name)?.[1];
    const impact = this.app.impact;
    if (quantity && side && impact) {
      const k = this.app.description.bodies.findIndex((b) => b.name === impact.bodies[Number(side) - 1]);
      document.querySelector(`[data-cell="now-${k}"]`)?.classList.add("hot");
    }
    this.stage.redraw();
  }

  /** On a phone one panel at a time. */
  private phoneTabs(): HTMLElement {
    const names = ["bodies", "equations", "ledger", "plots", "show"];
    const choose = (name: string) => {
      document.body.dataset.panel = name;
      bar.querySelectorAll("button").forEach((b) => b.setAttribute("aria-pressed", String(b.dataset.choose === name)));
    };
    const bar = h("nav", { class: "phone-tabs", aria: { label: t("panels") } }, names.map((name) => h("button", { type: "button", data: { choose: name }, aria: { pressed: String((document.body.dataset.panel ?? "bodies") === name) }, onclick: () => choose(name) }, t(`${name}.title`))));
    document.body.dataset.panel ??= "bodies";
    return bar;
  }

  private footer(): HTMLElement {
    const digest = h("output", { class: "digest", title: t("footer.digest") });
    const audit = h("span", { class: "audit" });
    const draw = () => {
      const report = this.app.survey.report;
      digest.textContent = report ? report.digest : "…";
      audit.textContent = report ? t(report.audit.pass ? "footer.passed" : "footer.failed", { stopped: t(`stopped.${report.stopped}`), capped: report.audit.capped }) : t("footer.running", { impacts: this.app.survey.impacts });
      audit.classList.toggle("fails", report !== null && !report.audit.pass);
    };
    this.app.on("survey", draw);
    this.app.on("scene", draw);
    draw();
    return h("footer", { class: "foot" }, audit, h("span", { class: "gap" }), h("span", {}, t("footer.state")), digest);
  }

  private help(): void {
    help(this.app.survey.report?.digest ?? "", "Carom 0.1.0");
  }

  /** Changes of the scene go into the address, so that a reload keeps them and Back undoes them. */
  private listenForAddress(): void {
    this.app.on("scene", () => {
      clearTimeout(this.writing);
      if (this.app.builtin !== null) return;
      this.writing = window.setTimeout(async () => {
        if (this.arriving !== null) return;
        const json = JSON.stringify(this.app.document);
        if (json === this.written) return;
        this.written = json;
        const lock = this.app.locked.size > 0 ? `&lock=${[...this.app.locked].join(",")}` : "";
        const next = (await encode(json)) + lock;
        if (this.app.builtin !== null || next === this.app.address) return;
        this.app.address = next;
        history.pushState(null, "", `#${next}`);
      }, 350);
    });
  }
}

const page = new Page();
(window as unknown as { caromLab: Page }).caromLab = page;
void page.start();
