// What the doctor finds in the run, as it comes: findings with the step they speak of, and their leaf in the panel.

import { exports } from "tiny-physics";
import { h, icon, short } from "./dom.js";

const ICONS = { error: "octagon-alert", warning: "triangle-alert", note: "info" };

/** Findings of a run. Going back forgets none, unless the run goes on from there in another way. */
export class Health {
  #before = [];
  #world;
  #offset;
  #last = 0;
  findings = [];

  constructor(world) {
    this.#world = world;
    // The doctor counts the world's steps, the timeline those of the history.
    this.#offset = world.history.at - world.counts().steps;
    this.#last = world.history.at;
  }

  /** Sees a step, once. */
  watch(step) {
    if (step <= this.#last) return;
    this.#last = step;
    exports().tp_watch(this.#world.session, false);
  }

  /** What was found so far, worst first. */
  read() {
    const wasm = exports();
    wasm.tp_findings(this.#world.session);
    const bytes = new Uint8Array(wasm.memory.buffer, wasm.tp_text(), wasm.tp_text_length());
    const rows = JSON.parse(new TextDecoder().decode(bytes));
    for (const row of rows) {
      row.first_step += this.#offset;
      row.last_step += this.#offset;
    }
    const known = new Set(rows.map(name));
    this.findings = [...this.#before.filter((row) => !known.has(name(row))), ...rows];
    const order = Object.keys(ICONS);
    this.findings.sort((a, b) => order.indexOf(a.severity) - order.indexOf(b.severity));
    return this.findings;
  }

  /** Forgets what was first seen after a step, if the run has come further. */
  cut(step) {
    if (step >= this.#last) return;
    this.#before = this.read().filter((row) => row.first_step <= step);
    this.#last = step;
    exports().tp_watch(this.#world.session, true);
  }
}

const name = ({ code, bodies }) => `${code} ${bodies.join()}`;

/** The leaf of all findings, and the line of the latest. */
export function clinic(app, root, line) {
  let shown;

  function jump(step) {
    app.setPlaying(false);
    app.goTo(step);
  }

  function row(finding) {
    const { severity, code, what, advice, first_step, last_step, count, others, figures, bodies } = finding;
    const measured = figures.map((figure) => `${figure.name} ${short(figure.value)}${figure.unit} (bound ${short(figure.threshold)}${figure.unit})`);
    const step = (at) => h("button.link", { onclick: () => jump(at), title: "Go to this step" }, `step ${at}`);
    const seen = count > 1 ? [" to ", step(last_step), `, ${count} times`] : [];
    return h(
      `article.finding.${severity}`,
      {},
      h("h3", {}, icon(ICONS[severity]), code.replaceAll("_", " "), others > 0 ? h("small", {}, `and ${others} more like it`) : undefined),
      h("p", {}, what),
      h("p.hint", {}, step(first_step), ...seen, measured.length ? ` · ${measured.join(", ")}` : ""),
      h("p.advice", {}, icon("arrow-right"), h("span", {}, advice)),
      bodies.length
        ? h("p.hint", {}, ...bodies.slice(0, 4).flatMap((id) => [h("button.link", { onclick: () => app.select({ kind: "body", id }) }, `body ${id % 2 ** 24}`), " "]))
        : undefined,
    );
  }

  function refresh(leafShown) {
    const findings = app.health.read();
    app.figures.found(findings);
    const state = JSON.stringify(findings.map(({ code, bodies, count, others }) => [code, bodies, count, others]));
    const latest = findings.filter(({ severity }) => severity !== "note").at(0);
    line.hidden = !latest;
    if (latest) {
      line.className = latest.severity;
      line.replaceChildren(icon(ICONS[latest.severity]), h("span", {}, latest.what));
    }
    if (!leafShown || state === shown) return;
    shown = state;
    root.replaceChildren(
      h("h2", {}, "Doctor"),
      findings.length
        ? h("p.hint", {}, "What looks wrong in this run, worst first, and what to change.")
        : h("p.hint", {}, "Nothing has been found in the steps so far."),
      ...findings.map(row),
    );
  }

  return {
    refresh,
    build() {
      shown = undefined;
      refresh(true);
    },
  };
}
