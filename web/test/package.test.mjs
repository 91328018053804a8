// The package as a user sees it: `node --test`.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { before, test } from "node:test";
import * as engine from "../npm/index.js";

const { Body, checkRecording, FixedStep, init, PhysicsError, World } = engine;

before(() => init());

const floor = { kind: "static", shapes: [{ shape: { rect: { half_extents: [20, 1] } } }] };
const ball = (x, y) => ({ position: [x, y], shapes: [{ shape: { circle: { radius: 0.5 } }, contact_events: true }] });

function pile() {
  const world = new World();
  world.addBody(floor);
  const balls = Array.from({ length: 8 }, (_, i) => world.addBody(ball(0.1 * (i % 3), 2 + 1.2 * i)));
  return { world, balls };
}

const run = (world, steps) => {
  for (let i = 0; i < steps; i++) world.step(1 / 60);
};

test("a load that is under way leaves a module alone that has come before it", async () => {
  const bytes = await readFile(new URL("../npm/tiny_physics.wasm", import.meta.url));
  const fresh = await import("../npm/index.js?fresh");
  const loading = fresh.init(bytes);
  fresh.initSync(bytes);
  const world = new fresh.World();
  const body = world.addBody(ball(0, 4));
  await loading;
  world.step(1 / 60);
  assert(world.body(body).position.y < 4);
});

test("a ball falls and rests", () => {
  const world = new World({ gravity: [0, -10] });
  world.addBody(floor);
  const id = world.addBody(ball(0, 4));
  let begun = 0;
  for (let i = 0; i < 300; i++) {
    world.step(1 / 60);
    begun += world.eventList("contactBegin").length;
  }
  const body = world.body(id);
  assert(body instanceof Body && Math.abs(body.position.y - 1.5) < 0.01);
  assert.equal(begun, 1);
  assert.equal(body.kind, "dynamic");
  assert.equal(body.isAwake, false);
  world.free();
  assert.throws(() => world.step(), /has been freed/);
});

test("hits tell their impulse and what the two weigh", () => {
  const world = new World({ gravity: [0, -10] });
  world.addBody(floor);
  const weight = world.addBody({ ...ball(0, 4), mass: 3 });
  const [first] = world.body(weight).shapes;
  world.changeShape(first, { set_events: [false, true] });
  let hit = [];
  while (!hit.length) {
    world.step(1 / 60);
    hit = world.eventList("hits");
  }
  assert.equal(hit.length, 1);
  const { normalY, speed, impulse, massA, massB, bodyA, bodyB } = hit[0];
  assert.equal(world.events("hits").length, 16);
  assert.equal(Math.abs(Math.round(normalY)), 1);
  assert(Math.abs(impulse - 3 * speed) < 3, `${impulse} of ${speed}`);
  assert.deepEqual([massA, massB].sort(), [0, 3]);
  assert.equal(massA === 3 ? bodyA : bodyB, weight);
});

test("events tell bodies and the user's numbers, of what is gone, too", () => {
  const world = new World({ gravity: [0, -10] });
  world.addBody({ ...floor, user_data: 7 });
  const door = { shape: { circle: { radius: 1 } }, sensor: true, user_data: 5 };
  const zone = world.addBody({ kind: "static", position: [0, 3], shapes: [door], user_data: 6 });
  const id = world.addBody({ ...ball(0, 4), user_data: 9 });
  const seen = [];
  const touched = [];
  for (let i = 0; i < 120; i++) {
    world.step(1 / 60);
    seen.push(...world.eventList("sensorBegin"));
    touched.push(...world.eventList("contactBegin"));
  }
  assert.deepEqual(
    seen.map((e) => [e.sensorBody, e.sensorData, e.sensorBodyData, e.visitorBody, e.visitorBodyData]),
    [[zone, 5, 6, id, 9]],
  );
  assert.deepEqual(touched.map((e) => [e.bodyDataA, e.bodyDataB].sort()), [[7, 9]]);
  world.removeBody(id);
  world.step(1 / 60);
  const [end] = world.eventList("contactEnd");
  assert.deepEqual([end.bodyDataA, end.bodyDataB].sort(), [7, 9]);
  assert([end.bodyA, end.bodyB].includes(id) && world.body(id) === undefined);
  assert.deepEqual(world.eventList("hits"), []);
  assert.throws(() => world.eventList("bangs"), /no such events/);
});

