// tiny-physics for JavaScript: one WebAssembly module behind plain classes. What everything means is in index.d.ts.

/** What the engine refused, in its words. */
export class PhysicsError extends Error {
  name = "PhysicsError";
}

let wasm;
let loading;
const decoder = new TextDecoder();
const encoder = new TextEncoder();

/** Loads the module, once. */
export function init(source) {
  loading ??= load(source).catch((error) => {
    loading = undefined;
    throw error;
  });
  return loading;
}

/** Loads the module at once, of bytes or a compiled module. */
export function initSync(source) {
  const module = source instanceof WebAssembly.Module ? source : new WebAssembly.Module(source);
  wasm ??= new WebAssembly.Instance(module, {}).exports;
  loading ??= Promise.resolve();
}

async function load(source) {
  const found = await (source ?? moduleBeside());
  if (found instanceof WebAssembly.Module || found instanceof ArrayBuffer || ArrayBuffer.isView(found)) {
    const made = await WebAssembly.instantiate(found, {});
    wasm ??= (made.instance ?? made).exports;
    return;
  }
  const response = found instanceof Response ? found : await fetch(found);
  if (!response.ok) throw new PhysicsError(`${response.url}: ${response.status} ${response.statusText}`);
  // Servers that do not know the type of wasm files are common.
  const streams = response.headers.get("content-type")?.startsWith("application/wasm");
  const made = streams
    ? await WebAssembly.instantiateStreaming(response, {})
    : await WebAssembly.instantiate(await response.arrayBuffer(), {});
  wasm ??= made.instance.exports;
}

/** The file beside this one: read in Node, fetched elsewhere. */
async function moduleBeside() {
  const url = new URL("./tiny_physics.wasm", import.meta.url);
  if (url.protocol !== "file:" || typeof process === "undefined") return url;
  const fs = "node:fs/promises";
  return (await import(/* @vite-ignore */ fs)).readFile(url);
}

function engine() {
  if (!wasm) throw new PhysicsError("call `await init()` before anything else");
  return wasm;
}

// Arguments and answers. Memory may have grown in any call, so its views are made anew each time.

function give(bytes) {
  const at = engine().tp_input(bytes.length);
  new Uint8Array(wasm.memory.buffer, at, bytes.length).set(bytes);
}

const giveText = (text) => give(encoder.encode(text));
const giveData = (data) => giveText(write(data));

// Whole 64 bits do not go through JSON as numbers: they are marked, and BigInts here.
const write = (data) => (JSON.stringify(data, writable) ?? "").replace(/"\\u0001(-?\d+)\\u0001"/g, "$1");
const read = (text) => JSON.parse(text.replace(/"(category|mask)":(\d{16,})/g, '"$1":"\\u0001$2"'), readable);
const readable = (_, value) => (typeof value === "string" && value[0] === "\u0001" ? BigInt(value.slice(1)) : value);

/** JSON has no numbers that are not finite, and would write nothing instead. */
function writable(name, value) {
  if (typeof value === "bigint") return `\u0001${value}\u0001`;
  if (typeof value === "number" && !Number.isFinite(value)) throw new PhysicsError(`${name} is ${value}; it has to be finite`);
  return value;
}

/** What is said in a description. */
const said = (data) => Object.fromEntries(Object.entries(data).filter(([, value]) => value !== undefined));

/** A filter as the module takes it. */
function sees({ category, mask, group, sensors, excludeBody, ...other } = {}) {
  const [unknown] = Object.keys(other);
  if (unknown) throw new PhysicsError(`a filter has no ${unknown}`);
  const kinds = said({ category, mask, group });
  const seen = { sensors: !!sensors };
  if (Object.keys(kinds).length) seen.filter = { category: ALL, mask: ALL, ...kinds };
  if (excludeBody !== undefined) seen.exclude_body = parts(excludeBody);
  return seen;
}

/** A question without anything unusual in it is nothing at all. */
function giveQuestion(filter, shape, angle = 0) {
  const question = {};
  if (filter) question.filter = sees(filter);
  if (shape) Object.assign(question, { shape, angle });
  const text = write(question);
  giveText(text === "{}" ? "" : text);
}

