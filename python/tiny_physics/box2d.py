"""The part of pybox2d's interface that Gymnasium's own environments use, on this engine.

>>> import tiny_physics.box2d
>>> tiny_physics.box2d.install()  # before Gymnasium's environments are imported
>>> import gymnasium
>>> env = gymnasium.make("LunarLander-v3")

After `install()`, ``import Box2D`` and ``from Box2D.b2 import ...`` give this module. It is opt-in, and no more than
that part: static, kinematic and dynamic bodies, polygons, circles and edges, revolute joints, contact listeners (called
after the step, not within it), ray casts. What pybox2d has beyond that is refused by its name. Velocity iterations
become solver iterations of each substep.
"""

from __future__ import annotations

import math
import sys
import types
from typing import Any, Iterator

from . import _native
from . import describe as _describe
from ._box2d_shapes import (
    FixtureFilter,
    b2CircleShape,
    b2EdgeShape,
    b2Filter,
    b2FixtureDef,
    b2PolygonShape,
    b2Transform,
    b2Vec2,
    field,
    lacks,
    through,
)

#: Velocity iterations of Box2D that one solver iteration stands for: Gymnasium's 180 become 4.
_ITERATIONS_PER_ITERATION = 45
_MOST_ITERATIONS = 8
#: Substeps of a step. Gymnasium's walker falls as often as on Box2D with 4, seldom with 8, always with 2.
_SUBSTEPS = 4
#: Metres and radians by which a new joint may be off; rounds to put it right, and the most radians of one.
_LOOSE = 0.005
_LOOSE_ANGLE = math.radians(2.0)
_ROUNDS = 60
_MOST_TURN = math.radians(8.0)
#: Kinds of bodies, as pybox2d numbers them.
b2_staticBody, b2_kinematicBody, b2_dynamicBody = 0, 1, 2
_KINDS = ("static", "kinematic", "dynamic")


@lacks("massData", "next", "type")
class b2Fixture:
    """A shape of a body. Attributes of your own may be set on it."""

    def __init__(self, body: "b2Body", inner: _native.Shape, definition: b2FixtureDef) -> None:
        self.body, self._inner = body, inner
        self.shape, self.userData = definition.shape._copy(), definition.userData

    sensor = through("sensor", bool, "Does it only sense?")
    isSensor = sensor
    density = field("material", "density", float, "The mass of its body follows at once.")
    friction = field("material", "friction", float, "Of its contacts, too, that there are.")
    restitution = field("material", "restitution", float, "Of its contacts, too, that there are.")

    @property
    def filterData(self) -> b2Filter:
        """Its filter; what is set on that acts from the next step on."""
        return FixtureFilter(self._inner)

    @filterData.setter
    def filterData(self, value: b2Filter) -> None:
        self._inner.filter = value._describe()


