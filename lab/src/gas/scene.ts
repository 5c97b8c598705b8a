// The gas as a scene file.

/** The scene of a gas, in the words of the scene file. */
export function gasScene(count: number, share: number, seed = 1): string {
  const side = Math.ceil(Math.sqrt(count));
  const pitch = 1 / side;
  const radius = Math.min(0.48 * pitch, Math.sqrt(share / (Math.PI * count)));
  return JSON.stringify({
    carom: 1,
    title: "A gas of hard discs",
    world: { dim: 2, boundary: { kind: "box", min: [0, 0], max: [1, 1] } },
    group: [{ name: "gas", kind: "square", count, spacing: pitch - 2 * radius, origin: [pitch / 2, pitch / 2], body: { mass: 1, radius }, velocity: { distribution: "maxwell", temperature: 1 } }],
    run: { until: { time: 1000 }, seed },
  });
}
