// The engine through wasm, as the page uses it, under Node. Each test carries its numbers of the Lab's list of behaviours.
// The command line runs the same scenes natively; what it says must be the same to the last digit.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { module } from "./typescript.mjs";

const here = new URL(".", import.meta.url);
const { Engine, Words, Files, SceneError, OtherDimension, dimensionOf } = await module(new URL("../src/engine/module.ts", here));
const { Frame } = await module(new URL("../src/engine/types.ts", here));
const { scenes } = await import("../scenes.mjs");
const builtin = new Map(scenes().map((scene) => [scene.name, scene.document]));

/** One module a dimension, as the page loads them. */
const engines = new Map();
for (const dim of [1, 2, 3]) engines.set(dim, await Engine.load(readFileSync(new URL(`../public/carom-${dim}d.wasm`, here))));
const words = await Words.load(readFileSync(new URL("../public/carom-words.wasm", here)));
const files = await Files.load(readFileSync(new URL("../public/carom-files.wasm", here)));
/** The text of the scene that was opened last. */
let opened;
/** The module of the scene that was opened last. */
let engine;
const start = (text) => {
  engine = engines.get(dimensionOf(text));
  const description = { ...engine.open(text), document: JSON.parse(text) };
  opened = text;
  return description;
};

const carom = process.env.CAROM ?? new URL("../../target/debug/carom", here).pathname;
const native = existsSync(carom);
const cli = (...args) => execFileSync(carom, args, { encoding: "utf8", maxBuffer: 1 << 28 });

/** Opens a scene, a document or the name of a built-in one, and runs its survey to the end. */
function open(scene) {
  const description = start(JSON.stringify(typeof scene === "string" ? builtin.get(scene) : scene));
  while (!engine.survey(1000));
  return { description, survey: engine.surveyed(), marks: engine.marks() };
}

/** A small generator of random numbers (Park and Miller 1988), the same on every machine. */
function random(seed) {
  let state = seed;
  return () => (state = (state * 48271) % 2147483647) / 2147483647;
}

const line = (e, m = [2, 1], v = [3, -1]) => ({
  carom: 1,
  world: { dim: 1 },
  material: { default: { restitution: e } },
  body: [
    { name: "A", mass: m[0], radius: 0.1, position: [-1], velocity: [v[0]] },
    { name: "B", mass: m[1], radius: 0.1, position: [1], velocity: [v[1]] },
  ],
  run: { until: { time: 2 } },
});

/** Two discs that meet at any angle. */
function plane(r, e, mu = 0) {
  const angle = 2 * Math.PI * r();
  const [x, y] = [Math.cos(angle), Math.sin(angle)];
  return {
    carom: 1,
    world: { dim: 2 },
    material: { default: { restitution: e, ...(mu > 0 ? { friction: mu } : {}) } },
    body: [
      { name: "A", mass: 0.1 + 5 * r(), radius: 0.2, position: [-x, -y], velocity: [x + r() - 0.5, y + r() - 0.5] },
      { name: "B", mass: 0.1 + 5 * r(), radius: 0.3, position: [0.2 * (r() - 0.5), 0.2 * (r() - 0.5)], velocity: [0, 0] },
    ],
    run: { until: { time: 5 } },
  };
}

test("L01 the default scene gives the numbers of the lecture", () => {
  const { survey } = open("two-balls");
  const [impact] = engine.lines(1, 1);
  assert.equal(survey.impacts, 1);
  assert.deepEqual([impact.time, impact.impulse, impact.lost], [0.45, 4, 4]);
  assert.deepEqual(impact.after.map((m) => m.velocity), [[1], [3]]);
});

test("L02 the same numbers as carom explain, to the last digit", { skip: !native && "no carom binary" }, () => {
  for (const scene of ["two-balls", "oblique", "wall", "space", "throw", "superball"]) {
    open(scene);
    const told = JSON.parse(cli("explain", scene, "--event", "1", "--format", "json"));
    const shown = new Map(words.explain(engine.question(1), "en", "").values);
    const one = (name) => shown.get(name)[0];
    for (const [name, key] of [["e", "restitution"], ["u", "approach"], ["u-after", "departure"], ["J", "impulse"], ["Q", "lost"]]) assert.equal(one(name), told[key], `${scene}: ${name}`);
    assert.deepEqual([one("m1"), one("m2")], told.masses, scene); // no number for a wall
    // What is only the rounding of a larger number is shown as the nought it is.
    const same = (shown, told) => shown === told || (shown === 0 && Math.abs(told) < 1e-14);
    told.normal.forEach((x, c) => assert.ok(same(shown.get("n")[c], x), `${scene}: n`));
    for (const when of ["before", "after"]) {
      const letter = (k) => shown.get(`v${k + 1}${when === "after" ? "-after" : ""}`);
      told[when].velocity.forEach((v, k) => v.forEach((x, c) => assert.ok(same(letter(k)[c], x), `${scene}: v${k + 1}`)));
    }
    if (told.slip) for (const [name, key] of [["Qn", "lost_normal"], ["Qt", "lost_friction"]]) assert.ok(same(one(name), told[key]), `${scene}: ${name}`);
  }
});

