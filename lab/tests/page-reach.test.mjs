// The page for everyone: keys, readers, languages, phones, and what a teacher asks of it. Each test carries its numbers of the Lab's list of behaviours.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { done, frames, go, here, next, quiet, settled, text, until, visit } from "./browser.mjs";

const axeSource = readFileSync(join(here, "../node_modules/axe-core/axe.min.js"), "utf8");

test("L30 a link of a newer format is told, and the page stays usable", async () => {
  const page = await visit({ hash: "#9.abcdef" });
  assert.match(await text(page, ".toast"), /newer/);
  await next(page);
  await done(page);
});

test("L32 L33 Portuguese: every phrase, decimal commas, and the letters of the course", async () => {
  const [en, pt] = ["en", "pt-BR"].map((l) => JSON.parse(readFileSync(join(here, `../src/words/${l}.json`), "utf8")));
  assert.deepEqual(Object.keys(en).sort(), Object.keys(pt).sort());
  for (const key of Object.keys(en)) assert.deepEqual((pt[key].match(/\{\w+\}/g) ?? []).sort(), (en[key].match(/\{\w+\}/g) ?? []).sort(), key);
  const page = await visit();
  await page.locator('[data-language="pt-BR"]').click();
  await until(page, () => document.documentElement.lang === "pt-BR" && caromLab.app.chain?.language === "pt-BR");
  const body = await page.evaluate(() => document.body.innerText);
  for (const key of Object.keys(en)) if (key.includes(".")) assert.ok(!body.includes(key), `untranslated ${key}`);
  const e = page.locator(".slider input[type=text]").first();
  assert.equal(await e.inputValue(), "0,5");
  await e.fill("0,25");
  await until(page, () => caromLab.app.impact?.restitution === 0.25);
  await page.evaluate(() => caromLab.change({ momentum: "Q", impulse: "I" }));
  // The equations, as they are seen, and the heads of the table.
  await until(page, () => [...document.querySelectorAll(".brief .katex-html")].some((e) => e.textContent === "I"));
  await settled(page);
  const heads = await page.locator(".ledger .momentum thead i").allTextContents();
  assert.deepEqual([...new Set(heads)], ["Q"]);
  const shown = await page.locator(".brief .katex-html").allTextContents();
  assert.ok(!shown.some((text) => /^(J|F̂)/.test(text)), shown.join(" "));
  await page.getByRole("button", { name: "Salvar" }).click();
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Tabela de choques" }).click()]);
  assert.match(readFileSync(await download.path(), "utf8"), /,I \(N s\),/);
  await done(page);
});

test("L34 L36 Tab reaches every control and shows where it is; letters rest while one types", async () => {
  const page = await visit();
  const wanted = await page.locator("button:visible:not(:disabled), a[href]:visible, input:visible:not(:disabled), select:visible, summary:visible").count();
  const seen = new Set();
  for (let k = 0; k < wanted + 12; k++) {
    await page.keyboard.press("Tab");
    const at = await page.evaluate(() => {
      const e = document.activeElement;
      e.dataset.tabbed = "yes";
      const host = e.matches(".segment input") ? e.nextElementSibling : e;
      const style = getComputedStyle(host);
      return { outline: style.outlineStyle !== "none" && parseFloat(style.outlineWidth) > 0, what: e.outerHTML.slice(0, 90), body: e === document.body };
    });
    if (!at.body) assert.ok(at.outline, `no visible focus: ${at.what}`);
    seen.add(at.what);
  }
  // Of a group of radio buttons only one takes part.
  const left = await page.locator("button:visible:not(:disabled):not([data-tabbed]), a[href]:visible:not([data-tabbed]), input:not([type=radio]):visible:not(:disabled):not([data-tabbed]), select:visible:not([data-tabbed])").evaluateAll((all) => all.map((e) => e.outerHTML.slice(0, 90)));
  assert.deepEqual(left, []);
  const shown = () => page.evaluate(() => caromLab.app.show.v);
  const title = page.getByLabel("A: mass");
  await title.focus();
  await page.keyboard.press("v");
  assert.equal(await shown(), true);
  await page.locator(".transport-play").focus();
  await page.keyboard.press("v");
  assert.equal(await shown(), false);
  // One press is one press, also after the page was built anew for another scene and another language.
  await go(page, "oblique");
  await page.evaluate(() => caromLab.change({ language: "pt-BR" }));
  await settled(page);
  for (const want of [true, false]) {
    await page.locator(".transport-play").focus();
    await page.keyboard.press("v");
    assert.equal(await shown(), want);
  }
  await page.keyboard.press("?");
  assert.equal(await page.locator("dialog").count(), 1);
  await page.keyboard.press("Escape");
  await page.evaluate(() => caromLab.change({ keys: false }));
  await page.locator(".transport-play").focus();
  await page.keyboard.press("v");
  assert.equal(await shown(), false);
  await done(page);
});

