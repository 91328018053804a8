#!/usr/bin/env bash
# Tries the package as others get it: packed, installed into an empty folder, used from Node, with Vite, in a plain page, and
# checked by TypeScript.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
archive=$(cd "$here/../npm" && npm pack --silent --pack-destination "$work")
cd "$work"
echo '{ "name": "empty", "private": true, "type": "module" }' > package.json
npm install --silent --no-audit --no-fund "./$archive"
ls node_modules/tiny-physics

cat > first.js <<'JS'
import { init, World } from "tiny-physics";
await init();
const world = new World({ gravity: [0, -9.8] });
world.addBody({ kind: "static", shapes: [{ shape: { rect: { half_extents: [20, 1] } } }] });
const ball = world.addBody({ position: [0, 6], shapes: [{ shape: { circle: { radius: 0.5 } } }] });
for (let i = 0; i < 300; i++) world.step(1 / 60);
const result = world.body(ball).position.y.toFixed(2);
globalThis.result = result;
console.log(result);
JS
[ "$(node first.js)" = 1.50 ] && echo "ok      Node"

cat > types.ts <<'TS'
import { character, init, World, FixedStep, PhysicsError, type BodyDef, type BodyId, type Character, type Scene } from "tiny-physics";
await init();
const crate: BodyDef = { position: [0, 1], shapes: [{ shape: { rect: { half_extents: [0.5, 0.5] } } }] };
const world: World = new World({ settings: { substeps: 8 } });
const id: BodyId = world.addBody(crate);
const body = world.body(id);
if (body) body.setVelocity(1, 2).setKind("kinematic");
const { ids, poses } = world.bodies(new FixedStep().alpha);
const first: number | undefined = ids[0] ?? poses[0];
try {
  world.addJoint(id, id, { kind: { revolute: { motor: { speed: 1, max: 2 } } } });
} catch (error) {
  if (error instanceof PhysicsError) console.log(error.message, first);
}
const gem: BodyDef = {
  center: [0, -0.1],
  inertia: 2,
  shapes: [
    {
      shape: { regular: { count: 6, size: 0.5, radius: 0.1 } },
      material: { friction_mix: "max", restitution_mix: null },
      sensor: true,
      sees_sensors: true,
    },
    { shape: { segment: { a: [0, 0], b: [1, 0] } }, link: { previous: [-1, 0], next: null } },
    { shape: { rect: { half_extents: [1, 1], center: [0, 1], angle: 0.5 } } },
  ],
};
world.addJoint(id, world.addBody(gem), { kind: { weld: {} }, anchors_at: [[0, 0], [1, 0]], enabled: false });
const scene: Scene = { version: 1, view: [[-1, 0], [1, 2]], bodies: [gem] };
world.explode({ center: [0, 0], radius: 1, falloff: 1, impulse_per_metre: 1 }, { mask: 2n, excludeBody: id });
world.applyWater({ surface: [0, 0], area: { min: [-1, -1], max: [1, 1] } }, undefined, { sensors: true });
world.applyZone({ shape: { circle: { radius: 1 } }, pose: { p: [0, 0], q: { c: 1, s: 0 } }, force: { damping: { linear: 1, angular: 1 } }, wakes: true });
let hero: Character = { ...character(0, 2, 1.8, 0.3), mass: 80, body: id };
hero = world.moveCharacter(hero, { walk: 1 });
if (hero.ground) world.body(hero.ground.body)?.applyImpulseToCenter(0, -hero.velocity[1]);
console.log(scene.view?.[0][1], hero.hits?.[0]?.normal[0]);
world[Symbol.dispose]();
// @ts-expect-error a zone has one of four forces
world.applyZone({ shape: { circle: { radius: 1 } }, pose: { p: [0, 0], q: { c: 1, s: 0 } }, force: { push: 1 }, wakes: true });
// @ts-expect-error a character is made by character
world.moveCharacter({}, {});
// @ts-expect-error a circle has a radius
world.addShape(id, { shape: { circle: {} } });
// @ts-expect-error there is no such kind
body?.setKind("liquid");
TS
"$here/node_modules/.bin/tsc" --strict --noEmit --target es2022 --module nodenext --moduleResolution nodenext --lib es2022,dom types.ts
echo "{ using other = new World(); other.step(); }" >> types.ts
"$here/node_modules/.bin/tsc" --strict --noEmit --target es2022 --module nodenext --moduleResolution nodenext --lib esnext,dom types.ts
echo "ok      tsc --strict"

mkdir vite && cp first.js vite/main.js
echo '<!doctype html><script type="module" src="./main.js"></script>' > vite/index.html
"$here/node_modules/.bin/vite" build vite --logLevel error --base ./ --outDir "$work/built"
mkdir plain && cp -r node_modules/tiny-physics plain/tiny-physics
sed 's|"tiny-physics"|"./tiny-physics/index.js"|' first.js > plain/main.js
echo '<!doctype html><script type="module" src="./main.js"></script>' > plain/index.html
cat > plain/worker.js <<'JS'
import { init, World } from "./tiny-physics/index.js";
await init();
postMessage(new World().hash());
JS
node "$here/pages.mjs" "$work/built" "$work/plain"
