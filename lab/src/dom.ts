// Making elements.

type Child = Node | string | number | null | undefined | false;
type Props = Record<string, unknown>;

/** An element: `h("button", { class: "x", onclick: f, aria: { label: "…" } }, "text")`. */
export function h<K extends keyof HTMLElementTagNameMap>(tag: K, props: Props = {}, ...children: (Child | Child[])[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  set(element, props);
  add(element, children);
  return element;
}

/** Sets attributes, listeners, `aria` and `data`. */
export function set(element: Element, props: Props): void {
  for (const [key, value] of Object.entries(props)) {
    if (value === undefined || value === null || value === false) continue;
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value as EventListener);
    else if (key === "aria") for (const [k, v] of Object.entries(value as Props)) element.setAttribute(`aria-${k}`, String(v));
    else if (key === "data") for (const [k, v] of Object.entries(value as Props)) (element as HTMLElement).dataset[k] = String(v);
    else if (key === "class") element.setAttribute("class", String(value));
    else if (key in element && key !== "list" && key !== "form") (element as unknown as Props)[key] = value;
    else element.setAttribute(key, value === true ? "" : String(value));
  }
}

export function add(element: Element, children: (Child | Child[])[]): void {
  for (const child of children.flat()) {
    if (child === null || child === undefined || child === false) continue;
    element.append(child instanceof Node ? child : String(child));
  }
}

/** Replaces what is in an element. */
export function fill(element: Element, ...children: (Child | Child[])[]): void {
  element.replaceChildren();
  add(element, children);
}

/** An icon from the sheet in the page, for the eye only. */
export function icon(name: string): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("class", "icon");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS(svg.namespaceURI!, "path");
  path.setAttribute("d", ICONS[name]);
  svg.append(path);
  return svg as SVGSVGElement;
}

const ICONS: Record<string, string> = {
  play: "M8 5v14l11-7z",
  pause: "M6 5h4v14H6zM14 5h4v14h-4z",
  reset: "M6 5h2.4v14H6zM20 5v14L9 12z",
  end: "M15.600 5H18v14h-2.400zM4 5v14l11-7z",
  back: "M17 5v14L6 12z",
  forth: "M7 5v14l11-7z",
  nextImpact: "M3 5v14l8-7zM11 5v14l8-7zM19.500 5H22v14h-2.500z",
  previousImpact: "M21 5v14l-8-7zM13 5v14l-8-7zM2 5h2.500v14H2z",
  add: "M11 5h2v6h6v2h-6v6h-2v-6H5v-2h6z",
  remove: "M6.400 5L5 6.400 10.600 12 5 17.600 6.400 19 12 13.400 17.600 19 19 17.600 13.400 12 19 6.400 17.600 5 12 10.600z",
  fit: "M4 4h6v2H6v4H4zM14 4h6v6h-2V6h-4zM4 14h2v4h4v2H4zM18 14h2v6h-6v-2h4z",
  share: "M14 4l6 5-6 5v-3c-5 0-8 1.500-10 5 .5-6 4-9 10-9.500z",
  save: "M11 4h2v9l3.500-3.500L18 11l-6 6-6-6 1.500-1.500L11 13zM5 18h14v2H5z",
  theme: "M12 3a9 9 0 1 0 0 18V3z",
  help: "M11 17h2v2h-2zM12 5c-2.500 0-4 1.600-4 3.600h2c0-1 .8-1.700 2-1.700s2 .7 2 1.700c0 1.800-3 2-3 5.400h2c0-2.600 3-2.700 3-5.500C16 6.500 14.500 5 12 5z",
};