test("L03 momentum before and after, 200 random scenes", () => {
  const r = random(3);
  let met = 0;
  for (let k = 0; k < 200; k++) {
    open(plane(r, r()));
    const ledger = engine.ledger(1);
    if (!ledger) continue;
    met++;
    const scale = ledger.rows.flatMap((row) => row.before).reduce((sum, p) => sum + Math.abs(p), 0);
    ledger.total.before.forEach((p, c) => assert.ok(Math.abs(p - ledger.total.after[c]) <= 1e-12 * scale, `${k} ${p}`));
    assert.ok(ledger.closes);
  }
  assert.ok(met > 120, `${met} scenes had an impact`);
});

test("L04 kinetic energy before is that after and what was lost, for all e and mu", () => {
  const r = random(4);
  let met = 0;
  for (const e of [0, 0.01, 0.3, 0.5, 0.99, 1]) {
    for (const mu of [0, 0.2, 1]) {
      for (let k = 0; k < 4; k++) {
        open(plane(r, e, mu));
        const energy = engine.ledger(1)?.energy;
        if (!energy) continue;
        met++;
        assert.ok(energy.closes && Math.abs(energy.before - energy.after - energy.lost) <= 1e-12 * energy.before);
        assert.ok(energy.lost >= -1e-14 * energy.before); // a few roundings of the energy, where e = 1
      }
    }
  }
  assert.ok(met > 40, `${met} scenes had an impact`);
});

test("L06 e = 0 in the plane gives equal normal velocities", () => {
  const r = random(6);
  for (let k = 0; k < 20; k++) {
    open(plane(r, 0));
    const [impact] = engine.lines(1, 1);
    if (!impact) continue;
    const along = impact.after.map((m) => m.velocity[0] * impact.normal[0] + m.velocity[1] * impact.normal[1]);
    assert.ok(Math.abs(along[0] - along[1]) < 1e-14);
  }
});

test("L12 the next impact stops at contact", () => {
  const r = random(12);
  for (let k = 0; k < 40; k++) {
    const { marks } = open(plane(r, r()));
    if (marks.length === 0) continue;
    engine.seek(0);
    assert.equal(engine.next(1e9), marks[0]);
    const frame = new Frame(engine.frame(), 2);
    const [a, b] = [frame.position(0), frame.position(1)];
    assert.ok(Math.abs(Math.hypot(a[0] - b[0], a[1] - b[1]) - 0.5) < 1e-12);
  }
});

const inelastic = {
  carom: 1,
  world: { dim: 2, gravity: [0, -9.81], boundary: { kind: "box", min: [0, 0], max: [2, 2] } },
  material: { default: { restitution: 0.9 } },
  body: [
    { name: "A", mass: 1, radius: 0.1, position: [0.5, 1.5], velocity: [3, 1] },
    { name: "B", mass: 2, radius: 0.15, position: [1.4, 1.2], velocity: [-2, 0.5] },
    { name: "C", mass: 0.5, radius: 0.08, position: [1, 0.6], velocity: [1, -2] },
  ],
  run: { until: { time: 6 } },
};

test("L13 back through 50 inelastic impacts to the initial state, bit for bit", () => {
  const { marks } = open(inelastic);
  assert.ok(marks.length >= 50, `${marks.length}`);
  engine.seek(0);
  const start = engine.frame();
  const there = [];
  for (let k = 0; k < 50; k++) {
    engine.seek(marks[k]);
    there.push(engine.frame());
  }
  for (let k = 49; k >= 0; k--) {
    engine.seek(marks[k]);
    assert.deepEqual(engine.frame(), there[k], `impact ${k + 1}`);
  }
  engine.seek(0);
  assert.deepEqual(engine.frame(), start);
});

