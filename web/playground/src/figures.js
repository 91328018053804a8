// Numbers of every step of the run, for plots and for the marks on the timeline.

/** Worlds with more bodies are looked at every few steps only. */
const MANY = 3000;

export const KINDS = {
  overlap: { label: "deep overlap", colour: "#ff5a4f" },
  break: { label: "joint broke", colour: "#ff9f43" },
  wake: { label: "woke up", colour: "#4fd1c5" },
  sleep: { label: "fell asleep", colour: "#7f8ea3" },
  error: { label: "doctor", colour: "#ff3b6b" },
  warning: { label: "doctor", colour: "#ffc861" },
};

export class Figures {
  constructor(world) {
    this.steps = [];
    this.rows = { kinetic: [], potential: [], momentum: [], deepest: [], contacts: [], awake: [], time: [] };
    this.marks = [];
    this.last = 0;
    const settings = world.settings;
    this.deep = 0.02 * settings.length_unit;
    this.was = { deep: false };
  }

  /** Takes a step in, once. */
  note(world, step, milliseconds) {
    if (step <= this.last) return;
    this.last = step;
    this.#events(world, step);
    const every = this.many ? 4 : 1;
    if (step % every) return;
    const counts = world.counts();
    this.many = counts.bodies > MANY;
    const deep = counts.deepest > this.deep;
    if (deep && !this.was.deep) this.#mark(step, "overlap");
    this.was.deep = deep;
    this.steps.push(step);
    const { rows } = this;
    rows.kinetic.push(counts.kinetic);
    rows.potential.push(counts.potential);
    rows.momentum.push(Math.hypot(counts.momentum.x, counts.momentum.y));
    rows.deepest.push(1000 * counts.deepest);
    rows.contacts.push(counts.contacts);
    rows.awake.push(counts.awake);
    rows.time.push(milliseconds);
  }

  #events(world, step) {
    if (world.events("jointBreaks").length) this.#mark(step, "break");
    if (world.events("woke").length) this.#mark(step, "wake");
    if (world.events("fellAsleep").length) this.#mark(step, "sleep");
  }

  #mark(step, kind) {
    const last = this.marks.findLast((mark) => mark.kind === kind);
    // What goes on and on is one mark.
    if (last && step - last.last < 20) last.last = step;
    else this.marks.push({ step, kind, last: step });
  }

  /** Marks what the doctor has found where it was first seen. */
  found(findings) {
    for (const { severity, code, first_step } of findings) {
      if (severity === "note") continue;
      const label = `doctor: ${code.replaceAll("_", " ")}`;
      if (!this.marks.some((mark) => mark.kind === severity && mark.label === label && mark.step === first_step)) {
        this.marks.push({ step: first_step, kind: severity, last: first_step, label });
        this.marks.sort((a, b) => a.step - b.step);
      }
    }
  }

  /** Forgets what came after a step. */
  cut(step) {
    this.last = Math.min(this.last, step);
    const count = this.steps.findIndex((at) => at > step);
    if (count >= 0) {
      this.steps.length = count;
      for (const row of Object.values(this.rows)) row.length = count;
    }
    this.marks = this.marks.filter((mark) => mark.step <= step);
  }
}
