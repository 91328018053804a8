//! Tile maps: smooth seams, slopes, edits while running, queries, other bodies beside them.

use tiny_physics::{
    DVec2, Filter, Material, QueryFilter, RigidBody, Rot, Shape, ShapeDef, Tile, TileForm,
    TileGrid, Vec2, World,
};

const SPEED: f32 = 10.0;

fn world() -> World {
    World::new(Vec2::new(0.0, -10.0))
}

fn slider(shape: Shape, place: Vec2) -> RigidBody {
    let shape = ShapeDef::new(shape).friction(0.0);
    RigidBody::dynamic().position(place).velocity(Vec2::new(SPEED, 0.0)).shape(shape)
}

fn shapes() -> [(Shape, f32); 4] {
    [
        (Shape::rect(0.5, 0.5).unwrap(), 0.5),
        (Shape::rect(1.6, 0.3).unwrap(), 0.3),
        (Shape::circle(0.5).unwrap(), 0.5),
        (Shape::circle(0.2).unwrap(), 0.2),
    ]
}

/// Slides over ground whose surface is at height 0 and checks speed and height.
fn slide(world: &World, steps: u32) {
    for (shape, height) in shapes() {
        let mut world = world.clone();
        let body = world.add_body(slider(shape, Vec2::new(2.3, height))).unwrap();
        let (mut top, mut bottom) = (f32::MIN, f32::MAX);
        for _ in 0..steps {
            world.step(1.0 / 60.0);
            let y = world.body(body).unwrap().position().y - height;
            (top, bottom) = (top.max(y), bottom.min(y));
        }
        world.validate().unwrap();
        let kept = world.body(body).unwrap().velocity().x / SPEED;
        println!("kept {kept}, top {top}, bottom {bottom}");
        assert!(kept > 0.999 && kept < 1.001, "{kept}");
        assert!(top < 0.001 && bottom > -0.007, "{bottom} to {top}");
    }
}

#[test]
fn tiles_of_one_size_or_several_are_smooth() {
    let long = "#".repeat(64);
    let mixed = "##_#".replace('_', "\"").repeat(16);
    let grid = TileGrid::parse(1.0, &[&mixed, &long]).unwrap().friction(0.0);
    let mut world = world();
    world.add_tiles(grid.position(Vec2::new(0.0, -2.0))).unwrap();
    slide(&world, 300);
}

#[test]
fn tiles_meet_other_bodies_and_other_grids() {
    let mut world = world();
    let row = "#".repeat(20);
    for (i, x) in [0.0, 24.0, 44.0].into_iter().enumerate() {
        let size = if i == 1 { 1.0 } else { 0.5 };
        let row = if i == 1 { row.clone() } else { row.repeat(2) };
        let grid = TileGrid::parse(size, &[&row]).unwrap().friction(0.0);
        world.add_tiles(grid.position(Vec2::new(x, -f64::from(size) as f32))).unwrap();
    }
    let bridge = ShapeDef::new(Shape::rect(2.0, 0.25).unwrap()).friction(0.0);
    world.add_body(RigidBody::fixed().position(Vec2::new(22.0, -0.25)).shape(bridge)).unwrap();
    slide(&world, 300);
}

#[test]
fn a_box_over_many_tiles_has_two_points() {
    let mut world = world();
    let grid = TileGrid::parse(0.5, &["################", "################"]).unwrap();
    world.add_tiles(grid).unwrap();
    let shape = Shape::rect(1.5, 0.5).unwrap();
    let body = RigidBody::dynamic().position(Vec2::new(4.0, 1.5)).shape(shape).can_sleep(false);
    world.add_body(body).unwrap();
    (0..60).for_each(|_| world.step(1.0 / 60.0));
    let points: usize = world.contacts().map(|contact| contact.points().len()).sum();
    assert_eq!(points, 2);
}

