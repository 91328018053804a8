"""Worlds, bodies, shapes, joints, events, queries, saving, drawing."""

import copy
import pickle
import threading

import numpy as np
import pytest

import tiny_physics as tp


def falling() -> tuple[tp.World, tp.Body, tp.Body]:
    world = tp.World()
    ground = world.add_body(tp.box(20, 1, contact_events=True), kind="static", position=(0, -1))
    ball = world.add_body(tp.circle(0.5, density=2.0), position=(0, 4))
    return world, ground, ball


def test_a_ball_falls_and_comes_to_rest():
    world, ground, ball = falling()
    world.step(1 / 60, steps=300)
    assert abs(ball.position[1] - 0.5) < 0.01
    assert ball.mass == pytest.approx(2.0 * np.pi * 0.25, rel=1e-5)
    assert (ground.kind, ball.kind) == ("static", "dynamic")
    assert not ball.awake and world.awake_body_count == 0
    assert world.bodies == [ground, ball] and world.step_count == 300


def test_free_fall_follows_its_formula():
    world = tp.World(gravity=(0, -10))
    body = world.add_body(tp.circle(0.1), position=(0, 100), velocity=(3, 0))
    world.step(1 / 100, steps=100)
    assert body.position == pytest.approx((3.0, 95.0), abs=0.06)
    assert body.velocity == pytest.approx((3.0, -10.0), rel=1e-4)


def test_numpy_numbers_are_numbers():
    world = tp.World(gravity=np.array([0.0, -9.8]))
    body = world.add_body([tp.circle(np.float32(0.5))], position=np.array([1.0, 2.0]))
    body.velocity = np.array([1.0, 0.0], dtype=np.float32)
    assert body.position == (1.0, 2.0) and body.velocity == (1.0, 0.0)


def test_bad_input_is_named():
    world, ground, ball = falling()
    with pytest.raises(ValueError, match="radius"):
        world.add_body(tp.circle(-1.0))
    with pytest.raises(ValueError, match="colour"):
        world.add_body(tp.circle(1.0), colour="red")
    with pytest.raises(ValueError, match="frition"):
        world.add_body(tp.circle(1.0, frition=0.5))
    with pytest.raises(ValueError, match="dt"):
        world.step(float("nan"))
    with pytest.raises(ValueError, match="another world"):
        tp.World().add_joint(ground, ball, tp.revolute())
    with pytest.raises(ValueError, match="two"):
        ball.position = (1, 2, 3)
    ball.remove()
    assert not ball.is_valid
    with pytest.raises(tp.StaleHandleError):
        ball.position
    with pytest.raises(LookupError):
        world.add_joint(ground, ball, tp.revolute())


@pytest.mark.parametrize("wrong", [float("nan"), float("inf"), 1e20])
def test_numbers_that_the_engine_refuses_raise(wrong):
    world, ground, ball = falling()
    before = world.state_hash()
    for name in ("position", "velocity", "damping"):
        with pytest.raises(ValueError):
            setattr(ball, name, (wrong, 0.0))
    for name in ("angular_velocity", "gravity_scale"):
        with pytest.raises(ValueError):
            setattr(ball, name, wrong)
    for push, args in (
        (ball.apply_force, ((wrong, 0.0),)),
        (ball.apply_impulse, ((0.0, 1.0), (wrong, 0.0))),
        (ball.apply_torque, (wrong,)),
        (ball.apply_angular_impulse, (wrong,)),
    ):
        with pytest.raises(ValueError):
            push(*args)
    assert world.state_hash() == before
    if not np.isfinite(wrong):
        with pytest.raises(ValueError):
            ball.angle = wrong
        with pytest.raises(ValueError):
            world.gravity = (0.0, wrong)
        with pytest.raises(ValueError):
            world.ray_cast((wrong, 0.0), (0.0, 1.0))
        with pytest.raises(ValueError):
            world.overlap_box((-1.0, -1.0), (wrong, 1.0))
    ball.velocity = (1.0, 0.0)
    assert ball.velocity == (1.0, 0.0)


