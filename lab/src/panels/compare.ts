// Several contacts at one instant: the same scene by three operators, side by side.
import type { App } from "../app.ts";
import { h } from "../dom.ts";
import { Client } from "../engine/client.ts";
import { Frame, type Survey } from "../engine/types.ts";
import { fmt, t, vector } from "../words/index.ts";
import { dialog } from "./dialogs.ts";

const OPERATORS = ["reflect", "sequential", "lcp"] as const;

export async function compare(app: App): Promise<void> {
  const table = h("div", { class: "scroll", tabIndex: 0, role: "region", aria: { label: t("compare.title") } }, h("p", {}, "…"));
  dialog(t("compare.title"), h("p", {}, t("compare.intro")), table);
  const client = Client.start();
  try {
    const columns: { together: string; survey: Survey; frame: Frame }[] = [];
    for (const together of OPERATORS) {
      const document = structuredClone(app.document);
      document.run = { ...document.run, together };
      let opened = await client.open(JSON.stringify(document));
      while (!opened.survey.done) {
        const survey = await new Promise<typeof opened.survey>((resolve) => (client.onSurvey = (s) => s.done && resolve(s)));
        opened = { ...opened, survey };
      }
      const end = await client.seek(opened.survey.time);
      columns.push({ together, survey: opened.survey, frame: new Frame(end!, app.dim) });
    }
    const shown = app.description.bodies.slice(0, 10);
    const cells = (of: (c: (typeof columns)[number]) => string) => columns.map((c) => h("td", {}, of(c)));
    const quiet = (v: number[]) => v.map((x) => (Math.abs(x) < 1e-12 ? 0 : x));
    const same = columns.every((c) => c.survey.report?.digest === columns[0].survey.report?.digest);
    table.replaceChildren(
      h(
        "table",
        { class: "numbers compare" },
        h("thead", {}, h("tr", {}, h("th", { scope: "col" }, t("compare.operator")), OPERATORS.map((o) => h("th", { scope: "col", data: { operator: o } }, t(`compare.${o}`))))),
        h(
          "tbody",
          {},
          shown.map((body, k) => h("tr", {}, h("th", { scope: "row" }, `v ${body.name}`), cells((c) => vector(quiet(c.frame.velocity(k)), 4)))),
          h("tr", {}, h("th", { scope: "row" }, t("compare.momentum")), cells((c) => vector(quiet(Array.from(c.frame.data.subarray(6, 6 + app.dim))), 4))),
          h("tr", {}, h("th", { scope: "row" }, t("compare.energy")), cells((c) => fmt(c.frame.kinetic, 4))),
          h("tr", {}, h("th", { scope: "row" }, t("compare.impacts")), cells((c) => String(c.survey.impacts))),
        ),
      ),
      ...(same ? [h("p", { class: "quiet-text" }, t("compare.same"))] : []),
    );
  } finally {
    client.stop();
  }
}
