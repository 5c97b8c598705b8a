// Predict first: results are hidden, also from the page's text, until the learner has said with what velocities they part: in
// numbers, or by dragging arrows on the stage.
import type { App } from "../app.ts";
import { fill, h } from "../dom.ts";
import { exact, parse, t } from "../words/index.ts";
import { who } from "./equations.ts";

const AXES = ["x", "y", "z"];
/** An answer within this part of the largest velocity is right. */
const RIGHT = 0.01;

export function predict(app: App): HTMLElement {
  const box = h("div", { class: "predict-form" });
  const toggle = h("input", { type: "checkbox", onchange: () => void begin(toggle.checked) });
  const panel = h("section", { class: "predict", aria: { label: t("predict.title") } }, h("label", { class: "toggle" }, toggle, h("span", {}, t("predict.title"))), box);

  const begin = async (on: boolean) => {
    app.predicting = on;
    app.tell("predict");
    if (on && app.marks.length > 0) await app.toImpact(1, "before");
    draw();
  };

  const draw = () => {
    toggle.checked = app.predicting;
    panel.classList.toggle("asking", app.predicting);
    toggle.disabled = app.marks.length === 0;
    const impact = app.impact;
    app.answers = [];
    if (!app.predicting || !impact) {
      fill(box);
      return;
    }
    const inputs: { element: HTMLInputElement; want: number }[] = [];
    const bodies = impact.bodies.map((name, side) => ({ name, side })).filter(({ name }) => app.description.bodies.some((b) => b.name === name && !b.fixed));
    app.answers = bodies.map(({ name, side }) => ({ body: app.description.bodies.findIndex((b) => b.name === name), side, velocity: impact.after[side].velocity.map(() => NaN) }));
    const verdict = h("p", { class: "verdict", role: "status" });
    const check = () => {
      const scale = Math.max(...inputs.map((i) => Math.abs(i.want)), 1e-9);
      let all = true;
      for (const { element, want } of inputs) {
        const right = Math.abs(parse(element.value) - want) <= RIGHT * Math.max(Math.abs(want), 0.1 * scale);
        all &&= right;
        element.dataset.mark = right ? "right" : "wrong";
        element.setAttribute("aria-invalid", String(!right));
      }
      verdict.textContent = t(all ? "predict.right" : "predict.wrong");
      if (all) {
        app.predicting = false;
        app.tell("predict");
        app.stage = "after";
        app.tell("impact");
        toggle.checked = false;
        app.play();
      }
    };
    const reveal = () => {
      app.predicting = false;
      app.tell("predict");
      void app.toImpact(1, "after");
      fill(box);
      toggle.checked = false;
    };
    fill(
      box,
      h("p", {}, t("predict.ask")),
      bodies.map(({ name, side }, k) =>
        h(
          "div",
          { class: "answer" },
          h("b", {}, who(name)),
          impact.after[side].velocity.map((want, c) => {
            const element = h("input", { type: "text", class: "number", inputMode: "decimal", autocomplete: "off", data: { answer: `${k}-${c}` }, aria: { label: `${name}: v′ ${app.dim > 1 ? AXES[c] : ""}` } });
            element.addEventListener("input", () => {
              app.answers[k].velocity[c] = parse(element.value);
              app.tell("answer");
            });
            inputs.push({ element, want });
            return h("label", {}, h("i", {}, "v′", app.dim > 1 ? h("sub", {}, AXES[c]) : ""), element, h("small", {}, "m/s"));
          }),
        ),
      ),
      h("div", { class: "row" }, h("button", { type: "button", class: "primary", onclick: check }, t("predict.check")), h("button", { type: "button", class: "quiet", onclick: reveal }, t("predict.reveal"))),
      verdict,
    );
  };
  // An arrow that is dragged writes its numbers.
  app.on("answer", () =>
    app.answers.forEach(({ velocity }, k) =>
      velocity.forEach((x, c) => {
        const element = box.querySelector<HTMLInputElement>(`[data-answer="${k}-${c}"]`);
        if (!element || Number.isNaN(x) || parse(element.value) === x) return;
        element.value = exact(x);
        delete element.dataset.mark;
        element.removeAttribute("aria-invalid");
      }),
    ),
  );
  let asked = "";
  app.on("impact", () => {
    // Only a new question empties the answers.
    const key = JSON.stringify([app.predicting, app.impact]);
    if (key === asked) return;
    asked = key;
    draw();
  });
  app.on("scene", () => {
    toggle.disabled = app.marks.length === 0;
  });
  return panel;
}
