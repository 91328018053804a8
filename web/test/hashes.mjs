// Every built-in scene through the package's module, from its scene file: `node hashes.mjs STEPS playground.wasm`, with the
// native lines of the example `state_hashes` on standard input. Fails where a hash is another one.
import { readFileSync } from "node:fs";
import { init, World } from "../npm/index.js";

const [, , steps, catalogue] = process.argv;
await init();
const { instance } = await WebAssembly.instantiate(readFileSync(catalogue), {});
const other = instance.exports;
const text = () => Buffer.from(other.memory.buffer, other.tp_text(), other.tp_text_length()).toString();
const files = new Map();
for (let i = 0; i < other.tp_scene_count(); i++) {
  other.tp_scene_entry(i);
  files.set(JSON.parse(text())[0], i);
}
const lines = readFileSync(0, "utf8").trim().split("\n");
let wrong = 0;
for (const line of lines) {
  const [name, expected] = line.split(" ");
  if (!files.has(name) || !other.tp_scene_file(files.get(name))) {
    wrong++;
    console.log(`${name}: the module has no such scene`);
    continue;
  }
  const world = World.loadScene(text());
  for (let i = 0; i < Number(steps); i++) world.step();
  const hash = world.hash();
  world.free();
  if (hash !== expected) {
    wrong++;
    console.log(`${name}: ${hash}, native ${expected}`);
  }
}
console.log(`${lines.length - wrong} of ${lines.length} scenes end with the native hash after ${steps} steps`);
process.exit(wrong ? 1 : 0);
