// Time: play, step, the next impact, and the whole history on a line.
import { type App, SPEEDS } from "../app.ts";
import { h, icon, fill } from "../dom.ts";
import { fixed, t } from "../words/index.ts";

export function transport(app: App): HTMLElement {
  const button = (name: string, glyph: string, key: string, onclick: () => void) =>
    h("button", { type: "button", class: `transport-${name}`, title: `${t(`transport.${name}`)} (${key})`, aria: { label: t(`transport.${name}`) }, onclick }, icon(glyph));
  const reset = button("reset", "reset", "Home", () => void app.toStart());
  const back = button("back", "back", "←", () => void app.stepBy(-1));
  const play = h("button", { type: "button", class: "transport-play primary", onclick: () => (app.playing ? app.pause() : app.play()) }, icon("play"));
  const forth = button("forth", "forth", "→", () => void app.stepBy(1));
  const previous = button("previous", "previousImpact", "Shift+N", () => void app.previous());
  const next = button("next", "nextImpact", "N", () => void app.next());
  next.append(h("span", { class: "wide" }, t("transport.next.short")));
  const speed = h(
    "select",
    { aria: { label: t("transport.speed") }, onchange: (event: Event) => ((app.speed = Number((event.target as HTMLSelectElement).value)), app.tell("play")) },
    SPEEDS.map((s, k) => h("option", { value: String(k), selected: k === app.speed }, s >= 1 ? `×${s}` : `×1/${1 / s}`)),
  );
  const slider = h("input", { type: "range", class: "time", min: "0", max: "1", step: "any", value: "0", aria: { label: t("transport.time") } });
  const marks = h("canvas", { class: "marks", aria: { hidden: true } });
  const clock = h("output", { class: "clock" });
  const status = h("span", { class: "status" });
  slider.addEventListener("input", () => {
    void app.seek(Number(slider.value));
  });

  const tick = () => {
    const { end } = app;
    const places = end > 0 ? Math.min(7, Math.max(2, 3 - Math.floor(Math.log10(end)))) : 3;
    slider.max = String(end || 1);
    if (document.activeElement !== slider || !app.playing) slider.value = String(app.frame.time);
    const time = `${fixed(app.frame.time, places)} s`;
    clock.textContent = time;
    slider.setAttribute("aria-valuetext", time);
    const n = app.frame.impacts;
    fill(status, t("transport.impacts", { n: String(n), of: app.survey.done ? String(app.survey.impacts) : `${app.survey.impacts}…` }));
    back.disabled = reset.disabled = app.frame.time <= 0;
    previous.disabled = app.previousImpact === 0;
    next.disabled = app.nextImpact === 0;
    forth.disabled = app.frame.time >= app.end && app.survey.done;
  };
  const state = () => {
    fill(play, icon(app.playing ? "pause" : "play"));
    const reason = app.problems.length > 0 ? t("transport.blocked", { reason: app.problems[0].message }) : null;
    play.setAttribute("aria-label", t(app.playing ? "transport.pause" : "transport.play"));
    play.title = reason ?? `${t(app.playing ? "transport.pause" : "transport.play")} (Space)`;
    play.disabled = reason !== null;
    speed.value = String(app.speed);
  };
  const draw = () => drawMarks(app, marks);
  for (const topic of ["frame", "survey", "scene"] as const) app.on(topic, tick);
  for (const topic of ["survey", "scene", "impact"] as const) app.on(topic, draw);
  for (const topic of ["play", "problems"] as const) app.on(topic, state);
  new ResizeObserver(draw).observe(marks);
  state();
  return h(
    "section",
    { class: "transport", aria: { label: t("transport.title") } },
    h("div", { class: "buttons" }, reset, previous, back, play, forth, next, status, h("span", { class: "gap" }), speed, clock),
    h("div", { class: "history" }, slider, marks),
  );
}

/** A diamond for every impact; where there are too many, a rug. */
function drawMarks(app: App, canvas: HTMLCanvasElement): void {
  const ratio = Math.min(2, devicePixelRatio || 1);
  const wide = canvas.clientWidth;
  const high = canvas.clientHeight;
  if (wide === 0) return;
  canvas.width = wide * ratio;
  canvas.height = high * ratio;
  const c = canvas.getContext("2d")!;
  c.scale(ratio, ratio);
  const style = getComputedStyle(document.documentElement);
  const { end, marks } = app;
  if (end <= 0) return;
  const inset = 8;
  const x = (time: number) => inset + (time / end) * (wide - 2 * inset);
  c.fillStyle = c.strokeStyle = style.getPropertyValue("--q-J");
  let last = -1;
  for (let k = 0; k < marks.length; k++) {
    const at = Math.round(x(marks[k]) * 2) / 2;
    if (at === last) continue;
    last = at;
    if (marks.length <= 60) {
      c.save();
      c.translate(at, high / 2);
      c.rotate(Math.PI / 4);
      const s = k + 1 === app.chosen ? 4.6 : 3;
      c.fillRect(-s, -s, 2 * s, 2 * s);
      c.restore();
    } else {
      c.globalAlpha = 0.5;
      c.fillRect(at, 2, 0.7, high - 4);
      c.globalAlpha = 1;
    }
  }
  if (app.chosen > 0 && marks.length > 60) c.fillRect(x(marks[app.chosen - 1]) - 1, 0, 2, high);
  c.globalAlpha = 1;
}
