// The page at an impact: the stage, the equations, the ledger, the plots. Each test carries its numbers of the Lab's list of behaviours.
import assert from "node:assert/strict";
import { test } from "node:test";
import { arrows, atImpact, cell, done, go, next, quiet, settled, stage, text, until, visit } from "./browser.mjs";
import { strict } from "./pace.mjs";

test("L01 next impact, after: v = 1.00 and 3.00, J = 4.00", async () => {
  const page = await visit();
  await page.getByRole("button", { name: "Next impact" }).click(); // once it is enabled
  await atImpact(page);
  await stage(page, "after");
  assert.equal(await cell(page, 0).textContent(), "1.00");
  assert.equal(await cell(page, 1).textContent(), "3.00");
  const J = (await arrows(page)).find((a) => a.quantity === "J" && a.label);
  assert.match(J.label, /J = 4\.00 N s/);
  await done(page);
});

test("L05 L06 e by slider and by typing; out of range is refused with a message", async () => {
  const page = await visit({ hash: "#oblique" });
  const e = page.locator('.slider input[type=text]').first();
  const slider = page.locator('.slider input[type=range]').first();
  assert.deepEqual(await slider.evaluate((s) => [s.min, s.max, s.step]), ["0", "1", "0.01"]);
  await e.fill("0.37");
  await until(page, () => caromLab.app.impact?.restitution === 0.37);
  await settled(page);
  assert.equal(await slider.inputValue(), "0.37");
  await e.fill("1.5");
  assert.match(await text(page, ".bodies .complaint"), /between 0 and 1/);
  assert.equal(await page.evaluate(() => caromLab.app.impact.restitution), 0.37);
  await e.fill("0");
  await until(page, () => caromLab.app.impact?.restitution === 0);
  await until(page, () => document.querySelector(".badge-Common") !== null);
  await done(page);
});

test("L07 changes while paused at an impact reach every equation", async () => {
  const page = await visit();
  await next(page);
  const mass = page.getByLabel("A: mass");
  const took = await page.evaluate(
    () =>
      new Promise((resolve) => {
        const input = document.querySelector('[data-key="body[1].mass"]');
        const was = document.querySelector(".brief").textContent;
        const from = performance.now();
        input.value = "4";
        input.dispatchEvent(new Event("input", { bubbles: true }));
        const look = () => (document.querySelector(".brief")?.textContent !== was ? resolve(performance.now() - from) : setTimeout(look, 1));
        look();
      }),
  );
  console.log(`  a change reaches the equations after ${took.toFixed(0)} ms`);
  assert.ok(!strict || took < 2 * (1000 / 60), `${took} ms`);
  await settled(page);
  // Every equation, the ledger, the table of bodies and the arrows are of the new numbers: v' = 3 - 4.8/4 and -1 + 4.8.
  assert.deepEqual(await page.evaluate(() => caromLab.app.chain.values.filter(([name]) => /^v\d-after$/.test(name)).map(([, v]) => v.map((x) => +x.toFixed(12)))), [[1.8], [3.8]]);
  assert.equal(await text(page, '[data-ledger="body-A-change-x"]'), "−4.800");
  assert.deepEqual([await cell(page, 0).textContent(), await cell(page, 1).textContent()], ["1.80", "3.80"]);
  assert.match((await arrows(page)).find((a) => a.quantity === "J" && a.label).label, /4\.80/);
  // m = 4 and 1, u = 4, e = 1/2: J = 1.5 * 0.8 * 4 = 4.8.
  await until(page, () => caromLab.app.impact.impulse === 4.8);
  assert.match(await text(page, ".brief"), /4\.8/);
  assert.ok(await page.evaluate(() => caromLab.app.atImpact));
  assert.equal(await mass.inputValue(), "4");
  await done(page);
});

