// The playground: puts the parts together.

import { exports, init, World } from "tiny-physics";
import "uplot/dist/uPlot.min.css";
import "./style.css";
import { App } from "./app.js";
import { $, button, h, icon, menu, toast } from "./dom.js";
import { editor } from "./editor.js";
import { files, fromLink, share } from "./files.js";
import { gallery } from "./gallery.js";
import { clinic } from "./health.js";
import { inspector } from "./inspector.js";
import { scenes } from "./picture.js";
import { plots } from "./plots.js";
import { Renderer } from "./renderer.js";
import { TOOLS, tools } from "./tools.js";
import { transport } from "./transport.js";

const FIRST = "fair";
const OVERLAYS = [
  ["joints", "Joints", "link"],
  ["contacts", "Contact points", "dot"],
  ["impulses", "Contact impulses", "move-vertical"],
  ["depth", "Overlap as colour", "thermometer"],
  ["islands", "Islands", "shapes"],
  ["load", "Load of joints", "weight"],
  ["bounds", "Boxes", "scan"],
  ["mass", "Centres of mass", "crosshair"],
  ["velocities", "Velocities", "move-up-right"],
];

theme(localStorage.getItem("theme") ?? (matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark"));

function theme(name) {
  document.documentElement.dataset.theme = name;
  $('meta[name="theme-color"]').content = name === "dark" ? "#0f131b" : "#f4f6fa";
}

async function main() {
  await init(new URL("tiny_physics.wasm", document.baseURI));
  const app = new App(new Renderer($("#stage")));
  // A million bodies are more than a page should try.
  const catalogue = scenes().filter(({ name }) => name !== "circles_1m");
  // For the console of the browser, and for tests.
  window.playground = app;
  app.sceneWorld = (name) => World.loadScene(catalogue.find((entry) => entry.name === name).file());
  app.memory = () => exports().memory.buffer.byteLength;
  const shelf = gallery(app, catalogue);
  const disk = files(app);
  const time = transport(app);
  const pointer = tools(app);

  // The panel at the side: one of three leaves.

  const panel = $("#panel");
  const leaves = { inspect: h("div.leaf"), scene: h("div.leaf.code"), plot: h("div.leaf"), doctor: h("div.leaf") };
  const inspect = inspector(app, leaves.inspect);
  const code = editor(app, leaves.scene);
  const curves = plots(app, leaves.plot);
  const health = clinic(app, leaves.doctor, $("#finding"));
  $("#finding").onclick = () => leaf("doctor", false);
  const TABS = [
    ["inspect", "sliders-horizontal", "Inspector (I)"],
    ["scene", "braces", "Scene file (E)"],
    ["plot", "chart-line", "Plots (P)"],
    ["doctor", "stethoscope", "Doctor (D)"],
  ];
  const tabs = TABS.map(([name, picture, title]) => button(picture, title, () => leaf(name), { id: `tab-${name}` }));
  panel.append(h("div.row.tabs", {}, ...tabs, h("span.grow"), button("x", "Close (Esc)", () => leaf(undefined))), ...Object.values(leaves));

  let shownLeaf;
  function leaf(name, toggle = true) {
    shownLeaf = toggle && name === shownLeaf ? undefined : name;
    panel.hidden = !shownLeaf;
    document.body.classList.toggle("with-panel", !panel.hidden);
    for (const [key, element] of Object.entries(leaves)) element.hidden = key !== shownLeaf;
    for (const [key] of TABS) {
      for (const id of [`tab-${key}`, `open-${key}`]) $(`#${id}`)?.setAttribute("aria-pressed", String(key === shownLeaf));
    }
    if (shownLeaf === "inspect") inspect.rebuild();
    if (shownLeaf === "scene") code.show();
    if (shownLeaf === "plot") curves.build();
    if (shownLeaf === "doctor") health.build();
    room();
  }

  function room() {
    const narrow = innerWidth < 760;
    app.setRoom({
      left: narrow ? 0 : $("#tools").offsetWidth + 14,
      right: panel.hidden || narrow ? 0 : panel.offsetWidth + 12,
      // On narrow pages the line of counts is at the top.
      top: $("#top").offsetHeight + (narrow ? 38 : 16),
      bottom: 76 + (narrow ? 52 : 0) + (narrow && !panel.hidden ? panel.offsetHeight : 0),
    });
  }
  addEventListener("resize", room);

  // The bar at the top.

  const overlays = button("layers", "Overlays (O)", () => menu(overlays, overlays.entries()), { id: "overlays" });
  overlays.entries = () => OVERLAYS.map(([name, label, picture]) => [picture, label, () => app.toggle(name), app.shown.has(name)]);
  const save = button("download", "Open, save, export", () => menu(save, save.entries()), { id: "save" });
  save.entries = () => [
    ["folder-open", "Open a scene or recording…", disk.choose],
    ["file-json", "Save the scene file", disk.saveScene],
    ["film", "Save the recording", disk.saveRecording],
    ["image", "Picture (PNG)", disk.png],
    ["images", "Animation (GIF)", disk.gif],
    ["video", "Film (WebM)", disk.webm],
  ];
  const lights = button("sun-moon", "Light or dark (L)", () => {
    theme(app.dark ? "light" : "dark");
    localStorage.setItem("theme", document.documentElement.dataset.theme);
    if (shownLeaf === "plot") curves.build();
  });
  $("#actions").append(
    ...TABS.map(([name, picture, title]) => button(picture, title, () => leaf(name), { id: `open-${name}` })),
    overlays,
    button("link-2", "Copy a link that holds the scene", () => share(app), { id: "share" }),
    save,
    lights,
    button("circle-help", "Keys (?)", () => $("#help").showModal(), { id: "ask" }),
  );
  $("#scene").onclick = $("#brand").onclick = shelf.open;

  // What happens.

  app.addEventListener("scene", ({ detail }) => {
    history.replaceState(undefined, "", `#${detail.name}`);
    openEntry(detail);
  });
  function openEntry(entry) {
    try {
      app.open(entry.file(), { name: entry.name });
    } catch (error) {
      app.say("error", error.message);
    }
  }
  app.addEventListener("open", () => {
    $("#scene").replaceChildren(h("span.name", {}, app.name.replaceAll("_", " ")), icon("chevron-down"));
    document.title = `${app.name.replaceAll("_", " ")} · tiny-physics`;
    if (shownLeaf === "scene") code.show();
    if (shownLeaf === "plot") curves.build();
    if (shownLeaf === "inspect") inspect.rebuild();
    if (shownLeaf === "doctor") health.build();
  });
  app.addEventListener("select", () => {
    if (shownLeaf === "inspect") inspect.rebuild();
    else if (app.selected && innerWidth > 1100 && !shownLeaf) leaf("inspect");
  });
  app.addEventListener("error", ({ detail }) => toast(detail, "bad"));

  const keys = {
    " ": () => app.setPlaying(!app.playing),
    ArrowRight: (event) => app.step(event.shiftKey ? 10 : 1),
    ArrowLeft: (event) => app.step(event.shiftKey ? -10 : -1),
    ArrowUp: () => time.faster(1),
    ArrowDown: () => time.faster(-1),
    Home: () => app.goTo(0),
    End: () => app.goTo(app.length),
    r: () => app.restart(),
    f: () => app.fit(),
    g: shelf.open,
    n: () => neighbour(1),
    b: () => neighbour(-1),
    i: () => leaf("inspect"),
    e: () => leaf("scene"),
    p: () => leaf("plot"),
    d: () => leaf("doctor"),
    o: () => overlays.click(),
    l: () => lights.click(),
    x: () => pointer.choose("erase"),
    Delete: () => app.selected && app.act((world) => world.removeBody(app.selected.id)),
    Escape: () => (app.selected ? app.select(undefined) : leaf(undefined)),
    "?": () => $("#help").showModal(),
  };
  TOOLS.slice(0, 10).forEach(([name], i) => (keys[String((i + 1) % 10)] = () => pointer.choose(name)));

  function neighbour(by) {
    const here = catalogue.findIndex(({ name }) => name === app.name);
    openEntry(catalogue[(here + by + catalogue.length) % catalogue.length]);
  }

  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("input:not([type=range]), textarea, select, .cm-editor, dialog")) return;
    const action = keys[event.key] ?? keys[event.key.toLowerCase()];
    if (!action) return;
    event.preventDefault();
    action(event);
  });
  $("#help").append(
    h("header", {}, h("h1", {}, "Keys and pointer"), h("button.tool", { title: "Close", onclick: () => $("#help").close() }, icon("x"))),
    h(
      "dl",
      {},
      ...[
        ["Space", "play, pause"],
        ["← →", "a step back, a step on; ten with Shift"],
        ["↑ ↓", "faster, slower"],
        ["Home End", "to the beginning, to the end"],
        ["R", "restart"],
        ["F", "fit the view"],
        ["G, N, B", "gallery, next and previous scene"],
        ["I, E, P, D", "inspector, scene file, plots, doctor"],
        ["O, L", "overlays, light or dark"],
        ["1 … 0, X", "tools"],
        ["Delete", "remove the selected body"],
        ["Drag", "pull a body; look around where there is none"],
        ["Wheel, two fingers", "zoom"],
      ].flatMap(([key, what]) => [h("dt", {}, key), h("dd", {}, what)]),
    ),
    h("p.hint", {}, "Go back on the timeline and touch anything: the run goes on from there, and what came after is forgotten."),
  );
  $("#help").addEventListener("click", (event) => event.target === $("#help") && $("#help").close());

  async function fromAddress() {
    const hash = decodeURIComponent(location.hash.slice(1));
    const entry = catalogue.find(({ name }) => name === hash);
    if (entry) return openEntry(entry);
    try {
      if (hash.startsWith("s=")) return app.open(await fromLink(hash.slice(2)));
      if (hash.startsWith("file=")) {
        const name = hash.slice(5);
        const response = await fetch("file");
        if (!response.ok) throw new Error(`${name} cannot be read`);
        return disk.openBytes(new Uint8Array(await response.arrayBuffer()), name);
      }
    } catch (error) {
      toast(`The link holds no scene: ${error.message}`, "bad");
    }
    openEntry(catalogue.find(({ name }) => name === FIRST));
  }
  addEventListener("hashchange", fromAddress);

  // Who is here for the first time is told what to try, until they try something.
  if (!localStorage.getItem("known")) {
    const hint = $("#hint");
    hint.textContent = matchMedia("(pointer: coarse)").matches ? "Drag anything. The slider goes back in time." : "Drag anything. The slider goes back in time. E shows the scene as text, G has more.";
    hint.hidden = false;
    const tried = () => {
      hint.hidden = true;
      localStorage.setItem("known", "yes");
    };
    for (const event of ["pointerdown", "keydown"]) addEventListener(event, tried, { once: true });
  }

  room();
  await fromAddress();
  app.setPlaying(true);
  leaf(undefined);
  app.fit();

  // Time passes.

  const status = $("#status");
  let last = performance.now();
  let pictures = 0;
  let since = last;
  function frame(now) {
    requestAnimationFrame(frame);
    const elapsed = Math.min(0.1, (now - last) / 1000);
    last = now;
    app.tick(elapsed);
    pictures++;
    if (now - since > 250) {
      const { bodies, awake, contacts, deepest } = app.world.counts();
      const rate = Math.round((1000 * pictures) / (now - since));
      status.textContent = `${bodies} bodies · ${awake} awake · ${contacts} contacts · deepest ${(1000 * deepest).toFixed(1)} mm · ${rate} fps`;
      if (shownLeaf === "inspect") inspect.refresh();
      if (shownLeaf === "plot") curves.refresh();
      health.refresh(shownLeaf === "doctor");
      [pictures, since] = [0, now];
    }
  }
  requestAnimationFrame(frame);
  document.body.classList.add("ready");
}

main().catch((error) => {
  document.body.append(h("p.fatal", {}, error.message));
  throw error;
});