@lacks("contacts", "joints", "localCenter", "massData", "next")
class b2Body:
    """A body. Attributes of your own may be set on it."""

    def __init__(self, world: "b2World", inner: _native.Body) -> None:
        self.world, self._inner = world, inner
        self.fixtures: list[b2Fixture] = []
        self.userData: Any = None
        self._turns = inner.angle

    @property
    def position(self) -> b2Vec2:
        return b2Vec2(self._inner.position)

    @position.setter
    def position(self, value: Any) -> None:
        self._inner.position = value

    @property
    def angle(self) -> float:
        """Radians; it counts turns, of less than a half in a step."""
        off = (self._inner.angle - self._turns + math.pi) % math.tau - math.pi
        self._turns += off
        return self._turns

    @angle.setter
    def angle(self, value: float) -> None:
        self._inner.angle = self._turns = float(value)

    def _from_center(self, point: Any) -> tuple[float, float]:
        """A point of its frame, from its center of mass."""
        x, y = self._inner.to_local(self._inner.center)
        return (float(point[0]) - x, float(point[1]) - y)

    @property
    def worldCenter(self) -> b2Vec2:
        return b2Vec2(self._inner.center)

    @property
    def linearVelocity(self) -> b2Vec2:
        return b2Vec2(self._inner.velocity)

    @linearVelocity.setter
    def linearVelocity(self, value: Any) -> None:
        self._inner.velocity = value

    @property
    def angularVelocity(self) -> float:
        return self._inner.angular_velocity

    @angularVelocity.setter
    def angularVelocity(self, value: float) -> None:
        self._inner.angular_velocity = value

    @property
    def mass(self) -> float:
        return self._inner.mass

    @property
    def inertia(self) -> float:
        """About its origin."""
        x, y = self._from_center((0.0, 0.0))
        return self._inner.inertia + self._inner.mass * (x * x + y * y)

    awake = through("awake", bool, "Is it awake?")
    active = through("enabled", bool, "Does it take part?")
    bullet = through("bullet", bool, "Kept and given back; it changes nothing.")
    gravityScale = through("gravity_scale", float, "Factor on the world's gravity.")
    sleepingAllowed = through("can_sleep", bool, "May it fall asleep?")

    @property
    def fixedRotation(self) -> bool:
        """Is it kept from turning? It stops turning when that is set."""
        return self._inner.locks["rotation"]

    @fixedRotation.setter
    def fixedRotation(self, value: bool) -> None:
        self._inner.locks = {**self._inner.locks, "rotation": bool(value)}
        if value:
            self._inner.angular_velocity = 0.0

    @property
    def linearDamping(self) -> float:
        return self._inner.damping[0]

    @linearDamping.setter
    def linearDamping(self, value: float) -> None:
        self._inner.damping = (value, self._inner.damping[1])

    @property
    def angularDamping(self) -> float:
        return self._inner.damping[1]

    @angularDamping.setter
    def angularDamping(self, value: float) -> None:
        self._inner.damping = (self._inner.damping[0], value)

    @property
    def type(self) -> int:
        """`b2_staticBody`, `b2_kinematicBody` or `b2_dynamicBody`."""
        return _KINDS.index(self._inner.kind)

    @type.setter
    def type(self, value: int) -> None:
        self._inner.kind = _KINDS[value]
        self.world._note_type(self)

    @property
    def transform(self) -> b2Transform:
        return b2Transform(self._inner.position, self._inner.rotation)

    def ApplyForceToCenter(self, force: Any, wake: bool = True) -> None:
        self.world._forces.append((self._inner.apply_force, (force,)))

    def ApplyForce(self, force: Any, point: Any, wake: bool = True) -> None:
        self.world._forces.append((self._inner.apply_force, (force, point)))

    def ApplyTorque(self, torque: float, wake: bool = True) -> None:
        self.world._forces.append((self._inner.apply_torque, (torque,)))

    def ApplyLinearImpulse(self, impulse: Any, point: Any, wake: bool = True) -> None:
        self._inner.apply_impulse(impulse, point)

    def ApplyAngularImpulse(self, impulse: float, wake: bool = True) -> None:
        self._inner.apply_angular_impulse(impulse)

    def GetWorldVector(self, vector: Any) -> b2Vec2:
        return b2Transform((0.0, 0.0), self._inner.rotation) * vector

    def GetWorldPoint(self, point: Any) -> b2Vec2:
        return self.transform * point

    def GetLocalPoint(self, point: Any) -> b2Vec2:
        return b2Vec2(self._inner.to_local(point))

    def CreateFixture(self, defn: b2FixtureDef | None = None, **fields: Any) -> b2Fixture:
        definition = b2FixtureDef(**fields) if defn is None else defn
        fixture = b2Fixture(self, self._inner.add_shape(definition._describe()), definition)
        self.fixtures.append(fixture)
        self.world._fixtures[fixture._inner] = fixture
        return fixture

    def CreateEdgeFixture(self, vertices: Any, **fields: Any) -> b2Fixture:
        return self.CreateFixture(shape=b2EdgeShape(vertices=vertices), **fields)

    def CreatePolygonFixture(self, vertices: Any = None, box: Any = None, **fields: Any) -> b2Fixture:
        return self.CreateFixture(shape=b2PolygonShape(vertices=vertices, box=box), **fields)

    def CreateCircleFixture(self, radius: float, pos: Any = (0.0, 0.0), **fields: Any) -> b2Fixture:
        return self.CreateFixture(shape=b2CircleShape(radius=radius, pos=pos), **fields)