def test_locks_and_sleep_of_a_body_can_be_set():
    world, ground, ball = falling()
    ball.locks = {"rotation": True}
    assert ball.locks == {"x": False, "y": False, "rotation": True}
    ball.apply_angular_impulse(1.0)
    assert ball.angular_velocity == 0.0
    assert ball.can_sleep
    ball.can_sleep = False
    world.step(1 / 60, steps=300)
    assert ball.awake and not ball.can_sleep


def test_joints_hold_limit_and_drive():
    world = tp.World(gravity=(0, 0))
    base = world.add_body(kind="static")
    arm = world.add_body(tp.box(1, 0.1), position=(1, 0))
    joint = world.add_joint(base, arm, tp.revolute((0, 0), (-1, 0), motor=(2.0, 500.0), limits=(-1, 1)))
    world.step(1 / 60, steps=20)
    assert joint.angular_speed == pytest.approx(2.0, rel=0.02)
    assert joint.translation == pytest.approx(0.0, abs=1e-3)
    world.step(1 / 60, steps=200)
    assert joint.angle == pytest.approx(1.0, abs=0.02)
    joint.set_motor(-2.0, 500.0)
    world.step(1 / 60, steps=200)
    assert joint.angle == pytest.approx(-1.0, abs=0.02)
    assert joint.bodies == (base, arm) and arm.joints == [joint]
    assert joint.description["kind"]["revolute"]["motor"]["speed"] == -2.0
    rod = world.add_joint(base, arm, tp.distance(2.0, break_at=(1e9, 1e9)))
    assert len(world.joints) == 2
    rod.remove()
    with pytest.raises(tp.StaleHandleError):
        rod.force


def test_joints_are_read_as_they_count():
    world = tp.World(gravity=(0, 0))
    base = world.add_body(kind="static", angle=0.3)
    cart = world.add_body(tp.box(1, 0.1), position=(1, 0), angle=0.3)
    slider = world.add_joint(base, cart, tp.prismatic((1, 0), motor=(2.0, 500.0)))
    world.step(1 / 60, steps=30)
    (bx, by), (ax, ay) = cart.position, base.position
    along = (bx - ax) * np.cos(0.3) + (by - ay) * np.sin(0.3)
    assert slider.translation == pytest.approx(along, abs=1e-4) and along > 1.9
    assert slider.speed == pytest.approx(2.0, rel=0.02)
    assert slider.angular_speed == pytest.approx(0.0, abs=1e-3)
    cart.apply_force((100 * np.cos(0.3), 100 * np.sin(0.3)))
    world.step(1 / 60)
    assert slider.motor_load == pytest.approx(-100.0, rel=0.05)  # It holds back what is pushed ahead.
    # Placed in the world, its angle counts from how the bodies are turned now.
    arm = world.add_body(tp.box(1, 0.1), position=(0, 3), angle=1.1)
    hinge = world.add_joint(base, arm, {"kind": {"revolute": {}}, "anchors_at": [[0, 3], [0, 3]]})
    assert hinge.angle == pytest.approx(0.0, abs=1e-6)
    arm.angular_velocity = -0.5
    world.step(1 / 60, steps=12)
    assert hinge.angle == pytest.approx(-0.1, rel=0.02)
    assert hinge.angular_speed == pytest.approx(-0.5, rel=0.02)


def test_hits_tell_their_impulse_and_masses():
    world = tp.World(gravity=(0, -10))
    ground = world.add_body(tp.box(20, 1), kind="static", position=(0, -1))
    ball = world.add_body(tp.circle(0.5, hit_events=True), position=(0, 4), mass=3.0)
    hits = []
    while not hits:
        world.step()
        hits = world.events()["hits"]
    ((a, b, point, normal, speed, impulse, mass_a, mass_b),) = hits
    assert {(a.body, mass_a), (b.body, mass_b)} == {(ground, 0.0), (ball, 3.0)}
    assert point == pytest.approx((0, 0), abs=0.1) and abs(normal[1]) == pytest.approx(1)
    assert speed == pytest.approx(8.4, abs=0.3) and impulse == pytest.approx(3 * speed, rel=0.05)


