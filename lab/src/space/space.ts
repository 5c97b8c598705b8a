// The stage of a scene in space: spheres and arrows in three.js, loaded only here. The view turns by drag or by keys.
import { AmbientLight, BufferGeometry, Color, ConeGeometry, CylinderGeometry, DirectionalLight, DoubleSide, GridHelper, Group, InstancedMesh, Line, LineBasicMaterial, LineDashedMaterial, Matrix4, Mesh, MeshBasicMaterial, MeshLambertMaterial, PerspectiveCamera, PlaneGeometry, Scene, SphereGeometry, Vector3, WebGLRenderer, type Object3D } from "three";
import type { App } from "../app.ts";
import type { Impact } from "../engine/types.ts";
import { h } from "../dom.ts";
import { usesFriction } from "../panels/bodies.ts";
import { inks } from "../stage/stage.ts";
import { picture, type Picture } from "../save.ts";
import { write } from "../stage/arrows.ts";
import { places } from "../stage/labels.ts";
import { initials, MOST_ARROWS } from "../stage/layout.ts";
import { impulseLetter } from "../settings.ts";
import { fmt, t } from "../words/index.ts";
import { markedSphere, Turned } from "./marked.ts";

/** How one looks at first (rad). */
const [TURN, TILT] = [-0.9, 0.42];
/** The longest arrow of a velocity, and that of an impulse, as parts of the size of the scene. */
const [SPEED, PUSH] = [0.28, 0.25];