test("rows are views of the module's memory", () => {
  const { world, balls } = pile();
  run(world, 30);
  const { count, ids, poses, velocities, states } = world.bodies();
  assert.equal(count, 9);
  assert.deepEqual([...ids.subarray(1)], balls);
  assert.equal(poses.length, 27);
  assert.equal(states[0] & 3, 0);
  assert.equal(states[1] & 7, 2 + 4);
  const [x, y, angle] = poses.subarray(3);
  const { position, velocity, angle: exact } = world.body(balls[0]);
  assert.deepEqual([x, y, angle], [position.x, position.y, exact].map(Math.fround));
  assert.deepEqual([...world.bodies().velocities.subarray(3, 5)], [velocity.x, velocity.y]);
  assert.equal(velocities.length, 27);
});

test("what is wrong is said in the engine's words, and changes nothing", () => {
  const { world } = pile();
  const before = world.hash();
  const wrong = (work, words) => assert.throws(work, (error) => error instanceof PhysicsError && words.test(error.message));
  wrong(() => world.addBody({ mass: NaN }), /mass is NaN; it has to be finite/);
  wrong(() => world.addBody({ shapes: [{ shape: { circle: { radius: -1 } } }] }), /shapes\[0\].*radius is -1/);
  wrong(() => world.addBody({ weight: 3 }), /unknown field `weight`, expected/);
  wrong(() => world.addJoint(0, 0, { kind: { revolute: {} } }), /body|joint/);
  wrong(() => world.step(-1), /dt is -1/);
  wrong(() => world.step(NaN), /dt is NaN/);
  wrong(() => world.step(0), /dt is 0/);
  wrong(() => world.step(1e-50), /dt is 1e-50/);
  wrong(() => world.step(1e-38), /dt is 1e-38/);
  wrong(() => engine.character(0, 2, 1.8, -0.3), /radius -0.3/);
  wrong(() => engine.character(0, 2, 0, 0.3), /height is 0/);
  wrong(() => world.setSettings({ substeps: 0 }), /substeps/);
  assert.equal(world.settings.substeps, 4);
  wrong(() => World.loadScene('{ "version": 1, "bodies": [ { "weight": 2 } ] }'), /line 1 column \d+: bodies\[0\]/);
  wrong(() => World.fromBytes(new Uint8Array(10)), /./);
  wrong(() => new World({ gravity: [0] }), /gravity/);
  wrong(() => world.apply({ no_such: 1 }), /unknown variant/);
  assert.equal(world.hash(), before);
  assert.equal(world.body(NaN), undefined);
  assert.equal(world.shape(-1), undefined);
  assert.equal(world.joint(1e300), undefined);
});

test("handles go stale and never mean another body", () => {
  const { world, balls } = pile();
  const body = world.body(balls[2]);
  body.remove();
  const fresh = world.addBody(ball(3, 3));
  assert.notEqual(fresh, balls[2]);
  assert.equal(world.body(balls[2]), undefined);
  assert.throws(() => body.position, PhysicsError);
  assert.throws(() => body.setVelocity(1, 0), PhysicsError);
});

