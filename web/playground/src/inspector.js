// Everything about the selected body, its shapes, joints and contacts, or about the world; numbers can be edited.

import { h, icon, short } from "./dom.js";

export function inspector(app, root) {
  let shown;
  let live = [];

  function rebuild() {
    live = [];
    const id = app.selected?.id;
    const body = id === undefined ? undefined : app.world.body(id);
    shown = body ? id : undefined;
    root.replaceChildren(...(body ? ofBody(body) : ofWorld()));
    refresh();
  }

  function refresh() {
    const id = app.selected?.id;
    const there = id !== undefined && app.world.body(id) ? id : undefined;
    if (there !== shown) return rebuild();
    for (const update of live) update();
  }

  function section(title, ...children) {
    return h("details.section", { open: true }, h("summary", {}, title), ...children);
  }

  /** A number that is shown as it changes, and set when it is edited. */
  function number(label, unit, read, write) {
    const input = h("input", { type: "number", step: "any", "aria-label": label, disabled: !write });
    const show = () => {
      if (document.activeElement !== input) input.value = short(read(), 4);
    };
    const commit = () => {
      const value = Number(input.value);
      if (write && input.value !== "" && Number.isFinite(value)) app.act(() => write(value));
    };
    input.onchange = commit;
    live.push(show);
    return h("label.field", {}, h("span", {}, label), input, h("small", {}, unit));
  }

  function flag(label, read, write) {
    const input = h("input", { type: "checkbox" });
    input.onchange = () => app.act(() => write(input.checked));
    live.push(() => (input.checked = read()));
    return h("label.flag", {}, input, h("span", {}, label));
  }

  function value(label, read) {
    const output = h("output", {});
    live.push(() => (output.textContent = read()));
    return h("div.field", {}, h("span", {}, label), output);
  }

  function ofBody(body) {
    const { world } = app;
    const kind = h("select", { "aria-label": "Kind" }, ...["static", "kinematic", "dynamic"].map((name) => h("option", { value: name }, name)));
    kind.onchange = () => app.act(() => body.setKind(kind.value));
    live.push(() => (kind.value = body.kind));
    const index = body.id % 2 ** 24;
    return [
      h("h2", {}, `Body ${index}`, h("span.grow"), kind),
      section(
        "Place and motion",
        number("x", "m", () => body.position.x, (x) => body.setPosition(x, body.position.y)),
        number("y", "m", () => body.position.y, (y) => body.setPosition(body.position.x, y)),
        number("angle", "rad", () => body.angle, (angle) => body.setAngle(angle)),
        number("speed x", "m/s", () => body.velocity.x, (x) => body.setVelocity(x, body.velocity.y)),
        number("speed y", "m/s", () => body.velocity.y, (y) => body.setVelocity(body.velocity.x, y)),
        number("spin", "rad/s", () => body.angularVelocity, (w) => body.setAngularVelocity(w)),
      ),
      section(
        "Substance",
        number("mass", "kg", () => body.mass, (mass) => body.setMass(mass)),
        number("inertia", "kg m²", () => body.inertia),
        number("gravity", "×", () => body.gravityScale, (scale) => body.setGravityScale(scale)),
        number("damping", "1/s", () => body.damping.linear, (linear) => body.setDamping(linear, body.damping.angular)),
        number("turn damping", "1/s", () => body.damping.angular, (angular) => body.setDamping(body.damping.linear, angular)),
        h(
          "div.flags",
          {},
          flag("awake", () => body.isAwake, (awake) => (awake ? body.wake() : body.sleep())),
          flag("enabled", () => body.isEnabled, (enabled) => body.setEnabled(enabled)),
          flag("bullet", () => body.isBullet, (bullet) => body.setBullet(bullet)),
          flag("can sleep", () => body.canSleep, (can) => body.setCanSleep(can)),
          flag("lock x", () => body.locks.x, (x) => body.setLocks({ ...body.locks, x })),
          flag("lock y", () => body.locks.y, (y) => body.setLocks({ ...body.locks, y })),
          flag("lock turning", () => body.locks.rotation, (rotation) => body.setLocks({ ...body.locks, rotation })),
        ),
      ),
      ...body.shapes.slice(0, 12).map((id, i) => ofShape(world, id, i)),
      ...body.joints.slice(0, 12).map((id) => ofJoint(world, id)),
      ofContacts(world, body),
      h(
        "div.row",
        {},
        h("button.wide", { onclick: () => app.act(() => body.remove()) }, icon("trash-2"), "Remove"),
        h("button.wide", { onclick: () => app.select(undefined) }, icon("x"), "Deselect"),
      ),
    ];
  }

  function ofShape(world, id, i) {
    const now = () => world.shape(id);
    const first = now();
    if (!first) return undefined;
    const [[form, sizes]] = Object.entries(first.shape);
    const sized = Object.entries(sizes).filter(([, size]) => typeof size === "number" || (Array.isArray(size) && typeof size[0] === "number"));
    const size = ([name, initial]) => {
      const set = (part, value) => {
        const [[, current]] = Object.entries(now().shape);
        const next = part === undefined ? value : current[name].map((old, at) => (at === part ? value : old));
        world.changeShape(id, { set_shape: { [form]: { ...current, [name]: next } } });
      };
      const read = (part) => {
        const [[, current]] = Object.entries(now()?.shape ?? { x: sizes });
        return part === undefined ? current[name] : current[name][part];
      };
      if (typeof initial === "number") return number(name, "m", () => read(), (value) => set(undefined, value));
      return [0, 1].map((part) => number(`${name} ${"xy"[part]}`, "m", () => read(part), (value) => set(part, value)));
    };
    const material = (name, unit) =>
      number(name.replace("_", " "), unit, () => now()?.material[name] ?? NaN, (value) =>
        world.changeShape(id, { set_material: { ...now().material, [name]: value } }),
      );
    return section(
      `Shape ${i + 1}: ${form}`,
      ...sized.flatMap(size),
      material("density", "kg/m²"),
      material("friction", ""),
      material("restitution", ""),
      material("rolling_resistance", ""),
      material("tangent_speed", "m/s"),
      h("div.flags", {}, flag("sensor", () => now()?.sensor, (sensor) => world.changeShape(id, { set_sensor: sensor }))),
    );
  }

  function ofJoint(world, id) {
    const now = () => world.joint(id);
    const first = now();
    if (!first) return undefined;
    const { kind } = first.def;
    const name = typeof kind === "string" ? kind : Object.keys(kind)[0];
    const text = h("textarea", { rows: 5, spellcheck: false, "aria-label": "Joint as JSON" }, JSON.stringify(first.def.kind, null, 1));
    const set = () => {
      try {
        const next = JSON.parse(text.value);
        app.act(() => world.setJoint(id, { ...now().def, kind: next }));
      } catch (error) {
        app.say("error", error.message);
      }
    };
    return section(
      `Joint: ${name}`,
      value("force", () => `${short(Math.hypot(now()?.force.x ?? NaN, now()?.force.y ?? NaN))} N`),
      value("torque", () => `${short(now()?.torque ?? NaN)} N m`),
      text,
      h(
        "div.row",
        {},
        h("button.wide", { onclick: set }, icon("check"), "Set"),
        h("button.wide", { onclick: () => (app.act(() => world.removeJoint(id)), rebuild()) }, icon("scissors"), "Cut"),
      ),
    );
  }

  function ofContacts(world, body) {
    const table = h("table", {});
    live.push(() => {
      const rows = world.contacts();
      const own = [];
      for (let i = 0; i + 10 < rows.length && own.length < 16; i += 11) {
        if (rows[i + 2] === body.id || rows[i + 3] === body.id) own.push(Array.from(rows.subarray(i, i + 11)));
      }
      table.replaceChildren(
        h("tr", {}, ...["with", "gap mm", "push N s", "friction"].map((name) => h("th", {}, name))),
        ...own.map((row) => {
          const other = row[2] === body.id ? row[3] : row[2];
          const link = h("button.link", { onclick: () => app.select({ kind: "body", id: other }) }, `body ${other % 2 ** 24}`);
          return h("tr", {}, h("td", {}, link), ...[1000 * row[8], row[9], row[10]].map((part) => h("td", {}, short(part))));
        }),
      );
    });
    return section("Contacts", table);
  }

  function ofWorld() {
    const { world } = app;
    const settings = world.settings;
    const setting = (name, unit = "") =>
      number(name.replaceAll("_", " "), unit, () => world.settings[name], (value) => world.setSettings({ [name]: value }));
    const counts = () => world.counts();
    return [
      h("h2", {}, "World"),
      h("p.hint", {}, "Click a body to see and change everything about it."),
      section(
        "Now",
        value("bodies", () => `${counts().bodies}, ${counts().awake} awake`),
        value("shapes, joints", () => `${counts().shapes}, ${counts().joints}`),
        value("contacts", () => counts().contacts),
        value("deepest overlap", () => `${short(1000 * counts().deepest)} mm`),
        value("energy", () => `${short(counts().kinetic + counts().potential)} J`),
        value("history", () => `${short(world.history.bytes / 2 ** 20)} MB`),
        value("hash", () => (app.playing ? "…" : world.hash())),
      ),
      section(
        "Gravity",
        number("x", "m/s²", () => world.gravity.x, (x) => world.setGravity(x, world.gravity.y)),
        number("y", "m/s²", () => world.gravity.y, (y) => world.setGravity(world.gravity.x, y)),
      ),
      section(
        "Settings",
        ...Object.entries(settings)
          .filter(([, setting]) => typeof setting === "number")
          .map(([name]) => setting(name)),
        h(
          "div.flags",
          {},
          flag("sleep", () => world.settings.sleep, (sleep) => world.setSettings({ sleep })),
          flag("continuous", () => world.settings.continuous, (continuous) => world.setSettings({ continuous })),
        ),
      ),
    ];
  }

  return { rebuild, refresh };
}
