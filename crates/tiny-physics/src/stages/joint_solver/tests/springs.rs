//! Springs of nets: what swings as a whole, and what swings against its neighbours.

use super::*;

const LENGTH: f64 = 1.0;

/// Bodies in a row, neighbours joined by springs, nothing else: its swings are cosines of the place. That of n half
/// waves has the frequency `w sqrt(1 - cos(pi n / bodies))` and a damping ratio that goes with it.
fn check_swing_of_row((hertz, zeta): (f32, f32), bodies: usize, n: usize) {
    let mut rig = Rig::new();
    rig.gravity = Vec2::ZERO;
    // Substeps as usual, all of which are looked at.
    (rig.dt, rig.substeps) = (1.0 / 240.0, 1);
    let row: Vec<u32> = (0..bodies).map(|i| rig.cube(LENGTH * i as f64, 0.0)).collect();
    let spring = JointDef::distance(LENGTH as f32).spring(hertz, zeta);
    row.windows(2).for_each(|pair| _ = rig.joint(pair[0], pair[1], spring));
    let shape = |i: usize| (TAU * 0.5 * n as f64 * (i as f64 + 0.5) / bodies as f64).cos();
    for (i, &body) in row.iter().enumerate() {
        rig.bodies.rows[body as usize][Slot::VX] = (0.1 * shape(i)) as f32;
    }
    let ratio = (1.0 - shape_cosine(n, bodies)).sqrt();
    let (omega, zeta) = (TAU * f64::from(hertz) * ratio, f64::from(zeta) * ratio);
    let root = (1.0 - zeta * zeta).sqrt();
    let extremes = rig.extremes((2.2 * TAU / (omega * root)) as f32, |rig| {
        row.iter().enumerate().map(|(i, &body)| shape(i) * rig.position(body).x).sum::<f64>()
    });
    let middle = (0..bodies).map(|i| shape(i) * LENGTH * i as f64).sum();
    let (period, decrement) = period_and_decrement(&extremes[..4], middle);
    let what = format!("{hertz} Hz, {zeta:.3}, {n} half waves of {bodies}");
    assert_near(&what, period * omega * root / TAU, 1.0, 0.01);
    assert_near(&what, decrement * root / TAU, zeta, 0.05 * zeta + 2e-4);
}

fn shape_cosine(n: usize, bodies: usize) -> f64 {
    (0.5 * TAU * n as f64 / bodies as f64).cos()
}

#[test]
fn rows_of_springs_swing_as_they_should() {
    for spring in [(1.0, 0.1), (2.0, 0.3), (8.0, 0.3), (5.0, 0.7), (8.0, 0.02)] {
        for (bodies, n) in [(3, 1), (8, 1), (8, 3), (20, 1), (20, 2)] {
            check_swing_of_row(spring, bodies, n);
        }
    }
}

fn random(seed: u32) -> impl FnMut(f32, f32) -> f32 {
    let mut state = seed;
    move |least, most| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        least + (most - least) * ((state >> 8) as f32 / (1 << 24) as f32)
    }
}

/// A net of any masses and springs that hangs and falls against its equations of motion, solved by Runge and Kutta.
#[test]
fn nets_of_springs_fall_as_they_should() {
    let mut random = random(5);
    for size in [2, 3, 5, 8] {
        let mut rig = Rig::new();
        let mut net = Net::default();
        for i in 0..size * size {
            let mass = random(0.3, 3.0);
            let at = [(i % size) as f64 * LENGTH, (i / size) as f64 * -LENGTH];
            rig.body(at[0], at[1], mass, 1.0);
            net.add(at, mass.into());
            // The uppermost hang on the world.
            let above = if i < size { vec![] } else { vec![i - size] };
            let beside = if i % size > 0 { vec![i - 1] } else { vec![] };
            for other in above.into_iter().chain(beside) {
                let (hertz, zeta) = (random(0.5, 20.0), random(0.0, 1.0));
                let spring = JointDef::distance(LENGTH as f32).spring(hertz, zeta);
                rig.joint(1 + other as u32, 1 + i as u32, spring);
                net.join(Some(other), i, (hertz, zeta));
            }
            if i < size {
                let (hertz, zeta) = (random(1.0, 8.0), random(0.0, 1.0));
                let spring = JointDef::distance(LENGTH as f32).spring(hertz, zeta);
                let at = Vec2::new(at[0] as f32, LENGTH as f32);
                rig.joint(0, 1 + i as u32, spring.anchors(at, Vec2::ZERO));
                net.join(None, i, (hertz, zeta));
            }
        }
        for _ in 0..4 {
            rig.run(0.25);
            (0..2000).for_each(|_| net.step(0.25 / 2000.0));
            let (mut off, mut way): (f64, f64) = (0.0, 0.0);
            for (i, body) in net.bodies.iter().enumerate() {
                let p = rig.position(1 + i as u32);
                off = off.max((p.x - body[0]).hypot(p.y - body[1]));
                way = way.max((body[0] - net.start[i][0]).hypot(body[1] - net.start[i][1]));
            }
            println!("{size}: {off:.4} of {way:.3} m");
            assert!(off < 0.02 * way, "{size}: {off} of {way}");
        }
    }
}

/// Points and springs in double precision.
#[derive(Default)]
struct Net {
    /// Place and velocity.
    bodies: Vec<[f64; 4]>,
    start: Vec<[f64; 2]>,
    masses: Vec<f64>,
    /// The first end, or the world above; the second; stiffness and damping.
    springs: Vec<(Option<usize>, usize, [f64; 2])>,
}

