// Prints the golden hashes that a WebAssembly build computes: node hashes.mjs module.wasm golden.txt
import { readFileSync } from "node:fs";

const [, , modulePath, tablePath] = process.argv;
const { instance } = await WebAssembly.instantiate(readFileSync(modulePath), {});
const lines = readFileSync(tablePath, "utf8").trim().split("\n");
lines.forEach((line, index) => {
  const [name, steps] = line.split(" ");
  const hash = BigInt.asUintN(64, instance.exports.golden_hash(index));
  console.log(name, steps, hash.toString(16).padStart(16, "0"));
});
