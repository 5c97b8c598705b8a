// The books: momentum of each body, of walls and Earth, and in all; energy with what was lost. A tick only where they close.
import type { App } from "../app.ts";
import { fill, h } from "../dom.ts";
import type { LedgerRow } from "../engine/types.ts";
import { fmt, t } from "../words/index.ts";

const AXES = ["x", "y", "z"];

export function ledger(app: App): HTMLElement {
  const body = h("div", { class: "scroll", tabIndex: 0, role: "region", aria: { label: t("ledger.title") } });
  const scope = h("div", { class: "segments", role: "radiogroup", aria: { label: t("ledger.scope") } });
  const panel = h("section", { class: "panel ledger", data: { panel: "ledger" }, aria: { label: t("ledger.title") } }, h("div", { class: "panel-head" }, h("h2", {}, t("ledger.title")), scope), body);

  const narrow = matchMedia("(max-width: 700px)");
  /** A row of this scene did not fit. */
  let cramped = false;
  const draw = () => {
    fill(
      scope,
      [false, true].map((whole) =>
        h("label", { class: "segment" }, h("input", { type: "radio", name: "ledger", checked: app.whole === whole, onchange: () => ((app.whole = whole), void app.study()) }), h("span", {}, t(whole ? "ledger.whole" : "ledger.impact"))),
      ),
    );
    const books = app.ledger;
    if (!books) {
      fill(body, h("p", { class: "quiet-text" }, t("ledger.none")));
      return;
    }
    const hide = app.predicting;
    const letter = app.settings.momentum;
    // Of nearly nothing beside much, only that it is nothing is worth a cell.
    const scale = Math.max(...[...books.rows, books.total].flatMap((r) => [...r.before, ...r.after]).map(Math.abs), 0);
    const number = (x: number, small = 1e-13) => fmt(Math.abs(x) <= small * scale ? 0 : x, 4);
    const cell = (v: number[], name: string, from = 0) => v.map((x, c) => h("td", { class: "q-p", data: { ledger: `${name}-${AXES[from + c]}` } }, number(x)));
    const ticked = (closes?: boolean) => (closes === undefined || hide ? "" : h("span", { class: closes ? "tick" : "cross", title: t(closes ? "ledger.closes" : "ledger.open") }, closes ? "✓" : "✗"));
    const blank = (v: number[]) => v.map(() => h("td", { class: "q-p" }, "?"));
    const row = (r: LedgerRow, name: string, key: string, closes?: boolean) =>
      h(
        "tr",
        { class: key, data: { row: key } },
        h("th", { scope: "row" }, name),
        cell(r.before, `${key}-before`),
        hide ? blank(r.change) : cell(r.change, `${key}-change`),
        hide ? blank(r.after) : cell(r.after, `${key}-after`),
        h("td", { class: "tick-cell" }, ticked(closes)),
      );
    const axes = AXES.slice(0, app.dim);
    /** Where the components side by side would not fit: one below the other. */
    const tall = app.dim === 3 || (app.dim === 2 && (narrow.matches || cramped));
    const tallRows = (r: LedgerRow, name: string, key: string, closes?: boolean) =>
      axes.map((axis, c) =>
        h(
          "tr",
          { class: c === 0 ? `${key} begins` : key, data: { row: key } },
          c === 0 ? h("th", { scope: "rowgroup", rowSpan: app.dim }, name) : null,
          h("th", { class: "axis", scope: "row" }, h("i", {}, letter, h("sub", {}, axis))),
          cell([r.before[c]], `${key}-before`, c),
          hide ? blank([0]) : cell([r.change[c]], `${key}-change`, c),
          hide ? blank([0]) : cell([r.after[c]], `${key}-after`, c),
          c === 0 ? h("td", { class: "tick-cell", rowSpan: app.dim }, ticked(closes)) : null,
        ),
      );
    const lines = (r: LedgerRow, name: string, key: string, closes?: boolean) => (tall ? tallRows(r, name, key, closes) : [row(r, name, key, closes)]);
    const p = (prefix: string, suffix: string) =>
      app.dim === 1 ? [h("th", { scope: "col" }, prefix, h("i", {}, letter), suffix)] : axes.map((axis) => h("th", { scope: "col" }, prefix, h("i", {}, letter, h("sub", {}, axis)), suffix));
    const e = books.energy;
    const energyRow = (name: string, x: number, key: string, tick?: boolean) =>
      h("tr", { class: key }, h("th", { scope: "row" }, name), h("td", { data: { ledger: key } }, hide && key !== "k-before" ? "?" : fmt(Math.abs(x) <= 1e-13 * Math.abs(e.before) ? 0 : x, 4)), h("td", { class: "tick-cell" }, tick && !hide ? h("span", { class: "tick", title: t("ledger.closes") }, "✓") : ""));
    fill(
      body,
      h(
        "table",
        { class: "numbers momentum" },
        h("caption", {}, t("ledger.momentum")),
        h("thead", {}, h("tr", {}, h("th", { colSpan: tall ? 2 : 1 }, h("span", { class: "sr" }, t("bodies.body"))), tall ? [t("ledger.before"), "Δ", t("ledger.after")].map((text) => h("th", { scope: "col" }, text)) : [p("", ` ${t("ledger.before")}`), p("Δ", ""), p("", ` ${t("ledger.after")}`)].flat(), h("th", {}, h("span", { class: "sr" }, t("ledger.closes"))))),
        h(
          "tbody",
          {},
          books.rows.flatMap((r) => lines(r, r.name, `body-${r.name}`)),
          books.others ? lines(books.others, t("ledger.others"), "others") : null,
          books.has_outside ? lines(books.outside, t(app.description.gravity.some((g) => g !== 0) ? "ledger.earth" : "ledger.walls"), "outside") : null,
          lines(books.total, t("ledger.total"), "total", books.closes),
        ),
      ),
      h(
        "table",
        { class: "numbers energy" },
        h("caption", {}, t("ledger.energy")),
        h(
          "tbody",
          {},
          energyRow(t(app.whole ? "ledger.energy.start" : "ledger.energy.before"), e.before, "k-before"),
          energyRow(t(app.whole ? "ledger.energy.now" : "ledger.energy.after"), e.after, "k-after"),
          energyRow(t("ledger.lost"), e.lost, "k-lost", e.closes),
          e.work !== 0 ? energyRow(t("ledger.work"), e.work, "k-work") : null,
        ),
      ),
    );
    if (app.dim === 2 && !tall && body.scrollWidth > body.clientWidth + 1) {
      cramped = true;
      draw();
    }
  };
  app.on("scene", () => (cramped = false));
  for (const topic of ["impact", "predict"] as const) app.on(topic, draw);
  narrow.onchange = () => app.description && draw();
  // On the way, the books since the start follow a few times a second.
  let last = 0;
  app.on("frame", () => {
    if (!app.playing || !app.whole || performance.now() - last < 200) return;
    last = performance.now();
    void app.client.ledger(0).then((books) => {
      app.ledger = books;
      draw();
    });
  });
  return panel;
}
