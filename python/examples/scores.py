"""Scores of Gymnasium's own heuristics over many seeds.

    python examples/scores.py [native|compat|box2d] [lander|continuous|walker] [--seeds 100]

`native` is this package's environment, `compat` Gymnasium's own file on this engine, `box2d` the same file on Box2D.
"""

from __future__ import annotations

import argparse

import gymnasium
import numpy as np

NATIVE = {
    "lander": "tiny_physics/LunarLander-v0",
    "continuous": "tiny_physics/LunarLanderContinuous-v0",
    "walker": "tiny_physics/BipedalWalker-v0",
}


def make(engine: str, task: str) -> gymnasium.Env:
    """The environment of a task on an engine."""
    if engine == "native":
        return gymnasium.make(NATIVE[task])
    if task == "walker":
        return gymnasium.make("BipedalWalker-v3")
    return gymnasium.make("LunarLander-v3", continuous=task == "continuous")


def episode(env: gymnasium.Env, task: str, seed: int) -> tuple[float, float]:
    """Score and last reward of one episode under Gymnasium's heuristic."""
    from gymnasium.envs.box2d import bipedal_walker, lunar_lander

    walker = bipedal_walker.BipedalWalkerHeuristics()
    seen, _ = env.reset(seed=seed)
    action = np.zeros(4)
    total = 0.0
    while True:
        if task != "walker":
            action = lunar_lander.heuristic(env, seen)
        seen, reward, ended, cut, _ = env.step(action)
        total += reward
        if ended or cut:
            return total, reward
        if task == "walker":
            action = walker.step_heuristic(seen)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("engine", choices=["native", "compat", "box2d"])
    parser.add_argument("task", choices=list(NATIVE))
    parser.add_argument("--seeds", type=int, default=100)
    words = parser.parse_args()
    if words.engine != "box2d":
        import tiny_physics.box2d

        tiny_physics.box2d.install()
    env = make(words.engine, words.task)
    if words.engine == "native":
        env.unwrapped.continuous = words.task == "continuous"
    results = np.array([episode(env, words.task, seed) for seed in range(words.seeds)])
    scores, last = results.T
    error = scores.std(ddof=1) / np.sqrt(len(scores))
    ends = f"{(last == 100).sum()} landed, {(last == -100).sum()} crashed"
    print(f"{words.engine} {words.task}: {scores.mean():.1f} +- {error:.1f} (standard error), {ends} of {len(scores)}")


if __name__ == "__main__":
    main()
