//! The benchmark scenes in tiny-physics, through its public interface.

#[cfg(feature = "world")]
mod world;

#[cfg(feature = "world")]
fn main() {
    peers_worker::serve::<world::Ours>();
}

#[cfg(not(feature = "world"))]
fn main() {
    println!(r#"{{"failed":"built without the feature `world`"}}"#);
}
