// All scenes, with pictures that move.

import { World } from "tiny-physics";
import { $, h, icon } from "./dom.js";
import { look } from "./looks.js";
import { framing, rows, SHOW } from "./picture.js";
import { Renderer } from "./renderer.js";

const GROUPS = [
  ["show", "To look at"],
  ["benchmark", "To measure"],
];
/** Scenes with more text than this get no moving picture: they are benchmarks of the engine, not of the gallery. */
const HEAVY = 1_500_000;
/** Steps before the picture, and until it begins again. */
const BEFORE = 40;
const TURN = 420;

export function gallery(app, scenes) {
  const dialog = $("#gallery");
  const search = h("input", { type: "search", placeholder: "Search scenes", "aria-label": "Search scenes" });
  const grid = h("div.grid", {});
  dialog.append(
    h("header", {}, h("h1", {}, "Scenes"), search, h("button.tool", { title: "Close", onclick: () => dialog.close() }, icon("x"))),
    grid,
  );
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());

  const cards = scenes.map((entry) => {
    const canvas = h("canvas", { width: 320, height: 200 });
    const card = h(
      "button.card",
      { onclick: () => choose(entry), "data-scene": entry.name },
      h("div.picture", {}, canvas, icon("shapes")),
      h("b", {}, entry.name.replaceAll("_", " ")),
      h("span", {}, entry.description),
    );
    return { entry, canvas, card };
  });
  for (const [tag, title] of GROUPS) {
    const own = cards.filter(({ entry }) => (tag === "show" ? entry.tags.includes("show") : !entry.tags.includes("show")));
    grid.append(h("h2", {}, title), ...own.map(({ card }) => card));
  }
  search.oninput = () => {
    const words = search.value.toLowerCase();
    for (const { entry, card } of cards) card.hidden = !`${entry.name} ${entry.description}`.toLowerCase().includes(words);
  };

  function choose(entry) {
    dialog.close();
    app.dispatchEvent(new CustomEvent("scene", { detail: entry }));
  }

  // One drawing surface for all pictures; one card a picture of the page.
  let renderer;
  const seen = new Set();
  const watcher = new IntersectionObserver(
    (changes) => {
      for (const { target, isIntersecting } of changes) {
        const card = cards.find((card) => card.card === target);
        if (isIntersecting) seen.add(card);
        else seen.delete(card);
      }
    },
    { root: dialog },
  );

  function begin(card) {
    card.world?.free();
    card.world = undefined;
    card.steps = 0;
    if (card.heavy || card.entry.tags.includes("scale")) return;
    card.text ??= card.entry.file();
    if (card.text.length > HEAVY) {
      card.heavy = true;
      card.text = undefined;
    }
    if (!card.text) return;
    card.world = World.loadScene(card.text);
    card.small = card.world.counts().bodies < 400;
    const [left, bottom, right, top] = framing(card.world, JSON.parse(card.text).view);
    card.camera = {
      x: (left + right) / 2,
      y: (bottom + top) / 2,
      scale: 0.94 * Math.min(320 / Math.max(right - left, 1), 200 / Math.max(top - bottom, 1)),
    };
    for (let i = 0; i < (card.small ? BEFORE : 2); i++) card.world.step();
  }

  function paint(card) {
    const { world, camera, canvas } = card;
    const found = rows(world, camera, 1, SHOW.joints | (app.dark ? 0 : SHOW.light));
    renderer.draw(found, camera, { ...look(app.dark), tint: 0, ratio: 1 });
    canvas.getContext("2d").drawImage(renderer.canvas, 0, 0);
  }

  let turn = 0;
  function tick() {
    if (!dialog.open) return;
    requestAnimationFrame(tick);
    const start = performance.now();
    const waiting = [...seen].filter((card) => !card.card.hidden);
    // Those without a picture first, then all of them in turn.
    const fresh = waiting.find((card) => !card.world && !card.failed && !card.painted);
    if (fresh) {
      try {
        begin(fresh);
        if (fresh.world) paint(fresh);
      } catch {
        fresh.failed = true;
      }
      fresh.painted = true;
      fresh.card.classList.toggle("plain", !fresh.world);
      return;
    }
    const moving = waiting.filter((card) => card.world && (card.small || card.card.matches(":hover")));
    for (let i = 0; i < moving.length && performance.now() - start < 9; i++) {
      const card = moving[turn++ % moving.length];
      card.world.step();
      if (++card.steps > TURN) begin(card);
      paint(card);
    }
  }

  function open() {
    if (!renderer) {
      const canvas = h("canvas", { width: 320, height: 200 });
      renderer = new Renderer(canvas);
    }
    dialog.showModal();
    for (const { card } of cards) watcher.observe(card);
    tick();
  }

  dialog.addEventListener("close", () => {
    watcher.disconnect();
    seen.clear();
    for (const card of cards) {
      card.world?.free();
      card.world = undefined;
      card.painted = false;
    }
  });

  return { open, choose };
}