test("bodies, shapes and joints can be read and changed", () => {
  const { world, balls } = pile();
  const body = world.body(balls[0]);
  body.setVelocity(1, 2).setAngularVelocity(3).setGravityScale(0.5).setDamping(0.1, 0.2).setBullet(true).setMass(7);
  assert.deepEqual(body.velocity, { x: 1, y: 2 });
  assert.deepEqual([body.angularVelocity, body.gravityScale, body.mass, body.isBullet], [3, 0.5, 7, true]);
  assert.deepEqual(body.damping, { linear: Math.fround(0.1), angular: Math.fround(0.2) });
  body.setLocks({ rotation: true }).setKind("kinematic");
  assert.deepEqual([body.kind, body.locks.rotation, body.locks.x], ["kinematic", true, false]);
  assert.throws(() => body.setKind("liquid"), /kind is liquid; allowed are static, kinematic, dynamic/);
  assert.throws(() => body.setMass(0), /mass is 0/);
  assert.throws(() => body.setUserData(-1), /user data is -1/);
  assert.throws(() => body.setUserData(1.5), /user data is 1.5/);
  assert.equal(body.setUserData(7).userData, 7);
  const [shape] = body.shapes;
  world.changeShape(shape, { set_shape: { circle: { radius: 2 } } });
  assert.equal(world.shape(shape).shape.circle.radius, 2);
  assert.equal(world.shape(shape).body, balls[0]);
  const joint = world.addJoint(balls[1], balls[2], { kind: { distance: { length: 1 } }, anchor_a: [0.1, 0] });
  assert.deepEqual(world.body(balls[1]).joints, [joint]);
  const { def, bodyA, bodyB } = world.joint(joint);
  assert.deepEqual([bodyA, bodyB, def.kind.distance.length], [balls[1], balls[2], 1]);
  world.setJoint(joint, { kind: { distance: { length: 2 } } });
  world.removeJoint(joint);
  assert.equal(world.joint(joint), undefined);
  world.setGravity(1, 2);
  world.setSettings({ substeps: 8 });
  assert.deepEqual([world.gravity, world.settings.substeps], [{ x: 1, y: 2 }, 8]);
  world.validate();
});

test("what is no number is refused by the name of the method", () => {
  const { world, balls } = pile();
  const body = world.body(balls[0]);
  const before = world.hash();
  const wrong = (work, words) => assert.throws(work, (error) => error instanceof PhysicsError && words.test(error.message));
  wrong(() => body.setVelocity([1, 2]), /setVelocity takes 2 numbers/);
  wrong(() => body.setPosition({ x: 1, y: 2 }), /setPosition takes 2 numbers/);
  wrong(() => body.setVelocity(1), /setVelocity takes 2 numbers/);
  wrong(() => body.applyForce(1, 2), /applyForce takes 4 numbers/);
  wrong(() => body.setAngle("1"), /setAngle takes 1 number/);
  wrong(() => body.setVelocity(NaN, 0), /setVelocity/);
  wrong(() => body.applyImpulseToCenter(0, Infinity), /applyImpulseToCenter/);
  wrong(() => body.setEnabled(), /setEnabled/);
  wrong(() => body.setVelocity(1e20, 0), /too large/);
  wrong(() => body.setPosition(1e300, 0), /too large/);
  assert.equal(world.hash(), before);
  body.setLocks().setMass().wake().setVelocity(1, 2);
  assert.deepEqual(body.velocity, { x: 1, y: 2 });
});

test("blasts, water and zones act on what a filter shows", () => {
  const both = () => {
    const world = new World({ gravity: [0, 0] });
    return [world, ...[-2, 2].map((x) => world.addBody({ ...ball(x, 0), shapes: [{ ...ball(0, 0).shapes[0], filter: { category: x < 0 ? 2 : 4 } }] }))];
  };
  const square = { min: [-9, -9], max: [9, 9] };
  const forces = {
    blast: (world, filter) => world.explode({ center: [0, 0], radius: 5, falloff: 1, impulse_per_metre: 10 }, filter),
    water: (world, filter) => world.applyWater({ surface: [0, 5], flow: [3, 0], area: square }, 1 / 60, filter),
    zone: (world, filter) => {
      const zone = { shape: { circle: { radius: 9 } }, pose: { p: [0, 0], q: { c: 1, s: 0 } }, force: { acceleration: [5, 0] }, wakes: true };
      world.applyZone(zone, 1 / 60, filter);
    },
  };
  const moves = (body) => Math.hypot(body.velocity.x, body.velocity.y) > 0.01;
  for (const [name, force] of Object.entries(forces)) {
    for (const [filter, expected] of [
      [undefined, [true, true]],
      [{ mask: 4 }, [false, true]],
      [{ mask: 2n }, [true, false]],
    ]) {
      const [world, a, b] = both();
      force(world, filter);
      world.step();
      assert.deepEqual([a, b].map((id) => moves(world.body(id))), expected, `${name} ${filter?.mask}`);
    }
    const [world, a, b] = both();
    force(world, { excludeBody: a });
    world.step();
    assert.deepEqual([a, b].map((id) => moves(world.body(id))), [false, true], name);
  }
});

