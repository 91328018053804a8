"""The interface of pybox2d by itself: what Gymnasium's environments do not use of it, too."""

import math

import pytest

from tiny_physics import box2d as b2

DT = 1 / 60


def step(world: b2.b2World, steps: int = 1) -> None:
    for _ in range(steps):
        world.Step(DT, 8, 3)


def ball_on_ground(**fixture) -> tuple[b2.b2World, b2.b2Body, b2.b2Body]:
    """A ball of half a metre, a metre above plain ground."""
    world = b2.b2World()
    ground = world.CreateStaticBody(fixtures=b2.b2FixtureDef(shape=b2.b2PolygonShape(box=(20, 1))))
    ball = world.CreateDynamicBody(
        position=(0, 2.5),
        fixtures=b2.b2FixtureDef(shape=b2.b2CircleShape(radius=0.5), density=1, **fixture),
    )
    return world, ground, ball


def floating(**fields) -> tuple[b2.b2World, b2.b2Body]:
    """A ball without gravity."""
    world = b2.b2World(gravity=(0, 0))
    shape = b2.b2FixtureDef(shape=b2.b2CircleShape(radius=0.5), density=1)
    return world, world.CreateDynamicBody(fixtures=shape, **fields)


def hinge(**fields) -> tuple[b2.b2World, b2.b2RevoluteJoint]:
    """A ball on a hinge through its middle, without gravity."""
    world, ball = floating()
    base = world.CreateStaticBody()
    return world, world.CreateRevoluteJoint(bodyA=base, bodyB=ball, **fields)


class Counter(b2.b2ContactListener):
    """Counts what touches each body, as a game does with its ground."""

    def __init__(self) -> None:
        super().__init__()
        self.touching: dict[b2.b2Body, int] = {}

    def _count(self, contact: b2.b2Contact, change: int) -> None:
        for fixture in (contact.fixtureA, contact.fixtureB):
            self.touching[fixture.body] = self.touching.get(fixture.body, 0) + change

    def BeginContact(self, contact: b2.b2Contact) -> None:
        self._count(contact, 1)

    def EndContact(self, contact: b2.b2Contact) -> None:
        self._count(contact, -1)


def test_the_larger_restitution_counts():
    world, _, ball = ball_on_ground(restitution=0.8)
    fastest = 0.0
    for _ in range(60):
        step(world)
        fastest = max(fastest, ball.linearVelocity.y)
    assert fastest == pytest.approx(0.8 * math.sqrt(2 * 10 * 1), rel=0.1)


def test_damping_can_be_set():
    world, ball = floating(linearVelocity=(1, 0), angularVelocity=1)
    ball.linearDamping, ball.angularDamping = 2, 3
    step(world, 60)
    assert (ball.linearDamping, ball.angularDamping) == (2, 3)
    assert ball.linearVelocity.x == pytest.approx(math.exp(-2), rel=0.05)
    assert ball.angularVelocity == pytest.approx(math.exp(-3), rel=0.05)


def test_a_rotation_can_be_fixed():
    world, ball = floating()
    ball.angularVelocity = 2
    ball.fixedRotation = True
    assert ball.angularVelocity == 0
    ball.ApplyAngularImpulse(1)
    assert ball.fixedRotation and ball.angularVelocity == 0
    ball.fixedRotation = False
    ball.ApplyAngularImpulse(1)
    assert ball.angularVelocity > 0


def test_gravity_scale_activity_and_type_can_be_set():
    world, _, ball = ball_on_ground()
    ball.gravityScale = 0
    step(world, 10)
    assert ball.gravityScale == 0 and ball.position.y == 2.5
    ball.gravityScale, ball.active = 1, False
    step(world, 10)
    assert not ball.active and ball.position.y == 2.5
    ball.active, ball.type = True, b2.b2_staticBody
    step(world, 10)
    assert ball.type == b2.b2_staticBody and ball.position.y == 2.5
    ball.type = b2.b2_dynamicBody
    step(world, 10)
    assert ball.position.y < 2.5


