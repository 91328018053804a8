//! Tile maps: what stands in each cell, and the shapes that it makes.
//!
//! A grid holds small numbers: 0 is empty, `k` is entry `k - 1` of the palette. Cells of one kind grow
//! together to rectangles as large as possible, within blocks of 16 by 16 cells, so that a box that
//! lies over many cells has two points, and an edit touches one block only.

use super::{Filter, Material, RigidBody, ShapeDef};
use crate::codec::{data, described, described_enum, setters};
use crate::error::Error;
use crate::geometry::{MAX_EXTENT, MIN_EXTENT, Polygon, Shape};
use crate::math::{DVec2, Rot, Vec2};

/// Side of a block of cells that share a body.
pub(crate) const BLOCK_CELLS: u32 = 16;
/// Most cells of a grid along either axis.
const MAX_CELLS: u32 = 1 << 20;
/// And in all: 128 MiB of them.
const MAX_AREA: u64 = 1 << 26;

described_enum! {
    /// What part of its cell a tile fills. [`Tile::mirror_x`] and [`Tile::mirror_y`] give the others: slopes that
    /// fall, ceilings, upper halves.
    #[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
    pub enum TileForm {
        /// All of it.
        #[default]
        Full = 0,
        /// The lower half.
        Half = 1,
        /// The left half.
        Side = 2,
        /// Under the diagonal that rises to the right, 45 degrees.
        Slope = 3,
        /// The lower cell of a slope over two cells: rises from the bottom left to half the height.
        GentleLow = 4,
        /// The upper cell of a slope over two cells: rises from half the height to the top right.
        GentleHigh = 5,
    }
}

described! {
    /// A kind of tile.
    #[derive(Clone, Copy, PartialEq, Debug)]
    pub struct Tile {
        /// The part of the cell that is solid.
        pub form: TileForm = TileForm::default(),
        /// Is the form mirrored left to right?
        pub mirror_x: bool = false,
        /// Is the form turned upside down?
        pub mirror_y: bool = false,
        /// The surface.
        pub material: Material = Material::default(),
        /// What it collides with.
        pub filter: Filter = Filter::default(),
        /// For one-way tiles: the direction out of the solid side, in the grid's frame.
        pub one_way: Option<Vec2> = None,
        /// Free for the user; the shapes get it.
        pub user_data: u64 = 0,
    }
}

impl Tile {
    /// A tile of this form with the default material.
    pub fn new(form: TileForm) -> Self {
        Self { form, ..Self::default() }
    }

    /// Mirrors the form left to right.
    pub fn mirrored_x(mut self) -> Self {
        self.mirror_x = !self.mirror_x;
        self
    }

    /// Turns the form upside down.
    pub fn mirrored_y(mut self) -> Self {
        self.mirror_y = !self.mirror_y;
        self
    }

    /// May equal neighbours grow together along (x, y)?
    fn merges(self) -> (bool, bool) {
        match self.form {
            TileForm::Full => (true, true),
            TileForm::Half => (true, false),
            TileForm::Side => (false, true),
            TileForm::Slope | TileForm::GentleLow | TileForm::GentleHigh => (false, false),
        }
    }

    /// Corners of the solid part in a cell of side 1.
    fn corners(self) -> Vec<Vec2> {
        let corners: &[(f32, f32)] = match self.form {
            TileForm::Full => &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)],
            TileForm::Half => &[(0.0, 0.0), (1.0, 0.0), (1.0, 0.5), (0.0, 0.5)],
            TileForm::Side => &[(0.0, 0.0), (0.5, 0.0), (0.5, 1.0), (0.0, 1.0)],
            TileForm::Slope => &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)],
            TileForm::GentleLow => &[(0.0, 0.0), (1.0, 0.0), (1.0, 0.5)],
            TileForm::GentleHigh => &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 0.5)],
        };
        let mirror = |on: bool, value: f32| if on { 1.0 - value } else { value };
        let place = |&(x, y)| Vec2::new(mirror(self.mirror_x, x), mirror(self.mirror_y, y));
        corners.iter().map(place).collect()
    }
}

