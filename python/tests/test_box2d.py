"""Gymnasium's own environments on this engine. In processes of their own: the real Box2D may be installed too."""

import subprocess
import sys
import textwrap

import pytest


def run(code: str) -> str:
    head = "import tiny_physics.box2d\ntiny_physics.box2d.install()\nimport gymnasium, numpy as np\n"
    process = subprocess.run(
        [sys.executable, "-c", head + textwrap.dedent(code)], capture_output=True, text=True, timeout=300
    )
    assert process.returncode == 0, process.stderr
    return process.stdout.strip()


def test_the_lander_flies_on_this_engine():
    out = run(
        """
        from gymnasium.envs.box2d import lunar_lander
        assert lunar_lander.Box2D.b2World is tiny_physics.box2d.b2World
        env = gymnasium.make("LunarLander-v3", render_mode="rgb_array")
        scores = []
        for seed in range(8):
            s, _ = env.reset(seed=seed)
            total = 0.0
            while True:
                s, r, end, cut, _ = env.step(lunar_lander.heuristic(env, s))
                total += r
                if end or cut:
                    break
            scores.append(total)
        assert env.render().shape == (400, 600, 3)
        print(sum(score > 200 for score in scores))
        """
    )
    assert int(out) >= 5


@pytest.mark.parametrize("options", ["", ", hardcore=True"])
def test_the_walker_walks_on_this_engine(options):
    out = run(
        f"""
        from gymnasium.envs.box2d.bipedal_walker import BipedalWalkerHeuristics
        env = gymnasium.make("BipedalWalker-v3"{options})
        s, _ = env.reset(seed=1)
        pilot, steps = BipedalWalkerHeuristics(), 0
        while steps < 150:
            s, r, end, cut, _ = env.step(pilot.step_heuristic(s))
            steps += 1
            if end:
                break
        assert np.isfinite(s).all() and (s[14:] <= 1).all()
        print(env.unwrapped.hull.position.x)
        """
    )
    assert float(out) > 4.0


def test_the_car_drives_on_this_engine():
    out = run(
        """
        env = gymnasium.make("CarRacing-v3")
        env.reset(seed=1)
        total = 0.0
        for _ in range(60):
            s, r, end, cut, _ = env.step(np.array([0.0, 0.3, 0.0]))
            total += r
        print(env.unwrapped.tile_visited_count, np.hypot(*env.unwrapped.car.hull.linearVelocity))
        """
    )
    tiles, speed = map(float, out.split())
    assert tiles > 5 and speed > 10


def test_what_is_missing_is_named():
    out = run(
        """
        world = tiny_physics.box2d.b2World()
        try:
            world.CreateDynamicBody(colour="red")
        except TypeError as error:
            print(error)
        """
    )
    assert "colour" in out
