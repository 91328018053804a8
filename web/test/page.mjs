// The playground in Chromium: `node page.mjs NATIVE_HASHES RECORDING RECORDING_HASH PICTURES`, or those checks alone whose names the
// expression `ONLY` of the environment finds. What it checks is listed as it
// passes; pictures are left in a folder to be looked at.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import { launch, pageOf } from "./browser.mjs";
import { serve } from "./serve.mjs";

const [, , nativeFile, recording, recordingHash, pictures] = process.argv;
mkdirSync(pictures, { recursive: true });
const { address, stop } = await serve(new URL("../playground/dist", import.meta.url).pathname);
const browser = await launch();
let failed = 0;

async function open(options, hash = "") {
  const page = await pageOf(browser, options);
  await page.goto(`${address}/${hash}`);
  await page.waitForSelector("body.ready");
  return page;
}

async function check(name, work, options, hash) {
  if (process.env.ONLY && !new RegExp(process.env.ONLY).test(name)) return;
  const start = performance.now();
  let page;
  try {
    page = await open(options, hash);
    await work(page);
    assert.deepEqual(page.problems, [], "no errors in the console");
    console.log(`ok      ${name} (${((performance.now() - start) / 1000).toFixed(1)} s)`);
  } catch (error) {
    failed++;
    console.log(`FAILED  ${name}: ${error.message}`);
  }
  await page?.context().close();
}

const picture = (page, name) => page.screenshot({ path: `${pictures}/${name}.png` });
const pause = (page) => page.evaluate(() => playground.setPlaying(false));
/** Where a body is on the page. */
const placeOf = (page, index) =>
  page.evaluate((index) => {
    const { x, y } = playground.world.body(playground.world.sceneBodies[index]).center;
    return playground.toPage(x, y);
  }, index);

/** What the scene's `view` holds is between the bars and beside the panel. */
async function seenWhole(page) {
  const [corners, room, size] = await page.evaluate(() => [
    playground.scene.view.map(([x, y]) => playground.toPage(x, y)),
    playground.room,
    { width: innerWidth, height: innerHeight },
  ]);
  const [{ x: left, y: bottom }, { x: right, y: top }] = corners;
  const inside = left >= room.left && right <= size.width - room.right && top >= room.top && bottom <= size.height - room.bottom;
  assert(inside, `${JSON.stringify(corners)} in ${JSON.stringify(room)} of ${JSON.stringify(size)}`);
}

const native = new Map(readFileSync(nativeFile, "utf8").trim().split("\n").map((line) => line.split(" ")));
if (native.size > 1) await check(`${native.size} scenes run 300 steps in the page and end with the native hash`, async (page) => {
  await pause(page);
  page.setDefaultTimeout(900_000);
  const wrong = [];
  for (const [name, expected] of native) {
    const hash = await page.evaluate(async (name) => {
      const world = playground.sceneWorld(name);
      for (let i = 0; i < 300; i++) world.step();
      const hash = world.hash();
      world.free();
      return hash;
    }, name);
    if (hash !== expected) wrong.push(`${name}: ${hash}, native ${expected}`);
  }
  assert.deepEqual(wrong, []);
});

await check(
  "scrubbing back and forth ends with the same hash",
  async (page) => {
    await pause(page);
    const hashes = await page.evaluate(() => {
      playground.goTo(0);
      const hashes = [playground.world.hash()];
      while (playground.at < 150) {
        playground.step(1);
        hashes[playground.at] = playground.world.hash();
      }
      return hashes;
    });
    for (const step of [20, 149, 75, 0, 150]) {
      await page.locator("#time").evaluate((range, step) => {
        range.value = step;
        range.dispatchEvent(new Event("input"));
      }, step);
      await page.waitForFunction((step) => playground.at === step, step);
      assert.equal(await page.evaluate(() => playground.world.hash()), hashes[step], `step ${step}`);
    }
    await page.keyboard.press("ArrowLeft");
    assert.equal(await page.evaluate(() => playground.at), 149);
    await page.keyboard.press("End");
    await page.keyboard.press(" ");
    await page.waitForFunction(() => playground.at > 152);
  },
  {},
  "#rain",
);

