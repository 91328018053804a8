//! The benchmark scenes in tiny-physics, through its public interface.

fn main() {
    peers_worker::serve::<tiny_physics_scenes::WorldHost>();
}