const ALL = 2n ** 64n - 1n;
/** The least number of 32 bits that keeps all its digits. */
const LEAST = 2 ** -126;

const text = () => decoder.decode(rawText());
const rawText = () => new Uint8Array(wasm.memory.buffer, wasm.tp_text(), wasm.tp_text_length());
const numbers = () => new Float64Array(wasm.memory.buffer, wasm.tp_numbers(), wasm.tp_numbers_length());
const list = () => Array.from(numbers());

function check(done) {
  if (!done) throw new PhysicsError(text());
}

const point = (x, y) => ({ x, y });

/** The parts of a handle, and the handle of them. */
const parts = (id) => ({ index: id % 2 ** 24, generation: Math.floor(id / 2 ** 24) });
const whole = ({ index, generation }) => generation * 2 ** 24 + index;

/** What a method takes: so many numbers. */
function takes(name, count, given) {
  const numbers = given.slice(0, count);
  if (numbers.length === count && numbers.every(Number.isFinite)) return;
  const wrong = numbers.find((value) => typeof value === "number" && !Number.isFinite(value));
  const words = `${name} takes ${count} number${count === 1 ? "" : "s"}`;
  throw new PhysicsError(wrong === undefined ? words : `${words}, all of them finite: ${wrong} is not`);
}

const forgotten = new FinalizationRegistry((session) => wasm.tp_free(session));
const own = Symbol("made here");
const KINDS = ["static", "kinematic", "dynamic"];
const EVENTS = {
  contactBegin: 0,
  contactEnd: 1,
  hits: 2,
  sensorBegin: 3,
  sensorEnd: 4,
  jointBreaks: 5,
  woke: 6,
  fellAsleep: 7,
};

const PAIR = ["shapeA", "shapeB", "bodyA", "bodyB", "shapeDataA", "bodyDataA", "shapeDataB", "bodyDataB"];
const SEEN = ["sensor", "visitor", "sensorBody", "visitorBody", "sensorData", "sensorBodyData", "visitorData", "visitorBodyData"];
const FIELDS = {
  contactBegin: PAIR,
  contactEnd: PAIR,
  hits: [...PAIR, "x", "y", "normalX", "normalY", "speed", "impulse", "massA", "massB"],
  sensorBegin: SEEN,
  sensorEnd: SEEN,
  jointBreaks: ["joint", "forceX", "forceY", "torque", "userData", "bodyA", "bodyB"],
  woke: ["body"],
  fellAsleep: ["body"],
};

export class World {
  #session;
  #token = {};