await check(
  "a body is dragged and thrown, and the run goes on from the past",
  async (page) => {
    await page.waitForFunction(() => playground.length > 60);
    await pause(page);
    await page.evaluate(() => playground.goTo(30));
    assert((await page.evaluate(() => playground.length)) > 60);
    const from = await placeOf(page, 100);
    await page.evaluate(() => playground.setPlaying(true));
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(from.x - 150, from.y - 120, { steps: 6 });
    await page.waitForFunction(() => playground.at > 45);
    const to = await placeOf(page, 100);
    await page.mouse.up();
    assert(Math.hypot(to.x - from.x, to.y - from.y) > 20, `it moved from ${JSON.stringify(from)} to ${JSON.stringify(to)}`);
    assert.equal(await page.evaluate(() => playground.at === playground.length), true);
    await picture(page, "dragged");
  },
  {},
  "#pyramid",
);

await check("shapes and joints are drawn, and joints are cut", async (page) => {
  await page.evaluate(() => {
    playground.open('{ "version": 1, "gravity": [0, 0], "bodies": [{ "position": [-2, 0], "shapes": [{ "shape": { "circle": { "radius": 0.5 } } }] }, { "position": [2, 0], "shapes": [{ "shape": { "circle": { "radius": 0.5 } } }] }] }');
  });
  await pause(page);
  await page.evaluate(() => (playground.camera.scale = 60));
  const counts = () => page.evaluate(() => playground.world.counts());
  const at = (x, y) => page.evaluate(([x, y]) => playground.toPage(x, y), [x, y]);
  const draw = async (tool, ...points) => {
    await page.click(`#tool-${tool}`);
    const [first, ...rest] = await Promise.all(points.map(([x, y]) => at(x, y)));
    await page.mouse.move(first.x, first.y);
    await page.mouse.down();
    for (const point of rest) await page.mouse.move(point.x, point.y, { steps: 4 });
    await page.mouse.up();
  };
  await draw("spring", [-2, 0], [2, 0]);
  assert.equal((await counts()).joints, 1);
  await draw("circle", [0, 2], [0.4, 2]);
  await draw("box", [-1, -2], [1, -1.4]);
  await draw("outline", [-3, 1], [-2, 1.2], [-2.2, 2], [-2.6, 1.5], [-3, 2]);
  const { bodies, shapes } = await counts();
  assert.equal(bodies, 5);
  assert(shapes > 5, `${shapes} shapes: the outline has several pieces`);
  await draw("rope", [2, 0], [2, 2.2]);
  assert.equal((await counts()).joints, 2);
  await picture(page, "drawn");
  await draw("cut", [0, 0.3], [0.01, -0.3]);
  assert.equal((await counts()).joints, 1);
  await draw("erase", [0, 2], [0, 2.01]);
  await draw("launch", [-3, -2], [-4, -2]);
  await draw("blast", [0, 0], [1, 0]);
  assert.equal((await counts()).bodies, 6);
});

await check(
  "the inspector shows and sets the values of a body",
  async (page) => {
    await pause(page);
    const place = await placeOf(page, 60);
    await page.mouse.click(place.x, place.y);
    await page.waitForSelector("#panel h2");
    const mass = page.getByLabel("mass");
    await mass.fill("12.5");
    await mass.press("Enter");
    assert.equal(await page.evaluate(() => playground.world.body(playground.selected.id).mass), 12.5);
    await page.getByLabel("friction").first().fill("0");
    await page.getByLabel("friction").first().press("Enter");
    assert.equal(
      await page.evaluate(() => playground.world.shape(playground.world.body(playground.selected.id).shapes[0]).material.friction),
      0,
    );
    await picture(page, "inspector");
  },
  {},
  "#pyramid",
);