setters! {
    Tile {
        /// Sets the friction.
        friction(friction: f32): material.friction = friction;
        /// Sets [`Tile::one_way`].
        one_way(direction: impl Into<Vec2>): one_way = Some(direction.into());
    }
}

described! {
    /// A map of tiles, fixed in the world.
    ///
    /// ```
    /// use tiny_physics::{TileGrid, Vec2, World};
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let grid = TileGrid::parse(1.0, &["..........", "...----...", "......./##", "##########"])?;
    /// let mut world = World::new(Vec2::new(0.0, -9.8));
    /// let level = world.add_tiles(grid)?;
    /// world.set_tile(level, 4, 1, 1)?; // A full tile in the second row from below.
    /// # Ok(())
    /// # }
    /// ```
    #[derive(Clone, PartialEq, Debug)]
    pub struct TileGrid {
        /// The lower left corner of cell (0, 0): world, metres.
        pub position: DVec2 = default,
        /// Angle of the rows, radians.
        pub angle: f32 = default,
        /// Side of a cell, metres.
        pub cell_size: f32,
        /// Cells in a row.
        pub width: u32,
        /// Rows, from the bottom up.
        pub height: u32,
        /// Kinds of tiles; cell value 1 is the first.
        pub palette: Vec<Tile>,
        /// Cell values by row from the bottom, 0 is empty.
        pub cells: Vec<u16>,
    }
}

impl TileGrid {
    /// An empty grid with a palette. One of more than 2^26 cells, or 2^20 along an axis, has no cells: no world takes it.
    pub fn new(cell_size: f32, width: u32, height: u32, palette: Vec<Tile>) -> Self {
        let (position, angle, cells) = (DVec2::ZERO, 0.0, Vec::new());
        let mut grid = Self { position, angle, cell_size, width, height, palette, cells };
        if grid.check_size().is_ok() {
            grid.cells = vec![0; width as usize * height as usize];
        }
        grid
    }

    /// A grid drawn with letters, the top row first: `#` full, `_` lower half, `"` upper half, `[` left
    /// half, `]` right half, `/` and `\` slopes, `l` `h` a gentle slope that rises to the right, `H` `L` one
    /// that falls, `-` a one-way tile, all else empty. The palette is always the same: value 1 is full.
    ///
    /// # Errors
    /// A cell size that is out of range, no rows, or more cells than a grid may have.
    pub fn parse(cell_size: f32, rows: &[&str]) -> Result<Self, Error> {
        let width = rows.iter().map(|row| row.chars().count()).max().unwrap_or(0) as u32;
        let mut grid = Self::new(cell_size, width, rows.len() as u32, legend());
        for (y, row) in rows.iter().rev().enumerate() {
            for (x, letter) in row.chars().enumerate() {
                let value = LETTERS.chars().position(|known| known == letter);
                if let Some(cell) = grid.cells.get_mut(y * width as usize + x) {
                    *cell = value.map_or(0, |index| index as u16 + 1);
                }
            }
        }
        grid.validate().map(|()| grid)
    }

    /// Sets the friction of the whole palette.
    pub fn friction(mut self, friction: f32) -> Self {
        self.palette.iter_mut().for_each(|tile| tile.material.friction = friction);
        self
    }

    /// The value of a cell; 0 outside of the grid.
    pub fn get(&self, x: u32, y: u32) -> u16 {
        self.index(x, y).map_or(0, |index| self.cells[index])
    }

    /// What stands in a cell.
    pub fn tile(&self, x: u32, y: u32) -> Option<&Tile> {
        self.palette.get(usize::from(self.get(x, y)).checked_sub(1)?)
    }

