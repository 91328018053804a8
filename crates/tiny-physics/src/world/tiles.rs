//! Tile grids in a world: which shapes stand for them, and edits.

use super::World;
use super::descriptions::{check_body, check_shape};
use super::ids::{BodyId, ShapeId, TileGridId};
use crate::codec::{Data, Generations, Reader, Sink, bad, store};
use crate::describe::{BLOCK_CELLS, Piece, ShapeDef, TileGrid};
use crate::error::Error;
use crate::footprint::MemoryUse;
use crate::geometry::Shape;

store! {
    /// All tile grids of a world.
    #[derive(Debug, Default)]
    pub(super) struct TileGrids {
        slots: Vec<Slot>,
        /// The slot of every block's body, ascending by body.
        owners: Vec<(BodyId, u32)>,
        generations: Generations,
    }
}

impl TileGrids {
    fn place_of(&self, body: BodyId) -> Result<usize, usize> {
        self.owners.binary_search_by_key(&body, |&(owned, _)| owned)
    }

    /// A block has this body instead of the one that it had.
    fn change_owner(&mut self, slot: u32, old: Option<BodyId>, new: BodyId) {
        if let Some(at) = old.and_then(|old| self.place_of(old).ok()) {
            self.owners.remove(at);
        }
        if let Err(at) = self.place_of(new) {
            self.owners.insert(at, (new, slot));
        }
    }
}

store! {
    #[derive(Debug)]
    struct Slot {
        generation: u32 as apart,
        grid: Option<Placed>,
    }
}

/// A grid and the bodies of its blocks.
#[derive(Debug)]
struct Placed {
    grid: TileGrid,
    blocks: Vec<BlockBody>,
}

impl Clone for Placed {
    fn clone(&self) -> Self {
        Self { grid: self.grid.clone(), blocks: self.blocks.clone() }
    }

    fn clone_from(&mut self, source: &Self) {
        let TileGrid { position, angle, cell_size, width, height, palette, cells } = &mut self.grid;
        let grid = &source.grid;
        (*position, *angle, *cell_size) = (grid.position, grid.angle, grid.cell_size);
        (*width, *height) = (grid.width, grid.height);
        palette.clone_from(&grid.palette);
        cells.clone_from(&grid.cells);
        self.blocks.clone_from(&source.blocks);
    }
}

impl Data for Placed {
    const HEAP: bool = true;

    fn save(&self, sink: &mut Sink) {
        self.grid.save(sink);
        self.blocks.save(sink);
    }

    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        let (grid, blocks): (TileGrid, Vec<BlockBody>) = Data::load(reader)?;
        grid.validate()?;
        let (columns, rows) = grid.blocks();
        if blocks.len() != columns as usize * rows as usize {
            return Err(bad("blocks of tiles are missing"));
        }
        Ok(Self { grid, blocks })
    }

    fn memory(&self) -> MemoryUse {
        [self.grid.memory(), self.blocks.memory()].into_iter().sum()
    }
}

store! {
    /// The body of a block, and the shapes of its pieces.
    #[derive(Debug, Default)]
    struct BlockBody {
        body: Option<BodyId>,
        shapes: Vec<(Piece, ShapeId)>,
    }
}

impl World {
    /// Adds a tile map. It is made of static bodies, one for each block of 16 by 16 cells that is not
    /// empty; their shapes are free of bumps at all seams.
    ///
    /// # Errors
    /// Those of [`TileGrid::validate`]; a material that a shape would be refused for; a place too far out. Nothing
    /// has been added then.
    pub fn add_tiles(&mut self, grid: TileGrid) -> Result<TileGridId, Error> {
        grid.validate()?;
        check_parts(&grid)?;
        let (columns, rows) = grid.blocks();
        let blocks = vec![BlockBody::default(); columns as usize * rows as usize];
        let slots = &mut self.state.tiles.slots;
        let index = slots.iter().position(|slot| slot.grid.is_none()).unwrap_or_else(|| {
            slots.push(Slot { generation: 0, grid: None });
            slots.len() - 1
        });
        slots[index].generation = self.state.tiles.generations.next();
        slots[index].grid = Some(Placed { grid, blocks });
        let id = TileGridId::new(index as u32, slots[index].generation);
        for y in 0..rows {
            for x in 0..columns {
                self.build_block(id, x, y)?;
            }
        }
        Ok(id)
    }

    /// Removes a tile map. What rested on it wakes.
    ///
    /// # Errors
    /// The handle is stale.
    pub fn remove_tiles(&mut self, id: TileGridId) -> Result<(), Error> {
        let placed = self.placed(id)?.clone();
        for body in placed.blocks.iter().filter_map(|block| block.body) {
            // The user may have removed it.
            let _ = self.remove_body(body);
        }
        self.state.tiles.owners.retain(|&(_, slot)| slot != id.index);
        self.state.tiles.slots[id.index()].grid = None;
        Ok(())
    }

