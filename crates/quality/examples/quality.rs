//! Runs rows of the suites on this engine: `quality [other] [row...]`.

use std::time::Instant;
use tiny_physics_quality::{Variant, our_engine, resolve};

fn main() {
    let mut variant = Variant::Usual;
    let mut wanted = Vec::new();
    for argument in std::env::args().skip(1) {
        match argument.as_str() {
            "other" => variant = Variant::Other,
            _ => wanted.push(argument),
        }
    }
    let mut passed = 0;
    for row in resolve(&wanted).expect("rows, `hard`, or families") {
        let start = Instant::now();
        let report = row.run(&our_engine, variant, std::env::var("AWAKE").is_ok(), &mut |_, _| {});
        passed += u32::from(report.pass);
        if std::env::var("SHORT").is_ok() {
            print!("{}:", report.id);
            report.measures.iter().for_each(|m| print!("{:.2} ", m.use_of_target()));
            continue;
        }
        let seconds = start.elapsed().as_secs_f64();
        println!("{:2} {} ({seconds:.1} s)", report.id, report.name);
        for measure in &report.measures {
            let mark = if measure.pass { "ok  " } else { "MISS" };
            println!(
                "   {mark} {:60} {:>12.5} {} (target {}; {:.2})",
                measure.metric,
                measure.value,
                measure.unit,
                measure.target,
                measure.use_of_target(),
            );
        }
    }
    println!("{passed} rows pass");
}
