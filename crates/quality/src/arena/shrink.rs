//! Makes a world smaller as long as it shows what it was kept for.

use tiny_physics_scenes::{Deed, Scene, Script};

/// The smallest world found in at most `tries` tries that still `shows` it: without bodies, without deeds, with fewer steps.
pub fn shrink(scene: &Scene, tries: u32, shows: &mut dyn FnMut(&Scene) -> bool) -> Scene {
    let mut best = scene.clone();
    let mut left = tries;
    let mut share = 2;
    // Halves, quarters, ... of the bodies are taken away, then single ones.
    while left > 0 {
        let chunk = best.bodies.len().div_ceil(share);
        let mut start = 0;
        let before = best.bodies.len();
        while start < best.bodies.len() && left > 0 {
            left -= 1;
            let smaller = without(&best, start, chunk);
            if !smaller.bodies.is_empty() && shows(&smaller) {
                best = smaller;
            } else {
                start += chunk;
            }
        }
        if chunk == 1 && best.bodies.len() == before {
            break;
        }
        share = if chunk == 1 { best.bodies.len().max(1) } else { 2 * share };
    }
    let smaller: [fn(&Scene) -> Scene; 3] = [
        without_deeds,
        |scene| with_steps(scene, scene.steps / 2),
        |scene| with_steps(scene, scene.steps / 2),
    ];
    for smaller in smaller {
        let smaller = smaller(&best);
        if smaller != best && shows(&smaller) {
            best = smaller;
        }
    }
    best
}

/// The same without some bodies, their joints and what is done to them.
fn without(scene: &Scene, start: usize, count: usize) -> Scene {
    let mut smaller = scene.clone();
    let gone = start..(start + count).min(scene.bodies.len());
    let place = |body: usize| match body {
        body if gone.contains(&body) => None,
        body if body < gone.start => Some(body),
        body => Some(body - gone.len()),
    };
    smaller.bodies.drain(gone.clone());
    smaller.joints.retain_mut(|joint| {
        let ends = place(joint.a).zip(place(joint.b));
        (joint.a, joint.b) = ends.unwrap_or_default();
        ends.is_some()
    });
    if let Some(Script::Timeline(line)) = &mut smaller.script {
        line.acts.retain_mut(|act| match &mut act.deed {
            Deed::SetVelocity { body, .. } | Deed::Remove { body } => {
                let now = place(*body);
                *body = now.unwrap_or_default();
                now.is_some()
            }
            _ => true,
        });
    }
    smaller
}

fn without_deeds(scene: &Scene) -> Scene {
    Scene { script: None, ..scene.clone() }
}

fn with_steps(scene: &Scene, steps: u32) -> Scene {
    Scene { steps: steps.max(60).min(scene.steps), ..scene.clone() }
}
