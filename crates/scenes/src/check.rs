//! Checks of what a scene is made of: every number makes sense, every index points at something.

use crate::error::{Problem, SceneError};
use tiny_physics::{
    DVec2, Error, JointDef, JointKind, Limits, Material, Motor, RigidBody, Settings, Shape,
    ShapeDef, Spring, Vec2,
};

/// Result of a check; the error's field is relative to what was checked.
pub(crate) type Check = Result<(), SceneError>;

pub(crate) fn each<T>(name: &str, items: &[T], check: impl Fn(&T) -> Check) -> Check {
    let checked = |(i, item)| check(item).map_err(|e| e.under(format_args!("{name}[{i}]")));
    items.iter().enumerate().try_for_each(checked)
}

pub(crate) fn check_settings(settings: &Settings) -> Check {
    settings.validate().map_err(of_number)
}

/// The engine's error under the field that it names.
fn of_number(error: Error) -> SceneError {
    match error {
        Error::OutOfRange { name, .. } | Error::NotFinite { name, .. } => {
            value(name.trim_end_matches(".x").trim_end_matches(".y"), error)
        }
        _ => value("", error),
    }
}

pub(crate) fn check_body(body: &RigidBody) -> Check {
    each("shapes", &body.shapes, check_shape_def)?;
    body.validate().map_err(of_number)
}

fn check_shape_def(def: &ShapeDef) -> Check {
    check_shape(&def.shape).map_err(|e| e.under("shape"))?;
    check_material(&def.material).map_err(|e| e.under("material"))?;
    def.validate().map_err(|error| match error {
        Error::Unsupported { .. } => value("link", error),
        _ => of_number(error),
    })
}

pub(crate) fn check_material(material: &Material) -> Check {
    let mut def = ShapeDef::new(Shape::Circle { radius: 1.0 });
    def.material = *material;
    def.validate().map_err(of_number)
}

/// The engine says what is wrong with a shape; here the error finds its field.
pub(crate) fn check_shape(shape: &Shape) -> Check {
    let Err(error) = shape.validate() else { return Ok(()) };
    let (variant, fields): (_, &[&str]) = match shape {
        Shape::Circle { .. } => ("circle", &["radius"]),
        Shape::Aabb { .. } => ("aabb", &["half_extents"]),
        Shape::Capsule { .. } => ("capsule", &["radius", "a", "b"]),
        Shape::Segment { .. } => ("segment", &["a", "b"]),
        Shape::Polygon(_) => ("polygon", &["radius", "vertices"]),
    };
    let name = match &error {
        Error::NotFinite { name, .. } | Error::OutOfRange { name, .. } => *name,
        _ => "",
    };
    let field = match fields {
        [only] => only,
        _ => fields.iter().find(|f| name.split([' ', '.']).any(|word| word == **f)).unwrap_or(&""),
    };
    Err(SceneError::new(*field, Problem::Value(error)).under(variant))
}

pub(crate) fn check_joint(def: &JointDef) -> Check {
    check_kind(&def.kind).map_err(|e| e.under("kind"))?;
    def.softness.as_ref().map_or(Ok(()), |s| check_spring("softness", s))?;
    def.validate().map_err(of_number)
}

/// The engine checks the kinds whose fields are not named here; its message names the number.
fn check_kind(kind: &JointKind) -> Check {
    match kind {
        JointKind::Distance { length, spring, limits, motor } => positive("length", *length)
            .and_then(|()| check_parts(spring.as_ref(), limits.as_ref(), motor.as_ref()))
            .and_then(|()| check_whole(kind))
            .map_err(|e| e.under("distance")),
        JointKind::Revolute { spring, target_angle, limits, motor } => {
            finite("target_angle", *target_angle)
                .and_then(|()| check_parts(spring.as_ref(), limits.as_ref(), motor.as_ref()))
                .and_then(|()| check_whole(kind))
                .map_err(|e| e.under("revolute"))
        }
        other => match JointDef::new(*other).validate() {
            Err(error) => Err(SceneError::new("", Problem::Value(error))),
            Ok(()) => Ok(()),
        },
    }
}

/// What the engine asks of the parts together.
fn check_whole(kind: &JointKind) -> Check {
    JointDef::new(*kind).validate().map_err(of_number)
}

fn check_parts(spring: Option<&Spring>, limits: Option<&Limits>, motor: Option<&Motor>) -> Check {
    spring.map_or(Ok(()), |s| check_spring("spring", s))?;
    limits.map_or(Ok(()), |l| check_limits(l).map_err(|e| e.under("limits")))?;
    motor.map_or(Ok(()), |m| check_motor(m).map_err(|e| e.under("motor")))
}

fn check_spring(name: &str, spring: &Spring) -> Check {
    positive("hertz", spring.hertz)
        .and_then(|()| not_negative("damping_ratio", spring.damping_ratio))
        .map_err(|e| e.under(name))
}

fn check_limits(limits: &Limits) -> Check {
    finite("lower", limits.lower)?;
    finite("upper", limits.upper)?;
    range("upper", limits.upper, limits.upper >= limits.lower, "the lower limit or above")
}

fn check_motor(motor: &Motor) -> Check {
    finite("speed", motor.speed)?;
    not_negative("max", motor.max)
}

fn value(name: &str, error: Error) -> SceneError {
    SceneError::new(name, Problem::Value(error))
}

pub(crate) fn range(name: &'static str, x: f32, ok: bool, allowed: &'static str) -> Check {
    if ok { Ok(()) } else { Err(value(name, Error::OutOfRange { name, value: x.into(), allowed })) }
}

pub(crate) fn finite(name: &'static str, x: f32) -> Check {
    if x.is_finite() {
        Ok(())
    } else {
        Err(value(name, Error::NotFinite { name, value: x.into() }))
    }
}

pub(crate) fn positive(name: &'static str, x: f32) -> Check {
    finite(name, x)?;
    range(name, x, x > 0.0, "above 0")
}

pub(crate) fn not_negative(name: &'static str, x: f32) -> Check {
    finite(name, x)?;
    range(name, x, x >= 0.0, "0 or above")
}

pub(crate) fn at_least_one(name: &'static str, count: u32) -> Check {
    if count >= 1 {
        return Ok(());
    }
    Err(value(name, Error::OutOfRange { name, value: count.into(), allowed: "1 or above" }))
}

/// A count of things that a script makes; the upper end keeps a file from asking for more than memory holds.
pub(crate) fn count(name: &'static str, count: u32) -> Check {
    if (1..=100_000).contains(&count) {
        return Ok(());
    }
    Err(value(name, Error::OutOfRange { name, value: count.into(), allowed: "1 to 100000" }))
}

pub(crate) fn finite_vec(name: &'static str, v: Vec2) -> Check {
    finite_dvec(name, DVec2::new(v.x.into(), v.y.into()))
}

pub(crate) fn finite_dvec(name: &'static str, v: DVec2) -> Check {
    for (i, x) in [v.x, v.y].into_iter().enumerate() {
        if !x.is_finite() {
            return Err(SceneError::new(
                format!("[{i}]"),
                Problem::Value(Error::NotFinite { name, value: x }),
            )
            .under(name));
        }
    }
    Ok(())
}

pub(crate) fn index(name: &str, index: usize, count: usize, of: &'static str) -> Check {
    if index < count {
        Ok(())
    } else {
        Err(SceneError::new(name, Problem::Index { index, count, of }))
    }
}
