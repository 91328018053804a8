// What the module says is to be drawn, as views of its memory.

import { exports } from "tiny-physics";

export const SHOW = {
  joints: 1,
  contacts: 2,
  impulses: 4,
  bounds: 8,
  mass: 16,
  velocities: 32,
  depth: 64,
  islands: 128,
  load: 256,
  light: 512,
};

function numbers(wasm) {
  return new Float64Array(wasm.memory.buffer, wasm.tp_numbers(), wasm.tp_numbers_length());
}

export function rows(world, camera, alpha, shown) {
  const wasm = exports();
  wasm.tp_draw(world.session, camera.x, camera.y, alpha, shown);
  const found = numbers(wasm);
  const view = (i) => new Float32Array(wasm.memory.buffer, found[2 * i], found[2 * i + 1]);
  return { boxes: view(0), polygons: view(1), lines: view(2), waters: view(3), still: { boxes: found[8], polygons: found[9] } };
}

/** The part of the world that is worth seeing: left, bottom, right, top. It is what the scene's `view` says, or what moves. */
export function framing(world, view) {
  if (view) return view.flat();
  const wasm = exports();
  wasm.tp_bounds(world.session);
  const [l0, b0, r0, t0, l1, b1, r1, t1] = numbers(wasm);
  if (r1 < l1) return r0 < l0 ? [-6, -1, 6, 7] : [l0, b0, r0, t0];
  if (r0 < l0) return grown([l1, b1, r1, t1], 0.1);
  const both = [Math.min(l0, l1), Math.min(b0, b1), Math.max(r0, r1), Math.max(t0, t1)];
  const size = (box) => Math.max(box[2] - box[0], box[3] - box[1]);
  const moving = [l1, b1, r1, t1];
  if (size(both) <= 2.2 * (1 + size(moving))) return both;
  // Of ground that goes on only what is near.
  const near = grown(moving, 0.6);
  return [
    Math.min(l1, Math.max(l0, near[0])),
    Math.min(b1, Math.max(b0, near[1])),
    Math.max(r1, Math.min(r0, near[2])),
    Math.max(t1, Math.min(t0, near[3])),
  ];
}

function grown([l, b, r, t], part) {
  const more = part * Math.max(r - l, t - b, 1);
  return [l - more, b - more, r + more, t + more];
}

export function scenes() {
  const wasm = exports();
  const decoder = new TextDecoder();
  const text = () => decoder.decode(new Uint8Array(wasm.memory.buffer, wasm.tp_text(), wasm.tp_text_length()));
  return Array.from({ length: wasm.tp_scene_count() }, (_, index) => {
    wasm.tp_scene_entry(index);
    const [name, description, steps, tags] = JSON.parse(text());
    const file = () => {
      if (!wasm.tp_scene_file(index)) throw new Error(text());
      return text();
    };
    return { name, description, steps, tags, file };
  });
}
