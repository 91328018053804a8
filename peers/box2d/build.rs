//! Passes on how the C compiler was called, so that the worker can refuse to be timed when Box2D's
//! assertions are on.

fn main() {
    println!("cargo::rerun-if-env-changed=CFLAGS");
    let flags = std::env::var("CFLAGS").unwrap_or_default();
    println!("cargo::rustc-env=PEERS_CFLAGS={flags}");
}
