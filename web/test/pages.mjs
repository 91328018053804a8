// Opens the pages that install.sh has built: what Vite made, and a plain one, with a worker.
import assert from "node:assert/strict";
import { launch, pageOf } from "./browser.mjs";
import { serve } from "./serve.mjs";

const browser = await launch();
for (const [name, folder] of [["Vite", process.argv[2]], ["a plain page", process.argv[3]]]) {
  const { address, stop } = await serve(folder);
  const page = await pageOf(browser);
  await page.goto(address);
  await page.waitForFunction(() => globalThis.result !== undefined);
  assert.equal(await page.evaluate(() => globalThis.result), "1.50");
  console.log(`ok      ${name}`);
  if (name === "a plain page") {
    const hash = await page.evaluate(
      () =>
        new Promise((done, failed) => {
          const worker = new Worker("./worker.js", { type: "module" });
          worker.onmessage = ({ data }) => done(data);
          worker.onerror = failed;
        }),
    );
    assert.match(hash, /^[0-9a-f]{16}$/);
    console.log("ok      a web worker");
  }
  assert.deepEqual(page.problems.filter((problem) => !problem.includes("favicon") && !problem.includes("404")), []);
  stop();
}
await browser.close();