class b2RevoluteJointDef:
    """A hinge: anchors in the bodies' frames, limits and motor."""

    __slots__ = (
        *("bodyA", "bodyB", "localAnchorA", "localAnchorB", "referenceAngle", "collideConnected"),
        *("enableMotor", "maxMotorTorque", "motorSpeed", "enableLimit", "lowerAngle", "upperAngle"),
    )

    def __init__(
        self,
        bodyA: b2Body,
        bodyB: b2Body,
        localAnchorA: Any = (0.0, 0.0),
        localAnchorB: Any = (0.0, 0.0),
        referenceAngle: float = 0.0,
        enableMotor: bool = False,
        enableLimit: bool = False,
        maxMotorTorque: float = 0.0,
        motorSpeed: float = 0.0,
        lowerAngle: float = 0.0,
        upperAngle: float = 0.0,
        collideConnected: bool = False,
    ) -> None:
        self.bodyA, self.bodyB = bodyA, bodyB
        self.localAnchorA, self.localAnchorB = localAnchorA, localAnchorB
        self.referenceAngle, self.collideConnected = referenceAngle, collideConnected
        self.enableMotor, self.enableLimit = enableMotor, enableLimit
        self.maxMotorTorque, self.motorSpeed = maxMotorTorque, motorSpeed
        self.lowerAngle, self.upperAngle = lowerAngle, upperAngle

    def _describe(self) -> dict[str, Any]:
        return _describe.revolute(
            list(self.localAnchorA),
            list(self.localAnchorB),
            limits=(self.lowerAngle, self.upperAngle) if self.enableLimit else None,
            motor=(self.motorSpeed, self.maxMotorTorque) if self.enableMotor else None,
            angle_a=float(self.referenceAngle),
            collide_connected=bool(self.collideConnected),
        )


