// A lesson from its beginning to its end in one page, by mouse and keyboard alone, as a teacher goes through it.
import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { test } from "node:test";
import { atImpact, cell, done, quiet, ready, server, settled, text, until, visit } from "./browser.mjs";

test("a lesson: drag, predict, impact, equations, another e, worksheet, link, frame, no network", async () => {
  const page = await visit({ workers: "allow" });
  // SHOTS=folder keeps a picture of each step.
  let steps = 0;
  const seen = async (name) => {
    if (!process.env.SHOTS) return;
    mkdirSync(process.env.SHOTS, { recursive: true });
    await page.screenshot({ path: `${process.env.SHOTS}/${++steps}-${name}.png` });
  };

  // A is dragged to the left, and the tip of its velocity to the right.
  const drag = async (handle, dx) => {
    await settled(page);
    const box = await page.locator(handle).boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + dx, y, { steps: 5 });
    await page.mouse.up();
    await settled(page);
  };
  await drag('.handle-ball[data-body="0"]', -30);
  const x = await page.evaluate(() => caromLab.app.description.document.body[0].position[0]);
  assert.ok(x < -1.05, `${x}`);
  await drag('.handle-tip[data-body="0"]', 25);
  const v = await page.evaluate(() => caromLab.app.description.document.body[0].velocity[0]);
  assert.ok(v > 3.2, `${v}`);
  assert.equal(Number((await page.getByLabel("A: v", { exact: true }).inputValue()).replace("−", "-")), v);
  await seen("dragged");

  // The class predicts: m = 2 and 1, e = 1/2, B comes with -1 m/s. v1' = v - J/2 and v2' = -1 + J, J = (1 + e) (2/3) (v + 1) = v + 1.
  await page.getByText("Predict first").click();
  await page.getByLabel("A: v′").waitFor();
  await settled(page);
  assert.equal(await page.locator(".brief").count(), 0);
  await seen("asked");
  const J = v + 1;
  await page.getByLabel("A: v′").fill(String(v - J / 2));
  await page.getByLabel("B: v′").fill(String(-1 + J));
  await seen("answered");
  await page.getByRole("button", { name: "Check" }).click();
  // Right: it plays on to the end, and the results are there.
  await until(page, () => !caromLab.app.predicting && caromLab.app.frame.time > caromLab.app.marks[0]);
  await page.keyboard.press("Home");
  await until(page, () => caromLab.app.frame.time === 0 && caromLab.app.settled && !caromLab.app.playing);

  // To the impact, and the equations.
  await page.getByRole("button", { name: "Next impact" }).click();
  await atImpact(page);
  assert.ok(Math.abs((await page.evaluate(() => caromLab.app.impact.impulse)) - J) < 1e-12 * J);
  assert.ok((await page.locator(".brief .equation").count()) >= 5);
  await page.locator(".step summary").nth(7).click();
  assert.match(await text(page, ".step[open]"), /restitution/);
  await seen("impact");

  // Another e, while the page stands at the impact.
  await page.locator(".slider input[type=range]").first().focus();
  for (let k = 0; k < 50; k++) await page.keyboard.press("ArrowRight");
  await until(page, () => caromLab.app.impact?.restitution === 1 && caromLab.app.settled && caromLab.app.atImpact);
  // e = 1: J = 2 (2/3) (v + 1).
  const elastic = (4 / 3) * (v + 1);
  assert.ok(Math.abs((await page.evaluate(() => caromLab.app.impact.impulse)) - elastic) < 1e-12 * elastic);
  assert.equal(await page.locator('[data-ledger="k-lost"]').textContent(), "0.000");
  assert.equal(await cell(page, 1).textContent(), (-1 + elastic).toPrecision(3));
  await seen("elastic");

  // A worksheet.
  await page.evaluate(() => (window.print = () => (window.printed = true)));
  await page.getByRole("button", { name: "Save" }).click();
  await page.getByRole("button", { name: "Worksheet" }).click();
  await until(page, () => window.printed === true);
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  await atImpact(page);

  // The link, for the class; with it the same scene opens in a frame, and without a network.
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.getByRole("button", { name: "Share" }).click();
  await page.locator(".toast").waitFor();
  const link = await page.evaluate(() => navigator.clipboard.readText());
  assert.ok(link.startsWith(server.url) && link.length < 2000, link);
  await seen("shared");
  const digest = await page.evaluate(() => caromLab.app.survey.report.digest);
  const fragment = link.slice(link.indexOf("#"));
  await page.goto(`${server.url}?embed=1${fragment}`);
  await ready(page);
  await until(page, () => caromLab.app.survey.done);
  assert.equal(await page.locator("header").count(), 0);
  assert.equal(await page.evaluate(() => caromLab.app.survey.report.digest), digest);
  await seen("embedded");
  await until(page, () => navigator.serviceWorker.controller !== null);
  await page.context().setOffline(true);
  await page.goto(`${server.url}?lang=pt-BR${fragment}&lock=e`);
  await ready(page);
  await until(page, () => caromLab.app.survey.done && document.documentElement.lang === "pt-BR");
  assert.equal(await page.evaluate(() => caromLab.app.survey.report.digest), digest);
  assert.ok(await page.locator(".slider input[type=range]").first().isDisabled());
  await page.getByRole("button", { name: "Próximo choque" }).click();
  await atImpact(page);
  await seen("offline");
  await done(page);
});

quiet();
