// What the stage shows.
import type { App, Show } from "../app.ts";
import { h } from "../dom.ts";
import { impulseLetter } from "../settings.ts";
import { t } from "../words/index.ts";

export function show(app: App): HTMLElement {
  const boxes = h("div", { class: "toggles" });
  const keys = ["v", "p", "J", "nt", "cm", "spin", "trail", "grid", "values"].filter((key) => app.dim > 1 || (key !== "spin" && key !== "nt")) as (keyof Show)[];
  const draw = () => {
    boxes.replaceChildren(
      ...keys.map((key) => {
        const letter = key === "v" ? "v" : key === "p" ? app.settings.momentum : key === "J" ? impulseLetter(app.settings) : key === "nt" ? "n, t" : key === "spin" ? "ω" : "";
        return h(
          "label",
          { class: `toggle show-${key}` },
          h("input", { type: "checkbox", checked: app.show[key], data: { show: key }, onchange: (event: Event) => ((app.show[key] = (event.target as HTMLInputElement).checked), app.tell("show")) }),
          h("span", { class: `sample sample-${key}`, aria: { hidden: true } }),
          letter ? h("i", {}, letter) : null,
          h("span", {}, t(`show.${key}`)),
        );
      }),
    );
  };
  draw();
  app.on("show", () => boxes.querySelectorAll<HTMLInputElement>("input").forEach((box) => (box.checked = app.show[box.dataset.show as keyof Show])));
  return h("section", { class: "panel show", data: { panel: "show" }, aria: { label: t("show.title") } }, h("h2", {}, t("show.title")), boxes);
}