/** Puts the view into its place; returns what ends it. */
export function space(app: App, place: HTMLElement): { leave(): void; picture: Picture } {
  const canvas = h("canvas", { class: "space-canvas", tabIndex: 0, role: "img", aria: { label: t("space.label"), describedby: "stage-summary" } });
  // What is written beside arrows; the tables say the same to those who listen.
  const labels = h("div", { class: "space-labels", aria: { hidden: true } });
  place.replaceChildren(canvas, labels);
  let written: { name: string; from: Vector3; to: Vector3; letter: string; who?: string; rest: string; colour: string }[] = [];
  const stood = new Map<string, number>();
  /** Where they stand. */
  let standing: [number, number][] = [];
  const renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
  const scene = new Scene();
  const camera = new PerspectiveCamera(35, 1, 0.01, 1e5);
  const sun = new DirectionalLight(0xffffff, 2.1);
  sun.position.set(2, -3, 5);
  scene.add(new AmbientLight(0xffffff, 1.6), sun);
  const things = new Group();
  const arrows = new Group();
  scene.add(things, arrows);
  let balls: InstancedMesh | null = null;
  let marked = false;
  const turned = new Turned();
  let [turn, tilt, zoom] = [TURN, TILT, 1];
  let centre = new Vector3();
  /** How long arrows are drawn (m), by the size of what is there at the start. */
  let size = 1;
  /** What is to be seen as the scene is opened: spheres, and the tips of arrows. */
  let seen: [Vector3, number][] = [];
  let pending = false;
  let ended = false;

  const v3 = (v: number[]) => new Vector3(v[0], v[1], v[2]);
  const build = (met: Impact[] = []) => {
    release(things);
    const ink = inks();
    renderer.setClearColor(new Color(ink.paper));
    const d = app.description;
    const low = new Vector3(Infinity, Infinity, Infinity);
    const high = new Vector3(-Infinity, -Infinity, -Infinity);
    d.bodies.forEach((body, k) => {
      const p = new Vector3(...(app.start.position(k) as [number, number, number]));
      low.min(p.clone().subScalar(body.radius));
      high.max(p.clone().addScalar(body.radius));
    });
    // Where they meet is to be seen as well.
    const mean = d.bodies.reduce((sum, b) => sum + b.radius, 0) / Math.max(1, d.bodies.length);
    for (const { point } of met) {
      const p = v3(point);
      low.min(p.clone().subScalar(1.5 * mean));
      high.max(p.clone().addScalar(1.5 * mean));
    }
    if (d.corners) {
      low.set(...(d.corners[0] as [number, number, number]));
      high.set(...(d.corners[1] as [number, number, number]));
    }
    size = Math.max(high.distanceTo(low), 1e-6);
    seen = [low, high].map((p) => [p, 0]);
    d.bodies.forEach((body, k) => seen.push([v3(app.start.position(k)), body.radius]));
    let fastest = Math.max(...d.bodies.map((_, k) => Math.hypot(...app.start.velocity(k))), 1e-300);
    for (const impact of met) for (const motion of [...impact.before, ...impact.after]) fastest = Math.max(fastest, Math.hypot(...motion.velocity));
    if (d.bodies.length <= MOST_ARROWS && !d.corners) {
      const tip = (from: Vector3, w: Vector3) => seen.push([from.clone().add(w), 0]);
      d.bodies.forEach((_, k) => tip(v3(app.start.position(k)), v3(app.start.velocity(k)).multiplyScalar((SPEED * size) / fastest)));
      for (const impact of met.slice(0, 8)) {
        const [point, n] = [v3(impact.point), v3(impact.normal)];
        for (const side of [-1, 1]) tip(point, n.clone().multiplyScalar(side * PUSH * size));
        for (const motion of impact.after) tip(point, v3(motion.velocity).multiplyScalar((SPEED * size) / fastest));
      }
    }
    const [left, right] = [new Vector3(Infinity, Infinity, Infinity), new Vector3(-Infinity, -Infinity, -Infinity)];
    for (const [p, r] of seen) {
      left.min(p.clone().subScalar(r));
      right.max(p.clone().addScalar(r));
    }
    centre = left.add(right).multiplyScalar(0.5);
    // Where nothing can turn there is nothing to mark.
    marked = d.bodies.length <= 200 && usesFriction(app.document);
    const ball = marked ? markedSphere() : new SphereGeometry(1, d.bodies.length > 500 ? 12 : 36, d.bodies.length > 500 ? 8 : 24);
    balls = new InstancedMesh(ball, new MeshLambertMaterial({ vertexColors: marked }), Math.max(1, d.bodies.length));
    d.bodies.forEach((body, k) => balls!.setColorAt(k, new Color(body.fixed ? ink.wall : ink.bodies[k % 6])));
    things.add(balls);
    if (d.corners) {
      const [a, b] = d.corners;
      const box: Vector3[] = [];
      for (let i = 0; i < 8; i++) for (const axis of [1, 2, 4]) if (!(i & axis)) box.push(corner(a, b, i), corner(a, b, i | axis));
      for (let i = 0; i < box.length; i += 2) things.add(new Line(new BufferGeometry().setFromPoints([box[i], box[i + 1]]), new LineBasicMaterial({ color: ink.wall })));
    } else {
      const grid = new GridHelper(size * 2, 16, ink.wall, ink.faint);
      grid.rotation.x = Math.PI / 2;
      grid.position.set((low.x + high.x) / 2, (low.y + high.y) / 2, low.z - 0.02 * size);
      things.add(grid);
    }
    for (const wall of d.walls) {
      if (wall.label.startsWith("boundary")) continue;
      const material = new MeshBasicMaterial({ color: ink.wall, transparent: true, opacity: 0.16, side: DoubleSide, depthWrite: false });
      if (wall.kind === "plane") {
        const mesh = new Mesh(new PlaneGeometry(2 * size, 2 * size), material);
        const n = new Vector3(...(wall.numbers[1] as [number, number, number])).normalize();
        const p = new Vector3(...(wall.numbers[0] as [number, number, number]));
        mesh.position.copy(centre.clone().sub(n.clone().multiplyScalar(centre.clone().sub(p).dot(n))));
        mesh.lookAt(mesh.position.clone().add(n));
        things.add(mesh);
      } else if (wall.kind === "triangle") {
        const points = wall.numbers.map((p) => new Vector3(...(p as [number, number, number])));
        const geometry = new BufferGeometry().setFromPoints(points);
        geometry.setIndex([0, 1, 2]);
        things.add(new Mesh(geometry, material));
      }
    }
    draw();
  };

  const arrow = (from: Vector3, w: Vector3, colour: string, thick: number): Object3D | null => {
    const length = w.length();
    if (!(length > 1e-9)) return null;
    // A shaft and a head; ArrowHelper's shaft is a hairline.
    const group = new Group();
    const material = new MeshLambertMaterial({ color: new Color(colour), emissive: new Color(colour), emissiveIntensity: 0.35 });
    const head = Math.min(0.045 * size * Math.sqrt(thick), 0.5 * length);
    const width = 0.0045 * size * thick;
    const shaft = new Mesh(new CylinderGeometry(width, width, length - head, 14), material);
    shaft.position.y = (length - head) / 2;
    const tip = new Mesh(new ConeGeometry(Math.min(2.6 * width + 0.006 * size, 0.5 * head), head, 20), material);
    tip.position.y = length - head / 2;
    group.add(shaft, tip);
    group.position.copy(from);
    group.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), w.clone().normalize());
    return group;
  };

  const paintArrows = () => {
    release(arrows);
    written = [];
    const { frame, description, show, start } = app;
    const ink = inks();
    if (description.bodies.length > MOST_ARROWS) return;
    const at = app.atImpact ? app.impact : null;
    let [fastest, hardest] = [0, 0];
    description.bodies.forEach((body, k) => {
      const speed = Math.max(Math.hypot(...start.velocity(k)), Math.hypot(...frame.velocity(k)));
      fastest = Math.max(fastest, speed);
      hardest = Math.max(hardest, speed * (body.mass ?? 0));
    });
    const put = (a: Object3D | null) => a && arrows.add(a);
    const few = show.values && description.bodies.length <= 8;
    const note = (name: string, from: Vector3, w: Vector3, letter: string, who: string | undefined, rest: string, colour: string) => few && w.length() > 1e-9 && written.push({ name, from, to: from.clone().add(w), letter, who, rest, colour });
    description.bodies.forEach((body, k) => {
      const side = at ? at.bodies.indexOf(body.name) : -1;
      let v = frame.velocity(k);
      if (at && side >= 0 && app.stage === "before") v = at.before[side].velocity;
      if (app.predicting && side >= 0) v = at!.before[side].velocity;
      const p = v3(frame.position(k));
      if (show.v) {
        const w = v3(v).multiplyScalar((SPEED * size) / (fastest || 1));
        put(arrow(p, w, ink.colour("v"), 1.2));
        const prime = at && side >= 0 && app.stage !== "before" && !app.predicting ? "′" : "";
        note(`v:${k}`, p, w, "v", description.bodies.length > 1 ? initials(body.name) : undefined, `${prime} = ${fmt(Math.hypot(...v))} m/s`, ink.colour("v"));
      }
      if (show.p && body.mass !== null) put(arrow(p, v3(v).multiplyScalar((SPEED * size * body.mass) / (hardest || 1)), ink.colour("p"), 2));
    });
    if (at && app.stage !== "before") {
      const point = v3(at.point);
      const n = v3(at.normal);
      if (show.nt) {
        const line = new Line(new BufferGeometry().setFromPoints([point.clone().addScaledVector(n, -0.35 * size), point.clone().addScaledVector(n, 0.35 * size)]), new LineDashedMaterial({ color: ink.colour("n"), dashSize: 0.02 * size, gapSize: 0.015 * size }));
        line.computeLineDistances();
        arrows.add(line);
      }
      if (show.J && !app.predicting) {
        const J = n.clone().multiplyScalar(at.impulse).add(v3(at.friction_impulse));
        const k = (PUSH * size) / (J.length() || 1);
        put(arrow(point, J.clone().multiplyScalar(k), ink.colour("J"), 2));
        put(arrow(point, J.clone().multiplyScalar(-k), ink.colour("J"), 2));
        note("J", point, J.clone().multiplyScalar(k), impulseLetter(app.settings), undefined, ` = ${fmt(J.length())} N s`, ink.colour("J"));
      }
    }
  };

  const paint = () => {
    if (!app.frame || !balls || app.frame.dim !== 3) return;
    const matrix = new Matrix4();
    if (marked) turned.pass(app.frame);
    for (let k = 0; k < app.frame.count; k++) {
      const p = app.frame.position(k);
      const r = app.description.bodies[k].radius;
      if (marked) matrix.compose(v3(p), turned.body(k), new Vector3(r, r, r));
      else matrix.makeScale(r, r, r).setPosition(p[0], p[1], p[2]);
      balls.setMatrixAt(k, matrix);
    }
    balls.instanceMatrix.needsUpdate = true;
    paintArrows();
    const reach = far() / zoom;
    camera.up.set(0, 0, 1);
    camera.position.set(centre.x + reach * Math.cos(tilt) * Math.cos(turn), centre.y + reach * Math.cos(tilt) * Math.sin(turn), centre.z + reach * Math.sin(tilt));
    camera.lookAt(centre);
    renderer.render(scene, camera);
    letter();
    canvas.dataset.view = `${turn.toFixed(3)} ${tilt.toFixed(3)} ${zoom.toFixed(3)}`;
  };
  /** So far off that everything that is to be seen at first is seen, from where one looks at first. */
  const far = () => {
    const [upright, aside] = [Math.tan((camera.fov * Math.PI) / 360), Math.tan((camera.fov * Math.PI) / 360) * camera.aspect];
    const back = new Vector3(Math.cos(TILT) * Math.cos(TURN), Math.cos(TILT) * Math.sin(TURN), Math.sin(TILT));
    const right = new Vector3(-Math.sin(TURN), Math.cos(TURN), 0);
    const up = back.clone().cross(right);
    let most = 1e-6;
    for (const [point, r] of seen) {
      const p = point.clone().sub(centre);
      const room = (across: number, half: number) => p.dot(back) + (Math.abs(across) + r) / half;
      most = Math.max(most, room(p.dot(up), 0.82 * upright), room(p.dot(right), 0.78 * aside));
    }
    return most;
  };
  /** The labels beside the tips of their arrows, as the camera sees them. */
  const letter = () => {
    const [width, height] = [place.clientWidth, place.clientHeight];
    while (labels.childElementCount > written.length) labels.lastElementChild!.remove();
    while (labels.childElementCount < written.length) labels.append(h("span"));
    const flat = (p: Vector3): [number, number] => {
      const seen = p.clone().project(camera);
      return [((seen.x + 1) / 2) * width, ((1 - seen.y) / 2) * height];
    };
    const wishes = written.map(({ name, from, to, letter, who, rest, colour }, k) => {
      const label = labels.children[k] as HTMLElement;
      const text = `${letter}${who ?? ""}${rest}`;
      if (label.textContent !== text) label.replaceChildren(letter, ...(who ? [h("sub", {}, who)] : []), rest);
      label.style.color = colour;
      return { name, width: label.offsetWidth, from: flat(from), to: flat(to) };
    });
    const discs = app.description.bodies.slice(0, MOST_ARROWS).map((body, k): [number, number, number] => {
      const p = v3(app.frame.position(k));
      return [...flat(p), (body.radius * height) / (2 * Math.tan((camera.fov * Math.PI) / 360) * camera.position.distanceTo(p))];
    });
    standing = places(wishes, { width, height, arrows: wishes, discs, boxes: [] }, stood);
    standing.forEach(([x, y], k) => {
      (labels.children[k] as HTMLElement).style.transform = `translate(${x.toFixed(1)}px, ${(y - 11).toFixed(1)}px)`;
    });
  };
  const draw = () => {
    if (pending || ended) return;
    pending = true;
    requestAnimationFrame(() => {
      pending = false;
      if (!ended) paint();
    });
  };

  const watch = new ResizeObserver(() => {
    if (place.clientWidth === 0) return;
    renderer.setPixelRatio(Math.min(2, devicePixelRatio || 1));
    renderer.setSize(place.clientWidth, place.clientHeight);
    camera.aspect = place.clientWidth / place.clientHeight;
    camera.updateProjectionMatrix();
    draw();
  });
  watch.observe(place);
  canvas.addEventListener("keydown", (event) => {
    const step = event.shiftKey ? 0.25 : 0.08;
    const by: Record<string, () => void> = {
      ArrowLeft: () => (turn -= step),
      ArrowRight: () => (turn += step),
      ArrowUp: () => (tilt = Math.min(1.5, tilt + step)),
      ArrowDown: () => (tilt = Math.max(-1.5, tilt - step)),
      "+": () => (zoom *= 1.1),
      "=": () => (zoom *= 1.1),
      "-": () => (zoom /= 1.1),
    };
    if (!by[event.key]) return;
    event.preventDefault();
    event.stopPropagation();
    by[event.key]();
    draw();
  });
  let last: [number, number] | null = null;
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    last = [event.clientX, event.clientY];
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!last) return;
    turn -= (event.clientX - last[0]) * 0.008;
    tilt = Math.max(-1.5, Math.min(1.5, tilt + (event.clientY - last[1]) * 0.008));
    last = [event.clientX, event.clientY];
    draw();
  });
  for (const end of ["pointerup", "pointercancel"] as const) canvas.addEventListener(end, () => (last = null));
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoom *= Math.exp(-event.deltaY * 0.001);
    draw();
  }, { passive: false });
  const buildByImpacts = async () => {
    const description = app.description;
    if (description.corners || description.bodies.length > 500) return;
    const lines = await app.client.lines(1, 60);
    if (!ended && app.description === description && lines.length > 0) build(lines);
  };
  app.on("scene", () => {
    build();
    void buildByImpacts();
  });
  for (const topic of ["frame", "impact", "show", "stage", "predict"] as const) app.on(topic, draw);
  build();
  void buildByImpacts();
  /** At twice the size of the page, with its labels. */
  const png = () => {
    const before = renderer.getPixelRatio();
    renderer.setPixelRatio(2);
    paint();
    const [width, height] = [place.clientWidth, place.clientHeight];
    const all = picture(width, height, (c, ratio) => {
      c.drawImage(canvas, 0, 0, width * ratio, height * ratio);
      c.setTransform(ratio, 0, 0, ratio, 0, 0);
      written.forEach(({ letter, who, rest, colour }, k) => standing[k] && write(c, letter + rest, who, standing[k], colour, inks().paper));
    });
    renderer.setPixelRatio(before);
    paint();
    return all;
  };
  return {
    leave() {
      ended = true;
      watch.disconnect();
      renderer.dispose();
    },
    picture: { png },
  };
}

/** Empties a group; geometry and colours of the graphics card are given back. */
function release(group: Group): void {
  group.traverse((thing) => {
    if (!(thing instanceof Mesh || thing instanceof Line)) return;
    thing.geometry.dispose();
    (thing.material as { dispose(): void }).dispose();
  });
  group.clear();
}

function corner(a: number[], b: number[], bits: number): Vector3 {
  return new Vector3(bits & 1 ? b[0] : a[0], bits & 2 ? b[1] : a[1], bits & 4 ? b[2] : a[2]);
}
