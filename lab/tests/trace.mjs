// What the page costs, in processor time: that of a thread alone, whatever else the machine does meanwhile.

/** Runs `work` on the page and says, of the page's own thread and of the busiest worker: the longest task and all together (ms). */
export async function traced(browser, page, work) {
  await browser.startTracing(page, { categories: ["disabled-by-default-devtools.timeline"] });
  let result;
  let events;
  try {
    result = await work();
  } finally {
    events = JSON.parse((await browser.stopTracing()).toString()).traceEvents;
  }
  const threads = new Map();
  for (const e of events) if (e.name === "thread_name") threads.set(`${e.pid}:${e.tid}`, { name: e.args.name, longest: 0, total: 0 });
  for (const e of events) {
    const thread = e.name === "RunTask" && threads.get(`${e.pid}:${e.tid}`);
    if (!thread || e.tdur === undefined) continue;
    thread.longest = Math.max(thread.longest, e.tdur / 1000);
    thread.total += e.tdur / 1000;
  }
  const busiest = (name) => [...threads.values()].filter((t) => t.name.startsWith(name)).sort((a, b) => b.total - a.total)[0] ?? { longest: 0, total: 0 };
  return { result, page: busiest("CrRendererMain"), worker: busiest("DedicatedWorker") };
}
