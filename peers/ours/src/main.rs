//! The benchmark scenes in tiny-physics, through its public interface.

mod world;

fn main() {
    peers_worker::serve::<world::Ours>();
}
