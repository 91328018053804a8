// What the pointer does on the canvas: mouse, pen, and fingers (two of them move the view).

import { $, button } from "./dom.js";

export const TOOLS = [
  ["grab", "hand", "Drag and throw; drag the ground to look around (1)"],
  ["circle", "circle", "Draw a ball (2)"],
  ["box", "square", "Draw a box (3)"],
  ["outline", "spline", "Draw any outline (4)"],
  ["hinge", "locate", "Pin bodies together with a hinge (5)"],
  ["rope", "cable", "Tie two bodies with a rope (6)"],
  ["spring", "waves", "Join two bodies with a spring (7)"],
  ["cut", "scissors", "Cut joints (8)"],
  ["launch", "rocket", "Shoot a ball (9)"],
  ["blast", "bomb", "Explosion (0)"],
  ["erase", "eraser", "Remove bodies (X)"],
];

const ACCENT = [0.36, 0.62, 1, 1];
const DANGER = [1, 0.36, 0.32, 1];

export function tools(app) {
  const { canvas } = app.renderer;
  const bar = $("#tools");
  for (const [name, picture, title] of TOOLS) {
    bar.append(button(picture, title, () => choose(name), { id: `tool-${name}` }));
  }

  function choose(name) {
    app.tool = name;
    for (const [other] of TOOLS) $(`#tool-${other}`).setAttribute("aria-pressed", String(other === name));
    canvas.style.cursor = name === "grab" ? "grab" : "crosshair";
  }
  choose("grab");

  const pointers = new Map();
  let act;
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return { px: event.clientX - box.left, py: event.clientY - box.top };
  };
  const at = (event) => {
    const { px, py } = place(event);
    return app.toWorld(px, py);
  };

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    canvas.focus({ preventScroll: true });
    pointers.set(event.pointerId, place(event));
    if (pointers.size === 2) {
      act?.cancel?.();
      act = pinch();
      return;
    }
    if (pointers.size > 2) return;
    const pans = event.button === 1 || event.button === 2;
    act = pans ? pan(event) : (DEEDS[app.tool] ?? pan)(at(event), event);
    act?.move?.(at(event), event);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!pointers.has(event.pointerId)) return;
    pointers.set(event.pointerId, place(event));
    act?.move?.(at(event), event);
  });
  const up = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    const done = act;
    act = undefined;
    app.overlay = [];
    if (event.type === "pointercancel") done?.cancel?.();
    else done?.end?.(at(event), event);
  };
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", up);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const { px, py } = place(event);
      const pixels = event.deltaMode === 1 ? event.deltaY * 24 : event.deltaY;
      app.zoom(Math.exp(-Math.max(-240, Math.min(pixels, 240)) * 0.0022), px, py);
    },
    { passive: false },
  );
  canvas.addEventListener("dblclick", () => app.tool === "grab" && !app.selected && app.fit());

  function pan(event) {
    let last = place(event);
    return {
      move: (_, now) => {
        const next = place(now);
        app.camera.x -= (next.px - last.px) / app.camera.scale;
        app.camera.y += (next.py - last.py) / app.camera.scale;
        last = next;
      },
    };
  }

  function pinch() {
    const middle = () => {
      const [a, b] = [...pointers.values()];
      return { px: (a.px + b.px) / 2, py: (a.py + b.py) / 2, apart: Math.hypot(a.px - b.px, a.py - b.py) };
    };
    let last = middle();
    return {
      move: () => {
        if (pointers.size < 2) return;
        const next = middle();
        app.camera.x -= (next.px - last.px) / app.camera.scale;
        app.camera.y += (next.py - last.py) / app.camera.scale;
        app.zoom(next.apart / Math.max(last.apart, 1), next.px, next.py);
        last = next;
      },
    };
  }

  /** A finger is not a mouse: what is near counts, too. */
  const reach = (event) => (event?.pointerType === "touch" ? 18 : 5) / app.camera.scale;

  /** The body at a point: what is solid comes before sensors, then what moves, then what came later. */
  function bodyAt({ x, y }, event) {
    const { world } = app;
    const found = world.overlapPoint(x, y, { sensors: true }).map((id) => world.shape(id));
    if (!found.length) return world.closestPoint(x, y, reach(event))?.body;
    const rank = ({ sensor, body }) => 2 * !sensor + (world.body(body).kind === "dynamic");
    return found.reduce((best, next) => (rank(next) >= rank(best) ? next : best)).body;
  }

  /** Where a body is held: at the pointer, or where it is nearest, a little further in. */
  function holdAt(body, start, event) {
    const { world } = app;
    const near = world.closestPoint(start.x, start.y, reach(event));
    if (near?.body !== body || near.distance === 0) return start;
    const towards = ({ x, y }) => {
      const [dx, dy] = [x - near.point.x, y - near.point.y];
      const part = 0.01 / Math.max(Math.hypot(dx, dy), 0.01);
      return { x: near.point.x + part * dx, y: near.point.y + part * dy };
    };
    const across = { x: 2 * near.point.x - start.x, y: 2 * near.point.y - start.y };
    const holds = ({ x, y }) => world.overlapPoint(x, y).some((shape) => world.shape(shape).body === body);
    return [towards(across), towards(world.body(body).center)].find(holds) ?? start;
  }

  function line(a, b, colour = ACCENT, width = 2) {
    return { a, b, colour, width };
  }

  function circleLines(c, radius, colour) {
    const points = Array.from({ length: 33 }, (_, i) => ({
      x: c.x + radius * Math.cos((i * Math.PI) / 16),
      y: c.y + radius * Math.sin((i * Math.PI) / 16),
    }));
    return points.slice(1).map((point, i) => line(points[i], point, colour));
  }

  function rectLines(a, b) {
    const corners = [a, { x: b.x, y: a.y }, b, { x: a.x, y: b.y }];
    return corners.map((corner, i) => line(corner, corners[(i + 1) % 4]));
  }

  /** Least size of what is drawn: what is smaller was a click. */
  const least = () => 6 / app.camera.scale;

  const DEEDS = {
    grab(start, event) {
      const body = bodyAt(start, event);
      const kind = body === undefined ? undefined : app.world.body(body)?.kind;
      if (body === undefined || kind === "static") {
        const moved = pan(event);
        const from = place(event);
        return {
          move: moved.move,
          end: (_, now) => {
            const to = place(now);
            if (Math.hypot(to.px - from.px, to.py - from.py) < 5) app.select(body === undefined ? undefined : { kind: "body", id: body });
          },
        };
      }
      app.select({ kind: "body", id: body });
      canvas.style.cursor = "grabbing";
      let last = start;
      const let_go = () => {
        app.world.release();
        canvas.style.cursor = "grab";
      };
      if (app.playing) {
        // Held in the past, the run goes on from there.
        app.act((world) => world.forgetLater());
        const { x, y } = holdAt(body, start, event);
        app.world.grab(x, y);
      }
      return {
        move: (now) => {
          if (!app.playing) {
            // Nothing moves by itself: the body goes where the pointer goes.
            const { position } = app.world.body(body) ?? {};
            if (position && (now.x !== last.x || now.y !== last.y)) {
              app.act((world) => world.body(body).setPosition(position.x + now.x - last.x, position.y + now.y - last.y));
            }
          } else {
            const held = app.world.drag(now.x, now.y);
            app.overlay = held ? [line(held, now, [1, 1, 1, 0.6], 1.5)] : [];
          }
          last = now;
        },
        end: let_go,
        cancel: let_go,
      };
    },

    circle: (start) => ({
      move: (now) => (app.overlay = circleLines(start, Math.hypot(now.x - start.x, now.y - start.y), ACCENT)),
      end: (now) => {
        let radius = Math.hypot(now.x - start.x, now.y - start.y);
        if (radius < least()) radius = 0.5;
        add(start, { circle: { radius } });
      },
    }),

    box: (start) => ({
      move: (now) => (app.overlay = rectLines(start, now)),
      end: (now) => {
        let [width, height] = [Math.abs(now.x - start.x) / 2, Math.abs(now.y - start.y) / 2];
        const center = { x: (start.x + now.x) / 2, y: (start.y + now.y) / 2 };
        if (Math.max(width, height) < least()) width = height = 0.5;
        const thin = 0.02;
        add(center, { rect: { half_extents: [Math.max(width, thin), Math.max(height, thin)] } });
      },
    }),

    outline(start) {
      const points = [start];
      return {
        move: (now) => {
          const last = points.at(-1);
          if (Math.hypot(now.x - last.x, now.y - last.y) > least()) points.push(now);
          app.overlay = points.slice(1).map((point, i) => line(points[i], point));
        },
        end: () => {
          const outline = simplified(points, 3 / app.camera.scale);
          if (outline.length < 3) return;
          const area = outline.reduce((sum, p, i) => {
            const q = outline[(i + 1) % outline.length];
            return sum + p.x * q.y - p.y * q.x;
          }, 0);
          if (area < 0) outline.reverse();
          const center = outline.reduce((c, p) => ({ x: c.x + p.x / outline.length, y: c.y + p.y / outline.length }), { x: 0, y: 0 });
          app.act((world) => {
            const body = world.addBody({ position: [center.x, center.y] });
            try {
              world.addOutline(body, outline.map((p) => [p.x - center.x, p.y - center.y]));
            } catch (error) {
              world.removeBody(body);
              throw error;
            }
            app.select({ kind: "body", id: body });
          });
        },
      };
    },

    hinge: (start, event) => ({
      end: () => {
        const shapes = app.world.overlapPoint(start.x, start.y);
        const bodies = [...new Set(shapes.map((shape) => app.world.shape(shape).body))];
        const [a = bodyAt(start, event), b] = bodies;
        if (a === undefined) return app.say("error", "A hinge needs a body under the pointer.");
        joint(a, b, start, start, { revolute: {} });
      },
    }),

    rope: (start, event) => between(start, event, (length) => ({ distance: { length, limits: { lower: 0, upper: length } } })),
    spring: (start, event) =>
      between(start, event, (length) => ({ distance: { length, spring: { hertz: 2, damping_ratio: 0.2 } } })),

    cut: (start) => ({
      move: (now) => (app.overlay = [line(start, now, DANGER)]),
      end: (now) => {
        const crossed = app.world.jointIds().filter((id) => {
          const { anchorA, anchorB, bodyA, bodyB } = app.world.joint(id);
          const [a, b] = [app.world.body(bodyA)?.center, app.world.body(bodyB)?.center];
          const lines = [[anchorA, anchorB], [a, anchorA], [anchorB, b]];
          return lines.some(([p, q]) => p && q && crosses(start, now, p, q)) || nearLine(anchorA, start, now) < least();
        });
        if (crossed.length) app.act((world) => crossed.forEach((id) => world.removeJoint(id)));
      },
    }),

    launch: (start) => ({
      move: (now) => (app.overlay = [line(start, now, DANGER, 3), ...circleLines(start, 0.3, ACCENT)]),
      end: (now) => {
        const pull = [(start.x - now.x) * 6, (start.y - now.y) * 6];
        const still = Math.hypot(...pull) < 0.5;
        app.act((world) => {
          const shape = { shape: { circle: { radius: 0.3 } }, material: { density: 4, restitution: 0.2 } };
          world.addBody({ position: [start.x, start.y], velocity: still ? [12, 4] : pull, bullet: true, shapes: [shape] });
        });
      },
    }),

    blast: (start) => ({
      move: (now) => (app.overlay = circleLines(start, Math.max(1, Math.hypot(now.x - start.x, now.y - start.y)), DANGER)),
      end: (now) => {
        const radius = Math.max(1, Math.hypot(now.x - start.x, now.y - start.y));
        app.act((world) => world.explode({ center: [start.x, start.y], radius: 0.3 * radius, falloff: 2 * radius, impulse_per_metre: 8 }));
      },
    }),

    erase(start, event) {
      const at = (now) => {
        const body = bodyAt(now, event);
        if (body === undefined) return;
        if (app.selected?.id === body) app.select(undefined);
        app.act((world) => world.removeBody(body));
      };
      at(start);
      return { move: (now) => app.world.overlapPoint(now.x, now.y).length && app.world.body(bodyAt(now))?.kind !== "static" && at(now) };
    },
  };

  function between(start, event, kind) {
    const a = bodyAt(start, event);
    return {
      move: (now) => (app.overlay = [line(start, now)]),
      end: (now) => {
        const b = bodyAt(now, event);
        if (a === undefined && b === undefined) return app.say("error", "Draw from one body to another, or to a place.");
        if (a === b) return app.say("error", "A joint needs two different bodies.");
        joint(a, b, start, now, kind(Math.max(0.05, Math.hypot(now.x - start.x, now.y - start.y))));
      },
    };
  }

  /** Joins two bodies, or one and the world, at points of the world. */
  function joint(a, b, pa, pb, kind) {
    app.act((world) => {
      const anchored = (body, p) => {
        if (body === undefined) return [world.addBody({ kind: "static", position: [p.x, p.y] }), [0, 0]];
        const { position, angle } = world.body(body);
        const [dx, dy, c, s] = [p.x - position.x, p.y - position.y, Math.cos(angle), Math.sin(angle)];
        return [body, [c * dx + s * dy, c * dy - s * dx]];
      };
      const [first, anchor_a] = anchored(a, pa);
      const [second, anchor_b] = anchored(b, pb);
      const turned = world.body(second).angle - world.body(first).angle;
      world.addJoint(first, second, { kind, anchor_a, anchor_b, angle_a: kind.revolute ? turned : 0 });
    });
  }

  function add(center, shape) {
    app.act((world) => {
      const id = world.addBody({ position: [center.x, center.y], shapes: [{ shape }] });
      app.select({ kind: "body", id });
    });
  }

  return { choose };
}

function crosses(a, b, c, d) {
  const side = (p, q, r) => (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

function nearLine(p, a, b) {
  const [x, y] = [b.x - a.x, b.y - a.y];
  const t = Math.max(0, Math.min(1, ((p.x - a.x) * x + (p.y - a.y) * y) / (x * x + y * y || 1)));
  return Math.hypot(p.x - a.x - t * x, p.y - a.y - t * y);
}

/** Fewer points: those from which the line between their neighbours is farther than `slack` (Douglas and Peucker, 1973). */
function simplified(points, slack) {
  if (points.length < 3) return points;
  let [far, most] = [0, slack];
  for (let i = 1; i < points.length - 1; i++) {
    const away = nearLine(points[i], points[0], points.at(-1));
    if (away > most) [far, most] = [i, away];
  }
  if (!far) return [points[0], points.at(-1)];
  return [...simplified(points.slice(0, far + 1), slack).slice(0, -1), ...simplified(points.slice(far), slack)];
}