#[test]
fn edits_while_running_drop_and_hold() {
    let mut world = world();
    let grid = TileGrid::parse(1.0, &["####", "####"]).unwrap();
    let tiles = world.add_tiles(grid).unwrap();
    let shape = Shape::rect(0.4, 0.4).unwrap();
    let body = world.add_body(RigidBody::dynamic().position(Vec2::new(1.5, 2.4)).shape(shape));
    let body = body.unwrap();
    (0..120).for_each(|_| world.step(1.0 / 60.0));
    assert!(!world.body(body).unwrap().is_awake());
    world.set_tile(tiles, 1, 1, 0).unwrap();
    assert!(world.body(body).unwrap().is_awake());
    (0..120).for_each(|_| world.step(1.0 / 60.0));
    world.validate().unwrap();
    assert!((world.body(body).unwrap().position().y - 1.4).abs() < 0.01);
    assert_eq!(world.tiles(tiles).unwrap().get(1, 1), 0);
    // Ids and bodies lead back to the grid.
    let ground = world.contacts().next().map(|c| c.body_a);
    assert!(ground.is_none_or(|id| world.tiles_of(id) == Some(tiles) || id == body));
    world.remove_tiles(tiles).unwrap();
    assert!(world.set_tile(tiles, 0, 0, 1).is_err() && world.tiles(tiles).is_none());
    assert_eq!(world.body_count(), 1);
}

#[test]
fn edits_cost_the_same_in_large_maps() {
    // Not timed: counted. An edit touches the shapes of one block only.
    let mut world = world();
    let palette = vec![Tile::new(TileForm::Full)];
    let mut grid = TileGrid::new(1.0, 512, 128, palette);
    grid.cells.fill(1);
    let tiles = world.add_tiles(grid).unwrap();
    assert_eq!(world.shape_count(), 32 * 8);
    let before: Vec<_> = world.shape_ids().collect();
    world.set_tile(tiles, 100, 70, 0).unwrap();
    let same = world.shape_ids().filter(|id| before.contains(id)).count();
    assert_eq!(same, 32 * 8 - 1);
    assert_eq!(world.shape_count(), 32 * 8 - 1 + 4);
}

#[test]
fn rays_see_tiles() {
    let mut world = world();
    let tiles = world.add_tiles(TileGrid::parse(1.0, &["..#", "/##"]).unwrap()).unwrap();
    let all = QueryFilter::new();
    let hit = world.ray_cast(Vec2::new(-5.0, 1.5), Vec2::new(10.0, 0.0), &all).unwrap();
    assert!((hit.point.x - 2.0).abs() < 1e-5 && hit.normal == -Vec2::X);
    assert_eq!(world.tiles_of(hit.body), Some(tiles));
    let other =
        world.add_tiles(TileGrid::parse(1.0, &["#"]).unwrap().position(Vec2::new(9.0, 0.0)));
    let floor = world.add_body(RigidBody::fixed()).unwrap();
    let hit = world.ray_cast(Vec2::new(9.5, 5.0), Vec2::new(0.0, -10.0), &all).unwrap();
    assert_eq!((world.tiles_of(hit.body), world.tiles_of(floor)), (other.ok(), None));
    let frame = World::from_bytes(&world.to_bytes()).unwrap();
    assert_eq!(frame.tiles_of(hit.body), world.tiles_of(hit.body));
    // A block whose body was removed gets another one at the next edit.
    world.remove_body(hit.body).unwrap();
    let other = world.tiles_of(hit.body).unwrap();
    world.set_tile(other, 0, 0, 2).unwrap();
    let again = world.ray_cast(Vec2::new(9.5, 5.0), Vec2::new(0.0, -10.0), &all).unwrap();
    assert_eq!((world.tiles_of(hit.body), world.tiles_of(again.body)), (None, Some(other)));
    let hit = world.ray_cast(Vec2::new(0.5, 5.0), Vec2::new(0.0, -10.0), &all).unwrap();
    assert!((hit.point.y - 0.5).abs() < 1e-5 && (hit.normal.x + hit.normal.y).abs() < 1e-5);
}