test("a character walks, and what it stands on has handles", () => {
  const world = new World();
  const ground = world.addBody(floor);
  let hero = engine.character(0, 2, 1.8, 0.3);
  assert.deepEqual([hero.position, hero.height, Math.fround(hero.radius), hero.mass], [[0, 2], 1.8, Math.fround(0.3), 70]);
  for (let i = 0; i < 120; i++) {
    world.step(1 / 60);
    hero = world.moveCharacter(hero, { walk: 3 }, 1 / 60);
  }
  assert(Math.abs(hero.position[0] - 6) < 0.1, `${hero.position}`);
  assert.equal(hero.ground.body, ground);
  assert.equal(hero.ground.shape, world.body(ground).shapes[0]);
  // It goes along with a body of its own, and does not collide with it.
  const own = world.addBody({ kind: "kinematic", position: hero.position, shapes: [{ shape: { circle: { radius: 0.3 } } }] });
  hero = world.moveCharacter({ ...hero, body: own, filter: { mask: 2n ** 64n - 1n } }, { walk: 3 });
  assert.equal(hero.body, own);
  assert.equal(world.body(own).position.x, hero.position[0]);
  // A character in which no more stands than what it is.
  const { position, velocity, height, radius, max_slope, step_height, snap_distance, push_force, mass, gravity_scale, skin, filter } = hero;
  const bare = { position, velocity, height, radius, max_slope, step_height, snap_distance, push_force, mass, gravity_scale, skin, filter };
  assert(world.moveCharacter(bare, {}).position[0] > 5);
  assert.throws(() => engine.character(0, 2, NaN, 0.3), PhysicsError);
});

test("a script is not part of a frame, but of a copy and of the history", () => {
  const scene = () =>
    World.loadScene({
      version: 1,
      gravity: [0, 0],
      bodies: [ball(0, 0)],
      script: { timeline: { acts: [{ when: { at: 5 }, deed: { set_velocity: { body: 0, velocity: [1, 0] } } }] } },
    });
  const moves = (world) => {
    run(world, 10);
    return world.body(world.sceneBodies[0]).velocity.x === 1;
  };
  const world = scene();
  const [frame, copy] = [world.save(), world.clone()];
  assert(moves(world) && moves(copy));
  world.restore(frame);
  assert.equal(moves(world), false);
  const kept = scene();
  kept.keepHistory();
  assert(moves(kept));
  for (const step of [Infinity, NaN]) assert.throws(() => kept.goTo(step), /goTo takes 1 number/);
  kept.goTo(0);
  assert(moves(kept));
});

test("filters have 64 bits, and what is read can be written", () => {
  const world = new World();
  const high = 2n ** 63n;
  world.addBody({ shapes: [{ shape: { circle: { radius: 1 } }, filter: { mask: 2n } }] });
  const [shape] = world.shapeIds();
  assert.equal(world.shape(shape).filter.mask, 2);
  world.changeShape(shape, { set_filter: { category: high, mask: 2n ** 64n - 1n, group: 0 } });
  const filter = world.shape(shape).filter;
  assert.equal(filter.category, high);
  world.changeShape(shape, { set_filter: { ...filter, category: 2 } });
  assert.equal(world.shape(shape).filter.category, 2);
  assert.equal(world.shape(shape).filter.mask, 2n ** 64n - 1n);
});

