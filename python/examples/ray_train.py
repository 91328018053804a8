"""Training on many machines with Ray: an evolution strategy whose rollouts run in actors, each a whole batch.

    python examples/ray_train.py [--task ragdoll] [--generations 40] [--workers 2] [--address auto] [--out train]

A generation is a fixed list of tries, cut into shards; a shard's scores follow from the generation and the shard
alone, so the curve is the same on any number of workers. After each generation the state is written beside the
curve (train/state.npz, train/curve.parquet), both under their final names at once: started again, training goes on
where it was. A worker that dies is started again and its shard done anew; scores come in by shard, so none counts
twice. Without --address a cluster starts on this machine.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from stand import play, ranks

import tiny_physics as tp

SPREAD, RATE = 0.01, 0.3


def directions(generation: int, shard: int, pairs: int, size: int) -> np.ndarray:
    """The directions that a shard of a generation tries."""
    return np.random.default_rng([11, generation, shard]).standard_normal((pairs, size))


def score(task: str, center: np.ndarray, generation: int, shard: int, pairs: int) -> np.ndarray:
    """Scores of a shard: its directions forwards, then backwards."""
    ways = directions(generation, shard, pairs, len(center))
    tries = np.concatenate([center + SPREAD * ways, center - SPREAD * ways])
    return play(task, tries, seed=1000 + generation, threads=1)


def advance(center: np.ndarray, momentum: np.ndarray, generation: int, scores: list[np.ndarray]):
    """The next center and momentum from the scores of all shards, in the order of the shards."""
    pairs = len(scores[0]) // 2
    size, shards = len(center), len(scores)
    ways = np.concatenate([directions(generation, shard, pairs, size) for shard in range(shards)])
    placed = ranks(np.concatenate([s[:pairs] for s in scores] + [s[pairs:] for s in scores]))
    half = len(placed) // 2
    slope = (placed[:half] - placed[half:]) @ ways / (half * SPREAD)
    momentum = 0.8 * momentum + 0.2 * slope
    return center + RATE * SPREAD * momentum, momentum


def save(folder: Path, center: np.ndarray, momentum: np.ndarray, curve: list[dict]) -> None:
    """Writes curve and state; a half-written file never has its final name. The state comes last and says how much of
    the curve counts."""
    part = folder / f".part-{os.getpid()}"
    pq.write_table(pa.Table.from_pylist(curve), part)
    part.rename(folder / "curve.parquet")
    with part.open("wb") as file:
        np.savez(file, center=center, momentum=momentum, generations=len(curve))
    part.rename(folder / "state.npz")


def load(folder: Path, size: int) -> tuple[np.ndarray, np.ndarray, list[dict]]:
    """What was saved, else the start."""
    if not (folder / "state.npz").exists():
        return np.zeros(size), np.zeros(size), []
    with np.load(folder / "state.npz") as state:
        done = int(state["generations"])
        curve = pq.read_table(folder / "curve.parquet").slice(0, done).to_pylist()
        return state["center"], state["momentum"], curve


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--task", default="ragdoll")
    parser.add_argument("--generations", type=int, default=40)
    parser.add_argument("--shards", type=int, default=4)
    parser.add_argument("--pairs", type=int, default=8, help="directions of a shard")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--address", help="a cluster to join")
    parser.add_argument("--out", type=Path, default=Path("train"))
    words = parser.parse_args()
    words.out.mkdir(parents=True, exist_ok=True)
    spec = tp.TaskBatch(words.task, 1, threads=1).spec
    center, momentum, curve = load(words.out, spec["action"] * (spec["observation"] + 1))
    import ray

    local = {"num_cpus": words.workers, "include_dashboard": False}
    here = str(Path(__file__).resolve().parent)
    path = {"env_vars": {"PYTHONPATH": os.pathsep.join([here, os.environ.get("PYTHONPATH", "")])}}
    ray.init(
        logging_level="ERROR",
        log_to_driver=False,
        runtime_env=path,
        **({"address": words.address} if words.address else local),
    )

    @ray.remote(num_cpus=1, max_restarts=-1, max_task_retries=-1)
    class Worker:
        def score(self, *shard) -> np.ndarray:
            return score(*shard)

    crew = [Worker.remote() for _ in range(words.workers)]
    for generation in range(len(curve), words.generations):
        sent = ray.put(center)
        shards = range(words.shards)
        scores = ray.get(
            [crew[s % len(crew)].score.remote(words.task, sent, generation, s, words.pairs) for s in shards]
        )
        center, momentum = advance(center, momentum, generation, scores)
        every = np.concatenate(scores)
        curve.append({"generation": generation, "mean": every.mean(), "best": every.max()})
        save(words.out, center, momentum, curve)
        filled = 30 * (generation + 1) // words.generations
        bar = "#" * filled + "." * (30 - filled)
        print(f"\r[{bar}] generation {generation}: mean {every.mean():.2f}, best {every.max():.2f}", end="", flush=True)
    ray.shutdown()
    print(f"\ncenter sums to {center.sum():.17g}")


if __name__ == "__main__":
    main()
