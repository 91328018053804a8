//! Stand-ins until the geometry branch is merged.
use super::manifold::RoundedBox;
use super::*;
use crate::error::Error;
use crate::math::*;
#[derive(Clone, Copy, Debug, Default)]
pub struct MassProperties {
    pub mass: f32,
    pub center: Vec2,
    pub inertia: f32,
}
impl MassProperties {
    pub fn transformed(self, t: Transform) -> Self {
        Self { center: t.apply(self.center), ..self }
    }
    pub fn combine(parts: impl Iterator<Item = Self>) -> Self {
        let parts: Vec<_> = parts.collect();
        let mass: f32 = parts.iter().map(|p| p.mass).sum();
        if mass == 0.0 {
            return Self::default();
        }
        let mut c = Vec2::ZERO;
        for p in &parts {
            c += p.center * (p.mass / mass);
        }
        let inertia = parts.iter().map(|p| p.inertia + p.mass * (p.center - c).length_sq()).sum();
        Self { mass, center: c, inertia }
    }
}
impl Shape {
    pub fn validate(&self) -> Result<(), Error> {
        Ok(())
    }
    pub fn mass_properties(&self, density: f32) -> MassProperties {
        match RoundedBox::of(self) {
            Some(b) => {
                let (x, y, r) = (b.half_extents.x, b.half_extents.y, b.radius);
                let box_m = density * 4.0 * x * y;
                let circle_m = density * 3.14159265 * r * r;
                let extra = density * 4.0 * r * (x + y);
                let mass = box_m + circle_m + extra;
                let inertia = if x == 0.0 && y == 0.0 {
                    0.5 * circle_m * r * r
                } else {
                    mass * ((x + r * 0.8) * (x + r * 0.8) + (y + r * 0.8) * (y + r * 0.8)) / 3.0
                };
                MassProperties { mass, center: b.frame.p, inertia }
            }
            None => MassProperties { mass: density, center: Vec2::ZERO, inertia: density },
        }
    }
    pub fn world_aabb(&self, pose: Pose) -> Aabb {
        Aabb::rounded_out(pose.p - Vec2::splat(1.0), pose.p + Vec2::splat(1.0))
    }
    pub fn bounding_radius(&self) -> f32 {
        1.0
    }
    pub fn inner_radius(&self) -> f32 {
        0.1
    }
}