test("what is not said of a material or filter stays", () => {
  const world = new World();
  const material = { density: 3, friction: 0.25, restitution: 0.5, friction_mix: "max" };
  const filter = { category: 4, mask: 2n ** 63n, group: -1 };
  const body = world.body(world.addBody({ shapes: [{ shape: { circle: { radius: 1 } }, material, filter }] }));
  const [shape] = body.shapes;
  const mass = body.mass;
  world.changeShape(shape, { set_material: { friction: 0, density: undefined } });
  world.changeShape(shape, { set_filter: { group: 7 } });
  const now = world.shape(shape);
  assert.deepEqual([now.material.density, now.material.friction, now.material.restitution], [3, 0, 0.5]);
  assert.equal(now.material.friction_mix, "max");
  assert.deepEqual([now.filter.category, now.filter.mask, now.filter.group], [4, 2n ** 63n, 7]);
  assert.equal(body.mass, mass);
  assert.throws(() => world.changeShape(shape, { set_material: { slippery: 1 } }), /slippery/);
  assert.throws(() => world.changeShape(shape, { set_material: null }), PhysicsError);
  body.remove();
  assert.throws(() => world.changeShape(shape, { set_material: { friction: 0 } }), PhysicsError);
});

test("questions are answered", () => {
  const { world, balls } = pile();
  const hit = world.rayCast(0, 30, 0, -40);
  assert.equal(hit.body, balls[7]);
  assert(hit.normal.y > 0.9 && hit.fraction > 0 && hit.fraction < 1);
  assert(world.rayCastAll(0, 30, 0, -40).length >= 9);
  assert.equal(world.rayCast(0, 30, 0, -40, { excludeBody: balls[7] }).body, balls[6]);
  assert.equal(world.rayCast(0, 30, 0, -40, { mask: 0 }), undefined);
  // What is left out or misspelt is told.
  assert.throws(() => world.rayCast(0, 30, -40), PhysicsError);
  assert.throws(() => world.overlapPoint(0), PhysicsError);
  assert.throws(() => world.closestPoint(0, 0), PhysicsError);
  assert.throws(() => world.rayCast(0, 30, 0, -40, { masks: 1 }), /a filter has no masks/);
  assert.equal(world.castShape({ circle: { radius: 0.2 } }, 0, 30, 0, 0, -40).body, balls[7]);
  assert.deepEqual(world.overlapPoint(0, 2), world.body(balls[0]).shapes);
  assert.equal(world.overlapAabb(-50, -50, 50, 50).length, 9);
  assert.equal(world.overlapShape({ circle: { radius: 0.4 } }, 0, 2).length, 1);
  assert.equal(world.closestPoint(0, 12, 5).body, balls[7]);
  assert.equal(world.closestPoint(0, 100, 5), undefined);
});

test("saved worlds go on bit for bit, whole and as differences", () => {
  const { world } = pile();
  run(world, 40);
  const frame = world.save();
  const copy = World.fromBytes(frame);
  const twin = world.clone();
  run(world, 50);
  const delta = world.deltaFrom(frame);
  assert(delta.length < frame.length / 2);
  for (const other of [copy, twin]) {
    run(other, 50);
    assert.equal(other.hash(), world.hash());
  }
  copy.restore(frame);
  copy.restoreDelta(frame, delta);
  assert.equal(copy.hash(), world.hash());
  run(copy, 10);
  run(world, 10);
  assert.equal(copy.hash(), world.hash());
});

