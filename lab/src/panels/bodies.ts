// The bodies as a table, and what their surfaces say of each other: everything that can be changed.
import type { App } from "../app.ts";
import { fill, h, icon } from "../dom.ts";
import type { BodyDocument, Material, SceneDocument } from "../engine/types.ts";
import { tint } from "../stage/bodies.ts";
import { inks } from "../stage/stage.ts";
import { exact, fmt, t } from "../words/index.ts";
import { field, type Field } from "./field.ts";

const AXES = ["x", "y", "z"];
/** More bodies than this are a count, not a table. */
const MOST = 16;

export function bodies(app: App): HTMLElement {
  const table = h("div", { class: "scroll" });
  const surfaces = h("div", { class: "surfaces" });
  const message = h("p", { class: "complaint", role: "alert" });
  const panel = h("section", { class: "panel bodies", data: { panel: "bodies" }, aria: { label: t("bodies.title") } }, h("h2", {}, t("bodies.title")), table, message, surfaces);
  let updates: (() => void)[] = [];
  let shape = "";

  panel.addEventListener("complaint", (event) => {
    const text = (event as CustomEvent<string | null>).detail;
    message.textContent = text ?? "";
  });

  const narrow = matchMedia("(max-width: 700px)");
  narrow.onchange = () => app.description && build();
  const build = () => {
    const d = app.document;
    panel.dataset.dim = String(app.dim);
    // The same rows and columns only need their numbers changed.
    const next = JSON.stringify([app.dim, usesFriction(d), narrow.matches, app.description.bodies.length, (d.body ?? []).map((b) => [b.name, b.fixed]), Object.keys(d.material ?? {}), (d.pair ?? []).map((p) => p.materials), [...app.locked]]);
    if (next === shape) {
      updates.forEach((u) => u());
      return;
    }
    shape = next;
    updates = [];
    fill(table, d.body?.length && app.description.bodies.length <= MOST ? rows(app, updates, narrow.matches) : summary(app));
    fill(surfaces, materials(app, updates), world(app, updates));
  };
  app.on("scene", build);
  app.on("frame", () => updates.forEach((u) => u()));
  app.on("stage", () => updates.forEach((u) => u()));
  app.on("predict", () => updates.forEach((u) => u()));
  app.on("problems", () => {
    const [first] = app.problems;
    message.textContent = first ? (first.message + (first.help ? ` – ${first.help}` : "")).replace(/`([^`]*)`/g, "“$1”") : "";
    for (const input of panel.querySelectorAll<HTMLInputElement>("input[data-key]")) {
      const hit = app.problems.some((p) => input.dataset.key!.startsWith(p.key) || p.key.startsWith(input.dataset.key!));
      if (hit) input.setAttribute("aria-invalid", "true");
      else if (!input.validationMessage) input.removeAttribute("aria-invalid");
    }
  });
  return panel;
}

function summary(app: App): HTMLElement {
  const d = app.description;
  return h("p", { class: "many" }, t("bodies.many", { count: d.bodies.length }));
}

function rows(app: App, updates: (() => void)[], narrow: boolean): HTMLElement {
  const { dim } = app;
  const axes = AXES.slice(0, dim);
  const spins = dim === 1 ? [] : dim === 2 ? ["ω"] : ["ωx", "ωy", "ωz"];
  const spinning = dim > 1 && usesFriction(app.document);
  const sub = (letter: string, axis: string) => (dim === 1 && letter !== "x" ? [letter] : letter === "x" ? [axis] : [letter, h("sub", {}, axis)]);
  const unit = (text: string) => h("small", {}, text);
  // What a body is and where it begins, and how it moves: two tables where one would not fit.
  const split = dim === 3 || spinning || (dim === 2 && narrow);
  const name = () => h("th", { scope: "col" }, h("span", { class: "sr" }, t("bodies.body")));
  const isHead = [
    name(),
    h("th", { scope: "col" }, h("i", {}, "m"), unit("kg")),
    h("th", { scope: "col" }, h("i", {}, "r"), unit("m")),
    axes.map((axis) => h("th", { scope: "col" }, h("i", {}, sub("x", axis)), unit("m"))),
  ].flat();
  const movesHead = [
    axes.map((axis) => h("th", { scope: "col", class: "q-v" }, h("i", {}, sub("v", axis)), unit("m/s"))),
    spinning ? spins.map((w) => h("th", { scope: "col" }, h("i", {}, w.length > 1 ? ["ω", h("sub", {}, w[1])] : w), unit("rad/s"))) : [],
    h("th", { scope: "col", class: "now" }, h("span", { class: "now-head" }, t("bodies.now"))),
  ].flat();
  const removeHead = h("th", {}, h("span", { class: "sr" }, t("bodies.remove")));
  const [is, moves] = [h("tbody"), h("tbody")];
  app.document.body!.forEach((one, k) => {
    const name = one.name ?? `body-${k + 1}`;
    const put = (label: string, key: string, get: (b: BodyDocument) => number | null, set: (b: BodyDocument, x: number) => void, limits: { min?: number; above?: boolean } = {}, lock = key) => {
      const f: Field = field({
        label: `${name}: ${label}`,
        value: get(one),
        key: `body[${k + 1}].${key}`,
        disabled: app.locked.has(lock) || (key === "mass" && one.fixed === true),
        ...limits,
        onchange: (x) => void app.edit((d) => set(d.body![k], x)),
      });
      updates.push(() => {
        const now = app.document.body?.[k];
        if (now) f.show(get(now));
      });
      return h("td", {}, f.element);
    };
    const now = h("output", { class: "q-v", data: { cell: `now-${k}`, q: `v${k + 1}` } });
    updates.push(() => {
      const text = nowText(app, k);
      if (now.textContent !== text.join("; ")) fill(now, text.map((x, c) => [c > 0 ? h("span", { class: "sr" }, "; ") : null, text.length > 1 ? h("span", {}, x) : x]).flat());
      now.title = t("bodies.now");
    });
    const title = () => h("th", { scope: "row" }, h("span", { class: "chip", data: { chip: k } }), name);
    const isCells = [
        put(t("quantity.mass"), "mass", (b) => (b.fixed && b.mass === undefined ? null : (b.mass ?? massOf(app, k))), (b, x) => ((b.mass = x), delete b.density), { min: 0, above: true }),
        put(t("quantity.radius"), "radius", (b) => b.radius, (b, x) => (b.radius = x), { min: 0, above: true }),
        axes.map((axis, c) => put(axis, "position", (b) => b.position[c], (b, x) => (b.position[c] = x))),
    ].flat();
    const movesCells = [
        axes.map((axis, c) => put(`v${dim > 1 ? axis : ""}`, "velocity", (b) => b.velocity?.[c] ?? 0, (b, x) => ((b.velocity ??= new Array(dim).fill(0))[c] = x))),
        spinning ? spins.map((w, c) => put(w, "spin", (b) => b.spin?.[c] ?? 0, (b, x) => ((b.spin ??= new Array(spins.length).fill(0))[c] = x))) : [],
        h("td", { class: "now" }, now),
    ].flat();
    const remove = h("td", {}, h("button", { class: "quiet tiny", type: "button", disabled: app.document.body!.length < 2 || app.locked.size > 0, title: t("bodies.remove"), aria: { label: `${t("bodies.remove")}: ${name}` }, onclick: () => void app.edit((d) => d.body!.splice(k, 1)) }, icon("remove")));
    if (split) {
      is.append(h("tr", { data: { body: k } }, title(), isCells, remove));
      moves.append(h("tr", { data: { body: k } }, title(), movesCells));
    } else {
      is.append(h("tr", { data: { body: k } }, title(), isCells, movesCells, remove));
    }
  });
  const paint = () => {
    const ink = inks();
    for (const part of [is, moves]) part.querySelectorAll<HTMLElement>(".chip").forEach((chip, k) => (chip.style.background = app.document.body?.[k]?.fixed ? ink.wall : tint(ink, k)));
  };
  updates.push(paint);
  paint();
  updates.forEach((u) => u());
  return h(
    "div",
    {},
    h("table", { class: split ? "numbers split" : "numbers" }, h("caption", { class: "sr" }, t("bodies.caption")), h("thead", {}, h("tr", {}, isHead, split ? null : movesHead, removeHead)), is),
    split ? h("table", { class: `numbers split ${spinning && dim === 3 ? "many-columns" : ""}` }, h("caption", { class: "sr" }, t("bodies.caption")), h("thead", {}, h("tr", {}, name(), movesHead)), moves) : null,
    h("button", { class: "quiet add", type: "button", disabled: app.locked.size > 0, onclick: () => addBody(app) }, icon("add"), t("bodies.add")),
  );
}

/** The velocity that the stage shows: that of the moment, or, at an impact, before or after it. */
function nowText(app: App, k: number): string[] {
  const side = app.atImpact && app.impact ? app.impact.bodies.indexOf(app.description.bodies[k]?.name) : -1;
  const hidden = app.predicting && app.chosen > 0 && app.frame.time >= app.marks[app.chosen - 1];
  let v = k < app.frame.count ? app.frame.velocity(k) : [];
  if (side >= 0 && app.stage === "before") v = app.impact!.before[side].velocity;
  else if (hidden) return ["?"];
  return v.map((x) => fmt(x, 3));
}

function massOf(app: App, k: number): number | null {
  return app.description.bodies[k]?.mass ?? null;
}

/** Adds a body like the last, on free ground. */
function addBody(app: App): void {
  const { dim } = app;
  void app.edit((d) => {
    const all = (d.body ??= []);
    const names = new Set(all.map((b, k) => b.name ?? `body-${k + 1}`));
    const name = [..."ABCDEFGHIJKLMNOPQRSTUVWXYZ"].find((letter) => !names.has(letter)) ?? `body-${all.length + 1}`;
    const last = all[all.length - 1];
    const radius = last?.radius ?? 0.1;
    const right = Math.max(...app.description.bodies.map((b, k) => app.start.position(k)[0] + b.radius));
    const position = new Array(dim).fill(0);
    position[0] = Number((right + 3 * radius).toPrecision(6));
    if (app.description.corners) {
      const [min, max] = app.description.corners;
      for (let c = 0; c < dim; c++) position[c] = Number(((min[c] + max[c]) / 2).toPrecision(6));
    }
    all.push({ name, mass: last?.mass ?? 1, radius, position, velocity: new Array(dim).fill(0), ...(last?.material ? { material: last.material } : {}) });
  });
}

export function usesFriction(d: SceneDocument): boolean {
  const rough = (m: Material) => m.friction !== undefined && m.friction !== 0;
  const turning = (d.body ?? []).some((b) => b.spin?.some((w) => w !== 0));
  return turning || Object.values(d.material ?? {}).some(rough) || (d.pair ?? []).some(rough);
}

const COEFFICIENTS = [
  { key: "restitution", letter: "e", min: 0, max: 1, unsaid: 1 },
  { key: "friction", letter: "μ", min: 0, max: 1, unsaid: 0 },
  { key: "tangential", letter: "eₜ", min: -1, max: 1, unsaid: 0 },
] as const;

/** Sliders for each material and pair of the scene: e, and in the plane and in space μ and e_t. */
function materials(app: App, updates: (() => void)[]): HTMLElement {
  const list = h("div", { class: "materials" });
  const named = Object.keys(app.document.material ?? {});
  if (!named.includes("default") && named.length === 0) named.unshift("default");
  const group = (title: string, get: (d: SceneDocument) => Material | undefined, make: (d: SceneDocument) => Material) => {
    const box = h("div", { class: "material", role: "group", aria: { label: title } });
    if (named.length > 1 || (app.document.pair?.length ?? 0) > 0) box.append(h("h3", {}, title));
    for (const c of COEFFICIENTS) {
      if (c.key !== "restitution" && app.dim === 1) continue;
      box.append(slider(app, updates, c, get, make));
    }
    list.append(box);
  };
  for (const name of named) group(name === "default" ? t("bodies.all") : name, (d) => d.material?.[name], (d) => ((d.material ??= {})[name] ??= {}));
  app.document.pair?.forEach((pair, k) => group(pair.materials.join(" – "), (d) => d.pair?.[k], (d) => d.pair![k]));
  return list;
}

function slider(app: App, updates: (() => void)[], c: (typeof COEFFICIENTS)[number], get: (d: SceneDocument) => Material | undefined, make: (d: SceneDocument) => Material): HTMLElement {
  const locked = app.locked.has(c.key) || (c.key === "restitution" && app.locked.has("e"));
  const read = (): number | "curve" => {
    const said = get(app.document)?.[c.key];
    return typeof said === "object" && said !== null ? "curve" : ((said as number | undefined) ?? c.unsaid);
  };
  const change = (x: number) => void app.edit((d) => (make(d)[c.key] = x));
  const letter = c.key === "restitution" ? app.settings.restitution : c.letter;
  const label = `${letter}: ${t(`quantity.${c.key}`)}`;
  const value = read();
  const range = h("input", { type: "range", min: String(c.min), max: String(c.max), step: "0.01", disabled: locked || value === "curve", aria: { label }, value: String(value === "curve" ? c.unsaid : value) });
  const f = field({ label, value: value === "curve" ? NaN : value, key: `material.${c.key}`, min: c.min, max: c.key === "friction" ? undefined : c.max, disabled: locked || value === "curve", width: "4.2em", onchange: change });
  range.addEventListener("input", () => {
    f.element.value = exact(Number(range.value));
    f.complain(null);
    change(Number(range.value));
  });
  updates.push(() => {
    const now = read();
    if (now === "curve") return;
    if (document.activeElement !== range) range.value = String(now);
    f.show(now);
  });
  return h(
    "label",
    { class: `slider ${locked ? "locked" : ""}`, title: t(`quantity.${c.key}`) },
    h("span", { class: "letter", data: { q: c.key === "restitution" ? "e" : c.key === "friction" ? "μ" : "et" } }, h("i", {}, letter)),
    range,
    f.element,
    locked ? h("small", { class: "lock" }, t("bodies.locked")) : null,
  );
}

/** Gravity and the operator for several contacts at one instant. */
function world(app: App, updates: (() => void)[]): HTMLElement {
  const down = app.dim - 1;
  const box = h("div", { class: "world" });
  if (app.description.periodic.length === 0) {
    const g = field({
      label: t("quantity.gravity"),
      value: -(app.document.world?.gravity?.[down] ?? 0) || 0,
      key: "world.gravity",
      width: "5em",
      disabled: app.locked.has("gravity"),
      onchange: (x) =>
        void app.edit((d) => {
          const gravity = (d.world ??= {}).gravity ?? new Array(app.dim).fill(0);
          gravity[down] = x === 0 ? 0 : -x;
          d.world.gravity = gravity;
        }),
    });
    updates.push(() => g.show(-(app.document.world?.gravity?.[down] ?? 0) || 0));
    box.append(h("label", { class: "inline" }, h("i", {}, "g"), g.element, h("small", {}, app.dim === 1 ? "m/s² (←)" : "m/s² (↓)")));
  }
  const time = field({
    label: t("quantity.until"),
    value: app.document.run?.until?.time ?? NaN,
    key: "run.until",
    min: 0,
    width: "5em",
    disabled: app.locked.has("time"),
    onchange: (x) => void app.edit((d) => (((d.run ??= {}).until ??= {}).time = x)),
  });
  updates.push(() => time.show(app.document.run?.until?.time ?? NaN));
  box.append(h("label", { class: "inline" }, t("bodies.until"), time.element, h("small", {}, "s")));
  if (app.description.periodic.length === 0 && app.document.body?.length && !app.document.group?.length) box.append(walls(app, updates));
  return box;
}

/** Walls round the scene, or none. */
function walls(app: App, updates: (() => void)[]): HTMLElement {
  const boxed = () => app.document.world?.boundary?.kind === "box";
  const change = () =>
    void app.edit((d) => {
      const world = (d.world ??= {});
      if (boxed()) delete world.boundary;
      else world.boundary = around(app);
    });
  const toggle = h("input", { type: "checkbox", data: { key: "world.boundary" }, checked: boxed(), disabled: app.locked.size > 0, onchange: change });
  updates.push(() => (toggle.checked = boxed()));
  return h("label", { class: "toggle inline" }, toggle, h("span", {}, t("bodies.walls")));
}

/** A box with room on every side, of round numbers. */
function around(app: App): Record<string, unknown> {
  const bodies = app.document.body!;
  const ends = Array.from({ length: app.dim }, (_, c) => [Math.min(...bodies.map((b) => b.position[c] - b.radius)), Math.max(...bodies.map((b) => b.position[c] + b.radius))]);
  const span = Math.max(...ends.map(([low, high]) => high - low));
  const grain = 10 ** Math.floor(Math.log10(span / 4));
  const out = (x: number, way: number) => Number((way * Math.ceil((way * x) / grain) * grain).toPrecision(6));
  return { kind: "box", min: ends.map(([low]) => out(low - 0.4 * span, -1)), max: ends.map(([, high]) => out(high + 0.4 * span, 1)) };
}