@lacks("active", "anchorA", "anchorB", "next", "type")
class b2RevoluteJoint:
    """A hinge of a world. Attributes of your own may be set on it."""

    def __init__(self, inner: _native.Joint, definition: b2RevoluteJointDef) -> None:
        self._inner = inner
        self.bodyA, self.bodyB = definition.bodyA, definition.bodyB
        self._reference = definition.referenceAngle
        self._limited, self._driven = bool(definition.enableLimit), bool(definition.enableMotor)
        self._limits = (float(definition.lowerAngle), float(definition.upperAngle))
        self._motor = (float(definition.motorSpeed), float(definition.maxMotorTorque))
        self._anchors = [
            body._from_center(anchor)
            for body, anchor in (
                (definition.bodyA, definition.localAnchorA),
                (definition.bodyB, definition.localAnchorB),
            )
        ]

    def _tighten(self, places: "dict[b2Body, _Place]") -> bool:
        """Turns and moves its bodies so that the angle is within the limits, then the anchors together; lighter bodies
        more. Was it right before?"""
        a, b = places[self.bodyA], places[self.bodyB]
        turn = 0.0
        if self._limited:
            angle, (lower, upper) = b.angle - a.angle - self._reference, self._limits
            turn = min(0.0, angle - lower + _LOOSE_ANGLE) + max(0.0, angle - upper - _LOOSE_ANGLE)
            inverse = a.inv_inertia + b.inv_inertia
            share = max(-_MOST_TURN, min(turn, _MOST_TURN)) / inverse if inverse > 0.0 else 0.0
            a.angle += a.inv_inertia * share
            b.angle -= b.inv_inertia * share
        (ax, ay), (bx, by) = a.arm(self._anchors[0]), b.arm(self._anchors[1])
        x, y = b.x + bx - a.x - ax, b.y + by - a.y - ay
        inverse = a.inv_mass + b.inv_mass
        xx = inverse + a.inv_inertia * ay * ay + b.inv_inertia * by * by
        yy = inverse + a.inv_inertia * ax * ax + b.inv_inertia * bx * bx
        xy = -a.inv_inertia * ax * ay - b.inv_inertia * bx * by
        det = xx * yy - xy * xy
        if det > 0.0:
            push = ((yy * x - xy * y) / det, (xx * y - xy * x) / det)
            a.move(push, (ax, ay))
            b.move((-push[0], -push[1]), (bx, by))
        return turn == 0.0 and math.hypot(x, y) < _LOOSE

    @property
    def angle(self) -> float:
        """Radians; it counts turns, as those of the bodies do."""
        return self.bodyB.angle - self.bodyA.angle - self._reference

    @property
    def speed(self) -> float:
        return self._inner.angular_speed

    @property
    def motorEnabled(self) -> bool:
        """Does the motor drive it?"""
        return self._driven

    @motorEnabled.setter
    def motorEnabled(self, value: bool) -> None:
        if bool(value) != self._driven:
            self._renew(motor=_motor(self._motor) if value else None)
            self._driven = bool(value)

    @property
    def motorSpeed(self) -> float:
        return self._motor[0]

    @motorSpeed.setter
    def motorSpeed(self, value: float) -> None:
        self._drive(float(value), self._motor[1])

    @property
    def maxMotorTorque(self) -> float:
        return self._motor[1]

    @maxMotorTorque.setter
    def maxMotorTorque(self, value: float) -> None:
        self._drive(self._motor[0], float(value))

    def _drive(self, speed: float, torque: float) -> None:
        if (speed, torque) != self._motor:
            if self._driven:
                self._inner.set_motor(speed, torque)
            self._motor = (speed, torque)

    @property
    def limitEnabled(self) -> bool:
        """Do the limits hold?"""
        return self._limited

    @limitEnabled.setter
    def limitEnabled(self, value: bool) -> None:
        self._limit(bool(value), self._limits)

    @property
    def limits(self) -> tuple[float, float]:
        """Least and greatest angle, radians."""
        return self._limits

    @limits.setter
    def limits(self, value: Any) -> None:
        lower, upper = value
        self._limit(self._limited, (float(lower), float(upper)))

    @property
    def lowerLimit(self) -> float:
        return self._limits[0]

    @lowerLimit.setter
    def lowerLimit(self, value: float) -> None:
        self.limits = (value, self._limits[1])

    @property
    def upperLimit(self) -> float:
        return self._limits[1]

    @upperLimit.setter
    def upperLimit(self, value: float) -> None:
        self.limits = (self._limits[0], value)

    def _limit(self, limited: bool, limits: tuple[float, float]) -> None:
        if (limited, limits) != (self._limited, self._limits):
            if limited or self._limited:
                self._renew(limits={"lower": limits[0], "upper": limits[1]} if limited else None)
            self._limited, self._limits = limited, limits

    def _renew(self, **fields: Any) -> None:
        """Changes fields of its kind; the engine refuses those that make no sense."""
        description = self._inner.description
        kind = {**description["kind"]["revolute"], **fields}
        self._inner.description = {**description, "kind": {"revolute": kind}}


def _motor(motor: tuple[float, float]) -> dict[str, float]:
    return {"speed": motor[0], "max": motor[1]}


class b2Contact:
    """Two fixtures that begin or end to touch."""

    def __init__(self, fixtureA: b2Fixture, fixtureB: b2Fixture) -> None:
        self.fixtureA, self.fixtureB = fixtureA, fixtureB


