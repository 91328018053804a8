//! Tile maps.

use crate::convert::{Pair, StaleHandleError, error, read, write};
use crate::handles::{Body, Tiles, World};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use tiny_physics::{DVec2, TileGrid};

#[pymethods]
impl World {
    /// Adds a tile map of static bodies, without bumps at the seams.
    ///
    /// tiles: rows of text, the top one first: "#" is full, "_" its lower half, '"' the upper, "[" the left, "]" the right,
    /// "/" and "\\" slopes, "lh" a gentle slope to the right, "HL" one to the left, "-" a tile that is solid from above, all
    /// else empty. Or a dictionary as `Tiles.description` gives, with a palette of your own; the rest is in that then.
    /// cell_size: side of a cell, metres. position: lower left corner of the map: world, metres.
    ///
    /// Raises ValueError where a field is unknown or a number makes no sense.
    #[pyo3(signature = (tiles, cell_size=1.0, position=Pair(0.0, 0.0)))]
    fn add_tiles(
        slf: &Bound<'_, Self>,
        tiles: &Bound<'_, PyAny>,
        cell_size: f32,
        position: Pair,
    ) -> PyResult<Tiles> {
        let grid: TileGrid = match tiles.extract::<Vec<String>>() {
            Ok(rows) => {
                let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
                let grid = TileGrid::parse(cell_size, &rows).map_err(error)?;
                TileGrid { position: DVec2::from(position), ..grid }
            }
            Err(_) => read(tiles)?,
        };
        let id = slf.try_borrow_mut()?.inner.add_tiles(grid).map_err(error)?;
        Ok(Tiles { world: slf.clone().unbind(), id })
    }
}

#[pymethods]
impl Body {
    /// The tile map that it is a part of; None of others.
    #[getter]
    fn tiles(&self, py: Python<'_>) -> PyResult<Option<Tiles>> {
        let found = self.world.try_borrow(py)?.inner.tiles_of(self.id);
        Ok(found.map(|id| Tiles { world: self.world.clone_ref(py), id }))
    }
}

impl Tiles {
    fn get<T>(&self, py: Python<'_>, get: impl FnOnce(&TileGrid) -> T) -> PyResult<T> {
        let world = self.world.try_borrow(py)?;
        let stale = || StaleHandleError::new_err(format!("{} has been removed", self.id));
        world.inner.tiles(self.id).map(get).ok_or_else(stale)
    }
}

#[pymethods]
impl Tiles {
    /// Is it still in the world?
    #[getter]
    fn is_valid(&self, py: Python<'_>) -> PyResult<bool> {
        Ok(self.world.try_borrow(py)?.inner.tiles(self.id).is_some())
    }

    /// Dense index: small, used again after removal.
    #[getter]
    fn index(&self) -> usize {
        self.id.index()
    }

    /// All of it as it is now, as a dictionary: position, angle, cell_size, width, height, palette, and cells by row from the bottom.
    #[getter]
    fn description<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        write(py, &self.get(py, TileGrid::clone)?)
    }

    /// The value of the cell in column x and row y, from the lower left: 0 is empty, k entry k - 1 of the palette.
    ///
    /// Raises IndexError outside of the map.
    fn __getitem__(&self, py: Python<'_>, cell: (u32, u32)) -> PyResult<u16> {
        let (x, y) = cell;
        let outside = || PyIndexError::new_err(format!("there is no cell ({x}, {y})"));
        let cell = |grid: &TileGrid| (x < grid.width && y < grid.height).then(|| grid.get(x, y));
        self.get(py, cell)?.ok_or_else(outside)
    }

    /// Sets a cell. What rested on it wakes.
    ///
    /// Raises ValueError outside of the map, and for what is not in the palette.
    fn __setitem__(&self, py: Python<'_>, cell: (u32, u32), value: u16) -> PyResult<()> {
        let mut world = self.world.try_borrow_mut(py)?;
        world.inner.set_tile(self.id, cell.0, cell.1, value).map_err(error)
    }

    /// Removes it. What rested on it wakes.
    fn remove(&self, py: Python<'_>) -> PyResult<()> {
        self.world.try_borrow_mut(py)?.inner.remove_tiles(self.id).map_err(error)
    }

    fn __repr__(&self) -> String {
        format!("<Tiles {}>", self.id.index())
    }
}
