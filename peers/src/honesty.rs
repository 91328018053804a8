//! Did two engines simulate the same thing?
//!
//! Engines differ in detail, and the moving scenes are chaotic, so the worlds at the end of a run are
//! never equal. But a comparison of times means nothing if one of them lost bodies, let them fall out
//! of the world, or threw contacts away. So figures of the last state are held against those of the
//! reference within the bounds below, and whatever lies outside is said beside the times.

use peers_worker::Summary;

/// Part by which the number of contacts may differ.
const CONTACTS: f64 = 0.05;
/// Metres by which the mean height may differ, beside [`HEIGHT_PART`].
const HEIGHT: f64 = 0.1;
/// Part of the reference's height by which the mean height may differ.
const HEIGHT_PART: f64 = 0.03;
/// Part by which kinetic energy may differ.
const ENERGY: f64 = 0.25;
/// Kinetic energy that counts as rest, joules a body.
const REST: f64 = 0.01;

/// The bounds, in words.
pub fn bounds() -> String {
    format!(
        "bounds: same bodies and joints; contacts within {:.0} %; mean height within {HEIGHT} m + {:.0} %; \
         kinetic energy within {:.0} % or both at rest (below {REST} J a body)",
        CONTACTS * 100.0,
        HEIGHT_PART * 100.0,
        ENERGY * 100.0,
    )
}

/// What lies outside the bounds, in words; empty is good.
pub fn differences(this: &Summary, reference: &Summary) -> Vec<String> {
    let mut notes = Vec::new();
    for (what, a, b) in
        [("bodies", this.bodies, reference.bodies), ("joints", this.joints, reference.joints)]
    {
        if a != b {
            notes.push(format!("{a} {what} against {b}"));
        }
    }
    let (a, b) = (this.contacts as f64, reference.contacts as f64);
    if (a - b).abs() > CONTACTS * a.max(b) {
        notes.push(format!("contacts {:+.0} %", (a / b - 1.0) * 100.0));
    }
    let rise = this.height - reference.height;
    if rise.abs() > HEIGHT + HEIGHT_PART * reference.height.abs() {
        notes.push(format!("mean height {rise:+.2} m"));
    }
    let rest = REST * reference.bodies as f64;
    let (a, b) = (this.energy, reference.energy);
    if a.max(b) > rest && (a - b).abs() > ENERGY * a.max(b) {
        notes.push(format!("kinetic energy {a:.3e} J against {b:.3e} J"));
    }
    notes
}

#[cfg(test)]
mod tests {
    use super::*;

    const REFERENCE: Summary = Summary {
        bodies: 100,
        joints: 3,
        contacts: 200,
        overlap: 0.0,
        awake: 99,
        height: 10.0,
        energy: 50.0,
    };

    #[test]
    fn small_differences_pass() {
        let this = Summary { contacts: 208, height: 10.3, energy: 60.0, awake: 0, ..REFERENCE };
        assert!(differences(&this, &REFERENCE).is_empty());
    }

    #[test]
    fn every_large_difference_is_named() {
        let this = Summary {
            bodies: 99,
            joints: 0,
            contacts: 100,
            overlap: 1.0,
            awake: 9,
            height: -5.0,
            energy: 1.0,
        };
        assert_eq!(differences(&this, &REFERENCE).len(), 5);
        let resting = Summary { energy: 0.5, ..REFERENCE };
        assert!(differences(&Summary { energy: 0.001, ..REFERENCE }, &resting).is_empty());
    }
}
