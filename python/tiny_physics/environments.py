"""Gymnasium environments: one world each, or many at once in one call.

>>> import gymnasium, tiny_physics
>>> env = gymnasium.make("tiny_physics/LunarLander-v0")
>>> observation, info = env.reset(seed=1)
>>> many = gymnasium.make_vec("tiny_physics/LunarLander-v0", num_envs=64)
>>> observations, infos = many.reset(seed=1)
>>> observations.shape
(64, 8)

Environments ``LunarLander-v0``, ``LunarLanderContinuous-v0``, ``BipedalWalker-v0``, ``BipedalWalkerHardcore-v0``,
``Driving-v0``, ``Stacking-v0`` and ``Ragdoll-v0``, each under ``tiny_physics/``. The rules run in Rust; a step of a vector
environment is one call for all worlds. An episode has at most the steps of its task: ``max_episode_steps`` of
``gymnasium.make`` can make it shorter, not longer, and that of ``gymnasium.make_vec`` can be no other number. World i of a vector environment that is reset with seed s does what a
single one does that is reset with seed s + i.
"""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from . import _native

_PI = float(np.pi)
_LANDER = [2.5, 2.5, 10.0, 10.0, 2 * _PI, 10.0, 1.0, 1.0]
_LEG = [_PI, 5.0, _PI, 5.0, 5.0]
_WALKER = [_PI, 5.0, 5.0, 5.0, *_LEG, *_LEG, *([1.0] * 10)]
#: Numbers that are never negative, of the bounds above.
_NOT_NEGATIVE = {"lunar_lander": (6, 7), "bipedal_walker": (8, 13)}
_BOUNDS = {"lunar_lander": _LANDER, "bipedal_walker": _WALKER}

#: Environments: name, task, options, steps of an episode.
TASKS: dict[str, tuple[str, dict[str, Any], int]] = {
    "LunarLander-v0": ("lunar_lander", {}, 1000),
    "LunarLanderContinuous-v0": ("lunar_lander", {"continuous": True}, 1000),
    "BipedalWalker-v0": ("bipedal_walker", {}, 1600),
    "BipedalWalkerHardcore-v0": ("bipedal_walker", {"hardcore": True}, 2000),
    "Driving-v0": ("driving", {}, 1000),
    "Stacking-v0": ("stacking", {}, 900),
    "Ragdoll-v0": ("ragdoll", {}, 500),
}


def register() -> None:
    """Tells Gymnasium of the environments. Importing tiny_physics does it."""
    for name, (task, options, steps) in TASKS.items():
        identity = f"tiny_physics/{name}"
        if identity in gymnasium.registry:
            continue
        gymnasium.register(
            id=identity,
            entry_point="tiny_physics.environments:TaskEnv",
            vector_entry_point="tiny_physics.environments:TaskVectorEnv",
            kwargs={"task": task, **options},
            max_episode_steps=steps,
        )


def _observation_space(task: str, width: int) -> spaces.Box:
    high = np.array(_BOUNDS.get(task, [np.inf] * width), dtype=np.float32)
    low = -high
    for index in _NOT_NEGATIVE.get(task, ()):
        low[index] = 0.0
    return spaces.Box(low, high, dtype=np.float32)


def _action_space(spec: dict[str, Any]) -> spaces.Space:
    if spec["choices"] is not None:
        return spaces.Discrete(spec["choices"])
    return spaces.Box(-1.0, 1.0, (spec["action"],), dtype=np.float32)


def _flat(actions: Any, space: spaces.Space) -> np.ndarray:
    """Actions of the shape of their space, one after the other."""
    given = np.asarray(actions, dtype=np.float32)
    if given.shape != space.shape:
        raise ValueError(f"actions has the shape {given.shape}; needed is {space.shape}")
    return np.ascontiguousarray(given).reshape(-1)


