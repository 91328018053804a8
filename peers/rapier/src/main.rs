//! The benchmark scenes in Rapier, through its public interface.

mod belts;
mod filters;
mod joints;
mod queries;
mod shapes;
mod world;

fn main() {
    peers_worker::serve::<world::Rapier>();
}
