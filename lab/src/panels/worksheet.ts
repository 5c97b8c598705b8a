// A worksheet to print: the picture before the impact, the numbers that are given, blanks for the rest; answers on page two.
import type { App } from "../app.ts";
import { h } from "../dom.ts";
import { math } from "../math.ts";
import type { Picture } from "../save.ts";
import { exact, fmt, t, vector } from "../words/index.ts";
import { who } from "./equations.ts";

export async function worksheet(app: App, shown: Picture | null): Promise<void> {
  const impact = app.impact;
  if (!impact) return;
  document.querySelector(".worksheet")?.remove();
  const back = { stage: app.stage, time: app.frame.time };
  await app.toImpact(app.chosen, "before");
  const picture = shown ? h("img", { alt: "", src: URL.createObjectURL(await shown.png()), width: 640 }) : null;
  const blank = () => "______________";
  const given = impact.bodies.map((name, side) => {
    const body = app.description.bodies.find((b) => b.name === name);
    const k = app.description.bodies.findIndex((b) => b.name === name);
    return h(
      "tr",
      {},
      h("th", {}, who(name)),
      h("td", {}, body?.mass ? `m = ${fmt(body.mass)} kg` : "m → ∞"),
      h("td", {}, `v = ${vector(impact.before[side].velocity)} m/s`),
      // From where they touch the pupil finds the normal.
      h("td", {}, app.dim > 1 && k >= 0 ? `x = ${vector(app.frame.position(k), 4)} m` : ""),
    );
  });
  const bothMove = impact.bodies.every((name) => app.description.bodies.some((b) => b.name === name));
  const brief = app.chain?.brief ?? [];
  const lines = (answers: boolean) =>
    brief.map((row) => h("p", { class: answers ? "answer-line" : "blank-line" }, math(row.sides[0].tex), answers ? row.sides.slice(1).flatMap((s) => [" ", math(`${s.rel} ${s.tex}`)]) : [" ", math("="), ` ${blank()}`]));
  const page = h(
    "div",
    { class: "worksheet" },
    h(
      "section",
      { class: "page-one" },
      h("h1", {}, `${t("worksheet.title")}: ${app.description.title}`),
      h("p", {}, `${t("worksheet.name")} ${blank()}${blank()}   ${t("worksheet.date")} ${blank()}`),
      picture,
      h("h2", {}, t("worksheet.given")),
      h("table", {}, given),
      h("p", {}, math("e"), ` = ${exact(impact.restitution)}`, app.dim > 1 && !bothMove ? `,  n = ${vector(impact.normal)}` : ""),
      h("p", {}, t("worksheet.task")),
      lines(false),
    ),
    h("section", { class: "page-two" }, h("h1", {}, t("worksheet.answers")), lines(true)),
  );
  document.body.append(page);
  document.body.classList.add("printing");
  const image = page.querySelector("img");
  if (image) await image.decode().catch(() => {});
  window.addEventListener("afterprint", () => document.body.classList.remove("printing"), { once: true });
  window.print();
  app.stage = back.stage;
  await app.look(back.time);
}
