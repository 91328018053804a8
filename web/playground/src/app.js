// The run on the screen: the world with its history, the camera, and what is selected. Knows no buttons.

import { FixedStep, World } from "tiny-physics";
import { Figures } from "./figures.js";
import { Health } from "./health.js";
import { framing, rows, SHOW } from "./picture.js";
import { look } from "./looks.js";

export const SPEEDS = [0.1, 0.25, 0.5, 1, 2];
const MEMORY = 256 * 2 ** 20;
/** Milliseconds of a picture that steps may take. */
const PATIENCE = 24;

export class App extends EventTarget {
  camera = { x: 0, y: 3, scale: 60 };
  playing = true;
  speed = 1;
  tool = "grab";
  shown = new Set(["joints"]);
  selected = undefined;
  source = "";
  name = "";
  steps = 600;

  constructor(renderer) {
    super();
    this.renderer = renderer;
    this.overlay = [];
  }

  say(what, detail) {
    this.dispatchEvent(new CustomEvent(what, { detail }));
  }

  get at() {
    return this.world.history.at;
  }

  get length() {
    return this.world.history.length;
  }

  // What is played.

  /** Starts a scene; throws where it is refused, and then nothing has changed. */
  open(source, { name, keepCamera = false, keepPlaying = false } = {}) {
    const world = World.loadScene(source);
    world.keepHistory(MEMORY);
    let scene = {};
    try {
      scene = JSON.parse(source);
    } catch {}
    this.scene = scene;
    this.source = source;
    this.#take(world, name ?? (scene.name || "untitled"), scene.steps ?? 600, keepCamera);
    if (!keepPlaying) this.setPlaying(true);
    this.say("open");
  }

  /** Opens a recording of the program, at its beginning. */
  openRecording(bytes, name) {
    const world = World.openRecording(bytes, MEMORY);
    this.scene = undefined;
    this.source = "";
    this.#take(world, name, world.history.length, false);
    this.setPlaying(true);
    this.say("open");
  }