test("differences are restored in worlds that are recorded or keep their history, too", () => {
  const { world } = pile();
  const [recorded, kept] = [world.clone(), world.clone()];
  run(world, 40);
  const frame = world.save();
  run(world, 50);
  const delta = world.deltaFrom(frame);
  // By a call of the module itself.
  const below = recorded.clone();
  assert(engine.exports().tp_record(below.session));
  recorded.startRecording();
  kept.keepHistory();
  for (const other of [recorded, below, kept, kept.clone(), World.openRecording(recorded.recording())]) {
    other.step(1 / 60);
    assert.throws(() => other.restoreDelta(frame, delta.slice(0, 9)), PhysicsError);
    other.restoreDelta(frame, delta);
    assert.equal(other.hash(), world.hash());
  }
  run(kept, 1);
  kept.goTo(1);
  assert.notEqual(kept.hash(), world.hash());
  assert.equal(checkRecording(recorded.recording()), 1);
});

test("a saved world has the length of its step from who loads it", () => {
  const { world } = pile();
  const frame = world.save();
  assert.equal(World.fromBytes(frame).dt, Math.fround(1 / 60));
  const slow = World.fromBytes(frame, 1 / 30);
  assert.equal(slow.clone().dt, Math.fround(1 / 30));
  for (let step = 0; step < 9; step += 1) {
    world.step(1 / 30);
    slow.step();
  }
  assert.equal(slow.hash(), world.hash());
  for (const dt of [0, -1, NaN, Infinity, "1"]) assert.throws(() => World.fromBytes(frame, dt), /dt is/);
});

test("recordings are checked, opened and gone back in", () => {
  const { world, balls } = pile();
  world.startRecording();
  run(world, 30);
  world.body(balls[3]).applyImpulseToCenter(3, 4);
  run(world, 30);
  const recording = world.recording();
  assert.equal(checkRecording(recording), 60);
  const opened = World.openRecording(recording);
  opened.goTo(60);
  assert.equal(opened.hash(), world.hash());
  assert.equal(opened.history.length, 60);
  const wrong = recording.slice();
  wrong[wrong.length - 3] ^= 1;
  assert.throws(() => checkRecording(wrong), PhysicsError);
});

test("a run can be gone back in, and on from there", () => {
  const { world, balls } = pile();
  world.keepHistory();
  const hashes = [world.hash()];
  for (let i = 0; i < 100; i++) {
    world.step(1 / 60);
    hashes.push(world.hash());
  }
  for (const step of [10, 99, 0, 50]) {
    world.goTo(step);
    assert.equal(world.hash(), hashes[step]);
  }
  world.body(balls[0]).setVelocity(5, 5);
  assert.deepEqual([world.history.at, world.history.length], [50, 50]);
  run(world, 50);
  assert.notEqual(world.hash(), hashes[100]);
});

test("a pointer pulls a body to where it is", () => {
  const { world, balls } = pile();
  assert.equal(world.grab(0, 2), balls[0]);
  world.drag(6, 5);
  run(world, 200);
  const { x, y } = world.drag(6, 5);
  assert(Math.hypot(x - 6, y - 5) < 0.2, `${x} ${y}`);
  world.release();
  assert.equal(world.drag(0, 0), undefined);
  assert.equal(world.grab(100, 100), undefined);
});

test("steps are even where pictures are not", () => {
  const clock = new FixedStep(0.01, 5);
  assert.deepEqual([clock.advance(0.025), clock.advance(0.006), clock.advance(1)], [2, 1, 5]);
  assert.equal(clock.advance(NaN), 0);
  assert.equal(new FixedStep().advance(1), 8);
  // As in Rust: what is no time is none, and rounding costs no step.
  assert.equal(new FixedStep().advance(Infinity), 0);
  assert.equal(new FixedStep(NaN).dt, 1 / 60);
  assert.equal(new FixedStep(0.1).advance(0.3 - 1e-12), 3);
});

test("worlds that are freed give their memory back", () => {
  const memory = () => process.memoryUsage().arrayBuffers + process.memoryUsage().external;
  const once = () => {
    const { world } = pile();
    world.keepHistory();
    run(world, 30);
    world.free();
  };
  for (let i = 0; i < 20; i++) once();
  const before = memory();
  for (let i = 0; i < 200; i++) once();
  assert(memory() - before < 8 * 2 ** 20, `${memory() - before} bytes more`);
});
