// Prints the golden hashes that a WebAssembly build computes, as `level threads name steps hash`:
// node hashes.mjs module.wasm golden.txt...
import { readFileSync } from "node:fs";

const [, , modulePath, ...tablePaths] = process.argv;
const { instance } = await WebAssembly.instantiate(readFileSync(modulePath), {});
const lines = tablePaths.flatMap((path) => readFileSync(path, "utf8").trim().split("\n"));
lines.forEach((line, index) => {
  const [name, steps] = line.split(" ");
  const hash = BigInt.asUintN(64, instance.exports.golden_hash(index));
  console.log("simd128", 1, name, steps, hash.toString(16).padStart(16, "0"));
});
