// The gallery, the help and short messages.
import { h, icon } from "../dom.ts";
import type { Builtin } from "../gallery.ts";
import { hasPhrase, t } from "../words/index.ts";

export function dialog(title: string, ...content: Node[]): HTMLDialogElement {
  const box = h("dialog", { aria: { label: title } });
  const close = () => box.close();
  box.append(h("div", { class: "dialog-head" }, h("h2", {}, title), h("button", { type: "button", class: "quiet tiny", aria: { label: t("close") }, onclick: close }, icon("remove"))), ...content);
  box.addEventListener("click", (event) => {
    if (event.target === box) close();
  });
  box.addEventListener("close", () => box.remove());
  document.body.append(box);
  box.showModal();
  return box;
}

export function gallery(scenes: Builtin[], open: (name: string) => void): void {
  const card = (scene: Builtin) => {
    const key = `scene.${scene.name}`;
    const about = `about.${scene.name}`;
    return h(
      "button",
      { type: "button", class: "card", data: { scene: scene.name }, onclick: () => (box.close(), open(scene.name)) },
      h("span", { class: "card-dim" }, `${scene.dim}D`),
      h("b", {}, hasPhrase(key) ? t(key) : scene.title),
      h("span", { class: "card-about" }, hasPhrase(about) ? t(about) : scene.about),
    );
  };
  const box = dialog(t("gallery.title"), h("div", { class: "cards" }, scenes.map(card)));
  box.classList.add("gallery");
}

const KEYS: [string, string][] = [
  ["Space", "play"],
  ["N · Shift+N", "impacts"],
  ["→ · ←", "steps"],
  ["Home · End", "ends"],
  ["+ · −", "speed"],
  ["Backspace", "reset"],
  ["V P J C", "arrows"],
  ["E", "view"],
  ["1 2 3", "stages"],
  ["?", "help"],
];

export function help(digest: string, version: string): void {
  const row = ([key, what]: [string, string]) => h("tr", {}, h("th", { scope: "row" }, h("kbd", {}, key)), h("td", {}, t(`keys.${what}`)));
  dialog(t("help.title"), h("p", {}, t("help.what")), h("p", {}, t("help.drag")), h("table", { class: "keys" }, h("caption", { class: "sr" }, t("help.keys")), h("tbody", {}, KEYS.map(row))), h("p", { class: "quiet-text" }, t("help.letters")), h("p", { class: "quiet-text digest" }, `${version} · ${digest}`));
}

/** A short message. What went wrong stays until it is closed. */
export function toast(text: string, wrong = false): void {
  document.querySelectorAll(".toast").forEach((old) => old.remove());
  const box = h("div", { class: wrong ? "toast wrong" : "toast", role: wrong ? "alert" : "status" }, h("span", {}, text));
  if (wrong) box.append(h("button", { type: "button", class: "tiny", aria: { label: t("close") }, onclick: () => box.remove() }, icon("remove")));
  else setTimeout(() => box.remove(), 6000);
  document.body.append(box);
}