    /// Sets the value of a cell.
    ///
    /// # Errors
    /// The cell is outside of the grid, or the palette has no such entry.
    pub fn set(&mut self, x: u32, y: u32, value: u16) -> Result<(), Error> {
        let reason = "the cell is outside of the tile grid";
        let index = self.index(x, y).ok_or(Error::Unsupported { reason })?;
        let is_known = usize::from(value) <= self.palette.len();
        Error::check("tile", value, is_known, "0 to the length of the palette")?;
        self.cells[index] = value;
        Ok(())
    }

    /// The cell that holds a point of the world.
    pub fn cell_at(&self, point: impl Into<DVec2>) -> Option<(u32, u32)> {
        let (Rot { c, s }, way) = (Rot::from_angle(self.angle), point.into() - self.position);
        let (c, s) = (f64::from(c), f64::from(s));
        // A rotation of 32 bits is not quite of length 1.
        let cell = f64::from(self.cell_size) * (c * c + s * s);
        let (x, y) = ((c * way.x + s * way.y) / cell, (c * way.y - s * way.x) / cell);
        let inside = |value: f64, count: u32| value >= 0.0 && value < f64::from(count);
        (inside(x, self.width) && inside(y, self.height)).then_some((x as u32, y as u32))
    }

    /// The middle of a cell: world, metres.
    pub fn center_of(&self, x: u32, y: u32) -> DVec2 {
        self.place(f64::from(x) + 0.5, f64::from(y) + 0.5)
    }

    /// Can this grid be added to a world?
    ///
    /// # Errors
    /// A number is out of range, the cells are not width times height, or one of them is not in the
    /// palette.
    pub fn validate(&self) -> Result<(), Error> {
        Error::check_finite("angle", self.angle)?;
        Error::check_finite_point("position", self.position)?;
        let size = f64::from(self.cell_size);
        let is_right = (f64::from(MIN_EXTENT) * 10.0..f64::from(MAX_EXTENT) / 32.0).contains(&size);
        Error::check("cell_size", size, is_right, "1e-4 to 3e4")?;
        self.check_size()?;
        if self.cells.len() as u64 != self.area() {
            return Err(Error::Unsupported { reason: "a tile grid needs width * height cells" });
        }
        if self.cells.iter().any(|&value| usize::from(value) > self.palette.len()) {
            return Err(Error::Unsupported { reason: "a cell is not in the palette of its grid" });
        }
        let pieces = self.palette.iter().map(|tile| tile.one_way);
        pieces.flatten().try_for_each(|way| Error::check_finite_vec("one_way", way))
    }

    fn area(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }

    fn check_size(&self) -> Result<(), Error> {
        for (name, value) in [("width", self.width), ("height", self.height)] {
            Error::check(name, value, (1..=MAX_CELLS).contains(&value), "1 to 1048576")?;
        }
        let area = self.area();
        Error::check("width * height", area as f64, area <= MAX_AREA, "1 to 67108864")
    }