await check(
  "the editor completes fields, says where a scene is wrong, and runs it",
  async (page) => {
    await page.click("#open-scene");
    await page.click(".cm-content");
    await page.keyboard.press("Control+a");
    await page.keyboard.insertText('{\n  "version": 1,\n  "name": "mine",\n  "bodies": [\n    { "shapes": [{ "shape": { "circle": { "radius": -1 } } }] }\n  ]\n}\n');
    await page.waitForSelector(".problem:not([hidden])");
    const words = await page.textContent(".problem");
    assert.match(words, /line 5 column \d+: .*radius is -1/);
    await page.waitForSelector(".cm-lintRange-error, .cm-lint-marker-error");
    await picture(page, "broken");
    await page.keyboard.press("Control+a");
    await page.keyboard.insertText('{\n  "version": 1,\n  "name": "mine",\n  "bodies": [\n    { "shapes": [{ "shape": { "circle": { "radius": 1 } } }] }\n  ]\n}\n');
    await page.waitForFunction(() => playground.name === "mine");
    assert.equal(await page.isVisible(".problem"), false);
    assert.equal(await page.evaluate(() => playground.world.counts().bodies), 1);
    await page.keyboard.press("Control+Home");
    await page.keyboard.press("End");
    await page.keyboard.press("Enter");
    await page.keyboard.type('"grav', { delay: 30 });
    await page.waitForSelector(".cm-tooltip-autocomplete");
    assert.match(await page.textContent(".cm-tooltip-autocomplete"), /gravity/);
    await picture(page, "editor");
  },
  {},
  "#domino",
);

await check(
  "a link holds the whole scene",
  async (page) => {
    const source = await page.evaluate(() => playground.source);
    await page.click("#share");
    await page.waitForFunction(() => location.hash.startsWith("#s="));
    const hash = await page.evaluate(() => location.hash);
    const other = await open({}, hash);
    await pause(other);
    const bodies = (page) => page.evaluate(() => JSON.stringify(JSON.parse(playground.source)));
    assert.equal(await bodies(other), JSON.stringify(JSON.parse(source)));
    await other.context().close();
  },
  {},
  "#car",
);

await check("a recording of the program is opened and scrubbed", async (page) => {
  await page.setInputFiles("#file", recording);
  await page.waitForFunction(() => playground.scene === undefined);
  await pause(page);
  const end = await page.evaluate(() => {
    playground.goTo(playground.length);
    return [playground.length, playground.world.hash()];
  });
  assert.deepEqual(end[1], recordingHash);
  await page.evaluate(() => playground.goTo(10));
  await page.evaluate(() => playground.goTo(playground.length));
  assert.equal(await page.evaluate(() => playground.world.hash()), recordingHash);
});

await check(
  "scenes, recordings and pictures are saved",
  async (page) => {
    await page.waitForFunction(() => playground.at > 20);
    const save = async (label) => {
      await page.click("#save");
      const [download] = await Promise.all([page.waitForEvent("download", { timeout: 120_000 }), page.click(`text=${label}`)]);
      return readFileSync(await download.path());
    };
    assert.match((await save("Save the scene file")).toString(), /"version": 1/);
    assert.equal((await save("Save the recording")).subarray(0, 3).toString(), "tpr");
    assert.equal((await save("Picture (PNG)")).subarray(1, 4).toString(), "PNG");
    assert.equal((await save("Animation (GIF)")).subarray(0, 3).toString(), "GIF");
  },
  { viewport: { width: 480, height: 360 } },
  "#stack",
);

/** Opens a ball without gravity at the middle of the page, and what else there is. */
const openBall = (page, ...more) =>
  page.evaluate((more) => {
    const ball = { position: [0, 0], shapes: [{ shape: { circle: { radius: 0.5 } } }] };
    playground.open(JSON.stringify({ version: 1, gravity: [0, 0], bodies: [ball, ...more] }));
    Object.assign(playground.camera, { x: 0, y: 0, scale: 60 });
  }, more);

const ballAt = (page) => page.evaluate(() => playground.world.body(playground.world.sceneBodies[0]).position.x);
const waitSteps = async (page, steps) => {
  const from = await page.evaluate(() => playground.at);
  await page.waitForFunction((until) => playground.at > until, from + steps);
};

