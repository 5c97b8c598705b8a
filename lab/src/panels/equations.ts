// The impact that is looked at: before, at, after, and the chain of `carom explain` with its numbers. The page sets what the
// engine says; it computes nothing.
import type { App, StageAt } from "../app.ts";
import { fill, h, icon } from "../dom.ts";
import type { Bit, Chain, Item, Row, Side } from "../engine/types.ts";
import { math } from "../math.ts";
import { fmt, t } from "../words/index.ts";

type View = "both" | "symbols" | "numbers";
/** Kept while the page is open. */
let view: View = "both";
const open = new Set<string>();

export function equations(app: App, point: (name: string) => void): HTMLElement {
  const head = h("div", { class: "impact-head" });
  const body = h("div", { class: "chain" });
  const panel = h("section", { class: "panel equations", data: { panel: "equations" }, aria: { label: t("equations.title") } }, head, body);

  const title = () => {
    const known = app.marks.length;
    const many = app.instant.length > 1;
    const heading = app.chosen > 0 ? t("impact.of", { n: app.chosen, of: app.survey.done ? app.survey.impacts : `${known}…` }) : t("impact.none");
    const stages: StageAt[] = ["before", "at", "after"];
    fill(
      head,
      h(
        "div",
        { class: "impact-title" },
        h("h2", {}, heading),
        h("button", { class: "quiet tiny", type: "button", disabled: app.chosen <= 1, aria: { label: t("impact.previous") }, onclick: () => void app.toImpact(app.chosen - 1) }, icon("back")),
        h("button", { class: "quiet tiny", type: "button", disabled: app.chosen === 0 || app.chosen >= known, aria: { label: t("impact.next") }, onclick: () => void app.toImpact(app.chosen + 1) }, icon("forth")),
      ),
      app.impact ? h("p", { class: "who" }, t(many ? "impact.who.many" : "impact.who", { a: who(app.impact.bodies[0]), b: who(app.impact.bodies[1]), time: fmt(app.impact.time, 5), count: app.instant.length })) : null,
      app.chosen > 0
        ? h(
            "div",
            { class: "choosers" },
            h(
              "div",
              { class: "segments", role: "radiogroup", aria: { label: t("impact.stage") } },
              stages.map((stage) =>
                h("label", { class: "segment" }, h("input", { type: "radio", name: "stage", value: stage, checked: app.atImpact && app.stage === stage, onchange: () => app.setStage(stage) }), h("span", {}, t(`impact.${stage}`))),
              ),
            ),
            app.chain && !app.predicting
              ? h(
                  "div",
                  { class: "segments views", role: "radiogroup", aria: { label: t("equations.view") } },
                  (["both", "symbols", "numbers"] as View[]).map((v) =>
                    h("label", { class: "segment" }, h("input", { type: "radio", name: "view", value: v, checked: view === v, onchange: () => ((view = v), (body.dataset.view = v)) }), h("span", {}, t(`equations.${v}`))),
                  ),
                )
              : null,
          )
        : null,
    );
  };

  const chain = () => {
    title();
    if (app.chosen === 0) {
      fill(body, h("p", { class: "quiet-text" }, t("impact.none.more")));
      return;
    }
    if (app.predicting) {
      fill(body, h("p", { class: "quiet-text" }, t("predict.hidden")));
      return;
    }
    if (app.chaining) {
      fill(body, h("p", { class: "quiet-text" }, "…"));
      return;
    }
    if (!app.chain) {
      fill(body, app.instant.length > 1 ? together(app) : h("p", { class: "quiet-text" }, app.impact ? t("impact.special") : t("impact.far", { count: app.survey.kept })));
      return;
    }
    const c = app.chain;
    fill(
      body,
      c.special.length > 0 ? h("ul", { class: "badges", aria: { label: t("equations.special") } }, c.special.map((s) => h("li", { class: `badge badge-${s}` }, t(`special.${s}`)))) : null,
      h("div", { class: "brief", data: { chain: "brief" } }, c.brief.map((row) => equation(short(row, c)))),
      h("h3", { class: "lecture" }, t("equations.chain")),
      c.steps.map((step, k) => {
        const key = `${step.number ?? k}`;
        const details = h("details", { class: "step", open: open.has(key) }, h("summary", {}, step.number !== null ? h("b", { class: "step-number" }, String(step.number)) : null, h("span", {}, bits(step.title))));
        // What is closed is not set: most of it is never looked at.
        const set = () => {
          if (details.open && details.childElementCount === 1) details.append(...step.items.map(item));
        };
        set();
        details.addEventListener("toggle", () => {
          if (details.open) open.add(key);
          else open.delete(key);
          set();
        });
        return details;
      }),
    );
    body.dataset.view = view;
  };

  const over = (event: Event) => {
    const letter = (event.target as Element).closest?.<HTMLElement>("[data-q]");
    point(letter?.dataset.q ?? "");
    if (letter && app.chain) {
      const value = app.chain.values.find(([name]) => name === letter.dataset.q);
      if (value) letter.title = value[1].length === 1 ? fmt(value[1][0], 6) : `(${value[1].map((x) => fmt(x, 6)).join("; ")})`;
    }
  };
  for (const type of ["pointerover", "focusin", "click"]) body.addEventListener(type, over);
  body.addEventListener("pointerleave", () => point(""));
  app.on("impact", chain);
  app.on("scene", title);
  app.on("survey", title);
  app.on("stage", title);
  app.on("predict", chain);
  app.on("frame", () => head.querySelectorAll<HTMLInputElement>("input[name=stage]").forEach((input) => (input.checked = app.atImpact && app.stage === input.value)));
  return panel;
}

