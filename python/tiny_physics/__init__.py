"""A small, fast 2D physics engine: worlds by the thousand, the same bits everywhere.

>>> import tiny_physics as tp
>>> world = tp.World(gravity=(0, -9.8))
>>> ground = world.add_body(tp.box(20, 1), kind="static", position=(0, -1))
>>> ball = world.add_body(tp.circle(0.5), position=(0, 4))
>>> world.step(1 / 60, steps=300)
>>> round(ball.position[1], 2)
0.5

Metres, kilograms, seconds, radians anticlockwise; y points up. Bodies, shapes and joints are handles: one that is
removed raises StaleHandleError. `WorldBatch` steps thousands of worlds at once; with Gymnasium installed,
importing this package registers its environments, ``tiny_physics/LunarLander-v0`` and others.
"""

from ._native import (
    Body,
    Character,
    Joint,
    Shape,
    StaleHandleError,
    TaskBatch,
    Tiles,
    World,
    WorldBatch,
    gif,
)
from .describe import (
    box,
    capsule,
    circle,
    distance,
    polygon,
    prismatic,
    regular,
    revolute,
    rope,
    segment,
    weld,
    wheel,
)
from .show import Film

__version__ = "0.1.0"

__all__ = [
    "Body",
    "Character",
    "Film",
    "Joint",
    "Shape",
    "StaleHandleError",
    "TaskBatch",
    "Tiles",
    "World",
    "WorldBatch",
    "box",
    "capsule",
    "circle",
    "distance",
    "gif",
    "polygon",
    "prismatic",
    "regular",
    "revolute",
    "rope",
    "segment",
    "weld",
    "wheel",
]

try:
    import gymnasium as _gymnasium  # noqa: F401
except ImportError:
    pass
else:
    from .environments import register as _register

    _register()
