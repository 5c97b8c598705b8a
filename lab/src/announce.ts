// One sentence for every impact, for those who listen.
import type { App } from "./app.ts";
import { h } from "./dom.ts";
import { spoken, t } from "./words/index.ts";
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