test("L08 every letter has a number and points at its arrow and its cell", async () => {
  const page = await visit({ hash: "#oblique" });
  await next(page);
  const letter = page.locator('.brief [data-q="v1-after"]').first();
  await letter.hover();
  await until(page, () => caromLab.stage.hot === "v1-after");
  assert.match(await letter.getAttribute("title"), /3\.92/);
  assert.ok((await arrows(page)).some((a) => a.name === "v1-after"));
  assert.ok(await page.locator('[data-cell="now-0"].hot').count());
  await letter.focus();
  await until(page, () => caromLab.stage.hot === "v1-after");
  const missing = await page.evaluate(() => {
    const names = new Set(caromLab.app.chain.values.map(([name]) => name));
    return [...document.querySelectorAll(".brief [data-q]")].map((e) => e.dataset.q).filter((q) => !names.has(q));
  });
  assert.deepEqual(missing, []);
  await done(page);
});

/** Three significant digits, with trailing noughts, as people write them. */
const three = (x, comma) => {
  const text = x === 0 ? "0.00" : Number(x.toPrecision(3)).toFixed(Math.max(0, 2 - Math.floor(Math.log10(Math.abs(Number(x.toPrecision(3)))))));
  return (comma ? text.replace(".", ",") : text).replace("-", "−");
};

test("L09 symbols, numbers, both: the values are the engine's in three significant digits", async () => {
  for (const [hash, locale] of [["#two-balls", "en-US"], ["#oblique", "en-US"], ["#oblique", "pt-BR"]]) {
    const page = await visit({ hash, locale });
    await next(page);
    // The engine's own number of each row is that of its first letter.
    const rows = () =>
      page.evaluate(() =>
        [...document.querySelectorAll(".brief .equation")].map((row) => {
          const values = caromLab.app.chain.values.find(([name]) => name === row.querySelector("[data-q]").dataset.q)[1];
          const shown = (kind) => [...row.querySelectorAll(`.part-${kind}:not(.first)`)].filter((e) => getComputedStyle(e).display !== "none");
          // What is seen; the MathML beside it says the same to those who listen.
          const text = shown("value").map((e) => e.querySelector(".katex-html").textContent).join();
          const spoken = shown("value").map((e) => [...e.querySelectorAll("mn")].map((n) => n.textContent).join(" ")).join();
          return { values, text, spoken, letters: shown("letters").length, numbers: shown("numbers").length };
        }),
      );
    const checked = async (view, want) => {
      if (view) await page.locator(`input[name=view][value=${view}]`).check({ force: true });
      const all = await rows();
      assert.ok(all.length >= 6, `${all.length} rows`);
      for (const row of all) {
        const numbers = row.text.match(/[−-]?\d+(?:[.,]\d+)?/g) ?? [];
        if (want[2]) assert.deepEqual(numbers.slice(0, row.values.length), row.values.map((x) => three(x, locale === "pt-BR")), `${view}: ${row.text} for ${row.values}`);
        else assert.equal(row.text, "");
      }
      assert.deepEqual([all.some((r) => r.letters), all.some((r) => r.numbers), all.some((r) => r.text !== "")], want, view);
    };
    await checked(null, [true, true, true]);
    await checked("symbols", [true, false, false]);
    await checked("numbers", [false, true, true]);
    await checked("both", [true, true, true]);
    // And the table of bodies says the same.
    const now = await page.evaluate(() => ["v1-after", "v2-after"].map((name) => caromLab.app.chain.values.find(([n]) => n === name)[1]));
    for (const k of [0, 1]) assert.deepEqual((await cell(page, k).textContent()).split("; "), now[k].map((x) => three(x, locale === "pt-BR")));
    await done(page);
  }
});