    /// The grid as static bodies, one for each block of 16 by 16 cells that is not empty: for scene files
    /// and for engines without tile grids. Edits need [`World::add_tiles`](crate::World::add_tiles).
    pub fn bodies(&self) -> Vec<RigidBody> {
        let (columns, rows) = if self.check_size().is_ok() { self.blocks() } else { (0, 0) };
        let blocks = (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y)));
        let bodies = blocks.map(|(x, y)| {
            let mut body = self.block_body(x, y);
            body.shapes = self.pieces(x, y).iter().map(|piece| self.shape(x, y, piece)).collect();
            body
        });
        bodies.filter(|body| !body.shapes.is_empty()).collect()
    }

    /// Where a cell of the grid is in the list, if it is there.
    fn index(&self, x: u32, y: u32) -> Option<usize> {
        let index = u64::from(y) * u64::from(self.width) + u64::from(x);
        let inside = x < self.width && y < self.height && index < self.cells.len() as u64;
        inside.then_some(index as usize)
    }

    /// Where a place of the grid, in cells, is in the world. In 64 bits: blocks far along turned rows lie flush.
    fn place(&self, x: f64, y: f64) -> DVec2 {
        let (Rot { c, s }, cell) = (Rot::from_angle(self.angle), f64::from(self.cell_size));
        let (c, s, x, y) = (f64::from(c), f64::from(s), x * cell, y * cell);
        self.position + DVec2::new(c * x - s * y, s * x + c * y)
    }

    /// Blocks in a row, and rows of blocks.
    pub(crate) fn blocks(&self) -> (u32, u32) {
        (self.width.div_ceil(BLOCK_CELLS), self.height.div_ceil(BLOCK_CELLS))
    }

    /// The body of a block, without shapes.
    pub(crate) fn block_body(&self, x: u32, y: u32) -> RigidBody {
        let corner = |block: u32| f64::from(block * BLOCK_CELLS);
        RigidBody::fixed().position(self.place(corner(x), corner(y))).angle(self.angle)
    }

    /// The shape of a piece in the frame of its block's body.
    pub(crate) fn shape(&self, block_x: u32, block_y: u32, piece: &Piece) -> ShapeDef {
        let tile = self.palette[usize::from(piece.value) - 1];
        let corner = Vec2::new(
            (piece.x - block_x * BLOCK_CELLS) as f32,
            (piece.y - block_y * BLOCK_CELLS) as f32,
        );
        let size = Vec2::new(piece.width as f32, piece.height as f32);
        let place = |at: &Vec2| corner + Vec2::new(at.x * size.x, at.y * size.y);
        // The hull is that of cells of side 1: it takes corners that are close for one. Tiles always have one, and the circle is never
        // taken.
        let hull = Polygon::hull(&tile.corners().iter().map(place).collect::<Vec<_>>());
        let scale = |hull: Polygon| hull.vertices().iter().map(|at| *at * self.cell_size).collect();
        let shape = hull.map(scale).and_then(|corners: Vec<Vec2>| Polygon::convex(&corners));
        let shape = shape.map_or(Shape::Circle { radius: self.cell_size }, Shape::Polygon);
        let mut def = ShapeDef::new(shape).filter(tile.filter).user_data(tile.user_data);
        def.material = tile.material;
        def.one_way = tile.one_way;
        def
    }

    /// The rectangles that the cells of a block make: each as wide as it can be, then as high.
    pub(crate) fn pieces(&self, block_x: u32, block_y: u32) -> Vec<Piece> {
        let (left, bottom) = (block_x * BLOCK_CELLS, block_y * BLOCK_CELLS);
        let right = (left + BLOCK_CELLS).min(self.width);
        let top = (bottom + BLOCK_CELLS).min(self.height);
        let mut taken = [0_u32; BLOCK_CELLS as usize];
        let mut pieces = Vec::new();
        for y in bottom..top {
            for x in left..right {
                let value = self.get(x, y);
                if self.tile(x, y).is_none() || taken[(y - bottom) as usize] >> (x - left) & 1 != 0
                {
                    continue;
                }
                let free = |x: u32, y: u32, taken: &[u32]| {
                    self.get(x, y) == value && taken[(y - bottom) as usize] >> (x - left) & 1 == 0
                };
                let (wide, high) = self.palette[usize::from(value) - 1].merges();
                let (mut end_x, mut end_y) = (x + 1, y + 1);
                while wide && end_x < right && free(end_x, y, &taken) {
                    end_x += 1;
                }
                while high && end_y < top && (x..end_x).all(|x| free(x, end_y, &taken)) {
                    end_y += 1;
                }
                let bits = ((1_u32 << (end_x - x)) - 1) << (x - left);
                taken[(y - bottom) as usize..(end_y - bottom) as usize]
                    .iter_mut()
                    .for_each(|row| *row |= bits);
                pieces.push(Piece { x, y, width: end_x - x, height: end_y - y, value });
            }
        }
        pieces
    }
}

setters! {
    TileGrid {
        /// Sets [`TileGrid::position`].
        position(position: impl Into<DVec2>): position = position.into();
    }
}

