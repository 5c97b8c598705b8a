// The gas: up to five thousand discs in a worker of their own, their speeds beside Maxwell's curve, and the arrow of time.
import { fill, h } from "../dom.ts";
import { Client } from "../engine/client.ts";
import { type Description, Frame } from "../engine/types.ts";
import { picture, type Picture } from "../save.ts";
import { drawMany } from "../stage/bodies.ts";
import { Camera } from "../stage/camera.ts";
import { inks } from "../stage/stage.ts";
import { fmt, t } from "../words/index.ts";
import { gasScene } from "./scene.ts";

const COUNTS = [100, 500, 1000, 2000, 5000];
/** What the engine may take of a frame (ms). */
const BUDGET = 16;
/** How far a disc may be from its start after a reversal to count as back (m). */
const BACK = 1e-6;

export function gas(place: HTMLElement): { leave(): void; picture: Picture } {
  const canvas = h("canvas", { role: "img", aria: { label: t("gas.label") } });
  const stage = h("div", { class: "gas-stage" }, canvas);
  const chart = h("canvas", { class: "histogram", role: "img", aria: { label: t("gas.speeds") } });
  const clock = h("p", { class: "quiet-text", data: { gas: "clock" } });
  const rate = h("p", { class: "quiet-text", data: { gas: "rate" } });
  const verdict = h("p", { role: "status", data: { gas: "verdict" } });
  const camera = new Camera();
  let client: Client | null = null;
  let description: Description | null = null;
  let frame: Frame | null = null;
  let first: Frame | null = null;
  let running = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  let ended = false;
  let [count, share] = [1000, 0.3];
  let speed = 0.05;
  /** Since the reversal: the impacts until then and the time of it. */
  let turned: { impacts: number; time: number } | null = null;
  const counts: number[] = [];
  let frames = 0;
  let total = 0;
  /** The picture is older than the place it fills. */
  let stale = true;
  let since = performance.now();
  let impactsThen = 0;
  /** The gas that was asked for last, and the one that is there. Until they are one nothing moves: the new gas would be on its
   * way before its start was seen. */
  let [asked, there] = [0, 0];

  const play = h("button", { type: "button", class: "primary", onclick: () => ((running = !running), label()) });
  const label = () => {
    fill(play, t(running ? "transport.pause" : "transport.play"));
  };
  const pick = h("select", { data: { gas: "count" }, onchange: () => ((count = Number(pick.value)), void open()) }, COUNTS.map((n) => h("option", { value: String(n), selected: n === count }, String(n))));
  const dense = h("input", { type: "range", min: "0.05", max: "0.7", step: "0.05", value: String(share), onchange: () => ((share = Number(dense.value)), void open()) });
  const quick = h("input", { type: "range", data: { gas: "speed" }, min: "-3", max: "0", step: "0.05", value: "-1.3", oninput: () => (speed = 10 ** Number(quick.value)) });
  const reverse = h("button", { type: "button", onclick: () => void turn() }, t("gas.reverse"));
  fill(
    place,
    stage,
    h(
      "div",
      { class: "gas-side" },
      h("section", { class: "panel" }, h("h2", {}, t("gas.title")), h("label", { class: "choice" }, t("gas.count"), pick), h("label", { class: "choice" }, t("gas.fill"), dense), h("label", { class: "choice" }, t("transport.speed"), quick), h("div", { class: "row" }, play, h("button", { type: "button", onclick: () => void open() }, t("gas.restart"))), h("div", { class: "row" }, reverse), verdict),
      h("section", { class: "panel" }, h("h2", {}, t("gas.speeds")), chart, clock, rate),
    ),
  );
  label();

  const open = async () => {
    if (!client) return;
    verdict.textContent = "";
    turned = null;
    counts.length = 0;
    const wanted = ++asked;
    const opened = await client.open(gasScene(count, share), false);
    const start = await client.frame();
    if (wanted !== asked) return;
    description = opened.description;
    first = frame = new Frame(start, 2);
    there = wanted;
    impactsThen = 0;
    fit();
  };

  const turn = async () => {
    if (!client || !frame || asked !== there) return;
    await client.reverse();
    turned = { impacts: frame.impacts, time: frame.time };
    verdict.textContent = t("gas.reversed", { n: frame.impacts });
  };

  const fit = () => {
    const ratio = Math.min(2, devicePixelRatio || 1);
    if (stage.clientWidth === 0) return;
    canvas.width = stage.clientWidth * ratio;
    canvas.height = stage.clientHeight * ratio;
    camera.width = stage.clientWidth;
    camera.height = stage.clientHeight;
    camera.scale = Math.min(camera.width, camera.height) - 24;
    camera.x = camera.y = 0.5;
    stale = true;
  };
  const watch = new ResizeObserver(fit);
  watch.observe(stage);

  const paint = () => {
    stale = false;
    if (frame) draw(canvas.getContext("2d", { alpha: false, willReadFrequently: true })!, canvas.width / camera.width);
  };
  const draw = (c: CanvasRenderingContext2D, ratio: number) => {
    if (!frame || !description) return;
    const ink = inks();
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.fillStyle = ink.paper;
    c.fillRect(0, 0, camera.width, camera.height);
    drawMany(c, camera, description, frame, ink);
    const [x0, y0] = camera.to([0, 1]);
    c.strokeStyle = ink.wall;
    c.lineWidth = 2.5;
    c.strokeRect(x0, y0, camera.scale, camera.scale);
  };

  /** The speeds of the last frames as a histogram, with Maxwell's curve of the same energy. */
  const histogram = () => {
    if (!frame) return;
    const bins = 28;
    const most = 4;
    // The first frame counts whole; after it each is a tenth of what is shown.
    const share = counts.length === bins ? 0.1 : 1;
    if (share === 1) counts.splice(0, counts.length, ...new Array(bins).fill(0));
    const { data, stride } = frame;
    for (let b = 0; b < bins; b++) counts[b] *= 1 - share;
    for (let k = 0; k < frame.count; k++) {
      const at = 16 + k * stride + 2;
      const b = Math.floor((Math.hypot(data[at], data[at + 1]) / most) * bins);
      if (b < bins) counts[b] += share;
    }
    const ratio = Math.min(2, devicePixelRatio || 1);
    const [wide, high] = [chart.clientWidth || 280, 150];
    chart.width = wide * ratio;
    chart.height = high * ratio;
    const c = chart.getContext("2d")!;
    c.scale(ratio, ratio);
    const ink = inks();
    const temperature = frame.kinetic / frame.count;
    const curve = (v: number) => ((frame!.count * v) / temperature) * Math.exp((-v * v) / (2 * temperature)) * (most / bins);
    const top = 1.25 * Math.max(curve(Math.sqrt(temperature)), 1);
    const base = high - 20;
    c.fillStyle = ink.bodies[0];
    counts.forEach((n, b) => {
      const y = (n / top) * base;
      c.fillRect((b * wide) / bins + 1, base - y, wide / bins - 2, y);
    });
    c.strokeStyle = ink.colour("p");
    c.lineWidth = 2;
    c.beginPath();
    for (let x = 0; x <= wide; x += 2) c.lineTo(x, base - (curve((x / wide) * most) / top) * base);
    c.stroke();
    c.fillStyle = ink.ink;
    c.font = '13px "Source Sans 3 Variable", system-ui';
    c.textAlign = "right";
    c.fillText("v / m/s", wide - 2, high - 4);
    c.fillStyle = ink.colour("p");
    c.fillText(t("gas.maxwell"), wide - 6, 16);
    c.fillStyle = ink.ink;
    c.textAlign = "center";
    for (let v = 1; v < most; v++) c.fillText(String(v), (v / most) * wide, high - 4);
  };

  /** After a reversal: is every disc where it was? */
  const returned = () => {
    if (!turned || !frame || !first || frame.time < 2 * turned.time) return;
    let farthest = 0;
    for (let k = 0; k < frame.count; k++) {
      const [a, b] = [frame.position(k), first.position(k)];
      farthest = Math.max(farthest, Math.hypot(a[0] - b[0], a[1] - b[1]));
    }
    verdict.textContent = farthest < BACK ? t("gas.back", { distance: fmt(farthest, 2), n: turned.impacts }) : t("gas.chaos", { n: turned.impacts });
    turned = null;
  };

  let waiting = false;
  let tick = 0;
  let last = performance.now();
  const loop = (now: number) => {
    if (ended) return;
    requestAnimationFrame(loop);
    const dt = Math.min(0.05, (now - last) / 1000);
    last = now;
    if (client && frame && running && !waiting && asked === there) {
      waiting = true;
      let target = frame.time + dt * speed;
      // The way back ends exactly at the start.
      if (turned) target = Math.min(target, 2 * turned.time);
      void client.live(target, BUDGET).then((next) => {
        waiting = false;
        if (ended) return;
        frame = new Frame(next, 2);
        frames++;
        total++;
        returned();
        paint();
        if (++tick % 6 === 0) histogram();
      });
    } else if (!running && stale) {
      paint();
    }
    if (now - since > 1000 && frame) {
      rate.textContent = t("gas.frame", { fps: String(Math.round((frames * 1000) / (now - since))), rate: String(Math.round(((frame.impacts - impactsThen) * 1000) / (now - since))) });
      rate.dataset.fps = String((frames * 1000) / (now - since));
      clock.textContent = `${t("gas.time", { time: fmt(frame.time, 4), impacts: frame.impacts, drift: fmt(frame.data[14], 1) })} · ${t("gas.temperature", { t: fmt(frame.kinetic / frame.count, 4) })}`;
      [frames, since, impactsThen] = [0, now, frame.impacts];
    }
  };
  client = Client.start();
  void open().then(() => requestAnimationFrame(loop));
  // What the tests look at.
  (window as unknown as { caromLab: Record<string, unknown> }).caromLab.gas = { count: () => frame?.count ?? 0, frames: () => total, impacts: () => frame?.impacts ?? 0, start: () => first?.time };
  return {
    leave() {
      ended = true;
      watch.disconnect();
      client?.stop();
    },
    picture: { png: () => picture(camera.width, camera.height, draw) },
  };
}
