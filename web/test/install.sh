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
import { init, World, FixedStep, PhysicsError, type BodyDef, type BodyId } from "tiny-physics";
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
// @ts-expect-error a circle has a radius
world.addShape(id, { shape: { circle: {} } });
// @ts-expect-error there is no such kind
body?.setKind("liquid");
TS
"$here/node_modules/.bin/tsc" --strict --noEmit --target es2022 --module nodenext --moduleResolution nodenext --lib es2022,dom types.ts
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