class _Place:
    """Center of mass and angle of a body, and how easily they change."""

    def __init__(self, body: b2Body) -> None:
        self.body = body
        (self.x, self.y), self.angle = body._inner.center, body.angle
        mass, inertia = body._inner.mass, body._inner.inertia
        moves = body._inner.kind == "dynamic"
        self.inv_mass = 1.0 / mass if moves and mass > 0.0 else 0.0
        self.inv_inertia = 1.0 / inertia if moves and inertia > 0.0 else 0.0

    def arm(self, point: tuple[float, float]) -> tuple[float, float]:
        """A point of the body, from its center of mass, turned as the body is."""
        (x, y), c, s = point, math.cos(self.angle), math.sin(self.angle)
        return (c * x - s * y, s * x + c * y)

    def move(self, push: tuple[float, float], arm: tuple[float, float]) -> None:
        self.x += self.inv_mass * push[0]
        self.y += self.inv_mass * push[1]
        self.angle += self.inv_inertia * (arm[0] * push[1] - arm[1] * push[0])

    def give(self) -> None:
        """Puts the body there."""
        x, y = self.arm(self.body._from_center((0.0, 0.0)))
        self.body.angle, self.body.position = self.angle, (self.x + x, self.y + y)


class b2ContactListener:
    """Derive from it, and give an instance to a world."""

    def BeginContact(self, contact: b2Contact) -> None:
        """Two fixtures began to touch."""

    def EndContact(self, contact: b2Contact) -> None:
        """Two fixtures no longer touch."""


class b2RayCastCallback:
    """Derive from it and define ReportFixture(fixture, point, normal, fraction)."""

    def ReportFixture(
        self, fixture: b2Fixture, point: b2Vec2, normal: b2Vec2, fraction: float
    ) -> float:
        """-1 goes on as if it were not there, 0 ends, a fraction cuts the ray there, 1 goes on."""
        raise NotImplementedError


