// `node run.mjs [ROUNDS]`: sizes, then the times in Node (CPU time of the process) and in Chromium (wall time).
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";
import { launch, pageOf } from "../../web/test/browser.mjs";
import { serve } from "../../web/test/serve.mjs";

const rounds = Number(process.argv[2] ?? 5);
const here = new URL(".", import.meta.url).pathname;
const work = mkdtempSync(join(tmpdir(), "peers-"));

// Everything is bundled the same way, so that Node and the browser run the same code.
const common = {
  bundle: true,
  format: "esm",
  absWorkingDir: here,
  alias: { "tiny-physics": "../../web/npm/index.js" },
  logLevel: "error",
};

function sizes() {
  const gzip = (...files) => files.reduce((sum, file) => sum + gzipSync(readFileSync(file), { level: 9 }).length, 0);
  const module = (path) => `${here}node_modules/${path}`;
  return {
    "tiny-physics": gzip("../../web/npm/index.js", "../../web/npm/tiny_physics.wasm"),
    "box2d3-wasm": gzip(module("box2d3-wasm/build/dist/es/deluxe/Box2D.deluxe.mjs"), module("box2d3-wasm/build/dist/es/deluxe/Box2D.deluxe.wasm")),
    "rapier2d-simd": gzip(module("@dimforge/rapier2d-simd-compat/rapier_wasm2d.js"), module("@dimforge/rapier2d-simd-compat/rapier_wasm2d_bg.wasm")),
    planck: gzip(module("planck/dist/planck.min.js")),
    "matter-js": gzip(module("matter-js/build/matter.min.js")),
  };
}

process.chdir(here);
const size = Object.entries(sizes());
console.log(`| kB gzip | ${size.map(([name]) => name).join(" | ")} |\n|---|${size.map(() => "---:").join("|")}|`);
console.log(`| script and module | ${size.map(([, bytes]) => (bytes / 1000).toFixed(0)).join(" | ")} |\n`);

const { measure, table } = await import("./node.mjs");
console.log(`Node ${process.version}, CPU time:\n\n${table(await measure({ rounds }))}\n`);

writeFileSync(
  `${here}.page.js`,
  `import { measure } from "./measure.js";
globalThis.run = (rounds) => measure({ rounds, clock: () => performance.now(), options: { ours: "tiny_physics.wasm" }, say: () => new Promise((next) => setTimeout(next)) });`,
);
await build({ ...common, entryPoints: [`${here}.page.js`], outfile: `${work}/page.js`, platform: "browser", external: ["module", "fs", "path", "worker_threads", "url"], loader: { ".wasm": "file" } });
writeFileSync(`${work}/index.html`, '<!doctype html><script type="module" src="page.js"></script>');
writeFileSync(`${work}/tiny_physics.wasm`, readFileSync("../../web/npm/tiny_physics.wasm"));
const deluxe = `${here}node_modules/box2d3-wasm/build/dist/es/compat/Box2D.compat.wasm`;
writeFileSync(`${work}/Box2D.compat.wasm`, readFileSync(deluxe));
rmSync(`${here}.page.js`);
const { address, stop } = await serve(work);
const browser = await launch();
const page = await pageOf(browser);
page.setDefaultTimeout(1_800_000);
await page.goto(address);
await page.waitForFunction(() => globalThis.run);
const results = await page.evaluate((rounds) => globalThis.run(rounds), rounds);
console.log(`Chromium ${browser.version()}, wall time:\n\n${table(results)}`);
await browser.close();
stop();
rmSync(work, { recursive: true });
