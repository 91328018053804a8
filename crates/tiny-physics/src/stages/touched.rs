//! Which faces and corners of shapes others touch that make one surface with them: what `stages/surfaces.rs` looks at contacts for.

use super::surfaces::{TOLERANCE, boxed_core, boxed_pose, is_ground, solid, world_box};
use crate::broad_phase::{BroadPhase, ProxyKind};
use crate::dynamics::{Bodies, Change, Shapes, guard};
use crate::geometry::Core;
use crate::geometry::manifold::{point_gap, support_height};
use crate::math::Vec2;

/// What covers a face by more than this part of [`TOLERANCE`] touches it: thin plates do, tiles at a corner do not.
const THIN: f32 = 0.1;

/// Finds anew which faces and corners of shapes others touch that make one surface with them, around the places where such shapes have
/// changed.
pub(crate) fn refresh(
    shapes: &mut Shapes,
    bodies: &Bodies,
    broad_phase: &BroadPhase,
    length_unit: f32,
) {
    let mut changed = core::mem::take(&mut shapes.changed_ground);
    changed.retain(|change| !matches!(change, Change::Moved { .. }));
    if changed.is_empty() {
        return;
    }
    // A bit a shape: much less than a sorted list where a large level is built.
    let mut near = vec![0_u64; shapes.records.len().div_ceil(64)];
    let mut mark = |index: u32| near[index as usize / 64] |= 1 << (index % 64);
    let mut parts = Vec::new();
    for change in changed {
        match change {
            Change::Ground { bounds } => {
                broad_phase.each_of(ProxyKind::Static, &bounds, u64::MAX, &mut mark);
            }
            Change::Parts { body } => parts.push(body),
            Change::Moved { .. } => {}
        }
    }
    parts.sort_unstable();
    parts.dedup();
    for info in parts.into_iter().filter_map(|body| bodies.infos.get(body as usize)) {
        shapes.of_body(info.first_shape).for_each(&mut mark);
    }
    for (word, mut bits) in near.into_iter().enumerate() {
        while bits != 0 {
            let index = word as u32 * 64 + bits.trailing_zeros();
            bits &= bits - 1;
            let touched = touched_features(index, shapes, bodies, broad_phase, length_unit);
            shapes.set_touched(index, touched);
        }
    }
}

/// Faces and corners of a shape that others touch with which it makes one surface, as bits.
fn touched_features(
    index: u32,
    shapes: &Shapes,
    bodies: &Bodies,
    broad_phase: &BroadPhase,
    length_unit: f32,
) -> u32 {
    let record = &shapes.records[index as usize];
    let core = boxed_core(record);
    let Some(kind) = broad_phase.kind(shapes.proxy(index)) else { return 0 };
    if record.sensor || record.link.is_some() || core.radius > 0.0 && kind == ProxyKind::Dynamic {
        return 0;
    }
    let tolerance = TOLERANCE * length_unit;
    let pose = boxed_pose(&bodies.poses, record);
    let bounds = world_box(pose, core.points(), tolerance);
    let mut bits = 0;
    broad_phase.each_of(kind, &bounds, u64::MAX, |other| {
        let neighbour = &shapes.records[other as usize];
        if other != index && is_ground(neighbour, record, kind) {
            let place = boxed_pose(&bodies.poses, neighbour).relative_to(pose);
            let line = boxed_core(neighbour).transformed(place);
            let sides = [true, false].map(|side| solid(line, neighbour.link, side, length_unit));
            let both = if sides[0] == sides[1] { 1 } else { 2 };
            for neighbour in sides.iter().take(both).flatten() {
                let touched = touched_by(&core, neighbour, tolerance);
                // A part that only sticks in another costs no looks: what is inside meets nothing.
                let counts = kind != ProxyKind::Dynamic
                    || goes_on_flush(&core, neighbour, touched, tolerance);
                bits |= if counts { touched } else { 0 };
            }
        }
    });
    if bits == 0 || record.one_way.is_some() {
        return bits;
    }
    let is_free = |face: &usize| bits & (guard::face(*face) | guard::nook(*face)) == 0;
    let free = (0..core.edge_count()).filter(is_free);
    free.fold(bits, |bits, face| bits | guard::free(core.normal(face)))
}

/// Is there a face that `other` touches or makes a nook with, at a corner that lies on the surface of that, not within?
fn goes_on_flush(core: &Core, other: &Core, touched: u32, tolerance: f32) -> bool {
    let count = core.edge_count();
    let is_flush = |corner: usize| {
        let corner = corner % count;
        touched & guard::corner(corner) != 0 && point_gap(other, core.points[corner]) >= -tolerance
    };
    let is_met = |i: usize| touched & (guard::face(i) | guard::nook(i)) != 0;
    (0..count).any(|i| is_met(i) && (is_flush(i) || is_flush(i + 1)))
}

/// Faces and corners of `core` that `other` touches; rather one too many.
fn touched_by(core: &Core, other: &Core, tolerance: f32) -> u32 {
    let mut bits = 0;
    for (i, point) in core.points().iter().enumerate() {
        if point_gap(other, *point) <= tolerance + core.radius {
            bits |= guard::corner(i);
        }
    }
    // Faces of what is round count as free: others rarely lie against them.
    if core.radius > 0.0 {
        return bits;
    }
    for i in 0..core.edge_count() {
        let ((start, end), normal) = (core.edge(i), core.normal(i));
        let along = normal.perp();
        let above = support_height(other, normal) - normal.dot(start);
        let below = -support_height(other, -normal) - normal.dot(start);
        let before = -support_height(other, -along) - along.dot(end);
        let behind = along.dot(start) - support_height(other, along);
        let beside = if before > behind { before } else { behind };
        if above > tolerance && below <= tolerance && beside < -THIN * tolerance {
            bits |= guard::face(i);
        }
        let is_nook = |k: usize, corner: Vec2| {
            let is_away = |point: &&Vec2| (**point - corner).length() > tolerance + other.radius;
            let mut away = other.points().iter().filter(is_away);
            bits & guard::corner(k) != 0 && away.all(|&point| normal.dot(point - start) > tolerance)
        };
        // As a rule what touches a corner goes on below the face.
        let is_before = above > tolerance && below >= -tolerance;
        if is_before && (is_nook(i, start) || is_nook((i + 1) % core.edge_count(), end)) {
            bits |= guard::nook(i);
        }
    }
    bits
}