#[test]
fn slopes_are_smooth() {
    // A frictionless circle goes down a long slope of tiles as down a plane: it keeps its energy, and
    // its velocity stays along the slope.
    let steep: Vec<String> =
        (0..12).map(|k| format!("{}\\{}", "#".repeat(k), ".".repeat(11 - k))).collect();
    let gentle: Vec<String> =
        (0..12).map(|k| format!("{}HL{}", "##".repeat(k), "..".repeat(11 - k))).collect();
    for (rows, normal) in [(steep, Vec2::new(1.0, 1.0)), (gentle, Vec2::new(1.0, 2.0))] {
        let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
        let grid = TileGrid::parse(1.0, &rows).unwrap().friction(0.0);
        let width = grid.width as f32;
        let mut world = world();
        world.add_tiles(grid).unwrap();
        let normal = normal.normalized();
        let start = Vec2::new(1.0, 12.0 - 12.0 / width) + normal * 0.3;
        let shape = ShapeDef::new(Shape::circle(0.3).unwrap()).friction(0.0);
        let body = world.add_body(RigidBody::dynamic().position(start).shape(shape)).unwrap();
        let energy = |world: &World| {
            let body = world.body(body).unwrap();
            0.5 * body.velocity().length_sq() + 10.0 * body.position().y
        };
        while world.body(body).unwrap().position().x < width - 2.0 {
            world.step(1.0 / 60.0);
            let across = world.body(body).unwrap().velocity().dot(normal);
            // Gravity of a step and settling in the first.
            assert!(across.abs() < 0.05, "{across}");
            let place = world.body(body).unwrap().position();
            assert!(world.step_count() < 600, "it is stuck at {place:?}");
        }
        world.validate().unwrap();
        let lost = 1.0 - (energy(&world) - 10.0) / (10.0 * start.y - 10.0);
        println!("lost {lost}");
        assert!(lost.abs() < 0.01, "{lost}");
    }
}

#[test]
fn one_way_tiles_let_pass_from_below_and_hold_from_above() {
    let mut world = world();
    world.add_tiles(TileGrid::parse(1.0, &["-----", ".....", ".....", "#####"]).unwrap()).unwrap();
    for (x, half) in [(1.5, 0.4), (3.0, 0.3)] {
        let shape = if half == 0.4 { Shape::rect(half, half) } else { Shape::circle(half) };
        let body = RigidBody::dynamic().position(Vec2::new(x, 1.5)).velocity(Vec2::new(0.0, 9.0));
        let body = world.add_body(body.shape(shape.unwrap()).lock_rotation()).unwrap();
        let mut highest = f32::MIN;
        for _ in 0..180 {
            world.step(1.0 / 60.0);
            highest = highest.max(world.body(body).unwrap().position().y);
        }
        assert!((highest - 5.55).abs() < 0.1, "passes: {highest}");
        let y = world.body(body).unwrap().position().y;
        assert!((y - 4.0 - half).abs() < 0.01, "comes to rest on the platform: {y}");
    }
}

#[test]
fn every_tile_has_its_own_material_and_filter() {
    let ice = Tile {
        material: Material { friction: 0.0, ..Material::default() },
        ..Tile::new(TileForm::Full)
    };
    let rough = Tile { material: Material { friction: 1.0, ..Material::default() }, ..ice };
    let ghost = Tile { filter: Filter { category: 2, ..Filter::default() }, ..rough };
    let mut grid = TileGrid::new(1.0, 60, 1, vec![ice, rough, ghost]);
    for x in 0..60 {
        grid.set(x, 0, 1 + x as u16 / 20).unwrap();
    }
    let mut world = world();
    world.add_tiles(grid).unwrap();
    let shape = ShapeDef::new(Shape::rect(0.4, 0.4).unwrap()).friction(1.0);
    let shape = shape.filter(Filter { mask: 1, ..Filter::default() });
    let slide = |world: &mut World, x: f32, speed: f32| {
        let body = RigidBody::dynamic().position(Vec2::new(x, 1.4)).shape(shape.clone());
        let body = body.velocity(Vec2::new(speed, 0.0)).lock_rotation();
        let body = world.add_body(body).unwrap();
        (0..120).for_each(|_| world.step(1.0 / 60.0));
        world.body(body).unwrap().position()
    };
    // 2 s on ice; v^2 / 2 mu g on rough ground; through the last third.
    let [on_ice, on_rock] = [slide(&mut world, 2.0, 4.0), slide(&mut world, 24.0, 8.0)];
    assert!((on_ice.x - 10.0).abs() < 0.02, "{on_ice:?}");
    assert!((on_rock.x - 24.0 - 3.2).abs() < 0.1, "{on_rock:?}");
    assert!(slide(&mut world, 50.0, 0.0).y < -5.0);
}