test("L10 L11 normal and tangent parts are perpendicular and add up; the impulse pair is equal and opposite", async () => {
  const page = await visit({ hash: "#oblique" });
  await next(page);
  await stage(page, "at");
  const all = await arrows(page);
  const d = (a) => [a.to[0] - a.from[0], a.to[1] - a.from[1]];
  const named = (name) => d(all.find((a) => a.name === name));
  for (const k of [1, 2]) {
    const [v, n, t] = [named(`v${k}`), named(`vp${k}`), named(`vn${k}`)];
    assert.ok(Math.abs(n[0] * t[0] + n[1] * t[1]) < 1e-6);
    for (const c of [0, 1]) assert.ok(Math.abs(n[c] + t[c] - v[c]) < 1, `${v} ${n} ${t}`);
  }
  const [a, b] = [named("Fh1"), named("Fh2")];
  assert.ok(Math.hypot(...a) > 20 && Math.hypot(a[0] + b[0], a[1] + b[1]) < 1e-9);
  // The tip of the impulse on the second body really is drawn in its colour.
  const tip = all.find((x) => x.name === "Fh2");
  const pixel = await page.evaluate(({ x, y }) => {
    const c = caromLab.stage.canvas;
    const k = c.width / c.clientWidth;
    return [...c.getContext("2d").getImageData(Math.round(x * k), Math.round(y * k), 1, 1).data];
  }, { x: tip.to[0] - d(tip)[0] * 0.06, y: tip.to[1] - d(tip)[1] * 0.06 });
  const want = [0x9a, 0x2f, 0x7c];
  assert.ok(want.every((x, k) => Math.abs(x - pixel[k]) < 40), `${pixel}`);
  await go(page, "wall");
  await next(page);
  assert.equal((await arrows(page)).filter((x) => x.quantity === "J").length, 2);
  await done(page);
});

test("L15 L16 a step back whenever t > 0, also with e < 1; the same impacts at every speed", async () => {
  const page = await visit();
  const back = page.getByRole("button", { name: "Step back" });
  assert.ok(await back.isDisabled());
  await next(page);
  assert.ok(await back.isEnabled());
  await back.click();
  await until(page, () => caromLab.app.frame.time < 0.45);
  await settled(page);
  const marks = () => page.evaluate(() => Array.from(caromLab.app.marks));
  const before = await marks();
  await page.locator(".transport select").selectOption("1");
  await page.keyboard.press("Home");
  assert.deepEqual(await marks(), before);
  await done(page);
});

test("L17 the ledger of a wall: walls take what the ball gives, and the total stays", async () => {
  const scene = { carom: 1, world: { dim: 1 }, wall: [{ name: "wall", plane: { point: [0], normal: [1] } }], body: [{ name: "A", mass: 1, radius: 0.1, position: [1], velocity: [-3] }], run: { until: { time: 1 } } };
  const page = await visit();
  await page.evaluate((s) => caromLab.app.load(JSON.stringify(s)), scene);
  await until(page, () => caromLab.app.survey.done);
  await next(page);
  assert.equal(await text(page, '[data-ledger="outside-change-x"]'), "−6.000");
  assert.equal(await text(page, '[data-ledger="total-change-x"]'), "0.000");
  assert.ok(await page.locator("tr.total .tick").count());
  await done(page);
});

test("L20 plots: total momentum and the stack of energies are flat; a click goes there", async () => {
  const page = await visit({ hash: "#oblique", height: 1200 });
  await until(page, () => caromLab.plots.data().time.length > 10);
  const { momentum, stacked, time } = await page.evaluate(() => caromLab.plots.data());
  for (const series of [momentum, stacked]) for (const x of series) assert.ok(Math.abs(x - series[0]) < 1e-12 * Math.max(1, Math.abs(series[0])));
  assert.ok(time.length > 100);
  const plot = page.locator(".plot .u-over").first();
  const box = await plot.boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + 20);
  await until(page, () => Math.abs(caromLab.app.frame.time - caromLab.app.end / 2) < 0.05);
  await done(page);
});

test("L21 predict first: hidden in the page's text, marked by cell", async () => {
  const page = await visit();
  await page.locator(".predict input[type=checkbox]").check();
  await until(page, () => document.querySelectorAll(".answer input").length === 2);
  await settled(page);
  assert.equal(await page.locator(".brief").count(), 0);
  const ledger = await text(page, ".ledger");
  assert.ok(!/4\.000|5\.500/.test(ledger), ledger);
  await page.getByLabel("A: v′").fill("1.005");
  await page.getByLabel("B: v′").fill("2");
  await page.getByRole("button", { name: "Check" }).click();
  assert.deepEqual(await page.locator(".answer input").evaluateAll((all) => all.map((i) => i.dataset.mark)), ["right", "wrong"]);
  await page.getByLabel("B: v′").fill("3");
  await page.getByRole("button", { name: "Check" }).click();
  await until(page, () => caromLab.app.playing || caromLab.app.frame.time > 0.45);
  await done(page);
});