/// A rectangle of cells of one kind that make one shape.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Piece {
    x: u32,
    y: u32,
    width: u32,
    height: u32,
    value: u16,
}

data!(Piece { x, y, width, height, value });

/// Letters of [`TileGrid::parse`] in the order of its palette.
const LETTERS: &str = "#_\"[]/\\lhHL-";

fn legend() -> Vec<Tile> {
    let tile = Tile::new;
    vec![
        tile(TileForm::Full),
        tile(TileForm::Half),
        tile(TileForm::Half).mirrored_y(),
        tile(TileForm::Side),
        tile(TileForm::Side).mirrored_x(),
        tile(TileForm::Slope),
        tile(TileForm::Slope).mirrored_x(),
        tile(TileForm::GentleLow),
        tile(TileForm::GentleHigh),
        tile(TileForm::GentleHigh).mirrored_x(),
        tile(TileForm::GentleLow).mirrored_x(),
        tile(TileForm::Half).mirrored_y().one_way(Vec2::Y),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_grow_together() {
        let grid = TileGrid::parse(0.5, &["#..#", "####", "####"]).unwrap();
        let pieces = grid.pieces(0, 0);
        let sizes: Vec<_> = pieces.iter().map(|p| (p.x, p.y, p.width, p.height)).collect();
        assert_eq!(sizes, [(0, 0, 4, 2), (0, 2, 1, 1), (3, 2, 1, 1)]);
        let body = &grid.bodies()[0];
        assert_eq!(body.shapes.len(), 3);
        let area: f32 = body.shapes.iter().map(|s| s.shape.mass_properties(1.0).mass).sum();
        assert!((area - 10.0 * 0.25).abs() < 1e-5);
    }

    #[test]
    fn large_grids_have_blocks() {
        let mut grid = TileGrid::new(1.0, 40, 20, legend());
        grid.cells.fill(1);
        assert_eq!(grid.blocks(), (3, 2));
        assert_eq!(grid.bodies().len(), 6);
        grid.cells.fill(0);
        assert!(grid.bodies().is_empty());
        grid.set(39, 19, 6).unwrap();
        assert_eq!(grid.bodies().len(), 1);
        assert_eq!(grid.tile(39, 19).unwrap().form, TileForm::Slope);
    }

    #[test]
    fn every_form_has_its_area() {
        for (letter, area) in
            LETTERS.chars().zip([1.0, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.25, 0.75, 0.75, 0.25, 0.5])
        {
            let grid = TileGrid::parse(2.0, &[letter.to_string().as_str()]).unwrap();
            let shape = &grid.bodies()[0].shapes[0].shape;
            let found = shape.mass_properties(1.0).mass / 4.0;
            assert!((found - area).abs() < 1e-5, "{letter}: {found}");
        }
    }

    #[test]
    fn points_have_cells() {
        let grid = TileGrid::parse(0.5, &["....", "...."]).unwrap().position(Vec2::new(10.0, -1.0));
        assert_eq!(grid.cell_at(Vec2::new(10.6, -0.9)), Some((1, 0)));
        assert_eq!(grid.cell_at(Vec2::new(9.9, -0.9)), None);
        assert_eq!(grid.cell_at(Vec2::new(12.1, -0.9)), None);
        assert_eq!(grid.center_of(1, 1).to_vec2(), Vec2::new(10.75, -0.25));
    }

    #[test]
    fn what_is_wrong_is_refused() {
        assert!(TileGrid::parse(0.0, &["#"]).is_err());
        assert!(TileGrid::parse(f32::NAN, &["#"]).is_err());
        assert!(TileGrid::parse(1.0, &[]).is_err());
        let mut grid = TileGrid::parse(1.0, &["##"]).unwrap();
        assert!(grid.set(2, 0, 1).is_err() && grid.set(0, 0, 99).is_err());
        grid.cells.push(0);
        assert!(grid.validate().is_err());
    }
}
