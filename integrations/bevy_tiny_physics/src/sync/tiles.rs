//! Tile maps.

use super::problems::Problems;
use super::scene::WithDisabled;
use crate::components::TileMap;
use crate::world::{PhysicsWorld, TilesRecord};
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::*;
use std::sync::Arc;
use tiny_physics::{Error, TileGrid};

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
        asked.extend(all.iter().filter(|(entity, tiles, is_disabled)| {
            let told = physics.maps.tiles.get(entity).map(|record| &*record.said);
            told != (!is_disabled).then_some(&tiles.0)
        }));
    }
    asked.sort_by(|a, b| key(a.1).partial_cmp(&key(b.1)).unwrap_or(core::cmp::Ordering::Equal));
    for (entity, TileMap(grid), is_disabled) in asked {
        if is_disabled {
            physics.remove_tiles(entity);
            continue;
        }
        let result = match physics.maps.tiles.get_mut(&entity) {
            Some(record)
                if is_like(&record.said, grid) && physics.world.tiles(record.id).is_some() =>
            {
                set_cells(&mut physics.world, record, grid)
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
    physics.maps.tiles.insert(entity, TilesRecord { id, said: Arc::new(grid.clone()) });
    Ok(())
}

/// Do two maps differ in cells at most?
fn is_like(before: &TileGrid, said: &TileGrid) -> bool {
    let bare =
        |grid: &TileGrid| TileGrid { cells: Vec::new(), palette: grid.palette.clone(), ..*grid };
    bare(before) == bare(said)
}

/// Sets the cells that were said to be something else before.
fn set_cells(
    world: &mut tiny_physics::World,
    record: &mut TilesRecord,
    said: &TileGrid,
) -> Result<(), Error> {
    said.validate()?;
    for y in 0..said.height {
        for x in 0..said.width {
            if said.get(x, y) != record.said.get(x, y) {
                world.set_tile(record.id, x, y, said.get(x, y))?;
            }
        }
    }
    if *record.said != *said {
        record.said = Arc::new(said.clone());
    }
    Ok(())
}
