"""Batches of worlds."""

import numpy as np
import pytest

import tiny_physics as tp


def template(mass: float = 1.0):
    world = tp.World()
    base = world.add_body(tp.box(10, 0.5), kind="static", position=(0, -0.5))
    cart = world.add_body(tp.box(0.5, 0.2, friction=0.0), position=(0, 0.2), mass=mass)
    pole = world.add_body(tp.box(0.05, 0.5, category=2, mask=0), position=(0, 0.9))
    hinge = world.add_joint(cart, pole, tp.revolute((0, 0.2), (0, -0.5)))
    actuators = [("force_x", cart)]
    readings = [
        ("position_x", cart),
        ("joint_angle", hinge),
        ("joint_speed", hinge),
        ("ray", cart, (0, 0), (0, -2)),
    ]
    return world, base, cart, actuators, readings


def batch(count: int, threads: int = 1) -> tp.WorldBatch:
    world, *_, actuators, readings = template()
    return tp.WorldBatch(world, count, threads, actuators, readings)


def push(count: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).uniform(-20, 20, (count, 1)).astype(np.float32)


def test_actions_go_in_and_observations_come_out():
    many = batch(5)
    seen = many.step(np.arange(5, dtype=np.float32).reshape(5, 1) * 10, steps=10)
    assert seen.shape == (5, 4) and seen.dtype == np.float32
    assert (np.diff(seen[:, 0]) > 0.005).all()
    assert seen is many.observations
    assert np.isclose(seen[:, 3], 0.1, atol=0.01).all()


def test_actions_count_by_their_shape_not_by_how_they_lie_in_memory():
    world, _, cart, *_ = template()
    ends = []
    for given in [lambda a: a, np.asfortranarray, lambda a: np.repeat(a, 2, axis=1)[:, ::2]]:
        many = tp.WorldBatch(world, 3, 1, [("force_x", cart), ("force_y", cart)])
        many.step(given(np.arange(6, dtype=np.float32).reshape(3, 2)))
        ends.append(many.state_hashes().tolist())
    assert ends[0] == ends[1] == ends[2]


def test_a_number_that_a_body_does_not_take_is_an_error():
    world, _, cart, *_ = template()
    many = tp.WorldBatch(world, 1, 1, [("velocity_x", cart)])
    with pytest.raises(ValueError, match="too large"):
        many.step(np.full((1, 1), 3e38, dtype=np.float32))


def test_one_world_of_a_batch_is_that_world():
    world, _, cart, actuators, readings = template()
    many = tp.WorldBatch([world], 3, 1, actuators, readings)
    force = push(3, 1)
    for _ in range(30):
        many.step(force)
        cart.apply_force((float(force[1, 0]), 0.0))
        world.step()
    assert many.state_hashes()[1] == world.state_hash()
    assert many.world(1).state_hash() == world.state_hash()


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_save_restore_and_threads_give_equal_bits(threads):
    one, many = batch(50), batch(50, threads)
    for step in range(10):
        one.step(push(50, step))
        many.step(push(50, step))
    assert (one.state_hashes() == many.state_hashes()).all()
    saved, mark = many.to_bytes(), many.observations.copy()
    many.step(push(50, 99), steps=5)
    later = many.state_hashes()
    many.restore_bytes(saved)
    assert (many.observations == mark).all() and many.threads == threads
    many.step(push(50, 99), steps=5)
    assert (many.state_hashes() == later).all()
    with pytest.raises(ValueError):
        many.restore_bytes(saved[:-9])
    with pytest.raises(ValueError, match="worlds"):
        batch(3).restore_bytes(saved)


def test_resets_and_scatter():
    many = batch(6)
    fresh = many.state_hashes()
    many.step(push(6, 1), steps=5)
    moved = many.state_hashes()
    many.reset([1, 3])
    now = many.state_hashes()
    assert [now[i] == fresh[i] for i in range(6)] == [False, True, False, True, False, False]
    assert now[0] == moved[0]
    many.reset()
    assert (many.state_hashes() == fresh).all()
    cart = template()[2]
    many.seed([7] * 6)
    many.scatter([("position_x", cart)], [-1.0], [1.0])
    places = many.observations[:, 0]
    assert len(set(places.tolist())) == 1 and abs(places[0]) <= 1
    many.seed(range(6))
    many.scatter([("position_x", cart)], [-1.0], [1.0])
    assert len(set(many.observations[:, 0].tolist())) == 6
    with pytest.raises(IndexError):
        many.reset([6])


def test_a_mask_says_which_worlds_begin_again():
    many = batch(4)
    fresh = many.state_hashes()
    for mask in [[False, True, False, True], np.array([False, True, False, True])]:
        many.step(push(4, 1), steps=5)
        many.reset(mask)
        assert (many.state_hashes() == fresh).tolist() == [False, True, False, True]
        many.reset()
    many.reset(np.array([1, 3]))
    many.step(push(4, 1), steps=5)
    moved = many.state_hashes()
    for wrong in [[True], [True] * 5, [True, 2, False, False], np.ones(3, dtype=bool)]:
        with pytest.raises(ValueError, match="mask"):
            many.reset(wrong)
    with pytest.raises(ValueError, match="bool"):
        many.scatter([("gravity_y",)], [-1.0], [1.0], indices=[True, False, False, False])
    assert (many.state_hashes() == moved).all()