@lacks("autoClearForces", "contactFilter", "contactManager", "contacts", "continuousPhysics")
@lacks("destructionListener", "renderer", "subStepping", "warmStarting")
class b2World:
    """A world of bodies. The larger of two restitutions counts, as in Box2D."""

    def __init__(
        self, gravity: Any = (0.0, -10.0), doSleep: bool = True, contactListener: Any = None
    ) -> None:
        settings = {"sleep": bool(doSleep), "substeps": _SUBSTEPS, "restitution_mix": "max"}
        self._inner = _native.World(gravity, settings)
        self._fixtures: dict[_native.Shape, b2Fixture] = {}
        self._iterations = 1
        self._forces: list[tuple[Any, tuple[Any, ...]]] = []
        self._fresh: list[b2RevoluteJoint] = []
        # Pairs of shapes of which BeginContact was told last; in the order in which they came.
        self._touching: dict[tuple[_native.Shape, _native.Shape], None] = {}
        self._moving: dict[b2Body, None] = {}
        self.contactListener = contactListener
        self.bodies: list[b2Body] = []
        self.joints: list[b2RevoluteJoint] = []

    @property
    def gravity(self) -> b2Vec2:
        return b2Vec2(self._inner.gravity)

    @gravity.setter
    def gravity(self, value: Any) -> None:
        self._inner.gravity = value

    def _create(self, kind: str, fixtures: Any, shapes: Any, fields: dict[str, Any]) -> b2Body:
        place = {
            "position": list(fields.pop("position", (0.0, 0.0))),
            "angle": float(fields.pop("angle", 0.0)),
            "velocity": list(fields.pop("linearVelocity", (0.0, 0.0))),
            "angular_velocity": float(fields.pop("angularVelocity", 0.0)),
            "linear_damping": float(fields.pop("linearDamping", 0.0)),
            "angular_damping": float(fields.pop("angularDamping", 0.0)),
            "bullet": bool(fields.pop("bullet", False)),
            "gravity_scale": float(fields.pop("gravityScale", 1.0)),
            "locks": {"rotation": bool(fields.pop("fixedRotation", False))},
            "can_sleep": bool(fields.pop("allowSleep", True)),
            "awake": bool(fields.pop("awake", True)),
            "enabled": bool(fields.pop("active", True)),
        }
        data = fields.pop("userData", None)
        if fields:
            raise TypeError(f"there is no field {next(iter(fields))!r} of a body here")
        body = b2Body(self, self._inner.add_body(kind=kind, **place))
        body.userData = data
        self.bodies.append(body)
        self._note_type(body)
        for definition in _list(fixtures):
            body.CreateFixture(definition)
        for shape in _list(shapes):
            body.CreateFixture(shape=shape)
        return body

    def CreateStaticBody(self, fixtures: Any = None, shapes: Any = None, **fields: Any) -> b2Body:
        return self._create("static", fixtures, shapes, fields)

    def CreateDynamicBody(self, fixtures: Any = None, shapes: Any = None, **fields: Any) -> b2Body:
        return self._create("dynamic", fixtures, shapes, fields)

    def CreateKinematicBody(self, fixtures: Any = None, shapes: Any = None, **fields: Any) -> b2Body:
        return self._create("kinematic", fixtures, shapes, fields)

    def _note_type(self, body: b2Body) -> None:
        """Keeps the list of bodies whose turns are counted."""
        self._moving.pop(body, None)
        if body.type != b2_staticBody:
            self._moving[body] = None

    def DestroyBody(self, body: b2Body) -> None:
        """Removes a body with its joints; what it touched is told, while it is still there."""
        gone = [joint for joint in self.joints if body in (joint.bodyA, joint.bodyB)]
        self.joints = [joint for joint in self.joints if joint not in gone]
        self._fresh = [joint for joint in self._fresh if joint not in gone]
        self._forces = [(call, args) for call, args in self._forces if call.__self__ != body._inner]
        self._part({fixture._inner for fixture in body.fixtures})
        for fixture in body.fixtures:
            self._fixtures.pop(fixture._inner, None)
        self._moving.pop(body, None)
        self.bodies.remove(body)
        body._inner.remove()

    def _part(self, shapes: set[_native.Shape]) -> None:
        """Tells that nothing touches these shapes any more."""
        ended = [pair for pair in self._touching if not shapes.isdisjoint(pair)]
        for pair in ended:
            del self._touching[pair]
        self._tell(ended, [])

    def CreateJoint(self, definition: b2RevoluteJointDef) -> b2RevoluteJoint:
        a, b = definition.bodyA._inner, definition.bodyB._inner
        inner = self._inner.add_joint(a, b, definition._describe())
        joint = b2RevoluteJoint(inner, definition)
        self.joints.append(joint)
        self._fresh.append(joint)
        return joint

    def CreateRevoluteJoint(self, **fields: Any) -> b2RevoluteJoint:
        return self.CreateJoint(b2RevoluteJointDef(**fields))

    def DestroyJoint(self, joint: b2RevoluteJoint) -> None:
        self.joints.remove(joint)
        self._fresh = [fresh for fresh in self._fresh if fresh is not joint]
        joint._inner.remove()

    def Step(self, timeStep: float, velocityIterations: int, positionIterations: int) -> None:
        wanted = -(-int(velocityIterations) // _ITERATIONS_PER_ITERATION)
        wanted = max(1, min(wanted, _MOST_ITERATIONS))
        if wanted != self._iterations:
            self._inner.settings = {**self._inner.settings, "iterations": wanted}
            self._iterations = wanted
        self._settle()
        for call, args in self._forces:
            call(*args)
        self._forces.clear()
        self._inner.step(float(timeStep))
        for body in self._moving:
            body.angle  # Counts its turns.
        self._tell(*self._changes())

    def _settle(self) -> None:
        """Puts the bodies of new joints together: Gymnasium's robots begin in parts half a metre apart. That gives
        nothing a velocity, and asks not what the bodies touch."""
        fresh, self._fresh = self._fresh, []
        places = {body: _Place(body) for joint in fresh for body in (joint.bodyA, joint.bodyB)}
        if all([joint._tighten(places) for joint in fresh]):
            return
        for _ in range(_ROUNDS):
            if all([joint._tighten(places) for joint in fresh]):
                break
        for place in places.values():
            place.give()

    def ClearForces(self) -> None:
        """Forces last one step; this drops those of the next."""
        self._forces.clear()

    def _changes(self) -> tuple[list[Any], list[Any]]:
        """Pairs of shapes that no longer touch, and that began to, in the last step."""
        events, touching = self._inner.events(), self._touching
        ended = [pair for pair in events["contact_end"] + events["sensor_end"] if pair in touching]
        begun = list(events["sensor_begin"])
        for pair in ended:
            del touching[pair]
        # Events of contacts tell of what is about to touch, too, up to 2 cm away.
        for contact in self._inner.contacts():
            pair = contact["shapes"]
            touches = any(gap <= 0 or push > 0 for _, gap, push, _ in contact["points"])
            if touches and pair not in touching:
                begun.append(pair)
            elif not touches and pair in touching:
                del touching[pair]
                ended.append(pair)
        return ended, begun

    def _tell(self, ended: list[Any], begun: list[Any]) -> None:
        for pair in ended:
            self._call("EndContact", pair)
        for pair in begun:
            self._touching[pair] = None
            self._call("BeginContact", pair)

    def _call(self, name: str, pair: tuple[_native.Shape, _native.Shape]) -> None:
        """Tells the listener of a pair; one that has lost a body meanwhile is passed over."""
        fixtures = [self._fixtures.get(shape) for shape in pair]
        if None in fixtures:
            self._touching.pop(pair, None)
        elif self.contactListener is not None:
            getattr(self.contactListener, name)(b2Contact(*fixtures))  # type: ignore[arg-type]

    def RayCast(self, callback: b2RayCastCallback, point1: Any, point2: Any) -> None:
        way = (point2[0] - point1[0], point2[1] - point1[1])
        reach = 1.0
        for hit in self._inner.ray_cast_all(point1, way):
            if hit["fraction"] > reach:
                return
            fixture = self._fixtures[hit["shape"]]
            point, normal = b2Vec2(hit["point"]), b2Vec2(hit["normal"])
            answer = callback.ReportFixture(fixture, point, normal, hit["fraction"])
            if answer == 0.0:
                return
            if answer > 0.0:
                reach = min(reach, answer)


def _list(value: Any) -> Iterator[Any]:
    if value is None:
        return iter(())
    return iter(value) if isinstance(value, (list, tuple)) else iter((value,))


_SHORT = {
    "vec2": b2Vec2,
    "transform": b2Transform,
    "polygonShape": b2PolygonShape,
    "edgeShape": b2EdgeShape,
    "circleShape": b2CircleShape,
    "filter": b2Filter,
    "fixtureDef": b2FixtureDef,
    "fixture": b2Fixture,
    "body": b2Body,
    "revoluteJointDef": b2RevoluteJointDef,
    "revoluteJoint": b2RevoluteJoint,
    "contact": b2Contact,
    "contactListener": b2ContactListener,
    "rayCastCallback": b2RayCastCallback,
    "world": b2World,
}


def install() -> None:
    """Makes ``import Box2D`` give this module. Raises RuntimeError where the real one is loaded already."""
    loaded = sys.modules.get("Box2D")
    if loaded is not None and getattr(loaded, "b2World", None) is not b2World:
        raise RuntimeError("Box2D is imported already: call tiny_physics.box2d.install() before")
    module, short = types.ModuleType("Box2D"), types.ModuleType("Box2D.b2")
    for number, name in enumerate(_KINDS):
        setattr(short, f"{name}Body", number)
        setattr(module, f"b2_{name}Body", number)
    for name, value in _SHORT.items():
        setattr(short, name, value)
        setattr(module, value.__name__, value)
    module.b2 = short  # type: ignore[attr-defined]
    module.__path__ = []  # type: ignore[attr-defined]
    sys.modules["Box2D"], sys.modules["Box2D.b2"] = module, short