export function cycleView(): void {
  const order: View[] = ["both", "symbols", "numbers"];
  view = order[(order.indexOf(view) + 1) % order.length];
  const input = document.querySelector<HTMLInputElement>(`input[name=view][value=${view}]`);
  input?.click();
}

/** "wall:floor" as people say it. */
export function who(label: string): string {
  const [kind, name] = label.includes(":") ? label.split(":") : ["", label];
  if (kind === "wall") return t("who.wall", { name });
  if (kind === "boundary") return t("who.boundary", { side: name.replace("-", "−") });
  return name;
}

/** Several contacts at one instant: no single chain tells them, so the table of contacts does. */
function together(app: App): HTMLElement {
  const head = ["who", "approach", "departure", "impulse", "lost"].map((key) => h("th", { scope: "col" }, t(`together.${key}`)));
  const rows = app.instant.map((line) =>
    h("tr", { class: line.n === app.chosen ? "chosen" : "" }, h("th", { scope: "row" }, line.bodies.map(who).join(" – ")), [line.approach, line.departure, line.impulse, line.lost].map((x) => h("td", {}, fmt(Math.abs(x) < 1e-14 ? 0 : x, 4)))),
  );
  return h(
    "div",
    {},
    h("p", {}, t(`together.${app.description.together}`)),
    h("div", { class: "scroll", tabIndex: 0, role: "region", aria: { label: t("together.caption") } }, h("table", { class: "numbers" }, h("caption", { class: "sr" }, t("together.caption")), h("thead", {}, h("tr", {}, head)), h("tbody", {}, rows))),
  );
}

function bits(text: Bit[]): Node[] {
  return text.map((bit) => ("w" in bit ? document.createTextNode(bit.w) : math(bit.m)));
}

/** A row of the heart of the impact with its value in three significant digits; the steps below show six. */
function short(row: Row, chain: Chain): Row {
  const name = /\\htmlData\{q=([^}]+)\}/.exec(row.sides[0]?.tex ?? "")?.[1];
  const exact = chain.values.find(([key]) => key === name)?.[1];
  const last = row.sides[row.sides.length - 1];
  if (!exact || last.kind !== "value") return row;
  const numbers = /-?(?:\d+(?:(?:\.|\{,\})\d+)?(?: \\times 10\^\{-?\d+\})?|10\^\{-?\d+\})/g;
  if ((last.tex.match(numbers) ?? []).length !== exact.length) return row;
  let k = 0;
  let rounded = false;
  const tex = last.tex.replace(numbers, () => {
    const x = exact[k++];
    const shown = x === 0 ? 0 : Number(x.toPrecision(3));
    rounded ||= Math.abs(shown - x) > 1e-12 * Math.abs(x);
    return inTex(fmt(x));
  });
  return { ...row, sides: [...row.sides.slice(0, -1), { ...last, tex, rel: rounded ? "\\approx" : "=" }] };
}

/** A number as people read it, in LaTeX. */
function inTex(text: string): string {
  return text
    .replaceAll("−", "-")
    .replace(",", "{,}")
    .replace(/×10(⁻?)([⁰¹²³⁴⁵⁶⁷⁸⁹]+)/, (_, minus: string, digits: string) => ` \\times 10^{${minus ? "-" : ""}${[...digits].map((d) => "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(d)).join("")}}`);
}

function equation(row: Row): HTMLElement {
  const parts: Node[] = [];
  row.sides.forEach((side: Side, k) => {
    const tex = k === 0 ? side.tex : `${side.rel} ${side.tex}`;
    parts.push(h("span", { class: `part part-${side.kind} ${k === 0 ? "first" : ""}` }, math(tex)));
  });
  if (row.tick) parts.push(h("span", { class: "tick", title: t("equations.holds") }, "✓"));
  return h("div", { class: "equation" }, parts);
}

function item(item: Item): HTMLElement {
  switch (item.kind) {
    case "prose":
      return h("p", {}, bits(item.text));
    case "note":
      return h("p", { class: "note" }, bits(item.text));
    case "points":
      return h("ul", {}, item.points.map((p) => h("li", {}, bits(p))));
    case "choices":
      return h("ul", { class: "choices" }, item.choices.map((c) => h("li", { class: c.holds ? "holds" : "" }, bits(c.when), ": ", bits(c.then))));
    case "rows":
      return h("div", { class: "rows" }, item.rows.map(equation));
    case "matrices":
      return h("div", { class: "rows" }, item.matrices.map((m) => h("div", { class: "equation matrix" }, math(m))));
    case "checks":
      return h("div", { class: "rows" }, item.checks.map((c) => h("div", { class: `check ${c.holds ? "holds" : "fails"}` }, h("span", { class: "tick" }, c.holds ? "✓" : "✗"), h("span", {}, bits(c.name)), equation(c.row))));
    case "table":
      return h(
        "div",
        { class: "scroll", tabIndex: 0, role: "region", aria: { label: t("equations.title") } },
        h(
          "table",
          { class: "numbers" },
          h("thead", {}, h("tr", {}, item.head.map((c) => h("th", { scope: "col" }, bits(c))))),
          h("tbody", {}, item.rows.map((r) => h("tr", {}, r.map((c, k) => (k === 0 ? h("th", { scope: "row" }, bits(c)) : h("td", { class: item.left[k] ? "left" : "" }, bits(c))))))),
        ),
      );
  }
}
