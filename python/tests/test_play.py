"""What is built on worlds: tile maps and characters."""

import copy

import pytest

import tiny_physics as tp

LEVEL = [
    "..........",
    "...--.....",
    "........./",
    "##########",
]


def test_tiles_hold_and_can_be_changed():
    world = tp.World(gravity=(0, -10))
    tiles = world.add_tiles(LEVEL, cell_size=2.0, position=(-10, -2))
    ball = world.add_body(tp.circle(0.5), position=(-5, 1))
    world.step(1 / 60, steps=120)
    assert ball.position[1] == pytest.approx(0.5, abs=0.01) and not ball.awake
    under = world.ray_cast((-5, 0.2), (0, -1), exclude=ball)
    assert under["body"].tiles == tiles and ball.tiles is None
    assert tiles[2, 0] == 1 and tiles[2, 3] == 0
    tiles[2, 0] = 0
    world.step(1 / 60, steps=60)
    assert ball.position[1] < -1.0
    with pytest.raises(IndexError):
        tiles[10, 0]
    with pytest.raises(ValueError):
        tiles[2, 0] = 999
    same = world.add_tiles({**tiles.description, "position": [100, 0]})
    assert same != tiles and same[3, 0] == 1 and same.description["cell_size"] == 2.0
    tiles.remove()
    assert not tiles.is_valid
    with pytest.raises(tp.StaleHandleError):
        tiles[0, 0]
    with pytest.raises(ValueError):
        world.add_tiles([], cell_size=1.0)


def go(world: tp.World, hero: tp.Character, steps: int, **asked: float) -> None:
    for _ in range(steps):
        world.step(1 / 60)
        hero.update(world, **asked)


def test_a_character_walks_jumps_and_is_stopped():
    world = tp.World(gravity=(0, -10))
    floor = world.add_body(tp.box(20, 1), kind="static", position=(0, -1))
    wall = world.add_body(tp.box(0.5, 3), kind="static", position=(6, 3))
    hero = tp.Character((0, 2), 1.8, 0.3, step_height=0.2)
    assert hero.description["step_height"] == pytest.approx(0.2) and not hero.grounded
    go(world, hero, 120, walk=2.0)
    assert hero.grounded and hero.ground(world)["body"] == floor
    assert hero.position == pytest.approx((4.0, 0.91), abs=0.01)
    go(world, hero, 1, walk=2.0, jump=5.0)
    assert hero.ground(world) is None and hero.velocity[1] > 4.0
    go(world, hero, 100, walk=2.0)
    assert hero.hits(world)[0]["body"] == wall and hero.hits(world)[0]["normal"] == pytest.approx((-1, 0))
    other, elsewhere = copy.copy(hero), world.copy()
    for character, place in ((hero, world), (other, elsewhere)):
        character.launch((-3.0, 6.0))
        go(place, character, 30)
    assert hero.position == other.position and hero.position[0] < 5.0
    with pytest.raises(ValueError, match="heigth"):
        tp.Character((0, 2), 1.8, 0.3, heigth=2.0)
    with pytest.raises(ValueError):
        hero.update(world, walk=float("nan"))


def test_a_character_is_moved_by_hand_ducks_and_is_noticed():
    world = tp.World(gravity=(0, -10))
    world.add_body(tp.box(20, 1), kind="static", position=(0, -1))
    coin = world.add_body(tp.circle(0.3, sensor=True), kind="static", position=(2, 1))
    hero = tp.Character((0, 6), 1.8, 0.3)
    body = hero.add_body(world)
    go(world, hero, 30)
    assert hero.velocity[1] < -4.0
    assert hero.move_by(world, (0, 0.5)) == pytest.approx((0, 0.5)) and hero.velocity == (0, 0)
    assert body.position == hero.position
    assert hero.move_by(world, (0, -20))[1] > -6 and hero.grounded
    assert hero.resize(world, 1.0, 0.3) and hero.height == 1.0 and hero.fits(world)
    found = []
    for _ in range(60):
        world.step(1 / 60)
        hero.update(world, walk=3.0)
        found += [pair for pair in world.events()["sensor_begin"] if pair[0].body == body]
    assert [visitor.body for _, visitor in found] == [coin]
    before = hero.interpolated_position(0.0)
    assert hero.position[0] - before[0] == pytest.approx(0.05, abs=1e-4)
