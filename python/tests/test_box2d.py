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
        places = []
        for seed in range(4):
            env.reset(seed=seed)
            action, pilot = np.zeros(4), BipedalWalkerHeuristics()
            for _ in range(150):
                s, r, end, cut, _ = env.step(action)
                if end:
                    break
                action = pilot.step_heuristic(s)
            assert np.isfinite(s).all() and (s[14:] <= 1).all()
            places.append(env.unwrapped.hull.position.x)  # from 4.7 on
        print(max(places))
        """
    )
    assert float(out) > 5.0


def test_a_new_joint_is_put_right_without_a_push():
    out = run(
        """
        b2 = tiny_physics.box2d
        world = b2.b2World(gravity=(0, 0))
        base = world.CreateStaticBody(position=(0, 0))
        arm = world.CreateDynamicBody(
            position=(2, 0.5), fixtures=b2.b2FixtureDef(shape=b2.b2PolygonShape(box=(0.5, 0.1)), density=1)
        )
        joint = world.CreateRevoluteJoint(
            bodyA=base, bodyB=arm, localAnchorB=(-0.5, 0), enableLimit=True, lowerAngle=0.3, upperAngle=0.4
        )
        world.Step(0.02, 180, 60)
        gap = np.hypot(*arm.GetWorldPoint((-0.5, 0)))
        print(gap, joint.angle, np.hypot(*arm.linearVelocity))
        """
    )
    gap, angle, speed = map(float, out.split())
    assert gap < 0.01 and 0.25 < angle < 0.45 and speed < 0.2


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
