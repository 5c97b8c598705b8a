// Keys. Letters act only while the stage or the transport has the focus, and can be switched off (WCAG 2.1.4).
import { type App, type Show, SPEEDS } from "./app.ts";
import { cycleView } from "./panels/equations.ts";

/** Listens until the page is built anew: the function that is given back ends it. */
export function keys(app: App, stage: HTMLElement, help: () => void): () => void {
  const letters: Record<string, keyof Show> = { v: "v", p: "p", j: "J", c: "cm" };
  const listening = new AbortController();
  const hear = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented || !app.frame) return;
    const target = event.target as HTMLElement;
    const typing = target.matches("input:not([type=checkbox]):not([type=radio]), select, textarea, [contenteditable]");
    if (typing || target.closest("dialog, .menu-list")) return;
    const onStage = stage.contains(target) || target === document.body || target.closest(".transport") !== null;
    const button = target.matches("button, summary, a, input");
    switch (event.key) {
      case " ":
        if (button && !stage.contains(target)) return;
        event.preventDefault();
        if (app.playing) app.pause();
        else app.play();
        return;
      case "ArrowRight":
      case "ArrowLeft":
        if (!onStage) return;
        event.preventDefault();
        void app.stepBy(event.key === "ArrowRight" ? 1 : -1);
        return;
      case "Home":
      case "End":
        if (!onStage) return;
        event.preventDefault();
        void (event.key === "Home" ? app.toStart() : app.seek(app.end));
        return;
      case "Backspace":
        if (!onStage) return;
        event.preventDefault();
        void app.toStart();
        return;
      case "=":
      case "+":
      case "-":
        if (!onStage) return;
        app.speed = Math.min(SPEEDS.length - 1, Math.max(0, app.speed + (event.key === "-" ? -1 : 1)));
        app.tell("play");
        return;
      case "?":
        help();
        return;
    }
    if (!onStage || !app.settings.keys) return;
    const key = event.key.toLowerCase();
    if (key === "n") {
      event.preventDefault();
      void (event.shiftKey ? app.previous() : app.next());
    } else if (letters[key]) {
      const which = letters[key];
      app.show[which] = !app.show[which];
      app.tell("show");
    } else if (key === "e") {
      cycleView();
    } else if (key === "1" || key === "2" || key === "3") {
      app.setStage((["before", "at", "after"] as const)[Number(key) - 1]);
    }
  };
  document.addEventListener("keydown", hear, { signal: listening.signal });
  return () => listening.abort();
}