/// A palette is looked at as a whole before anything is added.
#[test]
fn a_grid_is_added_whole_or_not_at_all() {
    let mut world = world();
    let before = world.to_bytes();
    let grid = TileGrid::parse(1.0, &["#.........................../"]).unwrap();
    let mut rough = grid.clone();
    rough.palette.iter_mut().for_each(|tile| tile.material.friction = -1.0);
    assert!(world.add_tiles(rough).is_err());
    assert!(world.add_tiles(grid.position(DVec2::new(1.0e12 - 1.0, 0.0))).is_err());
    assert_eq!(world.body_count(), 0);
    assert_eq!(world.to_bytes(), before);
}

/// A block whose body was removed has nothing; an edit brings all of its cells back.
#[test]
fn an_edit_brings_a_removed_block_back() {
    let mut world = World::new((0.0, -10.0));
    let level = world.add_tiles(TileGrid::parse(1.0, &["##....#"]).unwrap()).unwrap();
    let bodies: Vec<_> = world.body_ids().collect();
    bodies.into_iter().for_each(|body| world.remove_body(body).unwrap());
    world.set_tile(level, 4, 0, 1).unwrap();
    for (x, full) in [true, true, false, false, true, false, true].into_iter().enumerate() {
        let found = world.overlap_point((x as f64 + 0.5, 0.5), &QueryFilter::new());
        assert_eq!(found.len(), usize::from(full), "cell {x}");
    }
}

#[test]
fn grids_that_contradict_themselves_are_empty_where_they_do() {
    let mut grid = TileGrid::new(1.0, 2_000_000, 1, vec![]);
    assert_eq!(grid.get(1_500_000, 0), 0);
    assert!(grid.set(1_500_000, 0, 0).is_err());
    grid.cells.clear();
    assert_eq!(grid.get(0, 0), 0);
    let mut grid = TileGrid::parse(1.0, &["##"]).unwrap();
    grid.palette.clear();
    assert!(grid.bodies().is_empty());
}

/// Balls and boxes that roll and slide from flat one-way tiles down one-way slopes, and from slopes onto flat ones, stay on them.
#[test]
fn one_way_slopes_go_on_from_flat_ones() {
    let one_way = |form: TileForm| Tile::new(form).one_way(Vec2::Y).friction(0.2);
    let palette = vec![
        one_way(TileForm::Full),
        one_way(TileForm::Slope).mirrored_x(),
        one_way(TileForm::GentleHigh).mirrored_x(),
        one_way(TileForm::GentleLow).mirrored_x(),
    ];
    for (forms, fall) in [(vec![2], 1.0), (vec![3, 4], 0.5)] {
        for (shape, half) in shapes() {
            for speed in [0.5, 1.0, 2.0] {
                let mut grid = TileGrid::new(1.0, 14, 3, palette.clone());
                (0..4).for_each(|x| grid.set(x, 1, 1).unwrap());
                for (x, form) in forms.iter().enumerate() {
                    grid.set(4 + x as u32, 1, *form).unwrap();
                }
                (4 + forms.len() as u32..14).for_each(|x| grid.set(x, 0, 1).unwrap());
                let mut world = world();
                world.add_tiles(grid).unwrap();
                let body = slider(shape, Vec2::new(2.5, 2.0 + half));
                let body = body.velocity(Vec2::new(speed, 0.0)).can_sleep(false);
                let body = world.add_body(body).unwrap();
                for _ in 0..240 {
                    world.step(1.0 / 60.0);
                    let at = world.body(body).unwrap().position();
                    let top = (2.0 - fall * (at.x - 4.0)).clamp(1.0, 2.0);
                    assert!(at.x > 13.0 || at.y > top, "{forms:?} {shape:?} {speed}: {at}");
                }
            }
        }
    }
}

