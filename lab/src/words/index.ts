// Languages: words, numbers and the letters of a course.
export type Language = "en" | "pt-BR";
type Catalogue = Record<string, string>;

/** Each is loaded when it is asked for. */
const CATALOGUES: Record<Language, () => Promise<{ default: Catalogue }>> = { en: () => import("./en.json"), "pt-BR": () => import("./pt-BR.json") };

let language: Language = "en";
let catalogue: Catalogue = {};
let asked: Language = "en";

/** Speaks this language from now on; of several that were asked for, the last. */
export async function speak(next: Language): Promise<void> {
  asked = next;
  const { default: phrases } = await CATALOGUES[next]();
  if (asked !== next) return;
  language = next;
  catalogue = phrases;
  document.documentElement.lang = next;
}

export function currentLanguage(): Language {
  return language;
}

/** A phrase; `{name}` is filled in. A key without a phrase shows itself, which a test looks for. */
export function t(key: string, places: Record<string, string | number> = {}): string {
  const phrase = catalogue[key] ?? key;
  return phrase.replace(/\{(\w+)\}/g, (whole, name: string) => (name in places ? String(places[name]) : whole));
}

export function hasPhrase(key: string): boolean {
  return key in catalogue;
}

/** A number as people read it: `digits` significant ones, a real minus sign, the decimal sign of the language. */
export function fmt(x: number | null | undefined, digits = 3): string {
  if (x === null || x === undefined) return "∞";
  if (Number.isNaN(x)) return "–";
  if (!Number.isFinite(x)) return x > 0 ? "∞" : "−∞";
  const size = Math.abs(x);
  if (size !== 0 && (size >= 1e6 || size < 1e-4)) {
    const [mantissa, exponent] = size.toExponential(digits - 1).split("e");
    const power = Number(exponent).toString().replace("-", "⁻").replace(/\d/g, (d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(d)]);
    return `${x < 0 ? "−" : ""}${decimal(mantissa.replace(/\.?0+$/, ""))}×10${power}`;
  }
  const whole = size === 0 ? 1 : Math.floor(Math.log10(size)) + 1;
  const text = size.toFixed(Math.max(0, digits - whole));
  const zero = Number(text) === 0;
  return `${x < 0 && !zero ? "−" : ""}${decimal(text)}`;
}

/** Without needless noughts, to be spoken: 0.45, 4. */
export function spoken(x: number): string {
  return exact(Number(x.toPrecision(3)));
}

/** With a fixed number of places. */
export function fixed(x: number, places: number): string {
  const text = Math.abs(x).toFixed(places);
  return `${x < 0 && Number(text) !== 0 ? "−" : ""}${decimal(text)}`;
}

/** A number as it stands in a field: every digit that it has, and no more. */
export function exact(x: number): string {
  // What a scene leaves open stays empty.
  if (Number.isNaN(x)) return "";
  const text = String(x === 0 ? 0 : x);
  return decimal(text.replace("-", "−"));
}

function decimal(text: string): string {
  return language === "pt-BR" ? text.replace(".", ",") : text;
}

/** What a person typed, with a comma or a point; not a number if it is none. */
export function parse(text: string): number {
  const plain = text.trim().replace(/[−–]/g, "-").replace(/\s/g, "").replace(",", ".");
  return /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(plain) ? Number(plain) : NaN;
}

/** A vector: a number on the line, (x, y) in the plane. */
export function vector(v: number[], digits = 3): string {
  if (v.length === 1) return fmt(v[0], digits);
  return `(${v.map((x) => fmt(x, digits)).join(language === "pt-BR" ? "; " : ", ")})`;
}
