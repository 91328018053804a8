"""Trains the ragdoll to stand while it is shoved about, and shows what came of it.

    python examples/stand.py [--generations 12] [--pairs 24] [--out stand]

An evolution strategy (T. Salimans and others, 2017) with antithetic pairs and ranks: each generation tries `pairs` directions
forwards and backwards, all of them in one batch on all cores. The policy is linear in the observation. Of all generations
the one is kept that scores best on seeds of its own. Writes the
curve (stand.csv, and stand.png where matplotlib is there) and a film of the policy before and after (stand.gif).
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

import tiny_physics as tp


def make_policy(parameters: np.ndarray, width: int, actions: int) -> tuple[np.ndarray, np.ndarray]:
    """Weights (..., actions, width) and offsets (..., actions) of linear policies from flat parameters."""
    weights = parameters[..., : actions * width].reshape(*parameters.shape[:-1], actions, width)
    return weights, parameters[..., actions * width :]


def play(task: str, parameters: np.ndarray, seed: int, threads: int = 0, worlds: int = 4) -> np.ndarray:
    """Mean scores of policies, one a row of `parameters`, over so many worlds each; all policies see the same seeds."""
    policies = np.repeat(parameters, worlds, axis=0).astype(np.float32)
    batch = tp.TaskBatch(task, len(policies), threads=threads, autoreset="next_step")
    spec = batch.spec
    weights, offsets = make_policy(policies, spec["observation"], spec["action"])
    batch.seed([worlds * seed + i for i in range(worlds)] * len(parameters))
    batch.reset()
    scores, alive = np.zeros(len(policies)), np.ones(len(policies), dtype=bool)
    for _ in range(spec["time_limit"]):
        wish = np.einsum("nao,no->na", weights, batch.observations) + offsets
        rewards, ended, cut = batch.step(np.tanh(wish).ravel())
        scores += np.where(alive, rewards, 0.0)
        alive &= ~(ended | cut)
        if not alive.any():
            break
    return scores.reshape(-1, worlds).mean(axis=1)


def ranks(scores: np.ndarray) -> np.ndarray:
    """Places of scores, evenly from -0.5 to 0.5: what is far off counts no more than what is off."""
    places = np.empty(len(scores))
    places[np.argsort(scores, kind="stable")] = np.linspace(-0.5, 0.5, len(scores))
    return places


def train(task: str, generations: int, pairs: int, spread: float = 0.01, rate: float = 0.3, seed: int = 0):
    """Yields (generation, mean score, best score, parameters) after each generation."""
    spec = tp.TaskBatch(task, 1, threads=1).spec
    random = np.random.default_rng(seed)
    center = np.zeros(spec["action"] * (spec["observation"] + 1))
    momentum = np.zeros_like(center)
    for generation in range(generations):
        ways = random.standard_normal((pairs, len(center)))
        tries = np.concatenate([center + spread * ways, center - spread * ways])
        scores = play(task, tries, seed=1000 + generation)
        placed = ranks(scores)
        slope = (placed[:pairs] - placed[pairs:]) @ ways / (pairs * spread)
        momentum = 0.8 * momentum + 0.2 * slope
        center = center + rate * momentum * spread
        yield generation, scores.mean(), scores.max(), center


def film(task: str, parameters: np.ndarray, seed: int, out: tp.Film, frames: int = 100) -> None:
    """Adds one episode to a film, every second step."""
    batch = tp.TaskBatch(task, 1, threads=1, autoreset="next_step")
    spec = batch.spec
    weights, offsets = make_policy(parameters.astype(np.float32), spec["observation"], spec["action"])
    batch.seed([seed])
    batch.reset()
    for _ in range(frames):
        for _ in range(2):
            batch.step(np.tanh(weights @ batch.observations[0] + offsets))
        out.add(batch.draw(0, 300, 200))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--task", default="ragdoll")
    parser.add_argument("--generations", type=int, default=12)
    parser.add_argument("--pairs", type=int, default=24)
    parser.add_argument("--out", type=Path, default=Path("stand"))
    words = parser.parse_args()
    curve, parameters, most = [], None, -np.inf
    for generation, mean, best, center in train(words.task, words.generations, words.pairs):
        (held,) = play(words.task, center[None], seed=1 << 19, worlds=32)
        if held > most:
            parameters, most = center, held
        curve.append((generation, mean, best, held))
        print(f"generation {generation:3}: mean {mean:8.2f}, best {best:8.2f}, center {held:8.2f}", flush=True)
    fresh = 1 << 20
    before, after = play(words.task, np.stack([0 * parameters, parameters]), fresh, worlds=64)
    print(f"score on 64 fresh seeds: {after:.1f}; without training: {before:.1f}")
    np.savetxt(words.out.with_suffix(".csv"), curve, delimiter=",", header="generation,mean,best,center", comments="")
    movie = tp.Film(ms=40)
    film(words.task, np.zeros_like(parameters), fresh, movie)
    film(words.task, parameters, fresh, movie, frames=250)
    movie.save(words.out.with_suffix(".gif"))
    plot(curve, words.out.with_suffix(".png"))


def plot(curve: list[tuple[int, float, float, float]], path: Path) -> None:
    """Draws the curve where matplotlib is there."""
    try:
        from matplotlib import pyplot
    except ImportError:
        return
    generations, means, bests, centers = zip(*curve)
    pyplot.figure(figsize=(6, 3.5))
    pyplot.plot(generations, bests, label="best")
    pyplot.plot(generations, means, label="mean")
    pyplot.plot(generations, centers, label="center, other seeds")
    pyplot.xlabel("generation")
    pyplot.ylabel("score")
    pyplot.legend()
    pyplot.tight_layout()
    pyplot.savefig(path, dpi=120)


if __name__ == "__main__":
    main()