/// Tiles are what they are in cells of every size that is valid.
#[test]
fn tiles_of_all_sizes_are_alike() {
    let rows = ["/\\_\"#", "[]lhHL", "#-####"];
    let corners = |size: f32| -> Vec<(f32, f32)> {
        let bodies = TileGrid::parse(size, &rows).unwrap().bodies();
        let shapes = bodies.iter().flat_map(|body| &body.shapes);
        let polygons = shapes.map(|def| match def.shape {
            Shape::Polygon(polygon) => polygon,
            other => panic!("{size}: {other:?}"),
        });
        let scaled = |at: &Vec2| (at.x / size, at.y / size);
        polygons.flat_map(|p| p.vertices().iter().map(scaled).collect::<Vec<_>>()).collect()
    };
    let usual = corners(1.0);
    for size in [1.0e-4, 1.5e-4, 1.0e-3, 0.1, 17.0, 3.0e4] {
        let these = corners(size);
        assert_eq!(these.len(), usual.len(), "{size}");
        for (a, b) in these.iter().zip(&usual) {
            assert!((a.0 - b.0).abs() < 1e-5 && (a.1 - b.1).abs() < 1e-5, "{size}: {a:?} {b:?}");
        }
    }
}

/// Blocks far along a turned row lay a millimetre higher or lower than their neighbours: boxes that slid tripped there.
#[test]
fn long_turned_rows_are_smooth() {
    for (cell, angle) in [(1.0, 0.3), (0.3, -0.7)] {
        let mut grid = TileGrid::new(cell, 65536, 1, vec![Tile::new(TileForm::Full)]);
        grid.cells.fill(1);
        grid.angle = angle;
        let rot = Rot::from_angle(angle);
        let (up, right) = (rot.rotate(Vec2::Y), rot.rotate(Vec2::X));
        let mut world = World::new(up * -10.0);
        let end = grid.center_of(65336, 0);
        for x in [0, 1, 15, 16, 4097, 65336, 65535] {
            assert_eq!(grid.cell_at(grid.center_of(x, 0)), Some((x, 0)));
        }
        world.add_tiles(grid).unwrap();
        let box_ = ShapeDef::new(Shape::rect(0.25, 0.25).unwrap()).friction(0.0);
        let box_ = RigidBody::dynamic().position(end + up * (0.5 * cell + 0.26)).shape(box_);
        let box_ = world.add_body(box_.angle(angle).velocity(right * SPEED)).unwrap();
        for step in 0..300 {
            world.step(1.0 / 60.0);
            let now = world.body(box_).unwrap();
            assert!(now.angular_velocity().abs() < 0.5, "{cell} m, step {step}: {now:?}");
        }
        let kept = world.body(box_).unwrap().velocity().dot(right) / SPEED;
        assert!(kept > 0.99, "{cell} m: {kept}");
    }
}

/// Grids of more cells than make sense have none, and are refused with a reason.
#[test]
fn no_grid_takes_all_memory() {
    let grid = TileGrid::new(1.0, 1 << 20, 1 << 20, vec![]);
    assert!(grid.cells.is_empty() && grid.get(5, 5) == 0 && grid.bodies().is_empty());
    let reason = grid.validate().unwrap_err().to_string();
    assert!(reason.contains("width * height"), "{reason}");
    assert!(world().add_tiles(grid).is_err());
    let mut rows = vec![""; 70_000];
    let long = "#".repeat(1000);
    rows[3] = &long;
    assert!(TileGrid::parse(1.0, &rows).is_err());
    // On 32 bits this product is 0.
    let mut grid = TileGrid::new(1.0, 1 << 16, 1 << 16, vec![]);
    assert!(grid.validate().is_err());
    grid.cells.clear();
    assert!(grid.validate().is_err());
}