await check(
  "a finger beside a body drags it",
  async (page) => {
    await openBall(page);
    const from = await placeOf(page, 0);
    const client = await page.context().newCDPSession(page);
    const touch = (type, x, y) =>
      client.send("Input.dispatchTouchEvent", { type, touchPoints: type === "touchEnd" ? [] : [{ x, y }] });
    await touch("touchStart", from.x - 40, from.y);
    for (let i = 1; i <= 8; i++) await touch("touchMove", from.x - 40 - 12 * i, from.y);
    await waitSteps(page, 60);
    await touch("touchEnd");
    const x = await ballAt(page);
    assert(x < -1, `it is at ${x}`);
  },
  { hasTouch: true, viewport: { width: 1000, height: 700 } },
);

await check(
  "a sensor in front of a body does not hide it",
  async (page) => {
    await openBall(page, { kind: "static", shapes: [{ shape: { rect: { half_extents: [4, 4] } }, sensor: true }] });
    const from = await placeOf(page, 0);
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(from.x - 150, from.y, { steps: 6 });
    await waitSteps(page, 60);
    await page.mouse.up();
    const x = await ballAt(page);
    assert(x < -1, `it is at ${x}`);
    await page.mouse.click(from.x + 100, from.y + 100);
    assert.equal(await page.evaluate(() => playground.selected.id), await page.evaluate(() => playground.world.sceneBodies[1]));
  },
  { viewport: { width: 1000, height: 700 } },
);

await check("a joint that is cut in the inspector is gone from it", async (page) => {
  await pause(page);
  await page.evaluate(() => {
    const shapes = [{ shape: { circle: { radius: 0.5 } } }];
    const joints = [{ a: 0, b: 1, kind: { distance: { length: 2 } } }];
    playground.open(JSON.stringify({ version: 1, bodies: [{ shapes }, { position: [2, 0], shapes }], joints }), { keepPlaying: true });
    playground.select({ kind: "body", id: playground.world.sceneBodies[0] });
  });
  if (!(await page.isVisible("#panel h2"))) await page.click("#open-inspect");
  assert.equal(await page.locator("summary", { hasText: "Joint: distance" }).count(), 1);
  await page.click("#panel button:has-text('Cut')");
  assert.equal(await page.evaluate(() => playground.world.counts().joints), 0);
  assert.equal(await page.locator("summary", { hasText: "Joint: distance" }).count(), 0);
});

await check("text that is not right yet is there when one comes back to it", async (page) => {
  await page.click("#open-scene");
  await page.click(".cm-content");
  await page.keyboard.press("Control+a");
  await page.keyboard.insertText('{ "version": 1, "name": "mine", "weight": 3 }');
  await page.waitForSelector(".problem:not([hidden])");
  await page.click("#tab-inspect");
  await page.click("#tab-scene");
  assert.match(await page.textContent(".cm-content"), /"weight": 3/);
  assert.equal(await page.isVisible(".problem"), true);
  await page.click("#tab-inspect");
  await page.evaluate(() => playground.open('{ "version": 1, "name": "other" }'));
  await page.click("#tab-scene");
  assert.match(await page.textContent(".cm-content"), /"name": "other"/);
  assert.equal(await page.isVisible(".problem"), false);
});

await check("where films cannot be recorded that is said", async (page) => {
  for (const without of ["isTypeSupported", "all"]) {
    await page.evaluate((without) => {
      if (without === "all") delete window.MediaRecorder;
      else MediaRecorder.isTypeSupported = () => false;
    }, without);
    await page.click("#save");
    await page.click("text=Film (WebM)");
    await page.waitForSelector(".toast.bad");
    assert.match(await page.textContent(".toast.bad"), /film/);
    await page.waitForSelector(".toast.bad", { state: "detached" });
  }
});

await check(
  "an animation is as fast as the run",
  async (page) => {
    await openBall(page);
    await pause(page);
    const before = await page.evaluate(() => playground.at);
    await page.click("#save");
    await Promise.all([page.waitForEvent("download", { timeout: 120_000 }), page.click("text=Animation (GIF)")]);
    assert.equal((await page.evaluate(() => playground.at)) - before, 4 * 60);
  },
  { viewport: { width: 480, height: 360 } },
);