def test_sleep_and_bullet_can_be_set():
    world, _, ball = ball_on_ground()
    ball.sleepingAllowed, ball.bullet = False, True
    step(world, 200)
    assert ball.awake and not ball.sleepingAllowed and ball.bullet
    ball.sleepingAllowed = True
    step(world, 100)
    assert not ball.awake


def test_a_body_can_be_made_with_all_these():
    world = b2.b2World()
    body = world.CreateDynamicBody(
        fixedRotation=True, gravityScale=0.5, active=False, allowSleep=False, awake=False
    )
    assert body.fixedRotation and body.gravityScale == 0.5
    assert not (body.active or body.sleepingAllowed or body.awake)


def test_what_fixtures_are_of_can_be_set():
    world, ground, ball = ball_on_ground()
    fixture = ball.fixtures[0]
    mass = ball.mass
    fixture.friction, fixture.restitution, fixture.density = 0.9, 0.7, 2
    assert (fixture.friction, fixture.restitution, fixture.density) == pytest.approx((0.9, 0.7, 2))
    assert ball.mass == pytest.approx(2 * mass)
    fastest = 0.0
    for _ in range(60):
        step(world)
        fastest = max(fastest, ball.linearVelocity.y)
    assert fastest > 2.0


def test_the_filter_of_a_fixture_can_be_set():
    world, ground, ball = ball_on_ground()
    ball.fixtures[0].filterData = b2.b2Filter(categoryBits=2, maskBits=0)
    assert ball.fixtures[0].filterData.categoryBits == 2
    step(world, 120)
    assert ball.position.y < 0
    world, ground, ball = ball_on_ground()
    ball.fixtures[0].filterData.maskBits = 0
    assert ball.fixtures[0].filterData.maskBits == 0
    step(world, 120)
    assert ball.position.y < 0


def test_the_bits_of_a_definition_can_be_set():
    definition = b2.b2FixtureDef(shape=b2.b2CircleShape(radius=0.5), density=1)
    definition.categoryBits, definition.maskBits, definition.groupIndex = 2, 4, -1
    bits = definition.filter
    assert (bits.categoryBits, bits.maskBits, bits.groupIndex) == (2, 4, -1)
    body = b2.b2World().CreateDynamicBody(fixtures=definition)
    bits = body.fixtures[0].filterData
    assert (bits.categoryBits, bits.maskBits, bits.groupIndex) == (2, 4, -1)


def test_a_speed_does_not_switch_a_motor_on():
    world, joint = hinge(maxMotorTorque=100)
    joint.motorSpeed = 2
    step(world, 30)
    assert not joint.motorEnabled and joint.motorSpeed == 2
    assert joint.bodyB.angularVelocity == 0
    joint.motorEnabled = True
    step(world, 30)
    assert joint.motorEnabled and joint.bodyB.angularVelocity == pytest.approx(2, rel=0.01)
    joint.motorSpeed, joint.maxMotorTorque = -1, 200
    step(world, 30)
    assert joint.bodyB.angularVelocity == pytest.approx(-1, rel=0.01)
    joint.motorEnabled = False
    joint.bodyB.angularVelocity = 3
    step(world, 30)
    assert joint.bodyB.angularVelocity == pytest.approx(3, rel=0.01)


def test_limits_can_be_set():
    world, joint = hinge()
    joint.limits = (-0.5, 0.5)
    joint.bodyB.angularVelocity = 3
    step(world, 30)
    assert not joint.limitEnabled and joint.limits == (-0.5, 0.5) and joint.angle > 1
    world, joint = hinge(enableLimit=True, lowerAngle=-1, upperAngle=1)
    assert joint.limitEnabled and joint.limits == (-1, 1)
    joint.upperLimit, joint.lowerLimit = 0.5, -0.25
    joint.bodyB.angularVelocity = 3
    step(world, 60)
    assert joint.angle == pytest.approx(0.5, abs=0.05)
    joint.limitEnabled = False
    joint.bodyB.angularVelocity = 3
    step(world, 30)
    assert joint.angle > 1
    with pytest.raises(ValueError):
        joint.limits = (1, 0)
        joint.limitEnabled = True


