// The stage of a scene in space: spheres and arrows in three.js, loaded only here. The view turns by drag or by keys.
import { AmbientLight, BufferGeometry, Color, ConeGeometry, CylinderGeometry, DirectionalLight, DoubleSide, GridHelper, Group, InstancedMesh, Line, LineBasicMaterial, LineDashedMaterial, Matrix4, Mesh, MeshBasicMaterial, MeshLambertMaterial, PerspectiveCamera, PlaneGeometry, Scene, SphereGeometry, Vector3, WebGLRenderer, type Object3D } from "three";
import type { App } from "../app.ts";
import { h } from "../dom.ts";
import { usesFriction } from "../panels/bodies.ts";
import { inks } from "../stage/stage.ts";
import { MOST_ARROWS } from "../stage/layout.ts";
import { impulseLetter } from "../settings.ts";
import { fmt, t } from "../words/index.ts";
import { markedSphere, Turned } from "./marked.ts";

/** Puts the view into its place; returns what ends it. */
export function space(app: App, place: HTMLElement): () => void {
  const canvas = h("canvas", { class: "space-canvas", tabIndex: 0, role: "img", aria: { label: t("space.label") } });
  // What is written beside arrows; the tables say the same to those who listen.
  const labels = h("div", { class: "space-labels", aria: { hidden: true } });
  place.replaceChildren(canvas, labels);
  let written: { at: Vector3; text: string; colour: string }[] = [];
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
  let [turn, tilt, zoom] = [-0.9, 0.42, 1];
  let centre = new Vector3();
  let size = 1;
  let pending = false;
  let ended = false;

  const build = (met: number[][] = []) => {
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
    for (const point of met) {
      const p = new Vector3(...(point as [number, number, number]));
      low.min(p.clone().subScalar(1.5 * mean));
      high.max(p.clone().addScalar(1.5 * mean));
    }
    if (d.corners) {
      low.set(...(d.corners[0] as [number, number, number]));
      high.set(...(d.corners[1] as [number, number, number]));
    }
    centre = low.clone().add(high).multiplyScalar(0.5);
    size = Math.max(high.distanceTo(low), 1e-6);
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
      grid.position.set(centre.x, centre.y, low.z - 0.02 * size);
      things.add(grid);
    }
    for (const wall of d.walls) {
      if (wall.label.startsWith("boundary")) continue;
      const material = new MeshBasicMaterial({ color: ink.wall, transparent: true, opacity: 0.25, side: DoubleSide });
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

  const v3 = (v: number[]) => new Vector3(v[0], v[1], v[2]);
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
    const write = (from: Vector3, w: Vector3, text: string, colour: string) => few && w.length() > 1e-9 && written.push({ at: from.clone().add(w).addScaledVector(w.clone().normalize(), 0.02 * size), text, colour });
    description.bodies.forEach((body, k) => {
      const side = at ? at.bodies.indexOf(body.name) : -1;
      let v = frame.velocity(k);
      if (at && side >= 0 && app.stage === "before") v = at.before[side].velocity;
      if (app.predicting && side >= 0) v = at!.before[side].velocity;
      const p = v3(frame.position(k));
      if (show.v) {
        const w = v3(v).multiplyScalar((0.28 * size) / (fastest || 1));
        put(arrow(p, w, ink.colour("v"), 1.2));
        write(p, w, `${at && side >= 0 && app.stage !== "before" && !app.predicting ? "v′" : "v"} = ${fmt(Math.hypot(...v))} m/s`, ink.colour("v"));
      }
      if (show.p && body.mass !== null) put(arrow(p, v3(v).multiplyScalar((0.28 * size * body.mass) / (hardest || 1)), ink.colour("p"), 2));
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
        const k = (0.25 * size) / (J.length() || 1);
        put(arrow(point, J.clone().multiplyScalar(k), ink.colour("J"), 2));
        put(arrow(point, J.clone().multiplyScalar(-k), ink.colour("J"), 2));
        write(point, J.clone().multiplyScalar(k), `${impulseLetter(app.settings)} = ${fmt(J.length())} N s`, ink.colour("J"));
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
    // On a narrow stage further off, so that arrows at the sides are seen.
    const reach = ((1.55 * size) / zoom) * Math.max(1, 1.35 / camera.aspect);
    camera.up.set(0, 0, 1);
    camera.position.set(centre.x + reach * Math.cos(tilt) * Math.cos(turn), centre.y + reach * Math.cos(tilt) * Math.sin(turn), centre.z + reach * Math.sin(tilt));
    camera.lookAt(centre);
    renderer.render(scene, camera);
    letter();
    canvas.dataset.view = `${turn.toFixed(3)} ${tilt.toFixed(3)} ${zoom.toFixed(3)}`;
  };
  /** The labels where the camera sees the tips of their arrows, one below the other where they would meet. */
  const letter = () => {
    const [wide, high] = [place.clientWidth, place.clientHeight];
    while (labels.childElementCount > written.length) labels.lastElementChild!.remove();
    while (labels.childElementCount < written.length) labels.append(h("span"));
    const taken: { x: number; y: number; width: number }[] = [];
    written.forEach(({ at, text, colour }, k) => {
      const label = labels.children[k] as HTMLElement;
      if (label.textContent !== text) label.textContent = text;
      const seen = at.clone().project(camera);
      const width = 8 * text.length;
      const x = Math.min(Math.max(((seen.x + 1) / 2) * wide + 6, 4), wide - width - 4);
      let y = Math.min(Math.max(((1 - seen.y) / 2) * high - 10, 4), high - 24);
      while (taken.some((other) => Math.abs(other.y - y) < 18 && x < other.x + other.width && other.x < x + width) && y < high - 24) y += 6;
      taken.push({ x, y, width });
      label.style.color = colour;
      label.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
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
    if (!ended && app.description === description && lines.length > 0) build(lines.map((line) => line.point));
  };
  app.on("scene", () => {
    build();
    void buildByImpacts();
  });
  for (const topic of ["frame", "impact", "show", "stage", "predict"] as const) app.on(topic, draw);
  build();
  void buildByImpacts();
  return () => {
    ended = true;
    watch.disconnect();
    renderer.dispose();
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