  constructor(def = {}, from) {
    if (from?.[0] === own) {
      this.#session = from[1];
    } else {
      giveData(def);
      this.#session = wasm.tp_new();
    }
    check(this.#session);
    forgotten.register(this, this.#session, this.#token);
    /** Handles of the bodies of the scene that it was loaded from, by their index there. */
    this.sceneBodies = from?.[2] ?? [];
  }

  static #of(session, bodies) {
    check(session);
    return new World({}, [own, session, bodies]);
  }

  static loadScene(scene) {
    giveText(typeof scene === "string" ? scene : write(scene));
    const session = wasm.tp_new_scene();
    return World.#of(session, session ? list() : []);
  }

  static fromBytes(bytes, dt = 1 / 60) {
    if (!(Number.isFinite(dt) && dt >= LEAST)) throw new PhysicsError(`dt is ${dt}; it has to be above 0, and ${LEAST} or more`);
    give(bytes);
    return World.#of(wasm.tp_new_frame(dt));
  }

  static openRecording(bytes, budget = 64 * 2 ** 20) {
    give(bytes);
    return World.#of(wasm.tp_new_recording(budget));
  }

  /** Number of the session, for code that calls the module itself. */
  get session() {
    if (!this.#session) throw new PhysicsError("this world has been freed");
    return this.#session;
  }

  clone() {
    return World.#of(wasm.tp_clone(this.session), this.sceneBodies);
  }

  free() {
    if (!this.#session) return;
    forgotten.unregister(this.#token);
    wasm.tp_free(this.#session);
    this.#session = 0;
  }

  [Symbol.dispose ?? Symbol("dispose")]() {
    this.free();
  }

  // Time.

  step(dt) {
    // The module takes 0 for the scene's own step, and with what is next to nothing nothing moves.
    if (Math.abs(Math.fround(dt)) < LEAST) throw new PhysicsError(`dt is ${dt}; it has to be above 0, and ${LEAST} or more`);
    check(wasm.tp_step(this.session, dt === undefined ? 0 : Number.isFinite(dt) ? dt : NaN));
  }

  get dt() {
    return wasm.tp_dt(this.session);
  }

  get gravity() {
    check(wasm.tp_settings(this.session));
    const [x, y] = numbers();
    return point(x, y);
  }

  setGravity(x, y) {
    this.apply({ set_gravity: [x, y] });
  }

  get settings() {
    check(wasm.tp_settings(this.session));
    return JSON.parse(text());
  }

  setSettings(settings) {
    this.apply({ set_settings: { ...this.settings, ...settings } });
  }

  // What is done to it.

  apply(command) {
    giveData(command);
    check(wasm.tp_apply(this.session));
    return list();
  }

  addBody(body) {
    return this.apply({ add_body: body })[0];
  }

  removeBody(body) {
    this.apply({ remove_body: parts(body) });
  }

  body(id) {
    return wasm.tp_has_body(this.session, id) ? new Body(this, id) : undefined;
  }

  addShape(body, shape) {
    return this.apply({ add_shape: [parts(body), shape] })[0];
  }

  addChain(body, chain) {
    return this.apply({ add_chain: [parts(body), chain] });
  }

  addOutline(body, outline, like = { shape: { circle: { radius: 1 } } }) {
    return this.apply({ add_outline: [parts(body), outline, like] });
  }

  shape(id) {
    if (!wasm.tp_shape(this.session, id)) return undefined;
    return { id, body: numbers()[0], ...read(text()) };
  }

  shapeIds() {
    check(wasm.tp_ids(this.session, 0));
    return list();
  }

  changeShape(id, change) {
    const now = this.shape(id);
    const command = { ...change };
    // Commands are whole descriptions; what is not said stays as it is.
    for (const [name, before] of [["set_material", now?.material], ["set_filter", now?.filter]]) {
      if (command[name]) command[name] = { ...before, ...said(command[name]) };
    }
    this.apply({ shape: [parts(id), command] });
  }

  removeShape(id) {
    this.apply({ remove_shape: parts(id) });
  }

  addJoint(a, b, joint) {
    return this.apply({ add_joint: [parts(a), parts(b), joint] })[0];
  }

  joint(id) {
    if (!wasm.tp_joint(this.session, id)) return undefined;
    const [bodyA, bodyB, ax, ay, bx, by, fx, fy, torque] = numbers();
    const def = JSON.parse(text());
    return { id, bodyA, bodyB, anchorA: point(ax, ay), anchorB: point(bx, by), force: point(fx, fy), torque, def };
  }

  jointIds() {
    check(wasm.tp_ids(this.session, 1));
    return list();
  }

  setJoint(id, joint) {
    this.apply({ set_joint: [parts(id), joint] });
  }

  removeJoint(id) {
    this.apply({ remove_joint: parts(id) });
  }

  addTiles(grid) {
    return this.apply({ add_tiles: grid })[0];
  }

  setTile(grid, x, y, value) {
    this.apply({ set_tile: [parts(grid), x, y, value] });
  }

  removeTiles(grid) {
    this.apply({ remove_tiles: parts(grid) });
  }

  explode(explosion, filter) {
    this.apply({ explode: [explosion, sees(filter)] });
  }

  applyWater(water, dt = this.dt, filter) {
    this.apply({ apply_water: [water, sees(filter), dt] });
  }

  applyZone(zone, dt = this.dt, filter) {
    this.apply({ apply_zone: [zone, sees(filter), dt] });
  }

  moveCharacter(character, input, dt = this.dt) {
    const now = { drift: 0, dropping: false, previous: character.position, ...character };
    this.apply({ move_character: [withHandles(now, parts), input, dt] });
    return withHandles(read(text()), whole);
  }

  // What there is.

  bodies(alpha = 1) {
    check(wasm.tp_bodies(this.session, alpha));
    const [count, ids, poses, velocities, states] = numbers();
    const memory = wasm.memory.buffer;
    return {
      count,
      ids: new Float64Array(memory, ids, count),
      poses: new Float32Array(memory, poses, 3 * count),
      velocities: new Float32Array(memory, velocities, 3 * count),
      states: new Uint8Array(memory, states, count),
    };
  }

  events(which) {
    check(wasm.tp_events(this.session, EVENTS[which] ?? 99));
    return numbers();
  }

  eventList(which) {
    const [rows, fields] = [this.events(which), FIELDS[which]];
    const event = (_, i) => Object.fromEntries(fields.map((field, k) => [field, rows[i * fields.length + k]]));
    return Array.from({ length: rows.length / fields.length }, event);
  }

  contacts() {
    check(wasm.tp_contacts(this.session));
    return numbers();
  }

  counts() {
    check(wasm.tp_counts(this.session));
    const [bodies, awake, shapes, joints, contacts, steps, deepest, kinetic, potential, px, py] = numbers();
    return { bodies, awake, shapes, joints, contacts, steps, deepest, kinetic, potential, momentum: point(px, py) };
  }

  sensorOverlaps(sensor) {
    check(wasm.tp_sensor_overlaps(this.session, sensor));
    return list();
  }

  // Questions.

  rayCast(x, y, dx, dy, filter) {
    takes("rayCast", 4, [x, y, dx, dy]);
    giveQuestion(filter);
    check(wasm.tp_cast(this.session, x, y, dx, dy, false));
    return hits()[0];
  }

  rayCastAll(x, y, dx, dy, filter) {
    takes("rayCastAll", 4, [x, y, dx, dy]);
    giveQuestion(filter);
    check(wasm.tp_cast(this.session, x, y, dx, dy, true));
    return hits();
  }

  castShape(shape, x, y, angle, dx, dy, filter) {
    takes("castShape", 5, [x, y, angle, dx, dy]);
    giveQuestion(filter, shape, angle);
    check(wasm.tp_cast(this.session, x, y, dx, dy, false));
    return hits()[0];
  }

  overlapPoint(x, y, filter) {
    takes("overlapPoint", 2, [x, y]);
    giveQuestion(filter);
    check(wasm.tp_overlap(this.session, x, y));
    return list();
  }

  overlapShape(shape, x, y, angle = 0, filter) {
    takes("overlapShape", 3, [x, y, angle]);
    giveQuestion(filter, shape, angle);
    check(wasm.tp_overlap(this.session, x, y));
    return list();
  }

  overlapAabb(left, bottom, right, top, filter) {
    takes("overlapAabb", 4, [left, bottom, right, top]);
    giveQuestion(filter);
    check(wasm.tp_overlap_aabb(this.session, left, bottom, right, top));
    return list();
  }

  closestPoint(x, y, maxDistance, filter) {
    // All there is may be looked for.
    takes("closestPoint", 3, [x, y, maxDistance === Infinity ? 0 : maxDistance]);
    giveQuestion(filter);
    check(wasm.tp_closest(this.session, x, y, maxDistance));
    const [shape, body, px, py, distance] = numbers();
    return shape === undefined ? undefined : { shape, body, point: point(px, py), distance };
  }

  // A pointer that pulls.

  grab(x, y) {
    takes("grab", 2, [x, y]);
    check(wasm.tp_grab(this.session, x, y));
    return numbers()[0];
  }

  drag(x, y) {
    check(wasm.tp_drag(this.session, x, y));
    const [px, py] = numbers();
    return px === undefined ? undefined : point(px, py);
  }

  release() {
    check(wasm.tp_release(this.session));
  }

  // Frames, recordings, history.

  hash() {
    return BigInt.asUintN(64, wasm.tp_hash(this.session)).toString(16).padStart(16, "0");
  }

  save() {
    check(wasm.tp_save(this.session));
    return rawText().slice();
  }

  restore(bytes) {
    give(bytes);
    check(wasm.tp_restore(this.session, 0));
  }

  deltaFrom(frame) {
    give(frame);
    check(wasm.tp_delta(this.session));
    return rawText().slice();
  }

  restoreDelta(frame, delta) {
    const both = new Uint8Array(frame.length + delta.length);
    both.set(frame);
    both.set(delta, frame.length);
    give(both);
    if (wasm.tp_restore(this.session, frame.length)) return;
    // A world that is recorded or keeps its history takes whole frames alone. What is bad is bad in a plain world, too.
    const there = new World();
    try {
      give(both);
      check(wasm.tp_restore(there.session, frame.length));
      this.restore(there.save());
    } finally {
      there.free();
    }
  }

  startRecording() {
    check(wasm.tp_record(this.session));
  }

  recording() {
    check(wasm.tp_recording(this.session));
    return rawText().slice();
  }

  keepHistory(budget = 64 * 2 ** 20) {
    check(wasm.tp_keep(this.session, budget));
  }

  get history() {
    check(wasm.tp_history(this.session));
    const [at, length, bytes] = numbers();
    return { at, length, bytes };
  }

  goTo(step) {
    takes("goTo", 1, [step]);
    check(wasm.tp_go_to(this.session, Math.min(Math.max(0, Math.round(step)), 2 ** 32 - 1)));
  }

  forgetLater() {
    check(wasm.tp_forget_later(this.session));
  }

  /** Are the world's data sound? For tests. */
  validate() {
    check(wasm.tp_validate(this.session));
  }
}

/** A character that stands nowhere yet. */
export function character(x, y, height, radius) {
  takes("character", 4, [x, y, height, radius]);
  if (!(height > 0 && radius > 0)) throw new PhysicsError(`height is ${height} and radius ${radius}; both have to be above 0`);
  if (!engine().tp_character(x, y, height, radius)) throw new PhysicsError(text());
  return withHandles(read(text()), whole);
}

/** A character with the handles of bodies and shapes in it given by `change`. */
function withHandles(character, change) {
  const changed = (thing) => {
    if (!thing) return thing;
    const own = ["body", "shape"].filter((name) => thing[name] != null).map((name) => [name, change(thing[name])]);
    return { ...thing, ...Object.fromEntries(own) };
  };
  const { ground, hits = [], pushed } = character;
  return { ...changed(character), ground: changed(ground), hits: hits.map(changed), pushed: changed(pushed) };
}

function hits() {
  const rows = numbers();
  const found = [];
  for (let i = 0; i < rows.length; i += 7) {
    const [shape, body, x, y, nx, ny, fraction] = rows.subarray(i, i + 7);
    found.push({ shape, body, point: point(x, y), normal: point(nx, ny), fraction });
  }
  return found;
}

/** The module's commands to a body, in the order of their numbers, and how many numbers each takes. */
const COMMANDS = {
  setPosition: 2,
  setAngle: 1,
  setPose: 3,
  setVelocity: 2,
  setAngularVelocity: 1,
  setTarget: 4,
  applyForce: 4,
  applyForceToCenter: 2,
  applyTorque: 1,
  applyImpulse: 4,
  applyImpulseToCenter: 2,
  applyAngularImpulse: 1,
  wake: 0,
  sleep: 0,
  setKind: 1,
  setEnabled: 1,
  setLocks: 3,
  setMass: 1,
  setGravityScale: 1,
  setDamping: 2,
  setCanSleep: 1,
  setSleepSpeed: 1,
  setBullet: 1,
  setUserData: 1,
};

export class Body {
  constructor(world, id) {
    this.world = world;
    this.id = id;
  }

  #numbers() {
    check(wasm.tp_body(this.world.session, this.id));
    return numbers();
  }

  #state(bit) {
    return (this.#numbers()[10] & bit) !== 0;
  }

  get position() {
    const [x, y] = this.#numbers();
    return point(x, y);
  }

  get angle() {
    return this.#numbers()[2];
  }

  get velocity() {
    const [, , , x, y] = this.#numbers();
    return point(x, y);
  }

  get angularVelocity() {
    return this.#numbers()[5];
  }

  get mass() {
    return this.#numbers()[6];
  }

  get inertia() {
    return this.#numbers()[7];
  }

  get center() {
    const all = this.#numbers();
    return point(all[8], all[9]);
  }

  get kind() {
    return KINDS[this.#numbers()[10] & 3];
  }

  get isAwake() {
    return this.#state(4);
  }

  get isEnabled() {
    return this.#state(8);
  }

  get isBullet() {
    return this.#state(16);
  }

  get gravityScale() {
    return this.#numbers()[11];
  }

  get damping() {
    const all = this.#numbers();
    return { linear: all[12], angular: all[13] };
  }

  get locks() {
    const bits = this.#numbers()[14];
    return { x: !!(bits & 1), y: !!(bits & 2), rotation: !!(bits & 4) };
  }

  get sleepSpeed() {
    return this.#numbers()[15];
  }

  get canSleep() {
    return this.#numbers()[16] !== 0;
  }

  get userData() {
    return this.#numbers()[17];
  }

  get shapes() {
    check(wasm.tp_body_shapes(this.world.session, this.id));
    return list();
  }

  get joints() {
    check(wasm.tp_body_joints(this.world.session, this.id));
    return list();
  }

  remove() {
    this.world.removeBody(this.id);
  }
}

/** What a method takes, as the module's four numbers. */
const NUMBERS = {
  setKind: (kind) => {
    const index = KINDS.indexOf(kind);
    if (index < 0) throw new PhysicsError(`kind is ${kind}; allowed are ${KINDS.join(", ")}`);
    return [index];
  },
  setLocks: ({ x = false, y = false, rotation = false } = {}) => [+x, +y, +rotation],
  setEnabled: (flag) => [+flag],
  setCanSleep: (flag) => [+flag],
  setBullet: (flag) => [+flag],
  // The module takes 0 for the mass by densities.
  setMass: (mass) => {
    if (mass === 0) throw new PhysicsError("mass is 0; allowed is above 0");
    return [mass ?? 0];
  },
  setUserData: (data) => {
    if (Number.isFinite(data) && !(Number.isSafeInteger(data) && data >= 0)) {
      throw new PhysicsError(`user data is ${data}; allowed are whole numbers from 0 to 2^53 - 1`);
    }
    return [data];
  },
};

Object.entries(COMMANDS).forEach(([name, count], which) => {
  const numbersOf = NUMBERS[name] ?? ((...all) => all);
  Body.prototype[name] = function (...all) {
    const given = numbersOf(...all);
    takes(name, count, given);
    const [a = 0, b = 0, c = 0, d = 0] = given;
    check(wasm.tp_body_command(this.world.session, this.id, which, a, b, c, d));
    return this;
  };
});

export class FixedStep {
  #left = 0;

  constructor(dt = 1 / 60, maxSteps = 8) {
    this.dt = Number.isFinite(dt) && dt > 0 ? dt : 1 / 60;
    this.maxSteps = maxSteps >= 1 ? maxSteps : 1;
  }

  advance(elapsed) {
    if (elapsed > 0 && Number.isFinite(elapsed)) this.#left += elapsed;
    // A millionth of a step of rounding must not cost a step.
    const due = Math.floor(this.#left / this.dt + 1e-6);
    // What cannot be caught up with is dropped.
    this.#left = due > this.maxSteps ? 0 : Math.max(this.#left - due * this.dt, 0);
    return Math.min(due, this.maxSteps);
  }

  get alpha() {
    return Math.min(this.#left / this.dt, 1);
  }
}

/** Plays a recording and compares every step; how many there are. */
export function checkRecording(bytes) {
  give(bytes);
  check(wasm.tp_check_recording());
  return numbers()[0];
}

/** The module's own functions, for code that goes without these classes. */
export function exports() {
  return engine();
}
