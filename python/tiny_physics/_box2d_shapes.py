"""Vectors, shapes, filters and definitions of fixtures for `tiny_physics.box2d`, and what its properties are made of."""

from __future__ import annotations

import math
from typing import Any, Callable, Iterable

from . import _native
from . import describe as _describe


def through(name: str, kind: Callable[[Any], Any], doc: str) -> property:
    """An attribute of what the engine holds."""

    def read(self: Any) -> Any:
        return getattr(self._inner, name)

    def write(self: Any, value: Any) -> None:
        setattr(self._inner, name, kind(value))

    return property(read, write, doc=doc)


def field(of: str, name: str, kind: Callable[[Any], Any], doc: str) -> property:
    """A field of a description that the engine holds."""

    def read(self: Any) -> Any:
        return getattr(self._inner, of)[name]

    def write(self: Any, value: Any) -> None:
        setattr(self._inner, of, {**getattr(self._inner, of), name: kind(value)})

    return property(read, write, doc=doc)


def lacks(*names: str) -> Callable[[type], type]:
    """Refuses attributes that pybox2d has and this interface lacks: set, they would have no effect."""

    def mark(of: type) -> type:
        for name in names:
            setattr(of, name, _missing(f"there is no {name!r} of {of.__name__} here"))
        return of

    return mark


def _missing(reason: str) -> property:
    def refuse(self: Any, value: Any = None) -> None:
        raise AttributeError(reason)

    return property(refuse, refuse)


class b2Vec2(tuple):
    """Two numbers: x and y, with the arithmetic of vectors."""

    __slots__ = ()

    def __new__(cls, x: Any = 0.0, y: float | None = None) -> "b2Vec2":
        if y is None:
            x, y = (x, 0.0) if isinstance(x, (int, float)) else x
        return super().__new__(cls, (float(x), float(y)))

    @property
    def x(self) -> float:
        return self[0]

    @property
    def y(self) -> float:
        return self[1]

    @property
    def length(self) -> float:
        return math.hypot(*self)

    def __add__(self, other: Iterable[float]) -> "b2Vec2":  # type: ignore[override]
        x, y = other
        return b2Vec2(self[0] + x, self[1] + y)

    __radd__ = __add__

    def __sub__(self, other: Iterable[float]) -> "b2Vec2":
        x, y = other
        return b2Vec2(self[0] - x, self[1] - y)

    def __mul__(self, factor: float) -> "b2Vec2":  # type: ignore[override]
        return b2Vec2(self[0] * factor, self[1] * factor)

    __rmul__ = __mul__  # type: ignore[assignment]

    def __truediv__(self, factor: float) -> "b2Vec2":
        return b2Vec2(self[0] / factor, self[1] / factor)

    def __neg__(self) -> "b2Vec2":
        return b2Vec2(-self[0], -self[1])


class b2Transform:
    """A place and an angle: ``transform * point`` is the point in the world."""

    def __init__(self, position: Iterable[float], rotation: tuple[float, float]) -> None:
        self.position = b2Vec2(position)
        self.c, self.s = rotation

    @property
    def angle(self) -> float:
        return math.atan2(self.s, self.c)

    def __mul__(self, point: Iterable[float]) -> b2Vec2:
        x, y = point
        return self.position + (self.c * x - self.s * y, self.s * x + self.c * y)


class b2PolygonShape:
    """A convex polygon of up to eight vertices, or ``box=(half width, half height)``, also with center and angle:
    ``box=(half width, half height, (x, y), radians)``."""

    def __init__(self, vertices: Any = None, box: Any = None) -> None:
        if box is not None:
            vertices = _corners(box)
        self.vertices = [] if vertices is None else vertices

    @property
    def vertices(self) -> list[tuple[float, float]]:
        return self._vertices

    @vertices.setter
    def vertices(self, value: Any) -> None:
        self._vertices = [(float(x), float(y)) for x, y in value]

    def _copy(self) -> "b2PolygonShape":
        return type(self)(vertices=self.vertices)

    def _describe(self) -> dict[str, Any]:
        return _describe.polygon(self.vertices)


def _corners(box: Any) -> list[b2Vec2]:
    if len(box) not in (2, 4):
        raise ValueError(f"a box has two numbers, or center and angle too: not {len(box)} values")
    w, h, center, angle = (*box, (0.0, 0.0), 0.0)[:4]
    place = b2Transform(center, (math.cos(angle), math.sin(angle)))
    return [place * corner for corner in ((-w, -h), (w, -h), (w, h), (-w, h))]


class b2EdgeShape(b2PolygonShape):
    """A line between two vertices."""

    def _describe(self) -> dict[str, Any]:
        return _describe.segment(*self.vertices)


class b2CircleShape:
    """A disk."""

    def __init__(self, radius: float = 0.0, pos: Any = (0.0, 0.0)) -> None:
        self.radius, self.pos = float(radius), b2Vec2(pos)

    def _copy(self) -> "b2CircleShape":
        return b2CircleShape(self.radius, self.pos)

    def _describe(self) -> dict[str, Any]:
        return {**_describe.circle(self.radius), "offset": list(self.pos)}


class b2Filter:
    """Category and mask bits, and a group."""

    __slots__ = ("categoryBits", "maskBits", "groupIndex")

    def __init__(self, categoryBits: int = 1, maskBits: int = 0xFFFF, groupIndex: int = 0) -> None:
        self.categoryBits, self.maskBits, self.groupIndex = categoryBits, maskBits, groupIndex

    def _describe(self) -> dict[str, int]:
        return {"category": self.categoryBits, "mask": self.maskBits, "group": self.groupIndex}


class FixtureFilter(b2Filter):
    """That of a fixture: what is set on it acts."""

    __slots__ = ("_inner",)

    def __init__(self, inner: _native.Shape) -> None:
        self._inner = inner

    categoryBits = field("filter", "category", int, "What it is.")
    maskBits = field("filter", "mask", int, "What it collides with.")
    groupIndex = field("filter", "group", int, "Positive: its members collide; negative: they do not.")


def _bits(name: str, doc: str) -> property:
    """A number of the filter of a definition."""

    def read(self: Any) -> int:
        return getattr(self.filter, name)

    def write(self: Any, value: int) -> None:
        setattr(self.filter, name, value)

    return property(read, write, doc=doc)


class b2FixtureDef:
    """A shape with density, friction, restitution and filter."""

    __slots__ = ("shape", "density", "friction", "restitution", "isSensor", "userData", "filter")

    categoryBits = _bits("categoryBits", "What it is.")
    maskBits = _bits("maskBits", "What it collides with.")
    groupIndex = _bits("groupIndex", "Positive: its members collide; negative: they do not.")

    def __init__(
        self,
        shape: Any = None,
        density: float = 0.0,
        friction: float = 0.2,
        restitution: float = 0.0,
        isSensor: bool = False,
        categoryBits: int = 1,
        maskBits: int = 0xFFFF,
        groupIndex: int = 0,
        userData: Any = None,
        **more: Any,
    ) -> None:
        if more:
            raise TypeError(f"there is no field {next(iter(more))!r} of a fixture here")
        self.shape, self.density, self.friction = shape, density, friction
        self.restitution, self.isSensor, self.userData = restitution, isSensor, userData
        self.filter = b2Filter(categoryBits, maskBits, groupIndex)

    def _describe(self) -> dict[str, Any]:
        return {
            **self.shape._describe(),
            "material": {
                "density": float(self.density),
                "friction": float(self.friction),
                "restitution": float(self.restitution),
            },
            "filter": self.filter._describe(),
            "sensor": bool(self.isSensor),
            "contact_events": True,
        }