test("L13 a jump, back or ahead, in a long run is the straight run, bit for bit", () => {
  // Long enough for many key snapshots on the way: 3141 impacts, and a heap that moves by slices.
  for (const [scene, dim] of [["pi", 1], ["heap", 2], ["spheres", 3]]) {
    const document = structuredClone(builtin.get(scene));
    if (scene !== "pi") document.run.until = { time: scene === "heap" ? 0.25 : 0.1 };
    const { survey, marks } = open(document);
    const r = random(131);
    const times = Array.from({ length: scene === "pi" ? 5 : 2 }, () => survey.time * (0.4 + 0.6 * r()));
    if (scene === "pi") times.push(marks[3000], marks[1500], marks[2999], marks[0]);
    const jumped = times.map((time) => (engine.seek(time), engine.frame()));
    // Anew, without a survey and so without keys, each from the start.
    times.forEach((time, k) => {
      start(JSON.stringify(document));
      engine.seek(time);
      const straight = engine.frame();
      assert.equal(new Frame(jumped[k], dim).digest, new Frame(straight, dim).digest, `${scene} at ${time}`);
      assert.deepEqual(jumped[k], straight, `${scene} at ${time}`);
    });
  }
});

test("L14 the slider to t then play is play to t", () => {
  const { survey } = open(inelastic);
  const r = random(14);
  for (let k = 0; k < 10; k++) {
    const time = survey.time * r();
    engine.seek(0);
    engine.seek(time);
    const straight = engine.frame();
    engine.seek(0);
    for (let step = 1; step <= 37; step++) engine.seek((time * step) / 37);
    engine.seek(time);
    const played = engine.frame();
    assert.deepEqual(played.subarray(16), straight.subarray(16));
    assert.deepEqual([played[11], played[12]], [straight[11], straight[12]]);
  }
});

test("L17 an elastic wall takes 2 m v and the total stays", () => {
  const scene = { carom: 1, world: { dim: 1 }, wall: [{ name: "wall", plane: { point: [0], normal: [1] } }], body: [{ name: "A", mass: 1.5, radius: 0.1, position: [1], velocity: [-2] }], run: { until: { time: 2 } } };
  open(scene);
  const ledger = engine.ledger(1);
  assert.deepEqual(ledger.rows[0].change, [6]); // 2 m v = 2 * 1.5 * 2
  assert.deepEqual(ledger.outside.change, [-6]);
  assert.deepEqual(ledger.total.change, [0]);
  assert.ok(ledger.closes && ledger.energy.closes);
});

test("L18 special cases light up when true, and only then", () => {
  const special = (scene) => (open(scene), words.explain(engine.question(1), "en", "").special);
  assert.deepEqual(special(line(1, [1, 1])), ["Exchange", "CentreOfMass"]);
  assert.deepEqual(special(line(1, [1, 1 + 1e-8])), ["CentreOfMass"]);
  assert.deepEqual(special(line(0)), ["Common", "CentreOfMass"]);
  assert.deepEqual(special(line(0.5)), ["CentreOfMass"]);
  assert.deepEqual(special("wall"), ["Wall"]);
  const oblique = (e, m) => ({ carom: 1, world: { dim: 2 }, material: { default: { restitution: e } }, body: [{ mass: 1, radius: 0.5, position: [-3, 0], velocity: [5, 0] }, { mass: m, radius: 0.5, position: [0, 0.5], velocity: [0, 0] }], run: { until: { time: 2 } } });
  assert.deepEqual(special(oblique(1, 1)), ["Exchange", "RightAngle", "CentreOfMass"]);
  assert.deepEqual(special(oblique(0.9, 1)), ["CentreOfMass"]);
});

test("L19 the centre of mass moves in a straight line through an impact", () => {
  const r = random(19);
  for (let k = 0; k < 20; k++) {
    const scene = plane(r, r());
    const { marks } = open(scene);
    const masses = scene.body.map((b) => b.mass);
    const centre = (time) => {
      engine.seek(time);
      const frame = new Frame(engine.frame(), 2);
      return [0, 1].map((c) => (masses[0] * frame.position(0)[c] + masses[1] * frame.position(1)[c]) / (masses[0] + masses[1]));
    };
    const at = marks[0] ?? 1;
    const [a, b, c] = [centre(0), centre(at), centre(2 * at)];
    // Three times evenly apart: the middle is half-way. Positions are of order 1.
    for (const axis of [0, 1]) assert.ok(Math.abs(b[axis] - (a[axis] + c[axis]) / 2) < 1e-13);
  }
});

test("L20 the plot of total momentum is flat, and so is that of all energies", () => {
  for (const scene of ["two-balls", "oblique"]) {
    open(scene);
    const rows = engine.samples(50);
    const stride = rows[0];
    const first = rows.subarray(1, 1 + stride);
    for (let at = 1; at < rows.length; at += stride) {
      assert.ok(Math.abs(rows[at + 5] - first[5]) < 1e-13);
      assert.ok(Math.abs(rows[at + 1] + rows[at + 2] + rows[at + 3] - rows[at + 4] - first[1]) < 1e-12 * first[1] + 1e-13);
    }
  }
});