def test_a_platform_goes_where_it_is_led():
    world, ground, ball = falling()
    lift = world.add_body(tp.box(2, 0.2), kind="kinematic", position=(8, 2))
    rider = world.add_body(tp.box(0.3, 0.3), position=(8, 2.5))
    for i in range(60):
        lift.set_target((8, 2 + (i + 1) / 60), 0.0, 1 / 60)
        world.step(1 / 60)
    assert lift.position == pytest.approx((8, 3), abs=1e-4)
    assert rider.position == pytest.approx((8, 3.5), abs=0.01)
    lift.set_target((8, 3), angle=0.1)
    assert lift.angular_velocity == pytest.approx(6.0, rel=1e-4)
    with pytest.raises(ValueError):
        lift.set_target((8, 3), dt=0.0)


def test_an_explosion_pushes_away_what_it_sees():
    world = tp.World(gravity=(0, 0))
    right = world.add_body(tp.circle(0.5, category=2), position=(2, 0), mass=2.0)
    left = world.add_body(tp.circle(0.5, category=4), position=(-2, 0), mass=2.0)
    world.explode((0, 0), 5.0, falloff=1.0, impulse_per_metre=10.0, mask=2)
    assert right.velocity == pytest.approx((5, 0)) and left.velocity == (0, 0)
    world.explode((0, 0), 5.0, impulse_per_metre=10.0, exclude=right)
    assert right.velocity == pytest.approx((5, 0)) and left.velocity == pytest.approx((-5, 0))
    with pytest.raises(ValueError):
        world.explode((0, 0), -1.0)


def test_water_carries_what_is_lighter():
    world = tp.World(gravity=(0, -10))
    cork = world.add_body(tp.box(0.5, 0.5, density=250), position=(0, 2))
    stone = world.add_body(tp.box(0.5, 0.5, density=4000), position=(5, 2))
    aside = world.add_body(tp.box(0.5, 0.5, density=250), position=(50, 2))
    for _ in range(1200):
        world.apply_water(area=((-10, -30), (10, 0)))
        world.step()
    assert cork.position[1] == pytest.approx(0.25, abs=0.02)  # a quarter of it is under water
    assert stone.position[1] < -20 and aside.position[1] < -100
    with pytest.raises(ValueError, match="depth"):
        world.apply_water(depth=3)
    with pytest.raises(ValueError):
        world.apply_water(density=float("nan"))


def test_zones_and_wind_push():
    world = tp.World(gravity=(0, 0))
    inside = world.add_body(tp.circle(0.5))
    outside = world.add_body(tp.circle(0.5), position=(9, 0))
    for _ in range(60):
        world.apply_zone({"circle": {"radius": 4}}, {"acceleration": (0, 3)}, position=(0, 2))
        world.step()
    assert inside.velocity == pytest.approx((0, 3), rel=1e-3) and outside.velocity == (0, 0)
    sail = world.add_body(tp.box(0.1, 2), position=(0, 30))
    for _ in range(600):
        sail.apply_wind((5, 0))
        world.step()
    assert 1 < sail.velocity[0] < 5
    with pytest.raises(ValueError):
        world.apply_zone({"circle": {"radius": 4}}, {"gust": 3})


def test_events_tell_what_happened():
    world, ground, ball = falling()
    zone = ground.add_shape(tp.box(5, 1, offset=(0, 3), sensor=True))
    touched, entered = [], []
    for _ in range(120):
        world.step()
        events = world.events()
        touched += events["contact_begin"]
        entered += events["sensor_begin"]
    assert [{shape.body for shape in pair} for pair in touched] == [{ground, ball}]
    assert entered == [(zone, ball.shapes[0])]
    ball.awake = True
    world.step()
    (contact,) = world.contacts()
    assert set(contact["bodies"]) == {ground, ball} and len(contact["points"]) == 1


