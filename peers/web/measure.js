// Times all engines in turn, A B C A B C, so that what disturbs the machine disturbs all; the median of the rounds counts.

import { ENGINES } from "./engines.js";
import { SCENES } from "./scenes.js";

export async function measure({ rounds, clock, options, say = () => {}, part = 1 }) {
  const makers = {};
  for (const [name, load] of Object.entries(ENGINES)) makers[name] = await load(options);
  const results = [];
  for (const [scene, { bodies, steps }] of Object.entries(SCENES)) {
    const times = {};
    const lowest = {};
    for (let round = 0; round < rounds; round++) {
      for (const [engine, make] of Object.entries(makers)) {
        const world = make(bodies);
        world.step();
        const start = clock();
        for (let i = 1; i < steps * part; i++) world.step();
        const time = (clock() - start) / (steps * part - 1);
        (times[engine] ??= []).push(time);
        // That nothing fell through the floor is the least that a time is worth something for.
        lowest[engine] = Math.min(...world.heights());
        world.free();
        await say(scene, engine, time);
      }
    }
    const median = Object.fromEntries(Object.entries(times).map(([engine, all]) => [engine, all.sort((a, b) => a - b)[all.length >> 1]]));
    results.push({ scene, median, lowest });
  }
  return results;
}

export function table(results) {
  const engines = Object.keys(results[0].median);
  const lines = [`| ms a step | ${engines.join(" | ")} |`, `|---|${engines.map(() => "---:").join("|")}|`];
  for (const { scene, median, lowest } of results) {
    const cell = (engine) => `${median[engine].toFixed(3)}${lowest[engine] < -0.6 ? " (fell through)" : ""}`;
    lines.push(`| ${scene} | ${engines.map(cell).join(" | ")} |`);
  }
  return lines.join("\n");
}