def test_a_joint_that_broke_stands_still_and_the_others_go_on():
    world = tp.World()
    base = world.add_body(tp.box(1, 1), kind="static")
    arm = world.add_body(tp.box(0.5, 0.1), position=(1, 3))
    hinge = world.add_joint(
        base, arm, tp.revolute((0, 3), (-1, 0), motor=(1.0, 5.0), break_at=(100.0, 1e9))
    )
    readings = [("joint_holds", hinge), ("joint_speed", hinge), ("position_y", arm)]
    actuators = [("motor_speed", hinge), ("impulse_y", arm)]
    many = tp.WorldBatch(world, 3, 1, actuators, readings)
    actions = np.ones((3, 2), dtype=np.float32)
    actions[1, 1] = -1000.0
    for _ in range(3):
        seen = many.step(actions)
        actions[:, 1] = 0.0
    assert seen[:, 0].tolist() == [1, 0, 1]
    assert seen[1, 1] == 0 and seen[0, 1] != 0 and seen[1, 2] < seen[0, 2]
    actions[2, 1] = 3e38
    with pytest.raises(ValueError, match="world 2"):
        many.step(actions)


def test_rays_of_all_worlds():
    many = batch(4)
    rays = np.array([[0, 3, 0, -4], [8, 3, 0, -6], [0, 3, 0, 2]], dtype=float)
    found = many.ray_casts(rays)
    assert found.shape == (4, 3)
    world = template()[0]
    assert (found == world.ray_casts(rays)).all()


def test_actions_are_what_numpy_makes_floats_of():
    ends = []
    for given in [np.float32, np.float64, np.int64, np.ravel, np.ndarray.tolist]:
        many = batch(4)
        pushes = np.arange(4).reshape(4, 1)
        many.step(given(pushes))
        ends.append(many.state_hashes().tolist())
        tasks = tp.TaskBatch("bipedal_walker", 3, 1)
        tasks.reset()
        tasks.step(given(np.eye(3, 4, dtype=np.int64)))
        ends.append(tasks.state_hashes().tolist())
    assert ends[::2] == ends[:1] * 5 and ends[1::2] == ends[1:2] * 5
    world = template()[0]
    rays = [[0, 5, 0, -10], [1, 5, 0, -10]]
    for caster in (many, world):
        assert (caster.ray_casts(rays) == caster.ray_casts(np.array(rays, float))).all()


def test_arrays_of_another_form_are_told_what_is_needed():
    many, tasks, world = batch(4), tp.TaskBatch("bipedal_walker", 3), template()[0]
    for call, given, kind, words in [
        (many.step, np.zeros((4, 1), complex), TypeError, r"complex128; needed is \(4, 1\) or \(4,\) of float32"),
        (many.step, np.zeros((4, 1, 1)), ValueError, r"shape \(4, 1, 1\); needed is \(4, 1\)"),
        (many.step, ["left"] * 4, TypeError, "actions is of <U4"),
        (tasks.step, np.zeros((4, 3)), ValueError, r"shape \(4, 3\); needed is \(3, 4\) or \(12,\) of float32"),
        (many.ray_casts, np.zeros(4), ValueError, r"rays has the shape \(4,\); needed is \(n, 4\) of float64"),
        (world.ray_casts, np.zeros((4, 2)), ValueError, r"needed is \(n, 4\)"),
        (world.states, np.zeros((3, 6), np.float32), ValueError, r"shape \(3, 6\), of float64"),
        (tp.gif, [np.zeros((2, 2, 3))], TypeError, "a frame is of float64; needed is .* of uint8"),
    ]:
        with pytest.raises(kind, match=words):
            call(given)


def test_bad_input_is_named():
    many = batch(4)
    before = many.state_hashes()
    with pytest.raises(ValueError, match=r"actions has the shape \(3, 1\)"):
        many.step(np.zeros((3, 1), dtype=np.float32))
    with pytest.raises(ValueError, match=r"needed is \(4, 1\)"):
        many.step(np.zeros((1, 4), dtype=np.float32))
    bad = np.zeros((4, 1), dtype=np.float32)
    bad[2] = np.nan
    with pytest.raises(ValueError, match=r"actions\[2\]"):
        many.step(bad)
    for dt in [np.nan, 0.0, -1.0]:
        with pytest.raises(ValueError, match="dt is"):
            many.step(np.ones((4, 1), dtype=np.float32), dt=dt)
    assert (many.state_hashes() == before).all()
    world, _, cart, *_ = template()
    with pytest.raises(ValueError, match="warp"):
        tp.WorldBatch(world, 1, 1, [("warp", cart)])
    with pytest.raises(ValueError, match="templates"):
        tp.WorldBatch([], 1)


def test_ten_thousand_worlds_go_on_the_same_after_going_back_and_on_any_number_of_threads():
    count, steps = 10_000, 4
    actions = np.random.default_rng(1).integers(0, 4, (2 * steps, count)).astype(np.float32)
    runs = []
    for threads in (1, 2):
        many = tp.TaskBatch("lunar_lander", count, threads=threads)
        for action in actions[:steps]:
            many.step(action)
        saved = many.to_bytes()
        later = []
        for _ in range(2):
            for action in actions[steps:]:
                many.step(action)
            later.append((many.state_hashes().tobytes(), many.observations.tobytes()))
            many.restore_bytes(saved)
        assert later[0] == later[1]
        runs.append((saved, later[0]))
    assert runs[0] == runs[1]
