// The page under load: many impacts, many bodies, and a hand that drags. Each test carries its numbers of the Lab's list of behaviours.
import assert from "node:assert/strict";
import { test } from "node:test";
import { browser, done, frames, go, quiet, settled, until, visit } from "./browser.mjs";
import { byTheClock, FRAME, LONG, strict } from "./pace.mjs";
import { traced } from "./trace.mjs";

test("L25 pi: 314 and 3141 impacts, and thirty frames a second", async () => {
  const page = await visit({ hash: "#pi" });
  for (const [mass, count] of [["10000", 314], ["1000000", 3141]]) {
    await page.getByLabel("heavy: mass").fill(mass);
    await until(page, (count) => caromLab.app.survey.done && caromLab.app.survey.impacts === count, count);
    await until(page, (count) => document.querySelector(".impact-title h2").textContent.endsWith(` ${count}`), count);
  }
  await settled(page);
  await page.evaluate(() => caromLab.app.play());
  const cost = await traced(browser, page, () => frames(page, 60));
  console.log(`  pi: ${cost.result.toFixed(0)} frames a second, ${(cost.page.total / 60).toFixed(1)} ms of the processor a frame, longest task ${cost.page.longest.toFixed(0)} ms`);
  await until(page, () => caromLab.app.frame.time > 0);
  assert.ok(cost.page.total / 60 < FRAME && cost.page.longest < LONG, JSON.stringify(cost));
  byTheClock(cost.result);
  await done(page);
});

test("L27 a gas turned round comes back after 100 impacts; after many it does not, and the page says why", async () => {
  const page = await visit({ hash: "#gas" });
  const verdict = page.locator("[data-gas=verdict]");
  await page.locator("[data-gas=count]").selectOption("100");
  await until(page, () => caromLab.gas.count() === 100);
  // As soon as there are a hundred: a click from outside may come after a thousand.
  const turned = await page.evaluate(async () => {
    const verdict = document.querySelector("[data-gas=verdict]");
    const said = [];
    new MutationObserver(() => said.push(verdict.textContent)).observe(verdict, { childList: true, characterData: true, subtree: true });
    const reverse = [...document.querySelectorAll(".gas-side button")].find((b) => b.textContent.startsWith("Reverse"));
    while (caromLab.gas.impacts() < 100) await new Promise((r) => requestAnimationFrame(r));
    reverse.click();
    while (said.length < 2) await new Promise((r) => requestAnimationFrame(r));
    return said;
  });
  assert.match(turned[0], /turned round/);
  assert.match(await verdict.textContent(), /^Back at the start: farthest disc [\d.]+(×10⁻\S+)? m .* after \d{3} impacts/);
  // As fast as it goes, for the sake of the test.
  await page.locator("[data-gas=speed]").evaluate((input) => ((input.value = "0"), input.dispatchEvent(new Event("input"))));
  // However often it is begun again while it runs, the start is that of the gas, not what it was on its way to.
  for (let k = 0; k < 10; k++) {
    await page.getByRole("button", { name: "Start again" }).click();
    await frames(page, 4);
    assert.equal(await page.evaluate(() => caromLab.gas.start()), 0);
  }
  await until(page, () => caromLab.gas.impacts() > 3000);
  await page.getByRole("button", { name: "Reverse" }).click();
  await until(page, () => /rounding/.test(document.querySelector("[data-gas=verdict]").textContent));
  assert.match(await verdict.textContent(), /does not come back: after \d{4,} impacts/);
  await done(page);
});