test("L21 a prediction by arrows: the tip that is dragged writes the number", async () => {
  const page = await visit({ hash: "#oblique" });
  await page.locator(".predict input[type=checkbox]").check();
  await page.locator('.handle-answer[data-body="0"]').waitFor();
  await settled(page);
  const input = page.getByLabel("A: v′ x");
  assert.equal(await input.inputValue(), "");
  const box = await page.locator('.handle-answer[data-body="0"]').boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 20, y + 25, { steps: 4 });
  await page.mouse.up();
  await until(page, () => caromLab.stage.drawn.some((a) => a.name === "answer1"));
  const [arrow] = (await arrows(page)).filter((a) => a.name === "answer1");
  // The arrow is the numbers: as long, at the scale of the velocity before (5 m/s along x), and it points down.
  const v = (await arrows(page)).find((a) => a.name === "v1");
  const scale = (v.to[0] - v.from[0]) / 5;
  const said = await page.evaluate(() => caromLab.app.answers[0].velocity);
  assert.ok(said[0] < 5 && said[1] < 0, `${said}`);
  for (const c of [0, 1]) assert.ok(Math.abs((arrow.to[c] - arrow.from[c]) * (c ? -1 : 1) - said[c] * scale) < 1e-6);
  assert.equal(Number((await input.inputValue()).replace("−", "-")), said[0]);
  // By keys as well.
  await page.locator('.handle-answer[data-body="0"]').focus();
  await page.keyboard.press("Shift+ArrowRight");
  await until(page, (was) => Math.abs(caromLab.app.answers[0].velocity[0] - was - 0.1) < 1e-9, said[0]);
  await page.getByRole("button", { name: "Check" }).click();
  assert.equal(await input.evaluate((e) => e.dataset.mark), "wrong");
  await done(page);
});

test("before the impact the stage shows where the two will touch", async () => {
  const page = await visit({ hash: "#oblique" });
  await until(page, () => caromLab.stage.ghosts.length === 2);
  const { ghosts, at } = await page.evaluate(() => ({ ghosts: caromLab.stage.ghosts, at: caromLab.stage.camera.to(caromLab.app.impact.point) }));
  const [[x, y, r], [u, w, s]] = ghosts;
  assert.ok(Math.abs(Math.hypot(x - u, y - w) - r - s) < 1e-6, "they touch");
  assert.ok(Math.abs(Math.hypot(x - at[0], y - at[1]) - r) < 1e-6, "at the point of contact");
  await next(page);
  assert.deepEqual(await page.evaluate(() => caromLab.stage.ghosts), []);
  await done(page);
});

test("labels stand clear of one another and inside the picture, also on a phone", async () => {
  for (const [hash, width] of [["#oblique", 1280], ["#throw", 390], ["#two-balls", 390], ["#grip", 390]]) {
    const page = await visit({ hash, width, height: 844 });
    await next(page);
    await page.evaluate(() => caromLab.app.setStage("at"));
    await settled(page);
    const boxes = await page.evaluate(() => {
      const c = document.createElement("canvas").getContext("2d");
      c.font = '600 14px "Source Sans 3 Variable"';
      return { wide: caromLab.stage.camera.width, boxes: caromLab.stage.drawn.filter((a) => a.label).map((a) => [a.label, a.place[0], a.place[1], c.measureText(a.label).width]) };
    });
    assert.ok(boxes.boxes.length >= 3, hash);
    boxes.boxes.forEach(([text, x, y, w], k) => {
      assert.ok(x >= 0 && x + w <= boxes.wide + 1, `${hash} ${width}: ${text} at ${x}`);
      for (const [other, u, v, t] of boxes.boxes.slice(0, k)) assert.ok(Math.abs(y - v) >= 12 || x + w <= u || u + t <= x, `${hash} ${width}: ${text} over ${other}`);
    });
    await done(page);
  }
});

