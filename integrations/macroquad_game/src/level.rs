//! The level, drawn with letters, and what stands in it.

use tiny_physics::{DVec2, Error, TileGrid};

/// Ground as in [`TileGrid::parse`]; `P` hero, `o` coin, `x` crate, `b` brick, `=` lift, `T` barrel of powder, `D` foot of the door, `F` flag.
pub const ROWS: [&str; 14] = [
    "##################################################",
    "#                                                #",
    "#                                                #",
    "#                                 ##########     #",
    "#                                 ##########     #",
    "#                         o x     ##########     #",
    "#                      #######    ##########     #",
    "#                      #######    ##########     #",
    "#                      #######    ##########     #",
    "#       o     o        #######       b           #",
    "#      ---  /###\\      #######       b o         #",
    "# P  x     /#####\\     #######    T  b    D   F  #",
    "#################### =############################",
    "##################################################",
];

/// A thing that a letter stands for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Thing {
    /// Where the hero begins.
    Hero,
    /// Something to collect.
    Coin,
    /// Something to push.
    Crate,
    /// Something that is in the way.
    Brick,
    /// Something to ride on.
    Lift,
    /// Something to light.
    Barrel,
    /// Opens when all coins are found.
    Door,
    /// The end.
    Flag,
}

/// The ground.
///
/// # Errors
/// None as long as [`ROWS`] has rows.
pub fn ground() -> Result<TileGrid, Error> {
    TileGrid::parse(1.0, &ROWS)
}

/// Things with the middles of their cells, metres.
pub fn things() -> Vec<(Thing, DVec2)> {
    let mut things = Vec::new();
    for (y, row) in ROWS.iter().rev().enumerate() {
        for (x, letter) in row.chars().enumerate() {
            let place = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
            things.extend(thing(letter).map(|thing| (thing, place)));
        }
    }
    things
}

fn thing(letter: char) -> Option<Thing> {
    Some(match letter {
        'P' => Thing::Hero,
        'o' => Thing::Coin,
        'x' => Thing::Crate,
        'b' => Thing::Brick,
        '=' => Thing::Lift,
        'T' => Thing::Barrel,
        'D' => Thing::Door,
        'F' => Thing::Flag,
        _ => return None,
    })
}