await check("memory stays flat over 20,000 steps", async (page) => {
  await pause(page);
  const run = (budget, early, steps) =>
    page.evaluate(
      ([budget, early, steps]) => {
        const world = playground.sceneWorld("seed_demo");
        if (budget) world.keepHistory(budget);
        const sizes = [];
        for (let i = 1; i <= steps; i++) {
          world.step();
          // Something goes on all the time.
          if (i % 50 === 0) world.body(world.sceneBodies.at(-1 - (i % 7))).applyImpulseToCenter(0.4, 1);
          if (i === early || i === steps) sizes.push(playground.memory());
        }
        if (budget) sizes.push(world.history.bytes);
        world.free();
        return sizes;
      },
      [budget, early, steps],
    );
  const [early, late] = await run(0, 2000, 20_000);
  assert.equal(late, early, "a world by itself takes no more");
  const budget = 4 * 2 ** 20;
  // The list of steps has just doubled, and does so again in the 32,769th.
  const [full, end, kept] = await run(budget, 18_000, 32_000);
  assert(kept <= budget, `${kept} bytes of history`);
  assert(end - full <= 2 ** 18, `${full} bytes after 18,000 steps, ${end} after 32,000`);
});

await check(
  "marks of what happened, and plots",
  async (page) => {
    await page.waitForFunction(() => playground.at > 240, undefined, { timeout: 120_000 });
    await pause(page);
    assert((await page.evaluate(() => playground.figures.marks.length)) > 0, "something broke, woke or slept");
    await page.click("#open-plot");
    await page.waitForSelector(".u-over");
    await page.evaluate(() => ["contacts", "impulses", "load"].forEach((name) => playground.toggle(name)));
    await page.click("#events");
    await page.waitForTimeout(300);
    await picture(page, "plots");
    await page.click("#menu .entry >> nth=0");
    assert.equal(await page.evaluate(() => playground.at === playground.figures.marks.slice(-40)[0].step), true);
  },
  {},
  "#breaking_bridge",
);

await check("what the doctor finds comes up, with a jump to its step", async (page) => {
  await page.evaluate(() => {
    const box = (half_extents) => [{ shape: { rect: { half_extents } } }];
    const bodies = [
      { kind: "static", shapes: box([10, 1]) },
      { position: [0, 1.1], shapes: box([0.5, 0.5]) },
      { position: [3, 4], shapes: box([0.5, 0.5]) },
    ];
    playground.open(JSON.stringify({ version: 1, bodies }));
  });
  await page.waitForSelector("#finding:not([hidden])");
  await page.waitForFunction(() => playground.at > 30);
  await page.click("#finding");
  await page.waitForSelector("#panel article.finding");
  const found = await page.evaluate(() => playground.health.findings.map(({ code, first_step, bodies }) => ({ code, first_step, bodies })));
  assert.equal(found[0].code, "overlap_at_start");
  assert((await page.evaluate(() => playground.figures.marks)).some((mark) => mark.label === "doctor: overlap at start"));
  await picture(page, "doctor");
  await page.click("#panel article.finding .link >> nth=0");
  assert.deepEqual(await page.evaluate(() => [playground.at, playground.playing]), [found[0].first_step, false]);
  await page.click("#panel article.finding .link >> text=body");
  assert.deepEqual(await page.evaluate(() => playground.selected.id), found[0].bodies[0]);
  // Another future without the cause: what was found stays, and what comes of it anew is added.
  await page.evaluate(() => playground.act((world) => world.body(playground.selected.id).setPosition(0, 5)));
  assert.equal(await page.evaluate(() => playground.health.read().length), 1);
});

