// Times all engines in turn, A B C A B C, so that what disturbs the machine disturbs all; the best of several rounds counts.

import { ENGINES } from "./engines.js";
import { SCENES } from "./scenes.js";

export async function measure({ rounds, clock, options, say = () => {}, part = 1 }) {
  const makers = {};
  for (const [name, load] of Object.entries(ENGINES)) makers[name] = await load(options);
  const results = [];
  for (const [scene, { bodies, steps }] of Object.entries(SCENES)) {
    const best = {};
    const lowest = {};
    for (let round = 0; round < rounds; round++) {
      for (const [engine, make] of Object.entries(makers)) {
        const world = make(bodies);
        world.step();
        const start = clock();
        for (let i = 1; i < steps * part; i++) world.step();
        const time = (clock() - start) / (steps * part - 1);
        best[engine] = Math.min(best[engine] ?? Infinity, time);
        // That nothing fell through the floor is the least that a time is worth something for.
        lowest[engine] = Math.min(...world.heights());
        world.free();
        await say(scene, engine, time);
      }
    }
    results.push({ scene, best, lowest });
  }
  return results;
}

export function table(results) {
  const engines = Object.keys(results[0].best);
  const lines = [`| ms a step | ${engines.join(" | ")} |`, `|---|${engines.map(() => "---:").join("|")}|`];
  for (const { scene, best, lowest } of results) {
    const cell = (engine) => `${best[engine].toFixed(3)}${lowest[engine] < -0.6 ? " (fell through)" : ""}`;
    lines.push(`| ${scene} | ${engines.map(cell).join(" | ")} |`);
  }
  return lines.join("\n");
}