test("L35 a ball and its velocity by keyboard", async () => {
  const page = await visit();
  await page.locator('.handle-ball[data-body="0"]').focus();
  await page.keyboard.press("ArrowRight");
  await until(page, () => caromLab.app.description.document.body[0].position[0] === -0.99);
  await page.keyboard.press("Shift+ArrowLeft");
  await until(page, () => caromLab.app.description.document.body[0].position[0] === -1.09);
  await page.locator('.handle-tip[data-body="1"]').focus();
  await page.keyboard.press("Shift+ArrowLeft");
  await until(page, () => caromLab.app.description.document.body[1].velocity[0] === -1.1);
  await until(page, () => /B, velocity −1\.1/.test(document.querySelector('.handle-tip[data-body="1"]').getAttribute("aria-label")));
  await done(page);
});

test("L37 axe: nothing serious or critical on any tab, in both languages, light and dark", async () => {
  // Colours are the theme's and words the language's: each of both is seen on every tab.
  for (const [locale, theme] of [["en-US", "light"], ["pt-BR", "dark"]]) {
    for (const hash of ["#two-balls", "#oblique", "#space", "#gas"]) {
      const page = await visit({ hash, locale, theme, motion: "reduce" });
      if (hash !== "#gas") await next(page);
      await page.evaluate(axeSource);
      const found = await page.evaluate(() => axe.run(document, { resultTypes: ["violations"] }).then((r) => r.violations.filter((v) => ["serious", "critical"].includes(v.impact)).map((v) => `${v.id}: ${v.nodes.slice(0, 2).map((n) => `${n.html.slice(0, 140)} ${n.failureSummary?.split("\n")[1] ?? ""}`).join(" | ")}`)));
      assert.deepEqual(found, [], `${hash} ${locale} ${theme}`);
      await done(page);
    }
  }
});

test("L38 one sentence per impact for those who listen", async () => {
  const page = await visit();
  await next(page);
  await until(page, () => document.querySelector("[data-live]").textContent !== "");
  assert.equal(await text(page, "[data-live]"), "Impact 1 at 0.45 s: A and B, impulse 4 newton-seconds");
  await done(page);
});

test("L38 the stage in words: where it stands, each body with its place and velocity; nothing that is to be predicted", async () => {
  const page = await visit();
  const said = () => text(page, "#stage-summary");
  assert.equal(await page.locator(".stage-canvas").getAttribute("aria-describedby"), "stage-summary");
  await settled(page);
  assert.equal(await said(), "At 0 s. A at −1.00 m, velocity 3.00 m/s. B at 1.00 m, velocity −1.00 m/s.");
  await next(page);
  assert.equal(await said(), "At 0.45 s, impact 1, after. A at 0.350 m, velocity 1.00 m/s. B at 0.550 m, velocity 3.00 m/s.");
  await page.locator(".predict input[type=checkbox]").check();
  await until(page, () => caromLab.app.predicting && caromLab.app.settled);
  await until(page, () => /before/.test(document.querySelector("#stage-summary").textContent));
  assert.doesNotMatch(await said(), /velocity 1\.00|velocity 3\.00 m\/s\.$/);
  await done(page);
});

test("the keys of the table, one by one", async () => {
  const page = await visit({ hash: "#pi-31" });
  await until(page, () => caromLab.app.survey.done);
  await page.locator(".transport-play").focus();
  const press = async (key, expression) => {
    await page.locator(".transport-play").focus();
    await page.keyboard.press(key);
    await until(page, expression);
    await settled(page);
  };
  await press("n", () => caromLab.app.atImpact && caromLab.app.chosen === 1);
  await press("n", () => caromLab.app.atImpact && caromLab.app.chosen === 2);
  await press("Shift+N", () => caromLab.app.atImpact && caromLab.app.chosen === 1);
  for (const [key, stage] of [["1", "before"], ["2", "at"], ["3", "after"]]) {
    await page.locator(".transport-play").focus();
    await page.keyboard.press(key);
    await until(page, (stage) => caromLab.app.stage === stage && caromLab.app.settled, stage);
  }
  const at = await page.evaluate(() => caromLab.app.marks[0]);
  await page.locator(".transport-play").focus();
  await page.keyboard.press("ArrowRight");
  await until(page, (at) => caromLab.app.frame.time > at, at);
  await page.keyboard.press("ArrowLeft");
  await until(page, (at) => Math.abs(caromLab.app.frame.time - at) < 1e-9, at);
  await press("End", () => caromLab.app.frame.time === caromLab.app.end);
  await press("Home", () => caromLab.app.frame.time === 0);
  await press("End", () => caromLab.app.frame.time === caromLab.app.end);
  await press("Backspace", () => caromLab.app.frame.time === 0);
  for (const key of ["=", "+"]) {
    const was = await page.evaluate(() => caromLab.app.speed);
    await page.keyboard.press(key);
    await until(page, (was) => caromLab.app.speed === was + 1, was);
  }
  await page.keyboard.press("-");
  await until(page, () => caromLab.app.speed === 4);
  for (const [key, name] of [["v", "v"], ["p", "p"], ["j", "J"], ["c", "cm"]]) {
    const was = await page.evaluate((name) => caromLab.app.show[name], name);
    await page.keyboard.press(key);
    await until(page, ([name, was]) => caromLab.app.show[name] !== was, [name, was]);
  }
  await page.keyboard.press("n");
  await until(page, () => document.querySelector(".chain[data-view=both]") && caromLab.app.settled);
  await page.keyboard.press("e");
  await until(page, () => document.querySelector(".chain").dataset.view === "symbols");
  // The space bar plays where no button has the focus.
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press(" ");
  await until(page, () => caromLab.app.playing);
  await page.keyboard.press(" ");
  await until(page, () => !caromLab.app.playing);
  await done(page);
});