  #take(world, name, steps, keepCamera) {
    this.world?.free();
    Object.assign(this, { world, name, steps, selected: undefined });
    this.clock = new FixedStep(world.dt, 8);
    this.figures = new Figures(world);
    this.health = new Health(world);
    if (!keepCamera) this.fit();
    this.say("select");
    this.say("time");
  }

  restart() {
    if (this.source) this.open(this.source, { name: this.name, keepCamera: true });
    else this.goTo(0);
  }

  // Time.

  setPlaying(playing) {
    this.playing = playing;
    this.say("playing");
  }

  /** One step on: what was recorded, or a new one at the end. */
  advance() {
    const { at, length } = this.world.history;
    const start = performance.now();
    if (at < length) this.world.goTo(at + 1);
    else this.world.step();
    this.figures.note(this.world, at + 1, performance.now() - start);
    this.health.watch(at + 1);
  }

  step(count) {
    this.setPlaying(false);
    if (count < 0) this.goTo(this.at + count);
    else for (let i = 0; i < count; i++) this.advance();
    this.say("time");
  }

  goTo(step) {
    try {
      this.world.goTo(Math.max(0, Math.min(step, this.length)));
    } catch (error) {
      this.say("error", error.message);
    }
    this.say("time");
  }

  /** Does something to the world; what came after the current step is forgotten then. */
  act(work) {
    try {
      const made = work(this.world);
      this.figures.cut(this.at);
      this.health.cut(this.at);
      this.say("time");
      return made;
    } catch (error) {
      this.say("error", error.message);
    }
  }

  /** A picture later. */
  tick(elapsed) {
    if (this.playing && this.world) {
      const due = this.clock.advance(elapsed * this.speed);
      const start = performance.now();
      for (let i = 0; i < due; i++) {
        try {
          this.advance();
        } catch (error) {
          this.setPlaying(false);
          this.say("error", error.message);
        }
        // A scene that is too much for this machine plays slowly instead of standing still.
        if (performance.now() - start > PATIENCE) break;
      }
      if (due) this.say("time");
    }
    this.draw();
  }

  // Space.

  fit() {
    const [left, bottom, right, top] = framing(this.world, this.scene?.view);
    const { clientWidth, clientHeight } = this.renderer.canvas;
    const room = this.room ?? { left: 0, right: 0, top: 0, bottom: 0 };
    const [width, height] = [clientWidth - room.left - room.right, clientHeight - room.top - room.bottom];
    const scale = 0.92 * Math.min(width / Math.max(right - left, 1), height / Math.max(top - bottom, 1));
    this.camera.scale = Math.max(2, Math.min(scale, 420));
    this.camera.x = (left + right) / 2 + (room.right - room.left) / 2 / this.camera.scale;
    this.camera.y = (bottom + top) / 2 + (room.top - room.bottom) / 2 / this.camera.scale;
    this.fitted = { ...this.camera };
  }

  /** The part of the page in which the world is seen. What was seen whole is seen whole, or the middle stays the middle. */
  setRoom(now) {
    const before = this.room;
    this.room = now;
    if (!before || !this.world) return;
    const { camera, fitted } = this;
    if (["x", "y", "scale"].every((name) => camera[name] === fitted?.[name])) return this.fit();
    camera.x += (now.right - now.left - before.right + before.left) / 2 / camera.scale;
    camera.y += (now.top - now.bottom - before.top + before.bottom) / 2 / camera.scale;
  }

  zoom(factor, px, py) {
    const before = this.toWorld(px, py);
    this.camera.scale = Math.max(0.5, Math.min(this.camera.scale * factor, 4000));
    const after = this.toWorld(px, py);
    this.camera.x += before.x - after.x;
    this.camera.y += before.y - after.y;
  }

  toWorld(px, py) {
    const { clientWidth, clientHeight } = this.renderer.canvas;
    const { x, y, scale } = this.camera;
    return { x: x + (px - clientWidth / 2) / scale, y: y - (py - clientHeight / 2) / scale };
  }

  toPage(x, y) {
    const { clientWidth, clientHeight } = this.renderer.canvas;
    const { camera } = this;
    return { x: clientWidth / 2 + (x - camera.x) * camera.scale, y: clientHeight / 2 - (y - camera.y) * camera.scale };
  }

  // Looks.

  get dark() {
    return document.documentElement.dataset.theme === "dark";
  }

  get mask() {
    return [...this.shown].reduce((mask, name) => mask | SHOW[name], this.dark ? 0 : SHOW.light);
  }

  toggle(name) {
    if (!this.shown.delete(name)) this.shown.add(name);
    if (name === "depth" && this.shown.has("depth")) this.shown.delete("islands");
    if (name === "islands" && this.shown.has("islands")) this.shown.delete("depth");
    this.say("shown");
  }

  select(selected) {
    this.selected = selected;
    this.say("select");
  }

  draw() {
    if (!this.world) return;
    this.renderer.fit();
    const { camera, dark, mask } = this;
    const alpha = this.playing && this.at === this.length ? Math.min(1, this.clock.alpha) : 1;
    const found = rows(this.world, camera, alpha, mask);
    // Lines of the tools come after those of the module.
    if (this.overlay.length) {
      const own = this.overlay.flatMap(({ a, b, width, colour }) => [
        a.x - camera.x,
        a.y - camera.y,
        b.x - camera.x,
        b.y - camera.y,
        width * (this.renderer.ratio ?? 1),
        ...colour,
      ]);
      const lines = new Float32Array(found.lines.length + own.length);
      lines.set(found.lines);
      lines.set(own, found.lines.length);
      found.lines = lines;
    }
    const chosen = this.selected?.kind === "body" ? this.selected.id % 2 ** 24 : -1;
    const tint = this.shown.has("depth") ? 1 : this.shown.has("islands") ? 2 : 0;
    this.renderer.draw(found, camera, { ...look(dark), selected: chosen, tint });
  }
}
