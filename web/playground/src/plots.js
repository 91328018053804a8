// Energy, momentum, deepest overlap and the time of a step over the run.

import uPlot from "uplot";
import { h } from "./dom.js";

const PLOTS = [
  ["Energy, J", [["kinetic", "#5b9cff"], ["potential", "#45c79b"], ["sum", "#ffc861"]]],
  ["Momentum, kg m/s", [["momentum", "#a08cff"]]],
  ["Deepest overlap, mm", [["deepest", "#ff6f61"]]],
  ["Contacts and awake bodies", [["contacts", "#58c9e6"], ["awake", "#aed25c"]]],
  ["Time of a step, ms", [["time", "#ff86ae"]]],
];

export function plots(app, root) {
  let made = [];
  let drawn = -1;

  function build() {
    made.forEach((plot) => plot.destroy());
    root.replaceChildren();
    const style = getComputedStyle(document.documentElement);
    const [muted, line] = [style.getPropertyValue("--muted"), style.getPropertyValue("--line")];
    const axis = { stroke: muted, grid: { stroke: line, width: 1 }, ticks: { show: false }, font: "11px system-ui", size: 46 };
    made = PLOTS.map(([title, series]) => {
      const box = h("figure.plot", {}, h("figcaption", {}, title));
      root.append(box);
      return new uPlot(
        {
          width: Math.max(200, root.clientWidth - 4),
          height: 118,
          legend: { show: series.length > 1, live: true },
          cursor: { y: false, drag: { x: false } },
          scales: { x: { time: false } },
          axes: [{ ...axis, size: 24 }, axis],
          series: [{ label: "s" }, ...series.map(([label, stroke]) => ({ label, stroke, width: 1.5, points: { show: false } }))],
        },
        [[], ...series.map(() => [])],
        box,
      );
    });
    drawn = -1;
    refresh();
  }

  function refresh() {
    const { figures, world } = app;
    if (!made.length || drawn === figures.steps.length) return;
    drawn = figures.steps.length;
    const every = Math.ceil(drawn / 1500);
    const thin = (row) => (every < 2 ? row : row.filter((_, i) => i % every === 0));
    const times = thin(figures.steps).map((step) => step * world.dt);
    PLOTS.forEach(([, series], i) => {
      const rows = series.map(([name]) => {
        const { kinetic, potential } = figures.rows;
        return thin(name === "sum" ? kinetic.map((energy, at) => energy + potential[at]) : figures.rows[name]);
      });
      made[i].setData([times, ...rows]);
    });
  }

  return { build, refresh };
}
