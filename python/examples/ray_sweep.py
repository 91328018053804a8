"""A design search with Ray: which arch of blocks stands up to a shaken ground?

    python examples/ray_sweep.py [--runs 10000] [--workers 2] [--address auto] [--out sweep]

Each run builds a tower by its parameters (drawn from the run's number alone), shakes the ground under it and
measures what is left. Runs are dealt out in chunks; a chunk is done when its file `sweep/chunk-00042.parquet` is there,
under its final name at once, so a chunk counts once however often it was begun. Workers that die are started
again and their chunks dealt out anew; started again after any end, the search goes on where it was. The same runs
give the same table on any number of workers: the last lines print a hash of it. Without --address a cluster
starts on this machine; with one (`auto`, or `ray://host:10001`) the search joins that.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import time
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

import tiny_physics as tp

FIELDS = ["width", "height", "friction", "density", "shake"]
LOW = np.array([0.2, 0.1, 0.2, 0.5, 0.5])
HIGH = np.array([0.6, 0.4, 0.9, 4.0, 4.0])


def design(run: int) -> np.ndarray:
    """The parameters of a run: width and height of the blocks, friction, density, shaking (m/s2)."""
    return np.random.default_rng([7, run]).uniform(LOW, HIGH)


def tower(parameters: np.ndarray, blocks: int = 8) -> tuple[tp.World, tp.Body, list[tp.Body]]:
    """A tower of blocks on a plate that can be shaken."""
    width, height, friction, density, _ = map(float, parameters)
    world = tp.World()
    plate = world.add_body(tp.box(5, 0.5, friction=friction), kind="kinematic", position=(0, -0.5))
    block = tp.box(width, height, friction=friction, density=density)
    places = [(0.0, height * (2 * i + 1)) for i in range(blocks)]
    return world, plate, [world.add_body(block, position=place) for place in places]


def measure(run: int) -> dict[str, float]:
    """Shakes the tower of a run for three seconds: the part of its height that is left, and how far its top drifted."""
    parameters = design(run)
    world, plate, blocks = tower(parameters)
    before = blocks[-1].position[1]
    for step in range(180):
        plate.velocity = (float(parameters[4]) * 0.1 * np.sin(0.3 * step), 0.0)
        world.step(1 / 60)
    x, y = blocks[-1].position
    hash_ = world.state_hash() & (2**63 - 1)
    return {"run": run, **dict(zip(FIELDS, parameters)), "left": y / before, "drift": abs(x), "hash": hash_}


def write_chunk(folder: Path, chunk: int, runs: range) -> int:
    """Does the runs of a chunk and writes its file; the name appears only when all of it is there."""
    table = pa.Table.from_pylist([measure(run) for run in runs])
    part = folder / f".chunk-{chunk:05}.{os.getpid()}"
    pq.write_table(table, part)
    part.rename(chunk_file(folder, chunk))
    return chunk


def chunk_file(folder: Path, chunk: int) -> Path:
    return folder / f"chunk-{chunk:05}.parquet"


def collect(folder: Path, chunks: int) -> pa.Table:
    """All results, by run. Raises ValueError where one is missing or there twice."""
    table = pa.concat_tables([pq.read_table(chunk_file(folder, chunk)) for chunk in range(chunks)])
    runs = table.column("run").to_numpy()
    if not np.array_equal(runs, np.arange(len(runs))):
        raise ValueError("runs are missing or there twice")
    return table


def digest(table: pa.Table) -> str:
    """A hash of every number in the table."""
    state = hashlib.sha256()
    for name in table.column_names:
        state.update(name.encode())
        state.update(np.ascontiguousarray(table.column(name).to_numpy()).tobytes())
    return state.hexdigest()[:16]


def search(folder: Path, work: dict[int, range], workers: int, address: str | None, kill: bool) -> None:
    """Deals chunks out to workers until all are done."""
    import ray

    options = {"address": address} if address else {"num_cpus": workers, "include_dashboard": False}
    ray.init(logging_level="ERROR", log_to_driver=False, **options)

    @ray.remote(num_cpus=1, max_restarts=-1, max_task_retries=-1)
    class Worker:
        def pid(self) -> int:
            return os.getpid()

        def run(self, chunk: int, runs: range) -> int:
            if chunk_file(folder, chunk).exists():
                return chunk
            return write_chunk(folder, chunk, runs)

    crew = [Worker.remote() for _ in range(workers)]
    waiting, done = list(work.items()), 0
    busy = {crew[i].run.remote(*waiting.pop(0)): i for i in range(min(workers, len(waiting)))}
    while busy:
        (ready,), _ = ray.wait(list(busy), num_returns=1)
        who = busy.pop(ready)
        ray.get(ready)
        done += 1
        show(done, len(work))
        if kill and done == max(1, len(work) // 3):
            os.kill(ray.get(crew[0].pid.remote()), 9)
            print("\nkilled a worker", flush=True)
        if waiting:
            busy[crew[who].run.remote(*waiting.pop(0))] = who
    ray.shutdown()


def show(done: int, of: int) -> None:
    """A bar of progress."""
    filled = 40 * done // of
    print(f"\r[{'#' * filled}{'.' * (40 - filled)}] {done} of {of} chunks", end="", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=10_000)
    parser.add_argument("--chunk", type=int, default=100, help="runs of a chunk")
    parser.add_argument("--workers", type=int, default=2, help="0 does it in this process, without Ray")
    parser.add_argument("--address", help="a cluster to join")
    parser.add_argument("--out", type=Path, default=Path("sweep"))
    parser.add_argument("--kill", action="store_true", help="kill a worker on the way, to see that nothing is lost")
    words = parser.parse_args()
    folder = words.out.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    starts = range(0, words.runs, words.chunk)
    chunks = {i: range(s, min(s + words.chunk, words.runs)) for i, s in enumerate(starts)}
    work = {i: runs for i, runs in chunks.items() if not chunk_file(folder, i).exists()}
    print(f"{len(chunks) - len(work)} of {len(chunks)} chunks are there already")
    began = time.perf_counter()
    if words.workers == 0:
        for done, (chunk, runs) in enumerate(work.items(), 1):
            write_chunk(folder, chunk, runs)
            show(done, len(work))
    elif work:
        search(folder, work, words.workers, words.address, words.kill)
    seconds = time.perf_counter() - began
    table = collect(folder, len(chunks))
    pq.write_table(table, folder / "all.parquet")
    best = table.sort_by([("left", "descending"), ("drift", "ascending")]).slice(0, 3).to_pylist()
    print(f"\n{table.num_rows} runs, {seconds:.1f} s; hash {digest(table)}; the three that held best:")
    for row in best:
        print("  " + ", ".join(f"{name} {row[name]:.3g}" for name in ["run", *FIELDS, "left", "drift"]))


if __name__ == "__main__":
    main()