await check(
  "a scene is shown as its file says",
  async (page) => {
    const corners = await page.evaluate(() => playground.scene.view.map(([x, y]) => playground.toPage(x, y)));
    const [{ x: left, y: bottom }, { x: right, y: top }] = corners;
    // The room is what the bars and the tools leave.
    assert(left >= 64 && right <= 1280 && top >= 64 && bottom <= 800 - 76, JSON.stringify(corners));
    assert(right - left > 0.9 * (1280 - 64) || bottom - top > 0.9 * (800 - 64 - 76), "and it fills the room");
    await page.waitForFunction(() => playground.at > 60);
    await pause(page);
    await picture(page, "fair");
    // Water is blue; the air above it and the ground below are not.
    const colours = await page.evaluate(() => {
      playground.draw();
      const { canvas } = playground.renderer;
      const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
      copy.drawImage(canvas, 0, 0);
      return [[-14.6, -1.2], [-14.6, 0.5], [-14.6, -4]].map(([x, y]) => {
        const place = playground.toPage(x, y);
        return [...copy.getImageData(place.x * playground.renderer.ratio, place.y * playground.renderer.ratio, 1, 1).data];
      });
    });
    const blue = colours.map(([red, , blue]) => blue - red > 50);
    assert.deepEqual(blue, [true, false, false], JSON.stringify(colours));
  },
  {},
  "#fair",
);

for (const scheme of ["light", "dark"]) {
  await check(
    `the gallery, ${scheme}`,
    async (page) => {
      await page.keyboard.press("g");
      await page.waitForFunction(() => document.querySelector("#gallery").open);
      await page.waitForTimeout(5000);
      await picture(page, `gallery-${scheme}`);
      await page.click("[data-scene=newton_cradle]");
      await page.waitForFunction(() => playground.name === "newton_cradle");
      await page.waitForTimeout(1500);
      await picture(page, `stage-${scheme}`);
    },
    { colorScheme: scheme },
  );
}

await check(
  "a phone: nothing sticks out, a finger drags",
  async (page) => {
    await page.waitForTimeout(800);
    await picture(page, "phone");
    const wide = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
    assert.equal(wide, false);
    for (const id of ["play", "time", "scene", "tool-grab", "open-inspect", "overlays", "share", "save", "ask"]) {
      const box = await page.locator(`#${id}`).boundingBox();
      const inside = box && box.x >= 0 && box.y >= 0 && box.x + box.width <= 390 && box.y + box.height <= 844;
      assert(inside, `${id} is on the screen`);
    }
    const name = page.locator("#scene .name");
    assert.equal(await name.textContent(), "newton cradle");
    assert(await name.evaluate((name) => name.scrollWidth <= name.clientWidth), "the scene's name is not cut");
    const from = await placeOf(page, 1);
    const client = await page.context().newCDPSession(page);
    const touch = (type, x, y) =>
      client.send("Input.dispatchTouchEvent", { type, touchPoints: type === "touchEnd" ? [] : [{ x, y }] });
    await touch("touchStart", from.x, from.y);
    for (let i = 1; i <= 8; i++) await touch("touchMove", from.x - 8 * i, from.y - 14 * i);
    await page.waitForTimeout(500);
    const to = await placeOf(page, 1);
    await touch("touchEnd");
    assert(Math.hypot(to.x - from.x, to.y - from.y) > 15, "the finger moved it");
    // On a slow machine the finger may have missed the ball and moved the view.
    await page.evaluate(() => playground.fit());
    await page.click("#open-inspect");
    await page.waitForTimeout(300);
    await picture(page, "phone-inspector");
    await seenWhole(page);
    // Turned on its side, and back.
    await page.setViewportSize({ width: 844, height: 390 });
    await page.waitForTimeout(300);
    await picture(page, "phone-aside");
    await seenWhole(page);
    const [tools, top, below] = await Promise.all(["#tools", "#top", "#transport"].map((id) => page.locator(id).boundingBox()));
    assert(tools.y >= top.y + top.height && tools.y + tools.height <= below.y, `tools ${JSON.stringify(tools)} are between the bars`);
    await page.setViewportSize({ width: 390, height: 844 });
    await page.click("#panel [title^=Close]");
    await page.waitForTimeout(300);
    await seenWhole(page);
  },
  { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true, deviceScaleFactor: 2 },
  "#newton_cradle",
);

await browser.close();
stop();
process.exit(failed ? 1 : 0);
