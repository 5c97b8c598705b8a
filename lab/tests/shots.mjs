// Pictures of the page, to be looked at: every tab, light and dark, desktop and phone, both languages, and what else a lesson
// shows. `node lab/tests/shots.mjs FOLDER [PART OF A NAME]`, after `lab/build`.
import { existsSync, mkdirSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { serve } from "./serve.mjs";

const [folder, only = ""] = process.argv.slice(2);
if (!folder) {
  console.error("usage: node lab/tests/shots.mjs FOLDER [PART OF A NAME]");
  process.exit(2);
}
mkdirSync(folder, { recursive: true });
const executablePath = ["/usr/bin/chromium", "/usr/bin/chromium-browser", process.env.CHROMIUM].find((p) => p && existsSync(p));
const server = await serve(new URL("../dist", import.meta.url).pathname);
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", "--disable-gpu"] });

const SIZES = { desktop: [1280, 800], phone: [390, 844] };
const TABS = { line: "#two-balls", plane: "#oblique", space: "#space", gas: "#gas" };
const settled = (page) => page.waitForFunction(() => caromLab.app.settled && (caromLab.tab !== "gas" || window.caromLab.gas?.frames() > 30) && (caromLab.tab !== "3" || document.querySelector(".space-canvas")?.dataset.view), null, { timeout: 120_000 });
const drawn = (page) => page.evaluate(() => new Promise((r) => setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(r)), 400)));
/** To the n-th impact, looked at from this side. */
const impact = (n, side) => async (page) => {
  await page.waitForFunction((n) => caromLab.app.marks.length >= n, n, { timeout: 120_000 });
  await page.evaluate(([n, side]) => caromLab.app.toImpact(n, side), [n, side]);
};
const press = (name) => (page) => page.locator(name).first().click();

async function shot(name, { size = "desktop", hash = "", query = "", theme = "light", locale = "en-US", whole = false }, ...steps) {
  if (!name.includes(only)) return;
  const [width, height] = SIZES[size];
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: theme, locale, hasTouch: size === "phone", serviceWorkers: "block", reducedMotion: "no-preference" });
  context.setDefaultTimeout(120_000);
  const page = await context.newPage();
  await page.goto(server.url + query + hash);
  await page.waitForSelector("html[data-ready]");
  for (const step of steps) {
    await settled(page);
    await step(page);
  }
  await settled(page);
  await drawn(page);
  await page.screenshot({ path: join(folder, `${name}.png`), fullPage: whole });
  console.log(name);
  await context.close();
}

for (const [tab, hash] of Object.entries(TABS)) {
  for (const size of Object.keys(SIZES)) {
    for (const locale of ["en", "pt-BR"]) {
      for (const theme of ["light", "dark"]) {
        const steps = tab === "gas" ? [] : [impact(1, theme === "dark" ? "at" : "after")];
        if (size === "phone" && tab !== "gas") steps.push(press(`[data-choose=${{ line: "equations", plane: "ledger", space: "bodies" }[tab]}]`));
        await shot(`${tab}-${size}-${locale}-${theme}`, { size, hash, locale, theme, whole: size === "phone" && tab === "gas" }, ...steps);
      }
    }
  }
}
await shot("start", {});
await shot("start-phone", { size: "phone" });
for (const panel of ["plots", "show", "equations"]) await shot(`panel-${panel}-phone`, { size: "phone", hash: "#oblique", whole: true }, impact(1, "after"), press(`[data-choose=${panel}]`));
await shot("tall", { hash: "#oblique", whole: true }, impact(1, "after"));
for (const [scene, n] of [["superball", 1], ["grip", 1], ["topspin", 2], ["slide-roll", 1], ["throw", 1], ["break", 3], ["cradle", 1], ["collapse", 5], ["pi-31", 4], ["wall", 1], ["heap", 40], ["bernoulli", 1]]) await shot(`scene-${scene}`, { hash: `#${scene}` }, impact(n, "after"));
await shot("throw-phone", { size: "phone", hash: "#throw" }, impact(1, "at"), press("[data-choose=equations]"));
await shot("e0", { hash: "#oblique" }, (page) => page.locator(".slider input[type=text]").first().fill("0"), impact(1, "after"));
await shot("predict", {}, press(".predict input[type=checkbox]"));
await shot("predict-marked", { hash: "#oblique" }, press(".predict input[type=checkbox]"), async (page) => {
  const answers = page.locator(".answer input");
  for (let k = 0; k < (await answers.count()); k++) await answers.nth(k).fill("1");
  await page.locator(".predict .primary").click();
});
await shot("predict-phone", { size: "phone", hash: "#oblique" }, press(".predict input[type=checkbox]"));
await shot("worksheet", { hash: "#oblique", whole: true }, impact(1, "after"), async (page) => {
  await page.evaluate(() => (window.print = () => {}));
  await page.locator(".menu-button").first().click();
  await page.locator(".entry").last().click();
  await page.waitForSelector(".worksheet .page-two", { state: "attached" });
  await page.emulateMedia({ media: "print" });
});
await shot("compare", { hash: "#cradle" }, press(".menu-button >> nth=1"), press(".entry"), (page) => page.waitForSelector("dialog [data-operator]"));
await shot("gallery", {}, press(".scene-button"));
await shot("gallery-dark", { theme: "dark", locale: "pt-BR" }, press(".scene-button"));
await shot("gallery-phone", { size: "phone" }, press(".scene-button"));
await shot("help", {}, (page) => page.keyboard.press("?"));
await shot("settings", { locale: "pt-BR" }, press(".menu-button >> nth=1"));
await shot("embed", { query: "?embed=1", hash: "#oblique" }, impact(1, "at"));
await shot("error-link", { hash: "#9.abcdef" });
await shot("error-overlap", {}, (page) => page.getByLabel("A: x", { exact: true }).fill("0.9"));
await shot("locked", { hash: "#two-balls&lock=e,mass" });
await browser.close();
server.close();
