"""Descriptions of shapes and joints, in the form of scene files.

A shape takes besides its geometry: ``offset`` (x, y) and ``angle`` in the body's frame; ``density`` (kg/m2),
``friction``, ``restitution``, ``rolling_resistance``, ``tangent_speed`` (m/s); ``category``, ``mask``, ``group``;
``sensor``, ``one_way`` (x, y), ``contact_events``, ``hit_events``, ``user_data``. Lengths are metres, angles radians.
"""

from __future__ import annotations

import math
from typing import Any, Sequence

_MATERIAL = ("density", "friction", "restitution", "rolling_resistance", "tangent_speed")
_FILTER = ("category", "mask", "group")

Description = dict[str, Any]
Vector = Sequence[float]


def _shape(geometry: Description, fields: Description) -> Description:
    fields = {name: value for name, value in fields.items() if value is not None}
    for group, names in (("material", _MATERIAL), ("filter", _FILTER)):
        found = {name: fields.pop(name) for name in names if name in fields}
        if found:
            fields[group] = {**fields.get(group, {}), **found}
    return {"shape": geometry, **fields}


def circle(radius: float, **fields: Any) -> Description:
    """A disk around the shape's origin."""
    return _shape({"circle": {"radius": radius}}, fields)


def box(half_width: float, half_height: float, *, radius: float = 0.0, **fields: Any) -> Description:
    """A box around the shape's origin, its corners rounded outwards by ``radius``."""
    return _shape({"rect": {"half_extents": [half_width, half_height], "radius": radius}}, fields)


def polygon(vertices: Sequence[Vector], *, radius: float = 0.0, **fields: Any) -> Description:
    """A convex polygon: the hull of three to eight points."""
    points = [[float(x), float(y)] for x, y in vertices]
    return _shape({"polygon": {"vertices": points, "radius": radius}}, fields)


def regular(count: int, size: float, *, radius: float = 0.0, **fields: Any) -> Description:
    """A regular polygon; ``size`` from its middle to its corners."""
    return _shape({"regular": {"count": count, "size": size, "radius": radius}}, fields)


def capsule(a: Vector, b: Vector, radius: float, **fields: Any) -> Description:
    """All points within ``radius`` of the line from a to b."""
    return _shape({"capsule": {"a": list(a), "b": list(b), "radius": radius}}, fields)


def segment(a: Vector, b: Vector, **fields: Any) -> Description:
    """A line from a to b without thickness, for static bodies."""
    return _shape({"segment": {"a": list(a), "b": list(b)}}, fields)


def _pair(names: tuple[str, str], values: Vector | None) -> Description | None:
    return None if values is None else dict(zip(names, values, strict=True))


def _joint(kind: Description | str, fields: Description) -> Description:
    softness = _pair(("hertz", "damping_ratio"), fields.pop("softness", None))
    breaks = _pair(("force", "torque"), fields.pop("break_at", None))
    known = {name: value for name, value in fields.items() if value is not None}
    return {"kind": kind, "softness": softness, "break_at": breaks, **known}


def _driven(spring: Vector | None, limits: Vector | None, motor: Vector | None) -> Description:
    return {
        "spring": _pair(("hertz", "damping_ratio"), spring),
        "limits": _pair(("lower", "upper"), limits),
        "motor": _pair(("speed", "max"), motor),
    }


def revolute(
    anchor_a: Vector = (0, 0),
    anchor_b: Vector = (0, 0),
    *,
    spring: Vector | None = None,
    target_angle: float = 0.0,
    limits: Vector | None = None,
    motor: Vector | None = None,
    **fields: Any,
) -> Description:
    """A hinge. Anchors in the bodies' frames; spring (hertz, damping ratio); limits (lower, upper), radians; motor
    (radians a second, greatest torque). Other fields: angle_a, angle_b, collide_connected, softness (hertz,
    damping ratio), break_at (newtons, newton metres), user_data."""
    kind = {"revolute": {"target_angle": target_angle, **_driven(spring, limits, motor)}}
    return _joint(kind, {"anchor_a": anchor_a, "anchor_b": anchor_b, **fields})


def _along(direction: Vector, fields: Description) -> Description:
    angle = math.atan2(direction[1], direction[0])
    return {"angle_a": angle, "angle_b": angle, **fields}


def prismatic(
    direction: Vector,
    anchor_a: Vector = (0, 0),
    anchor_b: Vector = (0, 0),
    *,
    spring: Vector | None = None,
    target: float = 0.0,
    limits: Vector | None = None,
    motor: Vector | None = None,
    **fields: Any,
) -> Description:
    """A slider along a direction of A's frame, for bodies that now have the same angle. Limits and target in metres,
    motor (metres a second, greatest force)."""
    kind = {"prismatic": {"target": target, **_driven(spring, limits, motor)}}
    return _joint(kind, {"anchor_a": anchor_a, "anchor_b": anchor_b, **_along(direction, fields)})


def wheel(
    direction: Vector,
    anchor_a: Vector = (0, 0),
    anchor_b: Vector = (0, 0),
    *,
    spring: Vector | None = None,
    limits: Vector | None = None,
    motor: Vector | None = None,
    **fields: Any,
) -> Description:
    """A wheel B on a suspension of A along a direction of A's frame. Motor (radians a second, greatest torque)."""
    kind = {"wheel": _driven(spring, limits, motor)}
    return _joint(kind, {"anchor_a": anchor_a, "anchor_b": anchor_b, **_along(direction, fields)})


def distance(
    length: float,
    anchor_a: Vector = (0, 0),
    anchor_b: Vector = (0, 0),
    *,
    spring: Vector | None = None,
    limits: Vector | None = None,
    motor: Vector | None = None,
    **fields: Any,
) -> Description:
    """A rod of a length; with spring, limits or motor the distance is free but for what they do."""
    kind = {"distance": {"length": length, **_driven(spring, limits, motor)}}
    return _joint(kind, {"anchor_a": anchor_a, "anchor_b": anchor_b, **fields})


def rope(length: float, anchor_a: Vector = (0, 0), anchor_b: Vector = (0, 0), **fields: Any) -> Description:
    """A rope: the anchors are at most ``length`` apart."""
    return distance(length, anchor_a, anchor_b, limits=(0.0, length), **fields)


def weld(
    anchor_a: Vector = (0, 0),
    anchor_b: Vector = (0, 0),
    *,
    linear: Vector | None = None,
    angular: Vector | None = None,
    **fields: Any,
) -> Description:
    """Glue; ``linear`` and ``angular`` (hertz, damping ratio) make it springy."""
    names = ("hertz", "damping_ratio")
    kind = {"weld": {"linear": _pair(names, linear), "angular": _pair(names, angular)}}
    return _joint(kind, {"anchor_a": anchor_a, "anchor_b": anchor_b, **fields})