test("L39 with reduced motion nothing moves by itself and nothing fades", async () => {
  const page = await visit({ motion: "reduce" });
  assert.deepEqual(await page.evaluate(() => [caromLab.app.playing, getComputedStyle(document.querySelector("button")).transitionDuration]), [false, "0s"]);
  await page.evaluate(() => (location.hash = "#gas"));
  await until(page, () => window.caromLab.gas?.count() === 1000);
  await page.locator(".gas-tab").getByRole("button", { name: "Play" }).waitFor();
  await frames(page, 10);
  assert.equal(await page.evaluate(() => caromLab.gas.frames()), 0);
  await done(page);
});

test("L49 a phone: no sideways scroll, every panel, drag by touch", async () => {
  for (const locale of ["en-US", "pt-BR"]) {
    const page = await visit({ hash: "#oblique", width: 390, height: 844, touch: true, locale });
    for (const name of ["bodies", "equations", "ledger", "plots", "show"]) {
      await page.locator(`[data-choose=${name}]`).click();
      assert.ok(await page.locator(`.panel.${name}`).isVisible(), name);
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390, `${name} ${locale}`);
      // A finger needs 44 px; of a choice that hides its button, its label.
      const low = await page.evaluate(() =>
        [...document.querySelectorAll("button, select, input, .segment span, .toggle, .tab")]
          .filter((e) => e.checkVisibility() && !e.matches(".handle, [type=checkbox], [type=radio], .stage-fit"))
          .map((e) => [e.outerHTML.slice(0, 80), e.getBoundingClientRect().height])
          .filter(([, height]) => height > 0 && height < 43.5),
      );
      assert.deepEqual(low, [], `${name} ${locale}`);
    }
    await done(page);
  }
  const gas = await visit({ hash: "#gas", width: 390, height: 844, touch: true });
  for (const control of ["[data-gas=count]", "[data-gas=speed]", "[data-gas=rate]", ".histogram"]) await gas.locator(control).waitFor({ state: "visible" });
  await gas.getByRole("button", { name: "Reverse" }).waitFor({ state: "visible" });
  assert.ok((await gas.evaluate(() => document.documentElement.scrollWidth)) <= 390);
  await done(gas);
  const page = await visit({ width: 390, height: 844, touch: true });
  const box = await page.locator('.handle-tip[data-body="0"]').boundingBox();
  const client = await page.context().newCDPSession(page);
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await client.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [{ x, y }] });
  for (let k = 1; k <= 6; k++) await client.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: [{ x: x - 5 * k, y }] });
  await client.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  await until(page, () => caromLab.app.document.body[0].velocity[0] < 3);
  await done(page);
});

test("L53 a teacher's link freezes a control and says so", async () => {
  const page = await visit();
  await page.getByLabel("A: mass").fill("3");
  await until(page, () => location.hash.startsWith("#1."));
  const hash = await page.evaluate(() => location.hash);
  await done(page);
  const pupil = await visit({ hash: `${hash}&lock=e,mass` });
  assert.ok(await pupil.locator(".slider input[type=range]").first().isDisabled());
  assert.ok(await pupil.getByLabel("A: mass").isDisabled());
  assert.match(await text(pupil, ".slider"), /fixed by this link/);
  assert.ok(await pupil.getByLabel("A: radius").isEnabled());
  await done(pupil);
});

test("L54 the worksheet has blanks, and answers on page two", async () => {
  const page = await visit();
  await page.evaluate(() => (window.print = () => {}));
  await next(page);
  await page.getByRole("button", { name: "Save" }).click();
  await page.locator(".entry", { hasText: "Worksheet" }).click();
  await until(page, () => document.querySelector(".worksheet .page-two") !== null);
  const one = await text(page, ".page-one");
  assert.ok(one.includes("______") && !/= 4/.test(one.slice(one.indexOf("blank"))));
  assert.match(await text(page, ".page-two"), /4/);
  await page.emulateMedia({ media: "print" });
  assert.ok(await page.locator(".worksheet").isVisible());
  await done(page);
});

quiet();
