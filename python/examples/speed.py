"""Steps a CPU-second under random actions, by batch size; beside EnvPool where that is installed.

    python examples/speed.py [--seconds 2] [--sizes 1 16 256 4096] [--tasks lander walker]

Both sides run on one thread, in turns, each turn as long; the figure is the best of the turns by CPU time of this
process, threads of the libraries included.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable

import numpy as np

import tiny_physics as tp

TASKS = {
    "lander": ("lunar_lander", "LunarLander-v3"),
    "walker": ("bipedal_walker", "BipedalWalker-v3"),
}


def actions(task: str, count: int, random: np.random.Generator) -> np.ndarray:
    """Random actions of a batch."""
    if task == "lander":
        return random.integers(0, 4, count)
    return random.uniform(-1, 1, (count, 4)).astype(np.float32)


def ours(task: str, count: int) -> tuple[Callable[[np.ndarray], object], int]:
    """A function that steps our batch, and bytes a world."""
    batch = tp.TaskBatch(TASKS[task][0], count, threads=1)
    return lambda a: batch.step(np.ascontiguousarray(a, dtype=np.float32).ravel()), batch.memory // count


def theirs(task: str, count: int) -> Callable[[np.ndarray], object] | None:
    """A function that steps EnvPool's; None where it is not installed."""
    try:
        import envpool
    except ImportError:
        return None
    env = envpool.make(TASKS[task][1], env_type="gymnasium", num_envs=count, num_threads=1)
    env.reset()
    return env.step


def rate(step: Callable, task: str, count: int, seconds: float, random: np.random.Generator) -> float:
    """Steps a CPU-second over a turn."""
    tries = [actions(task, count, random) for _ in range(16)]
    began, done = time.process_time(), 0
    while (spent := time.process_time() - began) < seconds:
        step(tries[done % 16])
        done += 1
    return done * count / spent


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=2.0)
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--sizes", type=int, nargs="+", default=[1, 16, 256, 4096])
    parser.add_argument("--tasks", nargs="+", choices=list(TASKS), default=list(TASKS))
    words = parser.parse_args()
    for task in words.tasks:
        for count in words.sizes:
            random = np.random.default_rng(1)
            step, size = ours(task, count)
            other = theirs(task, count)
            turns = [
                [rate(s, task, count, words.seconds / words.turns, random) for s in (step, other) if s]
                for _ in range(words.turns)
            ]
            best = np.max(turns, axis=0)
            beside = f", EnvPool {best[1]:9.0f}, ratio {best[0] / best[1]:.2f}" if other else ""
            print(f"{task:7} {count:5} worlds: {best[0]:9.0f} steps a CPU-second{beside}, {size} bytes a world", flush=True)


if __name__ == "__main__":
    main()
