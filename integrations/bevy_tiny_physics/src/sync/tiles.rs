//! Tile maps.

use super::problems::Problems;
use super::scene::WithDisabled;
use crate::components::TileMap;
use crate::world::PhysicsWorld;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::*;
use tiny_physics::{Error, TileGrid, TileGridId};

/// Adds tile maps that are new; of others, sets the cells that changed. Those that are disabled go until they are enabled.
pub(crate) fn read(
    mut physics: ResMut<PhysicsWorld>,
    changed: Query<Entity, (Changed<TileMap>, WithDisabled)>,
    all: Query<(Entity, &TileMap, Has<Disabled>)>,
    mut problems: Problems,
) {
    let physics = &mut *physics;
    let told = changed.iter().chain(physics.notes.switched.iter().copied());
    let mut asked: Vec<_> = told.filter_map(|entity| all.get(entity).ok()).collect();
    if physics.fresh {
        asked.extend(all.iter().filter(|(entity, _, is_disabled)| {
            *is_disabled == physics.maps.tiles.contains_key(entity)
        }));
    }
    asked.sort_by(|a, b| key(a.1).partial_cmp(&key(b.1)).unwrap_or(core::cmp::Ordering::Equal));
    for (entity, TileMap(grid), is_disabled) in asked {
        if is_disabled {
            physics.remove_tiles(entity);
            continue;
        }
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
