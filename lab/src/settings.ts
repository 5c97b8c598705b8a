// What a person prefers, kept between visits where the browser allows: language, theme, letters. Never the scene.
import type { Language } from "./words/index.ts";

export interface Settings {
  language: Language;
  theme: "auto" | "light" | "dark";
  momentum: "p" | "Q";
  impulse: "F" | "J" | "I";
  restitution: "e" | "ε";
  keys: boolean;
}

const KEY = "carom-lab";

function system(): Language {
  return navigator.language.toLowerCase().startsWith("pt") ? "pt-BR" : "en";
}

export function load(): Settings {
  const settings: Settings = { language: system(), theme: "auto", momentum: "p", impulse: "F", restitution: "e", keys: true };
  try {
    Object.assign(settings, JSON.parse(localStorage.getItem(KEY) ?? "{}"));
  } catch {
    // A sandboxed frame has no storage; the defaults do.
  }
  const asked = new URLSearchParams(location.search).get("lang");
  if (asked === "en" || asked === "pt-BR") settings.language = asked;
  return settings;
}

export function store(settings: Settings): void {
  try {
    localStorage.setItem(KEY, JSON.stringify(settings));
  } catch {
    // As above.
  }
}

/** The letters for the engine: "Q,I,ε". */
export function letters(s: Settings): string {
  return [s.momentum === "Q" ? "Q" : "", s.impulse === "F" ? "" : s.impulse, s.restitution === "ε" ? "ε" : ""].filter(Boolean).join(",");
}

/** The letter of the impulse's magnitude. */
export function impulseLetter(s: Settings): string {
  return s.impulse === "I" ? "I" : "J";
}

export function applyTheme(s: Settings): void {
  const dark = s.theme === "dark" || (s.theme === "auto" && matchMedia("(prefers-color-scheme: dark)").matches);
  document.documentElement.dataset.theme = dark ? "dark" : "light";
}