test("L45 inelastic collapse ends, shows the cluster, and the page stays awake", async () => {
  const page = await visit({ hash: "#two-balls" });
  // What is loaded after the first picture is no part of it.
  await settled(page);
  const cost = await traced(browser, page, async () => {
    await go(page, "collapse");
    await until(page, () => caromLab.app.survey.done);
    await page.evaluate(() => caromLab.app.play());
    await frames(page, 30);
    // In the middle of it: the end is gone to, and stayed at.
    await page.keyboard.press("End");
    assert.equal(await page.evaluate(() => caromLab.app.playing), false);
    await until(page, () => caromLab.app.settled && !caromLab.app.playing && caromLab.app.frame.time === caromLab.app.end);
  });
  console.log(`  collapse: longest task ${cost.page.longest.toFixed(0)} ms of the processor`);
  assert.ok(cost.page.longest < LONG, `${cost.page.longest} ms`);
  const { impacts, gaps, speeds, cluster } = await page.evaluate(() => {
    const { frame, description, survey } = caromLab.app;
    const x = description.bodies.map((_, k) => frame.position(k)[0]);
    const r = description.bodies.map((b) => b.radius);
    return { impacts: survey.impacts, gaps: [0, 1].map((k) => x[k + 1] - x[k] - r[k] - r[k + 1]), speeds: x.map((_, k) => frame.velocity(k)[0]), cluster: caromLab.stage.clusters };
  });
  assert.ok(impacts > 10 && impacts < 100_000, `${impacts}`);
  gaps.forEach((gap) => assert.ok(Math.abs(gap) < 1e-6, `${gaps}`));
  speeds.forEach((v) => assert.ok(Math.abs(v - speeds[0]) < 1e-6, `${speeds}`));
  assert.deepEqual(cluster, [["left", "middle", "right"]]);
  await done(page);
});

test("no task beyond 100 ms while a ball and a velocity are dragged", async () => {
  for (const [hash, width, height] of [["#oblique", 1280, 800], ["#pi", 1280, 800], ["#break", 1280, 800], ["#oblique", 390, 844]]) {
    const page = await visit({ hash, width, height });
    await until(page, () => caromLab.app.survey.done);
    await settled(page);
    for (const handle of [".handle-ball", ".handle-tip"]) {
      const box = await page.locator(`${handle}[data-body="0"]`).boundingBox();
      if (!box) continue;
      const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
      const was = await page.evaluate(() => JSON.stringify(caromLab.app.document.body[0]));
      const cost = await traced(browser, page, async () => {
        await page.mouse.move(x, y);
        await page.mouse.down();
        for (let k = 1; k <= 25; k++) await page.mouse.move(x - 1.5 * k, y + (k % 3));
        await page.mouse.up();
        await settled(page);
      });
      console.log(`  dragging ${handle} in ${hash} at ${width}: longest task ${cost.page.longest.toFixed(0)} ms of the processor`);
      assert.notEqual(await page.evaluate(() => JSON.stringify(caromLab.app.document.body[0])), was);
      assert.ok(cost.page.longest < LONG, `${hash} ${handle}: ${cost.page.longest} ms`);
    }
    await done(page);
  }
});

test("L46 five thousand discs: thirty frames a second, and clicks are heard at once", async () => {
  const page = await visit({ hash: "#gas" });
  await page.locator("[data-gas=count]").selectOption("5000");
  await until(page, () => caromLab.gas.count() === 5000);
  const cost = await traced(browser, page, () =>
    page.evaluate(async () => {
      const [from, first] = [performance.now(), caromLab.gas.frames()];
      while (caromLab.gas.frames() < first + 45) await new Promise((r) => requestAnimationFrame(r));
      return [caromLab.gas.frames() - first, ((caromLab.gas.frames() - first) * 1000) / (performance.now() - from)];
    }),
  );
  const [n, seen] = cost.result;
  console.log(`  5,000 discs: ${seen.toFixed(1)} frames a second; of the processor a frame ${(cost.page.total / n).toFixed(1)} ms for the page, ${(cost.worker.total / n).toFixed(1)} ms for the engine; longest task ${cost.page.longest.toFixed(0)} ms`);
  assert.ok(cost.worker.total > 0, "the engine runs in a worker");
  assert.ok(cost.page.total / n < FRAME && cost.worker.total / n < FRAME, JSON.stringify(cost));
  // Nothing on the page's thread is longer, so that no input waits longer.
  assert.ok(cost.page.longest < LONG, `${cost.page.longest} ms`);
  byTheClock(seen);
  await page.evaluate(() => {
    window.delays = [];
    document.addEventListener("click", (e) => window.delays.push(performance.now() - e.timeStamp), true);
  });
  for (const name of ["Pause", "Play", "Pause", "Play", "Pause"]) await page.getByRole("button", { name, exact: true }).click();
  const delays = (await page.evaluate(() => window.delays)).sort((a, b) => a - b);
  console.log(`  a click is heard after ${delays[2].toFixed(0)} ms`);
  assert.equal(delays.length, 5);
  assert.ok(!strict || delays[2] < LONG, `${delays}`);
  await done(page);
});

quiet();
