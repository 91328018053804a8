//! Seeing physics through Bevy's gizmos.

use crate::PhysicsWorld;
use crate::sync::write::Interpolated;
use bevy_app::prelude::*;
use bevy_color::Color;
use bevy_ecs::prelude::*;
use bevy_gizmos::prelude::*;
use bevy_math::{Isometry2d, Rot2, Vec2};
use bevy_time::{Fixed, Time};
use tiny_physics::{DebugDraw, DebugDrawOptions, Transform};

/// Draws shapes, joints and contacts over the game. Needs Bevy's gizmos, which `DefaultPlugins` bring along.
#[derive(Clone, Copy, Debug, Default)]
pub struct PhysicsDebugPlugin;

/// What is drawn. `options.alpha` is set to where bodies are shown; text is not drawn.
#[derive(Resource, Clone, Debug)]
pub struct PhysicsDebug {
    /// Draws at all.
    pub enabled: bool,
    /// Radius of points, metres.
    pub point_radius: f32,
    /// What, and in which colours.
    pub options: DebugDrawOptions,
}

impl Default for PhysicsDebug {
    fn default() -> Self {
        Self { enabled: true, point_radius: 0.05, options: DebugDrawOptions::default() }
    }
}

impl Plugin for PhysicsDebugPlugin {
    fn build(&self, app: &mut App) {
        app.init_resource::<PhysicsDebug>().add_systems(PostUpdate, (follow, draw).chain());
    }
}

/// Draws between steps only where sprites are there, too.
fn follow(
    mut debug: ResMut<PhysicsDebug>,
    clock: Option<Res<Time<Fixed>>>,
    interpolated: Option<Res<Interpolated>>,
) {
    let clock = clock.filter(|_| interpolated.is_some());
    debug.options.alpha = clock.map_or(1.0, |clock| clock.overstep_fraction());
}

fn draw(physics: Res<PhysicsWorld>, debug: Res<PhysicsDebug>, gizmos: Gizmos) {
    if debug.enabled {
        let mut pen = Pen { gizmos, point_radius: debug.point_radius };
        physics.world.debug_draw(&mut pen, &debug.options);
    }
}

struct Pen<'w, 's> {
    gizmos: Gizmos<'w, 's>,
    point_radius: f32,
}

impl DebugDraw for Pen<'_, '_> {
    fn polygon(
        &mut self,
        pose: &Transform,
        vertices: &[tiny_physics::Vec2],
        radius: f32,
        color: tiny_physics::Color,
    ) {
        let color = bevy(color);
        let corner = |at: usize| point(pose.apply(vertices[at % vertices.len()]));
        for at in 0..vertices.len() {
            let (a, b) = (corner(at), corner(at + 1));
            let out = (b - a).perp().normalize_or_zero() * -radius;
            self.gizmos.line_2d(a + out, b + out, color);
            if radius > 0.0 {
                let next = corner(at + 2) - b;
                let turn = (b - a).angle_to(next);
                let frame = Isometry2d::new(
                    b,
                    Rot2::radians(out.to_angle() - core::f32::consts::FRAC_PI_2),
                );
                self.gizmos.arc_2d(frame, turn, radius, color).resolution(6);
            }
        }
    }

    fn circle(&mut self, pose: &Transform, radius: f32, color: tiny_physics::Color) {
        let (center, color) = (point(pose.p), bevy(color));
        self.gizmos.circle_2d(center, radius, color).resolution(24);
        self.gizmos.line_2d(center, center + point(pose.q.x_axis()) * radius, color);
    }

    fn capsule(
        &mut self,
        a: tiny_physics::Vec2,
        b: tiny_physics::Vec2,
        radius: f32,
        color: tiny_physics::Color,
    ) {
        let (a, b, color) = (point(a), point(b), bevy(color));
        let out = (b - a).perp().normalize_or_zero() * radius;
        self.gizmos.line_2d(a + out, b + out, color);
        self.gizmos.line_2d(a - out, b - out, color);
        let mut cap = |end: Vec2, side: Vec2| {
            let frame =
                Isometry2d::new(end, Rot2::radians(side.to_angle() - core::f32::consts::FRAC_PI_2));
            self.gizmos.arc_2d(frame, core::f32::consts::PI, radius, color).resolution(12);
        };
        cap(a, out);
        cap(b, -out);
    }

    fn segment(
        &mut self,
        a: tiny_physics::Vec2,
        b: tiny_physics::Vec2,
        color: tiny_physics::Color,
    ) {
        self.gizmos.line_2d(point(a), point(b), bevy(color));
    }

    fn point(&mut self, p: tiny_physics::Vec2, _size_px: f32, color: tiny_physics::Color) {
        self.gizmos.circle_2d(point(p), self.point_radius, bevy(color)).resolution(8);
    }

    fn text(&mut self, _p: tiny_physics::Vec2, _text: &str, _color: tiny_physics::Color) {}
}

fn point(v: tiny_physics::Vec2) -> Vec2 {
    Vec2::new(v.x, v.y)
}

fn bevy(color: tiny_physics::Color) -> Color {
    Color::srgba_u8(color.r, color.g, color.b, color.a)
}