def test_what_pybox2d_has_and_this_lacks_is_refused_by_name():
    world, ball = floating()
    joint = world.CreateRevoluteJoint(bodyA=world.CreateStaticBody(), bodyB=ball)
    for thing, name in (
        (world, "warmStarting"),
        (world, "destructionListener"),
        (ball, "massData"),
        (ball, "mass"),
        (ball.fixtures[0], "massData"),
        (joint, "anchorA"),
        (b2.b2FixtureDef(), "colour"),
        (b2.b2RevoluteJointDef(ball, ball), "enableSpring"),
        (b2.b2Filter(), "maskBit"),
    ):
        with pytest.raises(AttributeError, match=name):
            setattr(thing, name, 1)
    ball.colour, ball.fixtures[0].colour, joint.colour, world.colour = 1, 2, 3, 4
    assert "colour" in ball.__dict__


def test_what_a_destroyed_body_touched_is_told():
    world, ground, ball = ball_on_ground()
    counter = world.contactListener = Counter()
    step(world, 120)
    assert counter.touching == {ground: 1, ball: 1}
    seen = []
    counter.EndContact = lambda contact: (  # type: ignore[method-assign]
        seen.append((contact.fixtureA.body.position, contact.fixtureB.body.position)),
        Counter.EndContact(counter, contact),
    )
    world.DestroyBody(ball)
    assert counter.touching == {ground: 0, ball: 0} and len(seen) == 1
    step(world, 2)
    assert counter.touching == {ground: 0, ball: 0}


def test_what_overlapped_a_sensor_of_a_destroyed_body_is_told():
    for goes in (0, 1):
        world = b2.b2World(gravity=(0, 0))
        counter = world.contactListener = Counter()
        shape = b2.b2CircleShape(radius=0.5)
        zone = world.CreateStaticBody(fixtures=b2.b2FixtureDef(shape=shape, isSensor=True))
        ball = world.CreateDynamicBody(fixtures=b2.b2FixtureDef(shape=shape, density=1))
        step(world, 2)
        assert counter.touching == {zone: 1, ball: 1}
        world.DestroyBody((zone, ball)[goes])
        assert counter.touching == {zone: 0, ball: 0}
        step(world, 2)
        assert counter.touching == {zone: 0, ball: 0}


def test_a_body_that_is_no_longer_active_touches_nothing():
    world, ground, ball = ball_on_ground()
    counter = world.contactListener = Counter()
    step(world, 120)
    ball.active = False
    step(world)
    assert counter.touching == {ground: 0, ball: 0}
    ball.active = True
    step(world)
    assert counter.touching == {ground: 1, ball: 1}


def test_a_box_has_a_place_and_an_angle():
    box = b2.b2PolygonShape(box=(2, 1, (3, 4), math.pi / 2))
    corners = [(4, 2), (4, 6), (2, 6), (2, 2)]
    assert all(a == pytest.approx(b) for a, b in zip(box.vertices, corners))
    world = b2.b2World()
    body = world.CreateStaticBody()
    fixture = body.CreatePolygonFixture(box=(2, 1, (3, 4), 0))
    assert fixture.shape.vertices[0] == (1, 3)
    for box in ((2,), (2, 1, (3, 4)), (2, 1, 3, 4, 0)):
        with pytest.raises(ValueError, match="box"):
            b2.b2PolygonShape(box=box)


def test_angles_count_turns():
    world, joint = hinge(referenceAngle=0.5, enableMotor=True, motorSpeed=5, maxMotorTorque=1000)
    step(world, 120)
    assert joint.bodyB.angle == pytest.approx(10, rel=0.02)
    assert joint.angle == pytest.approx(9.5, rel=0.02)
    joint.motorSpeed = -5
    step(world, 240)
    assert joint.angle == pytest.approx(-10.5, rel=0.03)


def test_a_number_that_is_none_is_refused():
    world, ball = floating()
    with pytest.raises(ValueError):
        ball.linearVelocity = (math.nan, 0)
    with pytest.raises(ValueError):
        ball.angularVelocity = math.nan