    /// A tile map as it is now.
    pub fn tiles(&self, id: TileGridId) -> Option<&TileGrid> {
        self.placed(id).ok().map(|placed| &placed.grid)
    }

    /// Handles of all tile maps, in index order.
    pub fn tile_grid_ids(&self) -> impl Iterator<Item = TileGridId> + '_ {
        let filled =
            self.state.tiles.slots.iter().enumerate().filter(|(_, slot)| slot.grid.is_some());
        filled.map(|(index, slot)| TileGridId::new(index as u32, slot.generation))
    }

    /// The tile map that a body belongs to: for contacts and hits, together with
    /// [`TileGrid::cell_at`] a little below the surface, which is the border of two cells.
    pub fn tiles_of(&self, body: BodyId) -> Option<TileGridId> {
        let (_, index) = self.state.tiles.owners[self.state.tiles.place_of(body).ok()?];
        let slot = self.state.tiles.slots.get(index as usize)?;
        slot.grid.is_some().then(|| TileGridId::new(index, slot.generation))
    }

    /// Sets a cell (0 empties it, `k` is entry `k - 1` of the palette). The time does not depend on the
    /// size of the map: shapes of the block of 16 by 16 cells are made anew where they differ. What rested
    /// on them wakes.
    ///
    /// # Errors
    /// The handle is stale, the cell outside, or the value not in the palette.
    pub fn set_tile(&mut self, id: TileGridId, x: u32, y: u32, value: u16) -> Result<(), Error> {
        let placed = self.placed_mut(id)?;
        if placed.grid.get(x, y) == value && x < placed.grid.width && y < placed.grid.height {
            return Ok(());
        }
        placed.grid.set(x, y, value)?;
        self.build_block(id, x / BLOCK_CELLS, y / BLOCK_CELLS)
    }

    /// Brings the shapes of a block in line with its cells.
    fn build_block(&mut self, id: TileGridId, x: u32, y: u32) -> Result<(), Error> {
        let placed = self.placed(id)?;
        let grid = &placed.grid;
        let index = (y * grid.blocks().0 + x) as usize;
        let pieces = grid.pieces(x, y);
        let mut block = placed.blocks[index].clone();
        let alive = block.body.filter(|body| self.body(*body).is_some());
        if alive.is_none() {
            // The user has removed it, with all that it had.
            block.shapes.clear();
        }
        let new: Vec<Piece> = pieces
            .iter()
            .filter(|piece| !block.shapes.iter().any(|(old, _)| old == *piece))
            .copied()
            .collect();
        let shapes: Vec<_> = new.iter().map(|piece| grid.shape(x, y, piece)).collect();
        let body_def = grid.block_body(x, y);
        let mut kept = Vec::with_capacity(pieces.len());
        for (piece, shape) in core::mem::take(&mut block.shapes) {
            if pieces.contains(&piece) {
                kept.push((piece, shape));
            } else {
                // The user may have removed it.
                let _ = self.remove_shape(shape);
            }
        }
        if !shapes.is_empty() {
            let body = match alive {
                Some(body) => body,
                None => {
                    let body = self.add_body(body_def)?;
                    self.state.tiles.change_owner(id.index, block.body, body);
                    body
                }
            };
            block.body = Some(body);
            let body = self.body_index(body)?;
            kept.extend(new.into_iter().zip(self.insert_shapes(body, &shapes)?));
        }
        block.shapes = kept;
        self.placed_mut(id)?.blocks[index] = block;
        Ok(())
    }

    fn placed(&self, id: TileGridId) -> Result<&Placed, Error> {
        let slot = self.state.tiles.slots.get(id.index());
        let slot = slot.filter(|slot| slot.generation == id.generation);
        slot.and_then(|slot| slot.grid.as_ref()).ok_or_else(|| id.into())
    }

    fn placed_mut(&mut self, id: TileGridId) -> Result<&mut Placed, Error> {
        let slot = self.state.tiles.slots.get_mut(id.index());
        let slot = slot.filter(|slot| slot.generation == id.generation);
        slot.and_then(|slot| slot.grid.as_mut()).ok_or_else(|| id.into())
    }
}

/// Would all bodies and shapes of a grid be accepted?
fn check_parts(grid: &TileGrid) -> Result<(), Error> {
    for tile in &grid.palette {
        let like = ShapeDef::new(Shape::Circle { radius: 1.0 });
        check_shape(&ShapeDef { material: tile.material, ..like })?;
    }
    let (columns, rows) = grid.blocks();
    let corners = [(0, 0), (columns - 1, 0), (0, rows - 1), (columns - 1, rows - 1)];
    corners.into_iter().try_for_each(|(x, y)| check_body(&grid.block_body(x, y)))
}
