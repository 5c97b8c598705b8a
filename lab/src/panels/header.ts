// The bar at the top: tabs, the scene, share, save, language, letters, theme, help.
import type { App } from "../app.ts";
import { h, icon } from "../dom.ts";
import type { Builtin } from "../gallery.ts";
import { encode } from "../link.ts";
import { download, fileName, impactsCsv, type Picture, samplesCsv } from "../save.ts";
import type { Settings } from "../settings.ts";
import { t } from "../words/index.ts";
import { entry, menu } from "./menu.ts";

export type Tab = "1" | "2" | "3" | "gas";

export interface HeaderOptions {
  app: App;
  picture(): Picture | null;
  scenes: Builtin[];
  tab: Tab;
  toTab(tab: Tab): void;
  toScene(name: string): void;
  change(settings: Partial<Settings>): void;
  help(): void;
  gallery(): void;
  worksheet(): void;
  compare(): void;
  toast(text: string): void;
}

export function header(o: HeaderOptions): HTMLElement {
  const { app } = o;
  const tab = (id: Tab, text: string) =>
    h("a", { class: "tab", href: `#tab-${id}`, role: "tab", id: `tab-${id}`, aria: { selected: String(o.tab === id) }, data: { tab: id }, onclick: (event: Event) => (event.preventDefault(), o.toTab(id)) }, text);
  const name = h("span", { class: "scene-name" });
  const rename = () => {
    const title = app.description?.title;
    name.textContent = title ? t(`scene.${app.builtin}`) === `scene.${app.builtin}` ? title : t(`scene.${app.builtin}`) : t("scene.own");
  };
  app.on("scene", rename);
  if (app.description) rename();
  const share = async () => {
    const json = await app.client.write("json");
    const fragment = await encode(json);
    const url = `${location.origin}${location.pathname}#${fragment}`;
    try {
      await navigator.clipboard.writeText(url);
      o.toast(t("share.copied", { count: url.length }));
    } catch {
      prompt(t("share.copy"), url);
    }
  };
  const save = async (what: string) => {
    const base = fileName(app);
    const picture = o.picture();
    if (what === "impacts") download(`${base}-impacts.csv`, await impactsCsv(app), "text/csv");
    if (what === "samples") download(`${base}-samples.csv`, await samplesCsv(app), "text/csv");
    if (what === "toml") download(`${base}.toml`, await app.client.write("toml"), "application/toml");
    if (what === "png" && picture) download(`${base}.png`, await picture.png());
    if (what === "svg" && picture?.svg) download(`${base}.svg`, picture.svg(), "image/svg+xml");
  };
  const s = app.settings;
  const pick = <K extends keyof Settings>(key: K, label: string, values: [Settings[K], string][]) =>
    h(
      "label",
      { class: "choice" },
      h("span", {}, label.charAt(0).toUpperCase() + label.slice(1)),
      h("select", { data: { setting: key }, onchange: (event: Event) => o.change({ [key]: (event.target as HTMLSelectElement).value } as Partial<Settings>) }, values.map(([value, text]) => h("option", { value: String(value), selected: s[key] === value }, text))),
    );
  return h(
    "header",
    { class: "top" },
    h("a", { class: "brand", href: "./", title: "Carom Lab" }, mark(), h("span", {}, "Carom Lab")),
    h("div", { class: "tabs", role: "tablist", aria: { label: t("tabs") } }, tab("1", "1D"), tab("2", "2D"), tab("3", "3D"), tab("gas", t("tab.gas"))),
    h("button", { type: "button", class: "quiet scene-button", aria: { haspopup: "dialog" }, onclick: o.gallery }, name, h("span", { class: "caret", aria: { hidden: true } }, "▾"), h("span", { class: "sr" }, t("gallery.open"))),
    h("span", { class: "gap" }),
    h("button", { type: "button", class: "quiet", data: { verb: "share" }, onclick: () => void share() }, icon("share"), h("span", { class: "wide" }, t("share"))),
    menu([icon("save"), h("span", { class: "wide" }, t("save"))], t("save"), () => [
      entry(t("save.toml"), () => void save("toml"), ".toml"),
      // A gas has no end, and so no table of its impacts.
      ...(o.tab === "gas" ? [] : [entry(t("save.impacts"), () => void save("impacts"), ".csv"), entry(t("save.samples"), () => void save("samples"), ".csv")]),
      entry(t("save.png"), () => void save("png"), ".png"),
      ...(o.picture()?.svg ? [entry(t("save.svg"), () => void save("svg"), ".svg")] : []),
      ...(o.tab === "gas" ? [] : [entry(t("save.worksheet"), o.worksheet, t("save.print"))]),
    ]),
    h(
      "div",
      { class: "languages", role: "group", aria: { label: t("language") } },
      (["en", "pt-BR"] as const).map((language) => h("button", { type: "button", class: "quiet", lang: language, aria: { pressed: String(s.language === language), label: language === "en" ? "EN, English" : "PT, Português" }, data: { language }, onclick: () => o.change({ language }) }, language === "en" ? "EN" : "PT")),
    ),
    menu([icon("theme")], t("settings"), () => [
      pick("theme", t("settings.theme"), [["auto", t("settings.auto")], ["light", t("settings.light")], ["dark", t("settings.dark")]]),
      pick("momentum", t("quantity.momentum"), [["p", "p"], ["Q", "Q"]]),
      pick("impulse", t("quantity.impulse"), [["F", `F̂, J (${t("settings.lecture")})`], ["J", "J"], ["I", "I"]]),
      pick("restitution", t("quantity.restitution"), [["e", "e"], ["ε", "ε"]]),
      h("label", { class: "choice" }, h("span", {}, t("settings.keys")), h("input", { type: "checkbox", checked: s.keys, onchange: (event: Event) => o.change({ keys: (event.target as HTMLInputElement).checked }) })),
      entry(t("compare.open"), o.compare),
    ]),
    h("button", { type: "button", class: "quiet", aria: { label: t("help") }, title: `${t("help")} (?)`, onclick: o.help }, icon("help")),
  );
}

/** Two balls at contact. */
function mark(): SVGSVGElement {
  const ns = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(ns, "svg");
  svg.setAttribute("viewBox", "0 0 40 24");
  svg.setAttribute("class", "mark");
  svg.setAttribute("aria-hidden", "true");
  for (const [x, r, c] of [[12, 10, "mark-a"], [30, 8, "mark-b"]] as const) {
    const circle = document.createElementNS(ns, "circle");
    circle.setAttribute("cx", String(x));
    circle.setAttribute("cy", "12");
    circle.setAttribute("r", String(r));
    circle.setAttribute("class", c);
    svg.append(circle);
  }
  return svg as SVGSVGElement;
}