test("L24 the cradle: sequential and simultaneous both keep momentum, and they differ", () => {
  // The cradle that is seen: one in, one out. Reflections find it, and pair by pair finds it as well where all is elastic. As one
  // complementarity problem (LCP) all closing contacts part at once: another answer.
  const ends = (document, together) => {
    const { survey } = open({ ...document, run: { ...document.run, together } });
    engine.seek(survey.time);
    const frame = new Frame(engine.frame(), 1);
    const speeds = Array.from({ length: frame.count }, (_, k) => frame.velocity(k)[0]);
    // m = 1 each, and one comes in with 1 m/s.
    assert.ok(Math.abs(speeds.reduce((sum, v) => sum + v, 0) - 1) < 1e-14, `${together}: ${speeds}`);
    return speeds;
  };
  const cradle = builtin.get("cradle");
  const [reflect, sequential, lcp] = ["reflect", "sequential", "lcp"].map((together) => ends(cradle, together));
  for (const seen of [reflect, sequential]) [0, 0, 0, 0, 1].forEach((v, k) => assert.ok(Math.abs(seen[k] - v) < 1e-12, `${seen}`));
  assert.ok(Math.max(...lcp.map((v, k) => Math.abs(v - sequential[k]))) > 0.1, `${lcp}`);
});

test("L25 pi: 10^4 counts 314 impacts, 10^6 counts 3141", () => {
  const { description } = open("pi");
  for (const [mass, count] of [[1e4, 314], [1e6, 3141]]) {
    const document = structuredClone(description.document);
    document.body.find((b) => b.name === "heavy").mass = mass;
    assert.equal(open(document).survey.impacts, count);
  }
});

const { gasScene } = await module(new URL("../src/gas/scene.ts", here));

test("L26 a gas of 1,000 discs has Maxwell's speeds", () => {
  start(gasScene(1000, 0.3));
  const n = 1000;
  let time = 0;
  while (engine.frame()[1] < 50 * n * 0.5) engine.seek((time += 0.02)); // an impact is of two discs
  // Speeds squared over 2 T are exponential; ten bins of equal chance; samples a good way apart.
  const bins = new Array(10).fill(0);
  let total = 0;
  for (let sample = 0; sample < 10; sample++) {
    engine.seek((time += 0.3));
    const frame = new Frame(engine.frame(), 2);
    const temperature = frame.kinetic / n;
    for (let k = 0; k < n; k++) {
      const [x, y] = frame.velocity(k);
      const chance = 1 - Math.exp(-(x * x + y * y) / (2 * temperature));
      bins[Math.min(9, Math.floor(10 * chance))]++;
      total++;
    }
  }
  const chi = bins.reduce((sum, k) => sum + (k - total / 10) ** 2 / (total / 10), 0);
  // Nine degrees of freedom: above 27.9 once in a thousand.
  assert.ok(chi < 27.9, `chi squared ${chi}: ${bins}`);
});

test("L27 a gas turned round after 100 impacts is back within 1e-6, and not after many", () => {
  /** The impacts until the reversal, and how far the farthest disc ends from where it began. */
  const there = (impacts) => {
    start(gasScene(100, 0.3));
    const first = new Frame(engine.frame(), 2);
    for (let n = 0; n < impacts; n++) engine.next(1000);
    const half = new Frame(engine.frame(), 2);
    assert.ok(engine.reverse());
    engine.seek(2 * half.time);
    const frame = new Frame(engine.frame(), 2);
    const far = Array.from({ length: 100 }, (_, k) => Math.hypot(frame.position(k)[0] - first.position(k)[0], frame.position(k)[1] - first.position(k)[1]));
    return [half.impacts, Math.max(...far)];
  };
  const [few, near] = there(100);
  assert.ok(few >= 100 && few < 110 && near < 1e-6, `${few} impacts: ${near} m`);
  const [many, far] = there(3000);
  assert.ok(many >= 3000 && far > 1e-3, `${many} impacts: ${far} m`);
});

const { encode, decode, NewerLink } = await module(new URL("../src/link.ts", here));

