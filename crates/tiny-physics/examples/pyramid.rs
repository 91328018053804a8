use tiny_physics::*;
fn main() {
    let n: i32 = std::env::args().nth(1).map_or(100, |s| s.parse().unwrap());
    let steps: usize = std::env::args().nth(2).map_or(500, |s| s.parse().unwrap());
    let level: SimdLevel =
        std::env::args().nth(3).map_or(SimdLevel::detect(), |s| s.parse().unwrap());
    let mut world = World::new(Vec2::new(0.0, -10.0));
    world.settings.sleep = false;
    world.set_simd(level).unwrap();
    world.set_threads(std::env::args().nth(4).map_or(1, |s| s.parse().unwrap()));
    world
        .add_body(
            RigidBody::fixed()
                .position(Vec2::new(0.0, -1.0))
                .shape(Shape::Polygon(Polygon::rect(100.0, 1.0).unwrap())),
        )
        .unwrap();
    let mut ids = vec![];
    for i in 0..n {
        for j in i..n {
            let x = 0.5 * (i as f32 + 1.0) + (j - i) as f32 - 0.5 * n as f32;
            let y = i as f32 + 0.5;
            ids.push((
                world
                    .add_body(
                        RigidBody::dynamic()
                            .position(Vec2::new(x, y))
                            .shape(Shape::Polygon(Polygon::rect(0.5, 0.5).unwrap())),
                    )
                    .unwrap(),
                Vec2::new(x, y),
            ));
        }
    }
    let mut sum = [0.0; 7];
    let t = std::time::Instant::now();
    for _ in 0..steps {
        world.step(1.0 / 60.0);
        for (k, s) in Stage::ALL.into_iter().enumerate() {
            sum[k] += world.stats().seconds(s);
        }
    }
    let total = t.elapsed().as_secs_f64();
    let drift = ids
        .iter()
        .map(|(id, p)| (world.body(*id).unwrap().position() - *p).length())
        .fold(0.0f32, f32::max);
    println!(
        "{level} {:.3} ms/step contacts {} drift {drift} pen {} hash {:016x}",
        total * 1e3 / steps as f64,
        world.contact_count(),
        world.max_penetration(),
        world.state_hash()
    );
    for (k, s) in Stage::ALL.into_iter().enumerate() {
        println!("  {:14} {:.3} ms", s.name(), sum[k] * 1e3 / steps as f64);
    }
    if let Err(e) = world.validate() {
        println!("INVALID {e}");
    }
}
