use tiny_physics_quality::{arena, our_engine};
fn main() {
    let a: Vec<u64> = std::env::args().skip(1).map(|x| x.parse().unwrap()).collect();
    for seed in a[0]..a[1] {
        let s = arena::draw(seed);
        let f = arena::play(&s, &our_engine, &|| 0.0);
        println!(
            "{seed} {} {:.4} {:.4} {:?} {:?} {:?} {:?} {:?}",
            f.passed, f.deepest, f.resting_overlap, f.gain, f.restless, f.asleep, f.gap, f.overrun
        );
    }
}
