//! The benchmark scenes in Box2D v3, through its C interface.

mod joints;
mod queries;
mod shapes;
mod world;

fn main() {
    peers_worker::serve::<world::Box2d>();
}