def test_queries_find_shapes():
    world, ground, ball = falling()
    hit = world.ray_cast((0, 10), (0, -20))
    assert hit["body"] == ball and hit["point"] == pytest.approx((0, 4.5))
    assert hit["normal"] == pytest.approx((0, 1)) and hit["fraction"] == pytest.approx(5.5 / 20)
    assert [h["body"] for h in world.ray_cast_all((0, 10), (0, -20))] == [ball, ground]
    assert world.ray_cast((0, 10), (0, -20), exclude=ball)["body"] == ground
    assert world.ray_cast((0, 10), (0, 5)) is None
    rays = np.array([[0, 10, 0, -20], [5, 10, 0, -20], [0, 10, 0, 5]], dtype=float)
    assert world.ray_casts(rays) == pytest.approx([5.5 / 20, 0.5, 1.0])
    assert world.overlap_point((0, 4)) == ball.shapes
    assert world.overlap_box((-1, -1), (1, 5)) == ground.shapes + ball.shapes
    assert world.overlap_shape({"circle": {"radius": 1.0}}, (0, 5.4)) == ball.shapes
    assert world.closest_point((0, 6))["distance"] == pytest.approx(1.5)
    cast = world.cast_shape({"circle": {"radius": 0.5}}, (5, 3), 0.0, (0, -5))
    assert cast["body"] == ground and cast["fraction"] == pytest.approx(0.5, abs=1e-3)


def test_a_query_refuses_a_body_of_another_world():
    world, ground, ball = falling()
    for ask in (
        lambda other: world.ray_cast((0, 10), (0, -20), exclude=other),
        lambda other: world.ray_cast_all((0, 10), (0, -20), exclude=other),
        lambda other: world.cast_shape({"circle": {"radius": 0.5}}, (5, 3), 0.0, (0, -5), exclude=other),
        lambda other: world.overlap_shape({"circle": {"radius": 1.0}}, (0, 4), exclude=other),
        lambda other: world.overlap_box((-1, -1), (1, 5), exclude=other),
        lambda other: world.overlap_point((0, 4), exclude=other),
        lambda other: world.closest_point((0, 6), exclude=other),
    ):
        ask(ball)
        with pytest.raises(ValueError, match="another world"):
            ask(falling()[2])


def test_a_copy_has_the_same_future():
    world = tp.World.scene("card_house")
    world.step(1 / 60, steps=20)
    copies = [
        world.copy(),
        copy.deepcopy(world),
        pickle.loads(pickle.dumps(world)),
        tp.World.from_bytes(world.to_bytes()),
    ]
    other = tp.World()
    other.restore(world)
    for one in [world, *copies, other]:
        one.step(1 / 60, steps=30)
    assert len({one.state_hash() for one in [world, *copies, other]}) == 1
    world.step()
    assert world.state_hash() != copies[0].state_hash()
    with pytest.raises(ValueError):
        tp.World.from_bytes(world.to_bytes()[:100])


def test_threads_change_nothing():
    hashes = set()
    for threads in (1, 2):
        world = tp.World.scene("card_house")
        world.threads = threads
        world.step(1 / 60, steps=30)
        hashes.add(world.state_hash())
    assert len(hashes) == 1


def test_handles_of_a_copy_are_those_of_the_original():
    world, _, ball = falling()
    twin = world.copy()
    same = twin.same(ball)
    assert same != ball and same.position == ball.position
    with pytest.raises(ValueError):
        twin.add_joint(ball, same, tp.weld())


def test_scene_files(tmp_path):
    path = tmp_path / "scene.json"
    path.write_text('{"version": 1, "name": "x", "bodies": [{"shapes": [{"shape": {"circle": {"radius": 1}}}]}]}')
    assert tp.World.from_scene(path).body_count == 1
    path.write_text('{"version": 1, "name": "x", "bodies": [{"shapes": [{"shape": {"circle": {"radius": -1}}}]}]}')
    with pytest.raises(ValueError, match="radius"):
        tp.World.from_scene(path)
    with pytest.raises(ValueError, match="no_such"):
        tp.World.scene("no_such")