impl Net {
    fn add(&mut self, at: [f64; 2], mass: f64) {
        self.bodies.push([at[0], at[1], 0.0, 0.0]);
        self.start.push(at);
        self.masses.push(mass);
    }

    fn join(&mut self, a: Option<usize>, b: usize, (hertz, zeta): (f32, f32)) {
        let inverse = a.map_or(0.0, |a| 1.0 / self.masses[a]) + 1.0 / self.masses[b];
        let omega = TAU * f64::from(hertz);
        let strengths = [omega * omega / inverse, 2.0 * f64::from(zeta) * omega / inverse];
        self.springs.push((a, b, strengths));
    }

    fn rates(&self, bodies: &[[f64; 4]]) -> Vec<[f64; 4]> {
        let mut rates: Vec<_> =
            bodies.iter().map(|body| [body[2], body[3], 0.0, -f64::from(G)]).collect();
        for &(a, b, [stiffness, damping]) in &self.springs {
            let from = a.map_or([self.start[b][0], LENGTH, 0.0, 0.0], |a| bodies[a]);
            let d: [f64; 4] = core::array::from_fn(|k| bodies[b][k] - from[k]);
            let length = d[0].hypot(d[1]);
            let speed = (d[0] * d[2] + d[1] * d[3]) / length;
            let force = -(stiffness * (length - LENGTH) + damping * speed) / length;
            for k in 0..2 {
                rates[b][2 + k] += force * d[k] / self.masses[b];
                if let Some(a) = a {
                    rates[a][2 + k] -= force * d[k] / self.masses[a];
                }
            }
        }
        rates
    }

    fn step(&mut self, h: f64) {
        let at = |rates: &[[f64; 4]], part: f64| -> Vec<[f64; 4]> {
            let both = self.bodies.iter().zip(rates);
            both.map(|(x, v)| core::array::from_fn(|k| x[k] + part * h * v[k])).collect()
        };
        let first = self.rates(&self.bodies);
        let second = self.rates(&at(&first, 0.5));
        let third = self.rates(&at(&second, 0.5));
        let fourth = self.rates(&at(&third, 1.0));
        for i in 0..self.bodies.len() {
            for k in 0..4 {
                let sum = first[i][k] + 2.0 * (second[i][k] + third[i][k]) + fourth[i][k];
                self.bodies[i][k] += h / 6.0 * sum;
            }
        }
    }
}

/// A springy place with a rigid angle, held anywhere: it sags by g / w^2, and swings at its frequency, without turning. It counted with
/// the inertia that a body free to turn has there: a bar of 2 m held at its end sagged by 0.255 m in place of 0.063 m.
#[test]
fn springy_places_with_rigid_angles_know_no_lever_arm() {
    let mut random = random(11);
    for case in 0..40 {
        let (hertz, zeta) = (random(0.5, 8.0), random(0.1, 1.0));
        let (mass, inertia) = (random(0.3, 3.0), random(0.02, 3.0));
        let [x, y] = [0, 1].map(|_| random(-2.0, 2.0));
        let mut rig = Rig::new();
        let bar = rig.body(x.into(), y.into(), mass, inertia);
        let spring = Some(Spring { hertz, damping_ratio: zeta });
        let weld = JointDef::new(JointKind::Weld { linear: spring, angular: None });
        let held = match case % 2 {
            0 => 0,
            _ => rig.body(0.0, 0.0, random(0.3, 3.0), random(0.02, 3.0)),
        };
        rig.joint(held, bar, weld.anchors(Vec2::ZERO, Vec2::new(-x, -y)));
        let omega = TAU * f64::from(hertz);
        if held == 0 {
            rig.run(3.0 / (zeta * hertz));
            let sag = f64::from(y) - rig.position(bar).y;
            let expected = f64::from(G) / (omega * omega);
            assert_near(&format!("{case}: {hertz} Hz"), sag / expected, 1.0, 0.01);
            assert_near(&format!("{case}"), rig.angle(bar).into(), 0.0, 1e-3);
            continue;
        }
        // Two free ones swing across the line between their centres.
        rig.gravity = Vec2::ZERO;
        let across = Vec2::new(-y, x).direction_and_length().0;
        (rig.dt, rig.substeps) = (1.0 / 240.0, 1);
        rig.bodies.rows[bar as usize][Slot::VX] = 0.02 * across.x;
        rig.bodies.rows[bar as usize][Slot::VY] = 0.02 * across.y;
        let zeta = f64::from(zeta.min(0.5));
        let spring = Some(Spring { hertz, damping_ratio: zeta as f32 });
        let def = rig.joints.records[0].def;
        rig.update(0, JointDef { kind: JointKind::Weld { linear: spring, angular: None }, ..def });
        let root = (1.0 - zeta * zeta).sqrt();
        let extremes = rig.extremes((2.2 * TAU / (omega * root)) as f32, |rig| {
            let at = rig.bodies.poses[bar as usize].apply(Vec2::new(-x, -y));
            f64::from(across.dot(at.relative_to(rig.position(held))))
        });
        let (period, decrement) = period_and_decrement(&extremes[..3], 0.0);
        assert_near(&format!("{case}: {hertz} Hz"), period * omega * root / TAU, 1.0, 0.01);
        assert_near(&format!("{case}"), decrement * root / TAU, zeta, 0.05 * zeta);
    }
}
