// A button with a list under it: opens by click or key, closes by Escape or by leaving it.
import { h } from "../dom.ts";

export function menu(label: (Node | string)[], name: string, content: () => Node[]): HTMLElement {
  const list = h("div", { class: "menu-list", hidden: true });
  const button = h("button", { type: "button", class: "quiet menu-button", aria: { expanded: false, haspopup: "true", label: name } }, ...label);
  const box = h("div", { class: "menu" }, button, list);
  const close = () => {
    list.hidden = true;
    button.setAttribute("aria-expanded", "false");
  };
  button.addEventListener("click", () => {
    if (!list.hidden) return close();
    list.replaceChildren(...content());
    list.hidden = false;
    button.setAttribute("aria-expanded", "true");
    list.querySelector<HTMLElement>("button, a, input, select")?.focus();
  });
  box.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && !list.hidden) {
      event.stopPropagation();
      close();
      button.focus();
    }
  });
  box.addEventListener("focusout", (event) => {
    if (!box.contains(event.relatedTarget as Node | null) && event.relatedTarget !== null) close();
  });
  document.addEventListener("pointerdown", (event) => {
    if (!box.contains(event.target as Node)) close();
  });
  box.addEventListener("menu-close", close);
  return box;
}

/** One line of a menu. */
export function entry(text: string, onclick: () => void, small?: string): HTMLButtonElement {
  return h(
    "button",
    {
      type: "button",
      class: "entry",
      onclick: (event: Event) => {
        (event.target as Element).dispatchEvent(new CustomEvent("menu-close", { bubbles: true }));
        onclick();
      },
    },
    h("span", {}, text),
    small ? h("small", {}, small) : null,
  );
}
