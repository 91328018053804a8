//! Effective masses of contacts: what an impulse at a point moves.

use crate::dynamics::{Bodies, Contact, Graph};
use crate::simd::Lanes;

/// 1 / (sum of inverse masses + arms squared times inverse inertias), zero where nothing can move.
#[inline(always)]
pub(super) fn effective_mass<L: Lanes>(token: L::Token, arm: [L; 2], [mass, a, b]: [L; 3]) -> L {
    let k = mass + a * arm[0] * arm[0] + b * arm[1] * arm[1];
    let zero = L::splat(token, 0.0);
    L::select(k.gt(zero), L::splat(token, 1.0) / k, zero)
}

/// Has the constraint of a contact follow the masses of its bodies, which are others than when it was written.
pub(super) fn follow(graph: &mut Graph, contact: &Contact, bodies: &Bodies) {
    let Some((constraint, lane)) = graph.solved_mut(contact) else { return };
    let [(mass_a, a), (mass_b, b)] =
        [contact.body_a, contact.body_b].map(|body| bodies.inverse_masses(body));
    let inverses = [mass_a + mass_b, a, b];
    let anew = |mass: &mut f32, arms: [f32; 2]| {
        if *mass > 0.0 {
            *mass = effective_mass::<f32>((), arms, inverses);
        }
    };
    for point in &mut constraint.points {
        anew(&mut point.normal_mass[lane], [point.normal_arm_a[lane], point.normal_arm_b[lane]]);
        anew(&mut point.tangent_mass[lane], [point.tangent_arm_a[lane], point.tangent_arm_b[lane]]);
    }
}
