// The page in Debian's chromium, for the tests. None of them waits for a clock: they wait for what the page shows, and a machine
// that is slow, or busy with something else, only takes longer.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { chromium } from "playwright-core";
import { serve } from "./serve.mjs";

export const here = new URL(".", import.meta.url).pathname;
export const dist = join(here, "../dist");
export const carom = process.env.CAROM ?? join(here, "../../target/debug/carom");
export const native = existsSync(carom);
const executablePath = ["/usr/bin/chromium", "/usr/bin/chromium-browser", process.env.CHROMIUM].find((p) => p && existsSync(p));
const flags = ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-gpu"];
/** Nothing that is waited for takes so long (ms). */
const PATIENCE = 120_000;
/** THROTTLE=4 makes the page's thread four times slower than the machine. */
const throttle = Number(process.env.THROTTLE ?? 1);

export let server, browser;
/** What went wrong in any page. */
export const troubles = [];

before(async () => {
  server = await serve(dist);
  browser = await chromium.launch({ executablePath, args: flags });
});
after(async () => {
  await browser?.close();
  server?.close();
});

/** The last test of every file. */
export const quiet = () =>
  test("L52 no error in the console and no request to another host, in any of these", () => {
    assert.deepEqual(troubles, []);
  });

/** A fresh page at this address; what goes wrong in it is kept for L52. It stands at the start of its scene. */
export async function visit({ hash = "", query = "", width = 1280, height = 800, locale = "en-US", theme = "light", motion = "no-preference", touch = false, workers = "block" } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, locale, colorScheme: theme, reducedMotion: motion, hasTouch: touch, serviceWorkers: workers, acceptDownloads: true });
  context.setDefaultTimeout(PATIENCE);
  const page = await context.newPage();
  watch(page);
  if (throttle > 1) await (await context.newCDPSession(page)).send("Emulation.setCPUThrottlingRate", { rate: throttle });
  await page.goto(server.url + query + hash);
  await ready(page);
  return page;
}

/** Keeps what goes wrong in a page. */
export function watch(page, home = server.url) {
  page.on("pageerror", (e) => troubles.push(e.message));
  page.on("console", (m) => m.type() === "error" && troubles.push(m.text()));
  page.on("request", (r) => !r.url().startsWith(home) && !/^(blob|data):/.test(r.url()) && troubles.push(`request to ${r.url()}`));
}

export const done = (page) => page.context().close();
/** Waits until an expression about the page is true; if it never is, the error says what the page shows instead. */
export const until = async (page, expression, argument) => {
  try {
    await page.waitForFunction(expression, argument, { timeout: PATIENCE, polling: 30 });
  } catch (error) {
    error.message += `\n${expression}\n${JSON.stringify(await page.evaluate(state).catch(String), null, 1)}`;
    throw error;
  }
};
const state = () => {
  const { app } = window.caromLab;
  const own = Object.fromEntries(Object.entries(app).filter(([, value]) => value === null || ["number", "boolean", "string"].includes(typeof value)));
  const { impact, document: scene, frame, survey, start } = app;
  return { ...own, settled: app.settled, atImpact: app.atImpact, time: frame?.time, start: start?.time, marks: [...app.marks].slice(0, 8), survey, impact, scene, focus: document.activeElement?.outerHTML.slice(0, 300) };
};
/** The page has its scene, and what it loads afterwards for it: the gas, or the view of space. */
export const ready = async (page) => {
  await page.waitForSelector("html[data-ready]");
  await until(page, () => (caromLab.tab === "gas" ? window.caromLab.gas !== undefined : caromLab.tab !== "3" || document.querySelector(".space-canvas")?.dataset.view !== undefined));
};
/** Everything that is shown is of the scene, the time and the impact that were asked for, and has been drawn. */
export const settled = async (page) => {
  await until(page, () => caromLab.app.settled);
  await frames(page, 2);
};
/** Opens a built-in scene by the address, and waits for it. */
export const go = async (page, name) => {
  await page.evaluate((name) => (location.hash = `#${name}`), name);
  await until(page, (name) => caromLab.app.builtin === name && caromLab.app.address === name, name);
  await settled(page);
};
export const text = (page, selector) => page.locator(selector).first().textContent();
export const cell = (page, k) => page.locator(`[data-cell="now-${k}"]`);
/** Waits until the page stands at the n-th impact. */
export const atImpact = async (page, n = 1) => {
  await until(page, (n) => caromLab.app.chosen === n && caromLab.app.atImpact && caromLab.app.settled, n);
  await frames(page, 2);
};
/** Runs to the next impact by its key, once there is one. */
export const next = async (page, n = 1) => {
  await until(page, () => caromLab.app.nextImpact > 0);
  await page.keyboard.press("n");
  await atImpact(page, n);
};
export const stage = async (page, name) => {
  await page.locator(`input[name=stage][value=${name}]`).check({ force: true });
  await until(page, (s) => caromLab.app.stage === s && caromLab.app.settled, name);
};
/** The arrows as they are drawn. */
export const arrows = async (page) => {
  await settled(page);
  return page.evaluate(() => caromLab.stage.drawn);
};
/** So many frames of the animation, and the frames a second that they came at. */
export const frames = (page, n) =>
  page.evaluate(async (n) => {
    const from = performance.now();
    for (let k = 0; k < n; k++) await new Promise((r) => requestAnimationFrame(r));
    return (n * 1000) / (performance.now() - from);
  }, n);
