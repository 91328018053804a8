// Bundles the playground into dist/: static files that work from any folder, offline.

import { build } from "esbuild";
import { cpSync, existsSync, mkdirSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";

const here = new URL(".", import.meta.url).pathname;
process.chdir(here);

// Only the icons that are used.
const used = new Set();
for (const file of readdirSync("src")) {
  const text = readFileSync(`src/${file}`, "utf8");
  for (const [, name] of text.matchAll(/"([a-z][a-z0-9-]*)"/g)) if (existsSync(`node_modules/lucide-static/icons/${name}.svg`)) used.add(name);
}
const lines = [...used].sort().map((name) => {
  const svg = readFileSync(`node_modules/lucide-static/icons/${name}.svg`, "utf8").replace(/<!--.*?-->/gs, "").replace(/\s*class="[^"]*"/, "").replace(/\s+/g, " ").trim();
  return `  ${JSON.stringify(name)}: ${JSON.stringify(svg)},`;
});
const icons = `export default {\n${lines.join("\n")}\n};\n`;

rmSync("dist", { recursive: true, force: true });
mkdirSync("dist", { recursive: true });
await build({
  entryPoints: { playground: "src/main.js" },
  bundle: true,
  format: "esm",
  minify: true,
  target: ["chrome109", "firefox115", "safari16.4"],
  outdir: "dist",
  external: ["icon.svg"],
  alias: { "tiny-physics": "../npm/index.js" },
  logLevel: "warning",
  legalComments: "none",
  plugins: [
    {
      name: "icons",
      setup(at) {
        at.onResolve({ filter: /icons\.js$/ }, () => ({ path: "icons", namespace: "made" }));
        at.onLoad({ filter: /.*/, namespace: "made" }, () => ({ contents: icons }));
      },
    },
  ],
});
cpSync("index.html", "dist/index.html");
cpSync("public", "dist", { recursive: true });
// What is bundled, and under which licences.
const licences = ["@codemirror/view", "@lezer/common", "codemirror-json-schema", "gifenc", "lucide-static", "uplot"].map((name) => {
  const folder = `node_modules/${name}`;
  const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
  return `${name}\n\n${file ? readFileSync(`${folder}/${file}`, "utf8") : JSON.parse(readFileSync(`${folder}/package.json`)).license}`;
});
writeFileSync("dist/LICENCES.txt", licences.join("\n\n----\n\n"));
for (const file of readdirSync("dist").sort()) {
  const path = `dist/${file}`;
  console.log(`${path}: ${statSync(path).size} bytes, ${gzipSync(readFileSync(path)).length} gzip`);
}