test("walls: one switch puts them round the scene and takes them away", async () => {
  const page = await visit();
  const walls = page.locator('[data-key="world.boundary"]');
  await walls.check();
  await until(page, () => caromLab.app.description.corners !== null && caromLab.app.survey.done);
  const [min, max] = await page.evaluate(() => caromLab.app.description.corners);
  assert.ok(min[0] < -1.1 && max[0] > 1.1, `${min} ${max}`);
  await walls.uncheck();
  await until(page, () => caromLab.app.description.corners === null);
  await done(page);
});

test("L24 the operators side by side: momentum kept by each, different velocities, each under its name", async () => {
  const page = await visit({ hash: "#cradle" });
  await page.getByRole("button", { name: "Look and letters" }).click();
  await page.getByRole("button", { name: "Compare operators" }).click();
  await until(page, () => document.querySelectorAll("dialog [data-operator]").length === 3);
  const heads = await page.locator("dialog [data-operator]").evaluateAll((all) => all.map((e) => [e.dataset.operator, e.textContent]));
  assert.deepEqual(heads, [["reflect", "generalised reflections"], ["sequential", "sequential, pair by pair"], ["lcp", "all at once (LCP)"]]);
  const rows = await page.locator("dialog tbody tr").evaluateAll((all) => all.map((row) => [...row.children].map((e) => e.textContent)));
  assert.deepEqual(rows.find(([head]) => head === "momentum").slice(1), ["1.000", "1.000", "1.000"]);
  const speeds = rows.filter(([head]) => head.startsWith("v "));
  assert.equal(speeds.length, 5);
  assert.ok(speeds.some(([, , sequential, simultaneous]) => sequential !== simultaneous), JSON.stringify(speeds));
  await done(page);
});

test("L44 overlap on a drag is marked, and play says why it cannot", async () => {
  const page = await visit();
  const ball = page.locator('.handle-ball[data-body="0"]');
  const box = await ball.boundingBox();
  const other = await page.locator('.handle-ball[data-body="1"]').boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(other.x + other.width / 2 - 20, other.y + other.height / 2, { steps: 8 });
  await until(page, () => caromLab.app.problems.length > 0);
  await page.mouse.up();
  const play = page.locator(".transport-play");
  assert.ok(await play.isDisabled());
  assert.match(await play.getAttribute("title"), /overlap/);
  assert.match(await text(page, ".bodies .complaint"), /overlap/);
  await done(page);
});

test("L55 space: the same ledger, an equal and opposite pair, a view that turns by keys", async () => {
  const page = await visit({ hash: "#space" });
  const canvas = page.locator(".space-canvas");
  await next(page);
  assert.ok(await page.locator("tr.total .tick").count());
  const impact = await page.evaluate(() => caromLab.app.impact);
  const given = impact.bodies.map((_, k) => impact.after[k].velocity.map((v, c) => [1, 4][k] * (v - impact.before[k].velocity[c])));
  given[0].forEach((p, c) => assert.ok(Math.abs(p + given[1][c]) < 1e-14));
  const view = await canvas.getAttribute("data-view");
  await canvas.focus();
  await page.keyboard.press("ArrowLeft");
  await until(page, (was) => document.querySelector(".space-canvas").dataset.view !== was, view);
  await done(page);
});

test("the gallery opens every built-in scene", async () => {
  const page = await visit();
  const names = await page.evaluate(() => caromLab.scenes.map((s) => s.name));
  assert.ok(names.length >= 12);
  await page.locator(".scene-button").click();
  assert.equal(await page.locator(".card").count(), names.length);
  await page.locator('.card[data-scene="cradle"]').click();
  await until(page, () => caromLab.app.builtin === "cradle" && caromLab.app.address === "cradle");
  await settled(page);
  await until(page, () => caromLab.app.nextImpact > 0);
  await page.evaluate(() => caromLab.app.next());
  await until(page, () => document.querySelector(".equations table") !== null);
  await done(page);
});

quiet();
