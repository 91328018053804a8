// Play, step, speed, and the timeline.

import { SPEEDS } from "./app.js";
import { $, button, h, icon, menu } from "./dom.js";
import { KINDS } from "./figures.js";

export function transport(app) {
  const play = button("pause", "Play or pause (Space)", () => app.setPlaying(!app.playing), { id: "play" });
  const speed = h("button.speed", { title: "Speed", id: "speed" }, "1×");
  speed.entries = () => SPEEDS.map((value) => ["gauge", `${value}×`, () => setSpeed(value), app.speed === value]);
  speed.onclick = () => menu(speed, speed.entries());
  const range = h("input", { type: "range", min: 0, max: 1, value: 0, id: "time", "aria-label": "Timeline" });
  const marks = h("div.marks");
  const label = h("output.clock", { id: "clock" });
  const events = button("flag", "Jump to an event", () => menu(events, events.entries()), { id: "events" });
  events.entries = () => {
    const list = app.figures.marks.slice(-40);
    if (!list.length) return [["info", "Nothing has happened yet", () => {}]];
    return list.map((mark) => [
      "flag",
      `${mark.label ?? KINDS[mark.kind].label} · step ${mark.step}`,
      () => {
        app.setPlaying(false);
        app.goTo(mark.step);
      },
    ]);
  };

  function setSpeed(value) {
    app.speed = value;
    speed.textContent = `${value}×`;
  }

  $("#transport").append(
    h(
      "div.row.keys",
      {},
      button("rotate-ccw", "Restart (R)", () => app.restart(), { id: "restart" }),
      button("step-back", "One step back (←)", () => app.step(-1), { id: "back" }),
      play,
      button("step-forward", "One step (→)", () => app.step(1), { id: "forward" }),
      speed,
    ),
    h("div.timeline", {}, marks, range),
    h("div.row.ends", {}, label, events, button("skip-forward", "To the end (End)", () => app.goTo(app.length), { id: "end" })),
  );

  // Going back is work: one seek a picture is enough.
  let wanted;
  range.oninput = () => {
    app.setPlaying(false);
    if (wanted === undefined) {
      requestAnimationFrame(() => {
        const step = wanted;
        wanted = undefined;
        app.goTo(step);
      });
    }
    wanted = Number(range.value);
  };

  let marked = -1;
  function show() {
    const { at, length } = app.world.history;
    const most = Math.max(length, app.steps, 1);
    range.max = most;
    if (wanted === undefined) range.value = at;
    range.style.setProperty("--done", `${(100 * at) / most}%`);
    range.style.setProperty("--kept", `${(100 * length) / most}%`);
    label.textContent = `${(at * app.world.dt).toFixed(2)} s`;
    label.title = `step ${at} of ${length}`;
    document.body.classList.toggle("past", at < length);
    const state = app.figures.marks.length * 100_000 + most;
    if (state !== marked) {
      marked = state;
      marks.replaceChildren(
        ...app.figures.marks.slice(-200).map((mark) =>
          h("i", { style: `left:${(100 * mark.step) / most}%;background:${KINDS[mark.kind].colour}`, title: mark.label ?? KINDS[mark.kind].label }),
        ),
      );
    }
  }

  app.addEventListener("time", show);
  app.addEventListener("playing", () => {
    play.replaceChildren(icon(app.playing ? "pause" : "play"));
  });
  return { setSpeed, faster: (by) => setSpeed(SPEEDS[Math.max(0, Math.min(SPEEDS.length - 1, SPEEDS.indexOf(app.speed) + by))]) };
}
