"""Pictures that move."""

from __future__ import annotations

import base64
from pathlib import Path

import numpy as np

from . import _native


class Film:
    """Frames that a notebook shows as an animation, and that can be saved as a GIF.

    >>> import tiny_physics as tp
    >>> world, film = tp.World.scene("bridge"), tp.Film()
    >>> for _ in range(3):
    ...     world.step(1 / 30)
    ...     film.add(world.draw(160, 100))
    >>> len(film)
    3
    """

    def __init__(self, ms: int = 40) -> None:
        """ms: milliseconds a frame; players treat less than 20 as 100."""
        self.ms = ms
        self.frames: list[np.ndarray] = []

    def add(self, frame: np.ndarray) -> None:
        """Adds a frame: bytes, shape (height, width, 3), the size of the first."""
        self.frames.append(np.ascontiguousarray(frame, dtype=np.uint8))

    def __len__(self) -> int:
        return len(self.frames)

    def to_gif(self) -> bytes:
        """The GIF file. Raises ValueError where there is no frame or their sizes differ."""
        return _native.gif(self.frames, self.ms)

    def save(self, path: str | Path) -> None:
        """Writes the GIF file."""
        Path(path).write_bytes(self.to_gif())

    def _repr_html_(self) -> str:
        data = base64.b64encode(self.to_gif()).decode()
        return f'<img src="data:image/gif;base64,{data}" alt="{len(self)} frames">'