class TaskEnv(gymnasium.Env[np.ndarray, Any]):
    """One world of a task."""

    metadata = {"render_modes": ["rgb_array", "human"], "render_fps": 50}

    def __init__(self, task: str, render_mode: str | None = None, **options: Any) -> None:
        """task: as `TaskBatch` takes it. render_mode: None, "rgb_array" or "human" (a pygame window)."""
        if render_mode is not None and render_mode not in self.metadata["render_modes"]:
            raise ValueError(f"there is no render mode {render_mode!r}")
        self.render_mode = render_mode
        self.task, self.options = task, options
        self.batch = _native.TaskBatch(task, 1, threads=1, autoreset="disabled", **options)
        spec = self.batch.spec
        self.metadata = {**self.metadata, "render_fps": round(1.0 / spec["dt"])}
        self.observation_space = _observation_space(task, spec["observation"])
        self.action_space = _action_space(spec)
        self._window: Any = None
        self._begun = False

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[np.ndarray, dict[str, Any]]:
        """Begins an episode: that of `seed`, else the next of the last seed."""
        super().reset(seed=seed)
        if seed is not None:
            self.batch.seed([seed])
        elif not self._begun:
            self.batch.seed([int(self.np_random.integers(2**63))])
        self._begun = True
        self.batch.reset()
        if self.render_mode == "human":
            self.render()
        return self.batch.observations[0].copy(), {}

    def step(self, action: Any) -> tuple[np.ndarray, float, bool, bool, dict[str, Any]]:
        """One step of the task. Raises ValueError where the action makes no sense or the episode is over."""
        reward, terminated, truncated = self.batch.step(_flat(action, self.action_space))
        if self.render_mode == "human":
            self.render()
        seen = self.batch.observations[0].copy()
        return seen, float(reward[0]), bool(terminated[0]), bool(truncated[0]), {}

    def render(self) -> np.ndarray | None:
        """A picture: bytes, shape (400, 600, 3); in the mode "human" it goes to a window."""
        if self.render_mode is None:
            return None
        picture = self.batch.draw(0)
        if self.render_mode == "rgb_array":
            return picture
        self._show(picture)
        return None

    def _show(self, picture: np.ndarray) -> None:
        import pygame

        height, width, _ = picture.shape
        if self._window is None:
            pygame.display.init()
            self._window = (pygame.display.set_mode((width, height)), pygame.time.Clock())
        screen, clock = self._window
        screen.blit(pygame.surfarray.make_surface(picture.swapaxes(0, 1)), (0, 0))
        pygame.event.pump()
        pygame.display.flip()
        clock.tick(self.metadata["render_fps"])

    def close(self) -> None:
        """Closes the window."""
        if self._window is not None:
            import pygame

            pygame.display.quit()
            self._window = None

    def __getstate__(self) -> dict[str, Any]:
        state = {**self.__dict__, "_window": None}
        return {**state, "batch": self.batch.to_bytes()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self.batch = _native.TaskBatch(self.task, 1, threads=1, autoreset="disabled", **self.options)
        self.batch.restore_bytes(state["batch"])


class TaskVectorEnv(VectorEnv):
    """Many worlds of a task, stepped in one call on all cores."""

    def __init__(
        self,
        task: str,
        num_envs: int = 1,
        *,
        threads: int = 0,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        copy: bool = True,
        render_mode: str | None = None,
        max_episode_steps: int | None = None,
        **options: Any,
    ) -> None:
        """threads: 0 is one a core; results do not depend on it. copy: False gives the same array of observations each
        time, which the next step writes over."""
        mode = AutoresetMode(autoreset_mode)
        name = {
            AutoresetMode.NEXT_STEP: "next_step",
            AutoresetMode.SAME_STEP: "same_step",
            AutoresetMode.DISABLED: "disabled",
        }[mode]
        self.batch = _native.TaskBatch(task, num_envs, threads=threads, autoreset=name, **options)
        spec = self.batch.spec
        if max_episode_steps not in (None, spec["time_limit"]):
            raise ValueError(f"an episode of this task has {spec['time_limit']} steps")
        self.num_envs, self.copy, self.mode = num_envs, copy, mode
        self.render_mode = render_mode
        self.metadata = {
            "autoreset_mode": mode,
            "render_modes": ["rgb_array"],
            "render_fps": round(1.0 / spec["dt"]),
        }
        self.single_observation_space = _observation_space(task, spec["observation"])
        self.single_action_space = _action_space(spec)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._begun = False

    def _observations(self) -> np.ndarray:
        return self.batch.observations.copy() if self.copy else self.batch.observations

    def _seed(self, seed: int | list[int | None] | None) -> None:
        if isinstance(seed, (int, np.integer)):
            self._np_random, self._np_random_seed = gymnasium.utils.seeding.np_random(int(seed))
            self.batch.seed([int(seed) + i for i in range(self.num_envs)])
        elif seed is not None:
            draw = self.np_random.integers
            self.batch.seed([int(draw(2**63)) if one is None else int(one) for one in seed])
        elif not self._begun:
            self.batch.seed([int(s) for s in self.np_random.integers(2**63, size=self.num_envs)])
        self._begun = True

    def reset(
        self,
        *,
        seed: int | list[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[np.ndarray, dict[str, Any]]:
        """Begins episodes: everywhere, or where options["reset_mask"] (bool, shape (num_envs,)) says so.

        Seeds are for all worlds, also those that the mask leaves out: their next episodes draw from them. None in a list
        of seeds stands for a fresh one. Without `seed` every world goes on with its own random numbers."""
        self._seed(seed)
        mask = None if options is None else options.get("reset_mask")
        self.batch.reset(None if mask is None else np.asarray(mask, dtype=bool).tolist())
        return self._observations(), {}

    def step(
        self, actions: Any
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, dict[str, Any]]:
        """One step of all worlds. With AutoresetMode.SAME_STEP, info has "final_obs" where episodes ended."""
        rewards, terminated, truncated = self.batch.step(_flat(actions, self.action_space))
        infos: dict[str, Any] = {}
        if self.mode == AutoresetMode.SAME_STEP and (over := terminated | truncated).any():
            last = np.full(self.num_envs, None, dtype=object)
            for index in np.flatnonzero(over):
                last[index] = self.batch.final_observation(int(index))
            infos = {"final_obs": last, "_final_obs": over, "final_info": {}, "_final_info": over}
        return self._observations(), rewards, terminated, truncated, infos

    def render(self) -> tuple[np.ndarray, ...] | None:
        """A picture of each world: bytes, shape (400, 600, 3)."""
        if self.render_mode != "rgb_array":
            return None
        return tuple(self.batch.draw(index) for index in range(self.num_envs))