test("L28 a link holds the whole scene: 8 bodies in 2,000 characters", async () => {
  const r = random(28);
  const scene = { carom: 1, title: "Eight", world: { dim: 2, boundary: { kind: "box", min: [0, 0], max: [4, 4] } }, body: Array.from({ length: 8 }, (_, k) => ({ name: "ABCDEFGH"[k], mass: r() + 0.5, radius: 0.1 + 0.1 * r(), position: [0.5 + (k % 4) + 0.1 * r(), 1 + Math.floor(k / 4)], velocity: [r(), -r()] })), run: { until: { time: 3 } } };
  const { survey } = open(scene);
  const fragment = await encode(files.write(opened, "json"));
  assert.ok(fragment.length <= 2000, `${fragment.length}`);
  assert.equal(open(JSON.parse(await decode(`#${fragment}`))).survey.report.digest, survey.report.digest);
});

test("L30 a newer link is told from a broken one", async () => {
  await assert.rejects(decode("#2.abcd"), NewerLink);
  await assert.rejects(decode("#1.abcd"), (e) => !(e instanceof NewerLink));
  assert.equal(await decode("#cradle"), null);
});

test("L31 carom link opens the page's link, and the page opens that of carom link", { skip: !native && "no carom binary" }, async () => {
  for (const scene of ["oblique", "cradle", "wall"]) {
    const { survey } = open(scene);
    const toml = cli("link", "--open", `http://127.0.0.1/#${await encode(files.write(opened, "json"))}`);
    const { marks } = open(scene);
    const file = join(mkdtempSync(join(tmpdir(), "carom-lab-")), "scene.toml");
    writeFileSync(file, toml);
    assert.equal(JSON.parse(cli("run", file, "--format", "json")).digest, survey.report.digest);
    const events = cli("events", file, "--format", "json").trim().split("\n").map((line) => JSON.parse(line));
    assert.deepEqual(events.map((event) => event.time), Array.from(marks));
    const link = cli("link", scene).trim();
    assert.equal(open(JSON.parse(await decode(link.slice(link.indexOf("#"))))).survey.report.digest, survey.report.digest);
  }
});

test("L40 every arrow colour has a contrast of 3 to 1 on both themes", () => {
  const css = readFileSync(new URL("../src/style/base.css", here), "utf8");
  const blocks = [/:root \{([^}]*)\}/, /:root\[data-theme="dark"\] \{([^}]*)\}/].map((pattern) => pattern.exec(css)[1]);
  // WCAG 2.2: relative luminance and contrast ratio.
  const luminance = (hex) => {
    const [r, g, b] = [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16) / 255).map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const contrast = (a, b) => {
    const [x, y] = [luminance(a), luminance(b)].sort((p, q) => q - p);
    return (x + 0.05) / (y + 0.05);
  };
  for (const block of blocks) {
    const read = (name) => new RegExp(`--${name}: (#[0-9a-f]{6})`).exec(block)[1];
    for (const quantity of ["v", "p", "J", "n", "t", "cm"]) {
      for (const ground of ["stage", "card"]) assert.ok(contrast(read(`q-${quantity}`), read(ground)) >= 3, `${quantity} on ${ground}`);
    }
  }
});

test("L45 inelastic collapse is bounded and counted", () => {
  const { survey } = open("collapse");
  assert.ok(survey.done && survey.report.audit.pass);
  assert.ok(survey.impacts < 100_000);
});

test("L51 the digest in the page is the command line's", { skip: !native && "no carom binary" }, () => {
  for (const scene of ["two-balls", "oblique", "space", "wall", "piston", "bounce", "cradle", "bernoulli", "collapse", "pi-31", "pi", "break"]) {
    const { survey } = open(scene);
    const report = JSON.parse(cli("run", scene, "--format", "json"));
    assert.equal(survey.report.digest, report.digest, scene);
    assert.deepEqual(survey.report.bodies, report.bodies, scene);
    // Where the page looks at the end it is the same world.
    engine.seek(survey.time);
    assert.equal(new Frame(engine.frame(), report.dim).digest, report.digest, scene);
  }
});

test("a scene of another dimension is sent to its own module", () => {
  for (const [dim, other] of engines) {
    for (const scene of ["two-balls", "oblique", "space"]) {
      const wanted = builtin.get(scene).world.dim;
      if (wanted !== dim) assert.throws(() => other.open(JSON.stringify(builtin.get(scene))), (e) => e instanceof OtherDimension && e.dim === wanted);
    }
  }
});

test("what is wrong with a scene is told with its key", () => {
  const scene = line(0.5);
  scene.body[1].position = [-0.9];
  engine = engines.get(1);
  assert.throws(() => engine.open(JSON.stringify(scene)), (e) => e instanceof SceneError && e.problems[0].key === "body[2].position" && /overlaps/.test(e.message));
});
