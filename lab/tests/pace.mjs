// What the page may take of the processor, on the machine that it runs on.

/** STRICT=1 holds the page to the speeds that the Lab promises, by the clock as well: on a machine that does nothing else. */
export const strict = process.env.STRICT === "1";

/** Processor time of a fixed piece of work (ms): additions and roots, and a table that is walked through. */
function effort() {
  const table = new Float64Array(1 << 16);
  const from = process.cpuUsage();
  let sum = 0;
  for (let round = 0; round < 60; round++) for (let k = 0; k < table.length; k++) sum += table[(k * 7919) & 0xffff] = Math.sqrt(sum + k + round);
  const used = process.cpuUsage(from);
  return sum > 0 ? (used.user + used.system) / 1000 : NaN;
}

/** The same piece on the machine that the speeds were measured on (ms). */
const REFERENCE = 37;
/** How much slower this machine is; and another four times, for caches and cores that it shares with others. */
const slower = strict ? 1 : 4 * Math.max(1, Math.min(effort(), effort(), effort()) / REFERENCE);
/** Thirty frames a second: what a frame may take (ms). */
export const FRAME = (slower * 1000) / 30;
/** Nobody notices a task that is shorter (ms). */
export const LONG = slower * 100;
export const byTheClock = (seen) => {
  if (strict && !(seen >= 30)) throw new Error(`${seen} frames a second`);
};
