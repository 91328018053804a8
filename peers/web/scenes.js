// Scenes that all engines can build: bodies of one box or circle, metres, y up. `half` is a box, `radius` a circle; what has
// no density stands still. Sleeping is off everywhere, so that every step is work.

const wall = (x, y, half) => ({ x, y, half });
const crate = (x, y, half, angle = 0) => ({ x, y, angle, half: [half, half], density: 1 });
const ball = (x, y, radius) => ({ x, y, radius, density: 1 });

/** The same numbers for everybody. */
function chance(seed) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1_664_525) + 1_013_904_223) >>> 0;
    return state / 2 ** 32;
  };
}

function pyramid(rows) {
  const bodies = [wall(0, -0.5, [2 * rows, 0.5])];
  for (let row = 0; row < rows; row++) {
    for (let i = 0; i < rows - row; i++) bodies.push(crate(1.05 * (i - (rows - row - 1) / 2), 0.5 + row, 0.5));
  }
  return bodies;
}

/** Balls and crates fall into a box. */
function heap(count) {
  const width = Math.sqrt(count) * 0.6;
  const bodies = [wall(0, -0.5, [width + 1, 0.5]), wall(-width - 0.5, 20, [0.5, 21]), wall(width + 0.5, 20, [0.5, 21])];
  const next = chance(count);
  const columns = Math.floor((2 * width) / 1.1);
  for (let i = 0; i < count; i++) {
    const x = -width + 0.7 + (i % columns) * 1.1 + 0.1 * next();
    const y = 0.8 + Math.floor(i / columns) * 1.1;
    const size = 0.3 + 0.15 * next();
    bodies.push(i % 2 ? ball(x, y, size) : crate(x, y, size, next()));
  }
  return bodies;
}

function towers(count, height) {
  const bodies = [wall(0, -0.5, [2 * count + 2, 0.5])];
  for (let i = 0; i < count; i++) {
    for (let k = 0; k < height; k++) bodies.push(crate(2 * (i - count / 2), 0.5 + k, 0.5));
  }
  return bodies;
}

export const SCENES = {
  "pyramid of 20 rows (210)": { bodies: pyramid(20), steps: 300 },
  "heap of 300": { bodies: heap(300), steps: 300 },
  "heap of 1,000": { bodies: heap(1000), steps: 240 },
  "20 towers of 8 (160)": { bodies: towers(20, 8), steps: 300 },
};
