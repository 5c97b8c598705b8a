// One sentence for every impact, for those who listen.
import type { App } from "./app.ts";
import { h } from "./dom.ts";
import { spoken, t, vector } from "./words/index.ts";
import { who } from "./panels/equations.ts";

export function announcer(app: App): HTMLElement {
  const region = h("p", { class: "sr", role: "status", aria: { live: "polite" }, data: { live: "impact" } });
  let said = "";
  const say = () => {
    const impact = app.impact;
    // Before it happens there is nothing to tell.
    if (!impact || app.frame.time < impact.time || app.predicting) return;
    const sentence = t("live.impact", { n: impact.n, time: spoken(impact.time), a: who(impact.bodies[0]), b: who(impact.bodies[1]), impulse: spoken(impact.impulse) });
    if (sentence === said) return;
    said = sentence;
    region.textContent = sentence;
  };
  app.on("impact", say);
  app.on("scene", () => {
    said = "";
  });
  return region;
}

/** Up to so many bodies are told one by one. */
const MOST = 6;

/** What the stage shows, in words: where it stands, and each body with its place and velocity. The stage refers to it. */
export function summary(app: App): HTMLElement {
  const text = h("p", { class: "sr", id: "stage-summary" });
  const tell = () => {
    // A picture that moves is told when it stands.
    if (app.playing || !app.frame) return;
    const { frame, description } = app;
    const side = (name: string) => (app.atImpact && app.impact ? app.impact.bodies.indexOf(name) : -1);
    const hidden = app.predicting && app.chosen > 0 && frame.time >= app.marks[app.chosen - 1];
    const where = app.atImpact ? t("summary.impact", { n: app.chosen, time: spoken(frame.time), stage: t(`impact.${hidden ? "before" : app.stage}`) }) : t("summary.time", { time: spoken(frame.time) });
    const bodies = description.bodies.slice(0, MOST).map((body, k) => {
      const s = side(body.name);
      const velocity = s >= 0 && (app.stage === "before" || hidden) ? app.impact!.before[s].velocity : s >= 0 ? app.impact!.after[s].velocity : frame.velocity(k);
      return t("summary.body", { name: body.name, position: vector(frame.position(k)), velocity: vector(velocity) });
    });
    if (description.bodies.length > MOST) bodies.push(t("summary.more", { count: description.bodies.length - MOST }));
    const next = [where, ...bodies].join(" ");
    if (text.textContent !== next) text.textContent = next;
  };
  for (const topic of ["frame", "impact", "stage", "scene", "play", "predict"] as const) app.on(topic, tell);
  return text;
}
