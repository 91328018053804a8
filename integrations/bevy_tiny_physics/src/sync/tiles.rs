//! Tile maps.

use super::problems::Problems;
use crate::components::TileMap;
use crate::world::PhysicsWorld;
use bevy_ecs::prelude::*;
use tiny_physics::{Error, TileGrid, TileGridId};

/// Adds tile maps that are new; of others, sets the cells that changed.
pub(crate) fn read(
    mut physics: ResMut<PhysicsWorld>,
    changed: Query<(Entity, &TileMap), Changed<TileMap>>,
    all: Query<(Entity, &TileMap)>,
    mut problems: Problems,
) {
    let physics = &mut *physics;
    let mut asked: Vec<_> = changed.iter().collect();
    if physics.fresh {
        asked.extend(all.iter().filter(|(entity, _)| !physics.maps.tiles.contains_key(entity)));
    }
    asked.sort_by(|a, b| key(a.1).partial_cmp(&key(b.1)).unwrap_or(core::cmp::Ordering::Equal));
    for (entity, TileMap(grid)) in asked {
        let result = match physics.maps.tiles.get(&entity) {
            Some(id) if is_like(&physics.world, *id, grid) => {
                set_cells(&mut physics.world, *id, grid)
            }
            _ => add(physics, entity, grid),
        };
        problems.check(entity, "tile map", result);
    }
}

fn key(tiles: &TileMap) -> (f64, f64, &[u16]) {
    (tiles.0.position.y, tiles.0.position.x, &tiles.0.cells)
}

fn add(physics: &mut PhysicsWorld, entity: Entity, grid: &TileGrid) -> Result<(), Error> {
    let id = physics.world.add_tiles(grid.clone())?;
    physics.remove_tiles(entity);
    physics.maps.tiles.insert(entity, id);
    Ok(())
}

/// Do two maps differ in cells at most?
fn is_like(world: &tiny_physics::World, id: TileGridId, said: &TileGrid) -> bool {
    world.tiles(id).is_some_and(|is| {
        TileGrid { cells: Vec::new(), ..is.clone() }
            == TileGrid { cells: Vec::new(), ..said.clone() }
    })
}

fn set_cells(
    world: &mut tiny_physics::World,
    id: TileGridId,
    said: &TileGrid,
) -> Result<(), Error> {
    said.validate()?;
    for y in 0..said.height {
        for x in 0..said.width {
            world.set_tile(id, x, y, said.get(x, y))?;
        }
    }
    Ok(())
}
