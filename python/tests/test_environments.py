"""Gymnasium environments."""

import copy
import pickle
import warnings

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode

import tiny_physics as tp
from tiny_physics.environments import TASKS, TaskEnv

NAMES = [f"tiny_physics/{name}" for name in TASKS]


@pytest.mark.parametrize("name", NAMES)
def test_gymnasium_finds_nothing_wrong(name):
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=".*(infinity|human|symmetric).*")
        env = gymnasium.make(name, render_mode="rgb_array", disable_env_checker=True)
        check_env(env.unwrapped, skip_render_check=True)
    picture = env.unwrapped.render()
    assert picture.shape == (400, 600, 3) and picture.std() > 1


@pytest.mark.parametrize("name", NAMES)
def test_a_vector_environment_is_that_many_single_ones(name):
    count = 3
    many = gymnasium.make_vec(name, num_envs=count)
    singles = [gymnasium.make(name) for _ in range(count)]
    seen, _ = many.reset(seed=5)
    for i, env in enumerate(singles):
        assert (env.reset(seed=5 + i)[0] == seen[i]).all()
    many.action_space.seed(1)
    for _ in range(50):
        actions = many.action_space.sample()
        seen, rewards, ends, cuts, _ = many.step(actions)
        for i, env in enumerate(singles):
            expected = env.step(actions[i])
            assert (expected[0] == seen[i]).all()
            assert expected[1:4] == (rewards[i], ends[i], cuts[i])
        if (ends | cuts).any():
            break


@pytest.mark.parametrize("asked, steps", [(3, 3), (600, 500)])
def test_an_episode_can_be_shorter_than_its_task_but_not_longer(asked, steps):
    env = gymnasium.make("tiny_physics/Ragdoll-v0", max_episode_steps=asked)
    env.reset(seed=1)
    for taken in range(1, 700):
        _, _, end, cut, _ = env.step(np.zeros(env.action_space.shape, dtype=np.float32))
        if end or cut:
            break
    assert taken == steps and cut and not end
    with pytest.raises(ValueError, match="500"):
        gymnasium.make_vec("tiny_physics/Ragdoll-v0", 2, max_episode_steps=asked)


def test_a_seed_is_for_the_worlds_too_that_a_mask_leaves_out():
    name = "tiny_physics/LunarLander-v0"
    many, other = gymnasium.make_vec(name, num_envs=2), gymnasium.make_vec(name, num_envs=2)
    first, _ = many.reset(seed=1)
    seen, _ = many.reset(seed=[7, 8], options={"reset_mask": np.array([False, True])})
    assert (seen[0] == first[0]).all() and (seen[1] == other.reset(seed=8)[0][0]).all()
    seen, _ = many.reset(options={"reset_mask": np.array([True, False])})
    assert (seen[0] == other.reset(seed=7)[0][0]).all()


def test_autoreset_modes():
    lander = "tiny_physics/LunarLanderContinuous-v0"
    modes = [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP, AutoresetMode.DISABLED]
    envs = [gymnasium.make_vec(lander, 2, autoreset_mode=mode) for mode in modes]
    for env, mode in zip(envs, modes):
        assert env.metadata["autoreset_mode"] == mode
        env.reset(seed=3)
    fall = np.full((2, 2), -1.0, dtype=np.float32)
    while True:
        (seen, _, ends, _, _), (first, _, _, _, info), (kept, *_) = [env.step(fall) for env in envs]
        if ends.any():
            break
    i = int(np.flatnonzero(ends)[0])
    assert (info["final_obs"][i] == seen[i]).all() and info["_final_obs"][i]
    assert (kept[i] == seen[i]).all() and (first[i] != seen[i]).any()
    begun, rewards, ends, _, _ = envs[0].step(fall)
    assert rewards[i] == 0 and not ends[i] and (begun[i] == first[i]).all()
    with pytest.raises(ValueError, match="episode"):
        envs[2].step(fall)
    again, _ = envs[2].reset(options={"reset_mask": np.array([i == 0, i == 1])})
    assert (again[i] == first[i]).all() and (again[1 - i] == kept[1 - i]).all()


def test_threads_and_copies_change_nothing():
    runs = []
    for threads, keep in ((1, True), (2, False)):
        env = gymnasium.make_vec(
            "tiny_physics/BipedalWalker-v0", 8, threads=threads, copy=keep
        )
        env.reset(seed=1)
        env.action_space.seed(2)
        for _ in range(80):
            seen, *_ = env.step(env.action_space.sample())
        runs.append((seen.tobytes(), env.unwrapped.batch.state_hashes().tolist()))
    assert runs[0] == runs[1]


@pytest.mark.parametrize("way", [copy.deepcopy, lambda env: pickle.loads(pickle.dumps(env))])
def test_a_copy_of_an_environment_goes_on_the_same(way):
    env = TaskEnv("lunar_lander", continuous=True, enable_wind=True)
    env.reset(seed=4)
    action = np.array([0.5, 0.7], dtype=np.float32)
    for _ in range(20):
        env.step(action)
    other = way(env)
    for _ in range(20):
        (a, *rest), (b, *more) = env.step(action), other.step(action)
        assert (a == b).all() and rest == more


def test_bad_arguments_are_named():
    with pytest.raises(ValueError, match="warp"):
        TaskEnv("lunar_lander", warp=True)
    with pytest.raises(ValueError, match="no task"):
        TaskEnv("chess")
    with pytest.raises(ValueError, match="gravity"):
        TaskEnv("lunar_lander", gravity=3.0)
    with pytest.raises(ValueError, match="render mode"):
        TaskEnv("lunar_lander", render_mode="ascii")
    env = TaskEnv("lunar_lander")
    env.reset(seed=1)
    with pytest.raises(ValueError, match=r"actions\[0\]"):
        env.step(7)


@pytest.mark.parametrize("name, shape", [("BipedalWalker-v0", (4,)), ("LunarLander-v0", ())])
def test_actions_have_the_shape_of_their_space(name, shape):
    one = gymnasium.make(f"tiny_physics/{name}", disable_env_checker=True)
    many = gymnasium.make_vec(f"tiny_physics/{name}", num_envs=3)
    for env, right in [(one, shape), (many, (3, *shape))]:
        env.reset(seed=1)
        env.step(np.zeros(right))
        env.step(np.zeros(right).tolist())
        env.step(np.zeros((*right, 2))[..., 0])
        for wrong in {right[::-1], (*right, 1), (1, *right), (int(np.prod(right)),)} - {right}:
            with pytest.raises(ValueError, match="shape"):
                env.unwrapped.step(np.zeros(wrong))


def test_spaces_say_what_comes():
    for task, options, _ in TASKS.values():
        batch = tp.TaskBatch(task, 2, threads=1, **options)
        assert len(batch.spec["names"]) == batch.observations.shape[1]
        assert batch.memory > 0


def lander_pilot(s: np.ndarray, env) -> int:
    from gymnasium.envs.box2d.lunar_lander import heuristic

    return heuristic(env, s)
