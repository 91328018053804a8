//! Paints what bodies look like: a colour with a darker rim.

use bevy::asset::RenderAssetUsages;
use bevy::ecs::system::SystemParam;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::prelude::*;
use bevy_tiny_physics::prelude::{Collider, Shape};
use bevy_tiny_physics::tiny_physics;

/// Colours that go together.
pub const PALETTE: [&str; 7] =
    ["e76f51", "f4a261", "e9c46a", "8ab17d", "2a9d8f", "5b8fb9", "9d7fb8"];

/// A colour, by its hexadecimal name.
#[derive(Clone, Copy, Debug)]
pub struct Ink(pub &'static str);

impl Ink {
    /// One of the palette.
    pub fn nth(at: usize) -> Self {
        Self(PALETTE[at % PALETTE.len()])
    }

    fn fill(self) -> Color {
        Srgba::hex(self.0).map_or(Color::WHITE, Color::from)
    }

    fn rim(self) -> Color {
        self.fill().mix(&Color::BLACK, 0.4)
    }
}

/// Width of rims, metres.
const RIM: f32 = 0.05;

/// Paints entities.
#[derive(SystemParam)]
pub struct Brush<'w, 's> {
    /// For spawning what is to be painted.
    pub commands: Commands<'w, 's>,
    meshes: ResMut<'w, Assets<Mesh>>,
    materials: ResMut<'w, Assets<ColorMaterial>>,
}

impl Brush<'_, '_> {
    /// Paints the shapes of a collider, below its entity.
    pub fn paint(&mut self, entity: Entity, collider: &Collider, ink: Ink) {
        for def in collider.shapes() {
            let at = Transform::from_xyz(def.offset.x, def.offset.y, 0.0)
                .with_rotation(Quat::from_rotation_z(def.angle));
            let outline = outline(&def.shape);
            self.spawn_polygon(entity, at, &outline, ink.rim());
            let inner = outline_inside(&outline, RIM);
            self.spawn_polygon(
                entity,
                at.with_translation(at.translation + Vec3::Z * 0.01),
                &inner,
                ink.fill(),
            );
            if let Shape::Circle { radius } = def.shape {
                let spoke = [
                    Vec2::new(0.0, -RIM / 2.0),
                    Vec2::new(radius, -RIM / 2.0),
                    Vec2::new(radius, RIM / 2.0),
                    Vec2::new(0.0, RIM / 2.0),
                ];
                self.spawn_polygon(
                    entity,
                    at.with_translation(at.translation + Vec3::Z * 0.02),
                    &spoke,
                    ink.rim(),
                );
            }
        }
    }

    /// Paints a convex polygon without a rim.
    pub fn polygon(&mut self, at: Transform, corners: &[Vec2], ink: Ink) -> Entity {
        let (mesh, material) = (self.meshes.add(fan(corners)), self.materials.add(ink.fill()));
        self.commands.spawn((Mesh2d(mesh), MeshMaterial2d(material), at)).id()
    }

    fn spawn_polygon(&mut self, parent: Entity, at: Transform, corners: &[Vec2], color: Color) {
        let (mesh, material) = (self.meshes.add(fan(corners)), self.materials.add(color));
        self.commands.spawn((Mesh2d(mesh), MeshMaterial2d(material), at, ChildOf(parent)));
    }
}

/// Corners of a shape, anticlockwise; what is round has many.
fn outline(shape: &Shape) -> Vec<Vec2> {
    match shape {
        Shape::Circle { radius } => arc(Vec2::ZERO, *radius, 0.0, core::f32::consts::TAU, 32),
        Shape::Aabb { half_extents: half } => [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, y)| Vec2::new(x * half.x, y * half.y))
            .into(),
        Shape::Capsule { a, b, radius } => rounded(&[vec(*a), vec(*b)], *radius),
        Shape::Segment { a, b } => rounded(&[vec(*a), vec(*b)], 0.03),
        Shape::Polygon(polygon) => {
            let corners: Vec<Vec2> = polygon.vertices().iter().copied().map(vec).collect();
            if polygon.radius() > 0.0 { rounded(&corners, polygon.radius()) } else { corners }
        }
    }
}

/// A hull with round corners.
fn rounded(corners: &[Vec2], radius: f32) -> Vec<Vec2> {
    let count = corners.len();
    let out = |from: Vec2, to: Vec2| (-(to - from).perp()).to_angle();
    let corner = |at: usize| {
        let (before, here, after) =
            (corners[(at + count - 1) % count], corners[at], corners[(at + 1) % count]);
        let (start, end) = (out(before, here), out(here, after));
        arc(here, radius, start, (end - start).rem_euclid(core::f32::consts::TAU) * 10.0 / 9.0, 10)
    };
    (0..count).flat_map(corner).collect()
}

fn arc(center: Vec2, radius: f32, start: f32, turn: f32, steps: usize) -> Vec<Vec2> {
    (0..steps)
        .map(|i| center + Vec2::from_angle(start + turn * i as f32 / steps as f32) * radius)
        .collect()
}

/// The outline, drawn in by a width towards its middle.
fn outline_inside(corners: &[Vec2], width: f32) -> Vec<Vec2> {
    let count = corners.len();
    let line = |at: usize| {
        let (a, b) = (corners[at % count], corners[(at + 1) % count]);
        let inward = (b - a).perp().normalize_or_zero();
        (a + inward * width, b - a)
    };
    let meet = |at: usize| {
        let ((p, u), (q, v)) = (line(at + count - 1), line(at));
        let cross = u.perp_dot(v);
        if cross.abs() < 1e-4 * u.length() * v.length() {
            q
        } else {
            p + u * ((q - p).perp_dot(v) / cross)
        }
    };
    (0..count).map(meet).collect()
}

/// A convex polygon as triangles.
fn fan(corners: &[Vec2]) -> Mesh {
    let positions: Vec<[f32; 3]> = corners.iter().map(|p| [p.x, p.y, 0.0]).collect();
    let indices = (1..corners.len() as u32 - 1).flat_map(|i| [0, i, i + 1]).collect();
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
        .with_inserted_indices(Indices::U32(indices))
}

fn vec(v: tiny_physics::Vec2) -> Vec2 {
    Vec2::new(v.x, v.y)
}
