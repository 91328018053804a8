// The package as a user sees it: `node --test`.
import assert from "node:assert/strict";
import { before, test } from "node:test";
import { Body, checkRecording, FixedStep, init, PhysicsError, World } from "../npm/index.js";

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

test("a ball falls and rests", () => {
  const world = new World({ gravity: [0, -10] });
  world.addBody(floor);
  const id = world.addBody(ball(0, 4));
  let begun = 0;
  for (let i = 0; i < 300; i++) {
    world.step(1 / 60);
    begun += world.events("contactBegin").length / 2;
  }
  const body = world.body(id);
  assert(body instanceof Body && Math.abs(body.position.y - 1.5) < 0.01);
  assert.equal(begun, 1);
  assert.equal(body.kind, "dynamic");
  assert.equal(body.isAwake, false);
  world.free();
  assert.throws(() => world.step(), /has been freed/);
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
  assert.throws(() => body.setKind("liquid"), PhysicsError);
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

test("questions are answered", () => {
  const { world, balls } = pile();
  const hit = world.rayCast(0, 30, 0, -40);
  assert.equal(hit.body, balls[7]);
  assert(hit.normal.y > 0.9 && hit.fraction > 0 && hit.fraction < 1);
  assert(world.rayCastAll(0, 30, 0, -40).length >= 9);
  assert.equal(world.rayCast(0, 30, 0, -40, { excludeBody: balls[7] }).body, balls[6]);
  assert.equal(world.rayCast(0, 30, 0, -40, { mask: 0 }), undefined);
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
