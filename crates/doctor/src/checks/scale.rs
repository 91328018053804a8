//! Sizes, units and masses.

use crate::finding::Short;
use crate::look::{About, Findings, Look, Sighting, Words, figure};
use crate::track::Track;
use crate::{Code, Severity};
use tiny_physics::{Body, BodyId, BodyKind, JointId};

/// Length units.
const SMALLEST: f32 = 0.02;
const LARGEST: f32 = 100.0;
/// Median of sizes from which on units look like pixels.
const LIKE_PIXELS: f32 = 12.0;
const MIXED: f32 = 1000.0;
/// Greatest factor between a body's density and the median.
const ODD_DENSITY: f32 = 1000.0;
/// Mass ratios of a note and of a warning.
const RATIO: [f32; 2] = [50.0, 2000.0];

/// Is one body's size in range?
pub(crate) fn check_one(look: &Look<'_>, body: &Body<'_>, track: &Track, findings: &mut Findings) {
    let size = 2.0 * track.size / look.unit;
    if body.kind() != BodyKind::Dynamic || size == 0.0 || (SMALLEST..=LARGEST).contains(&size) {
        return;
    }
    let small = size < SMALLEST;
    let figure = if small {
        figure("times too small", SMALLEST / size, 1.0, "")
    } else {
        figure("times too large", size / LARGEST, 1.0, "")
    };
    let seen = Sighting::new(Code::Size, Severity::Warning, About::Body(track.id), figure);
    findings.add(look, seen, || Words {
        what: format!(
            "{} is {} length units wide, far {} than what contacts are made for",
            track.id,
            Short(size.into()),
            if small { "smaller" } else { "larger" }
        ),
        advice: "scale the world so that moving bodies are 0.1 to 10 units, or set Settings::length_unit to the size of a usual one",
        bodies: vec![track.id],
        ..Words::default()
    });
}

/// Do the bodies fit the units and each other?
pub(crate) fn check_all<'a>(
    look: &Look<'_>,
    tracks: impl Iterator<Item = &'a Track>,
    findings: &mut Findings,
) {
    let tracks = tracks.filter(|track| track.size > 0.0 && track.density > 0.0);
    let (mut sizes, mut stuff): (Vec<_>, Vec<_>) = tracks
        .map(|track| ((2.0 * track.size / look.unit, track.id), (track.density, track.id)))
        .unzip();
    if sizes.is_empty() {
        return;
    }
    let ([smallest, (median, _), largest], thick) = (spread(&mut sizes), spread(&mut stuff));
    if look.unit == 1.0 && median > LIKE_PIXELS {
        let seen = Sighting::new(
            Code::Size,
            Severity::Warning,
            About::World,
            figure("usual size", median, LIKE_PIXELS, " units"),
        );
        findings.add(look, seen, || Words {
            what: format!("bodies are {median:.0} units wide: that looks like pixels, and everything falls as slowly as from a tower"),
            advice: "set Settings::length_unit to the pixels of a metre and gravity in pixels, or build the world in metres and scale what you draw",
            ..Words::default()
        });
    } else if largest.0 > MIXED * smallest.0 {
        let seen = Sighting::new(
            Code::Size,
            Severity::Warning,
            About::World,
            figure("largest by smallest", largest.0 / smallest.0, MIXED, ""),
        );
        findings.add(look, seen, || Words {
            what: format!(
                "{} is {:.0} times as large as {}: units look mixed",
                largest.1,
                largest.0 / smallest.0,
                smallest.1
            ),
            advice: "give all lengths in one unit",
            bodies: vec![largest.1, smallest.1],
            ..Words::default()
        });
    }
    check_density(look, stuff.len(), thick, findings);
}

/// The least, the middle one, and the greatest; of equals, by their ids. Of two, the lesser counts as the middle one.
fn spread(items: &mut [(f32, BodyId)]) -> [(f32, BodyId); 3] {
    let by_size = |a: &(f32, BodyId), b: &(f32, BodyId)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
    let middle = (items.len() - 1) / 2;
    let (below, &mut middle, above) = items.select_nth_unstable_by(middle, by_size);
    let least = below.iter().copied().min_by(by_size).unwrap_or(middle);
    let greatest = above.iter().copied().max_by(by_size).unwrap_or(middle);
    [least, middle, greatest]
}

fn check_density(
    look: &Look<'_>,
    count: usize,
    [least, (median, _), greatest]: [(f32, BodyId); 3],
    findings: &mut Findings,
) {
    if count < 2 {
        return;
    }
    for (density, id) in [least, greatest] {
        let factor = if density > median { density / median } else { median / density };
        if factor < ODD_DENSITY {
            continue;
        }
        let figure = figure("density by the median", factor, ODD_DENSITY, "");
        let seen = Sighting::new(Code::Density, Severity::Warning, About::Body(id), figure);
        findings.add(look, seen, || Words {
            what: format!(
                "{id} has {} kg by square metre where {} is usual",
                Short(density.into()),
                Short(median.into())
            ),
            advice: "leave out `mass` and give materials a density: masses then follow from sizes",
            bodies: vec![id],
            ..Words::default()
        });
    }
}

/// A light body that carries a heavy one.
pub(crate) fn report_ratio(
    look: &Look<'_>,
    [light, heavy]: [BodyId; 2],
    ratio: f32,
    joint: Option<JointId>,
    findings: &mut Findings,
) {
    if ratio < RATIO[0] {
        return;
    }
    let severity = if ratio >= RATIO[1] { Severity::Warning } else { Severity::Note };
    let figure = figure("mass ratio", ratio, RATIO[0], "");
    let seen = Sighting::new(Code::MassRatio, severity, About::Body(light), figure);
    findings.add(look, seen, || Words {
        what: format!("{light} carries {heavy}, which is {ratio:.0} times as heavy"),
        advice: "bring the masses closer together (give materials a density instead of bodies a mass), or raise substeps",
        bodies: vec![light, heavy],
        joints: joint.into_iter().collect(),
        ..Words::default()
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use tiny_physics::{RigidBody, Shape, Vec2, World};

    /// The library's way to halve lists differs from platform to platform: what is told must not hang on it.
    #[test]
    fn of_equals_the_ids_decide() {
        let mut world = World::new(Vec2::ZERO);
        let mut items: Vec<_> = (0..5)
            .map(|_| {
                let body = RigidBody::new(Shape::circle(0.5).unwrap(), Vec2::ZERO, 1.0);
                (1.0, world.add_body(body).unwrap())
            })
            .collect();
        let sorted = [items[0], items[2], items[4]];
        for _ in 0..items.len() {
            items.rotate_left(1);
            assert_eq!(spread(&mut items.clone()), sorted);
        }
    }
}
