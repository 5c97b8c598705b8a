// A number to type: comma or point, told what is wrong, never thrown away.
import { h } from "../dom.ts";
import { exact, parse, t } from "../words/index.ts";

export interface FieldOptions {
  label: string;
  value: number | null;
  /** The key of the scene, so that the engine's problems find their field. */
  key?: string;
  min?: number;
  max?: number;
  /** Whether `min` itself is refused. */
  above?: boolean;
  disabled?: boolean;
  width?: string;
  onchange(value: number): void;
}

export interface Field {
  element: HTMLInputElement;
  show(value: number | null): void;
  complain(message: string | null): void;
}

export function field(options: FieldOptions): Field {
  const element = h("input", {
    type: "text",
    inputMode: "decimal",
    class: "number",
    autocomplete: "off",
    spellcheck: false,
    disabled: options.disabled ?? false,
    aria: { label: options.label },
    data: options.key ? { key: options.key } : {},
    value: options.value === null ? "∞" : exact(options.value),
  });
  if (options.width) element.style.width = options.width;
  const note = (message: string | null) => {
    element.setCustomValidity(message ?? "");
    element.toggleAttribute("aria-invalid", message !== null);
    if (message !== null) element.setAttribute("aria-invalid", "true");
    element.title = message ?? "";
    element.dispatchEvent(new CustomEvent("complaint", { bubbles: true, detail: message }));
  };
  const check = (x: number): string | null => {
    if (Number.isNaN(x)) return t("field.number");
    if (options.min !== undefined && (options.above ? !(x > options.min) : !(x >= options.min))) {
      return options.above ? t("field.positive") : t("field.range", { min: exact(options.min), max: options.max === undefined ? "∞" : exact(options.max) });
    }
    if (options.max !== undefined && !(x <= options.max)) return t("field.range", { min: exact(options.min ?? -Infinity), max: exact(options.max) });
    return null;
  };
  element.addEventListener("input", () => {
    const x = parse(element.value);
    const message = check(x);
    note(message);
    if (message === null) options.onchange(x);
  });
  element.addEventListener("keydown", (event) => {
    if (event.key !== "ArrowUp" && event.key !== "ArrowDown") return;
    const x = parse(element.value);
    if (Number.isNaN(x)) return;
    event.preventDefault();
    const step = (event.shiftKey ? 0.1 : 0.01) * (event.key === "ArrowUp" ? 1 : -1);
    const next = Number((x + step).toPrecision(12));
    if (check(next) !== null) return;
    element.value = exact(next);
    note(null);
    options.onchange(next);
  });
  return {
    element,
    show(value) {
      // Never under the hands of someone who types.
      if (document.activeElement === element) return;
      element.value = value === null ? "∞" : exact(value);
      note(null);
    },
    complain: note,
  };
}