def test_states_write_into_the_array_that_is_given():
    world, _, ball = falling()
    out = np.empty((2, 6))
    assert world.states(out) is out
    assert out[1].tolist() == [0, 4, 0, 0, 0, 0]
    with pytest.raises(ValueError, match="shape"):
        world.states(np.empty((3, 6)))
    with pytest.raises(ValueError, match="order C"):
        world.states(np.empty((2, 6), order="F"))


def test_frames_of_a_film_may_lie_in_memory_as_they_like():
    world, _, _ = falling()
    picture = world.draw(40, 20)
    assert tp.gif([np.asfortranarray(picture)]) == tp.gif([picture])


def test_pictures():
    world, _, _ = falling()
    picture = world.draw(200, 100)
    assert picture.shape == (100, 200, 3) and picture.dtype == np.uint8
    assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 3
    assert world._repr_png_().startswith(b"\x89PNG")
    film = tp.Film()
    for _ in range(3):
        world.step(steps=10)
        film.add(world.draw(64, 48))
    assert film.to_gif().startswith(b"GIF89a") and "image/gif" in film._repr_html_()
    film.add(np.zeros((10, 20, 3)))
    with pytest.raises(ValueError):
        film.to_gif()
    with pytest.raises(ValueError):
        world.draw(1, 1)


def test_other_threads_run_while_a_world_steps():
    ticks, stop = [], threading.Event()

    def tick():
        while not stop.is_set():
            ticks.append(1)

    thread = threading.Thread(target=tick)
    thread.start()
    during = 0
    for _ in range(50):
        world = tp.World.scene("pyramid")  # one that has fallen asleep takes no time
        before = len(ticks)
        world.step(1 / 60, steps=300)
        during = max(during, len(ticks) - before)
        if during > 1000:
            break
    stop.set()
    thread.join()
    assert during > 1000


def test_a_world_that_another_thread_steps_refuses_politely():
    world = tp.World(gravity=(0, -10))
    for i in range(300):
        world.add_body(tp.circle(0.4), position=(0.1 * (i % 7), i))
    thread = threading.Thread(target=lambda: world.step(1 / 60, steps=400))
    thread.start()
    refused = 0
    while thread.is_alive():
        for read in (lambda: world.bodies, world.contacts, world.events, lambda: world.ray_cast((0, 0), (1, 0))):
            try:
                read()
            except RuntimeError:
                refused += 1
    thread.join()
    assert refused > 0
    assert len(world.bodies) == 300


def test_arrays_that_cannot_be_written_are_refused():
    world = tp.World()
    world.add_body(tp.circle(1))
    out = np.zeros((1, 6))
    out.flags.writeable = False
    with pytest.raises(ValueError):
        world.states(out=out)
    with pytest.raises(ValueError):
        world.states(out=np.zeros((6, 1)))


def test_a_picture_of_a_lone_turned_circle_shows_it():
    world = tp.World(gravity=(0, 0))
    world.add_body(tp.circle(1), angle=np.pi / 4)
    picture = world.draw(60, 60)
    covered = (picture != picture[0, 0]).any(axis=2).mean()
    assert 0.2 < covered < 0.95


def test_what_is_not_said_of_a_material_or_filter_stays():
    world = tp.World()
    body = world.add_body(tp.circle(1, density=3, friction=0.25, restitution=0.5, category=4, mask=2**63, group=-1))
    (shape,), mass = body.shapes, body.mass
    shape.material = {"friction": 0}
    shape.filter = {"group": 7}
    assert {**shape.material, "density": 3, "friction": 0, "restitution": 0.5} == shape.material
    assert shape.filter == {"category": 4, "mask": 2**63, "group": 7}
    assert body.mass == mass
    for wrong in [{"slippery": 1}, 5, {"friction": -1}]:
        with pytest.raises(ValueError):
            shape.material = wrong
    shape.material = shape.material
    assert shape.material["friction"] == 0
