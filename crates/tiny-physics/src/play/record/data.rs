//! Commands as bytes: a number for the kind, which keeps its meaning within a version of recordings, then
//! the parts.

use super::{BodyCommand, Command, FilterData, ShapeCommand};
use crate::codec::{Data, Reader, Sink, bad, data};
use crate::{Error, Explosion, ForceZone, MoverInput, Water, Wind, ZoneForce};

/// Commands are rare: what a part is made of is compiled once, not into every command.
#[inline(never)]
fn keep(part: &impl Data, sink: &mut Sink) {
    part.save(sink);
}

#[inline(never)]
fn part<T: Data>(reader: &mut Reader<'_>) -> Result<T, Error> {
    T::load(reader)
}

/// Implements [`Data`] for an enum: a number for each variant, then its parts, without padding.
macro_rules! variants {
    ($type:ident: $unknown:literal {
        $($tag:literal => $name:ident $(($($part:ident),*))? $({$($field:ident),*})?,)*
    }) => {
        impl Data for $type {
            fn save(&self, sink: &mut Sink) {
                match self {
                    $(Self::$name $(($($part),*))? $({$($field),*})? => {
                        sink.put([$tag]);
                        $($(keep($part, sink);)*)?
                        $($(keep($field, sink);)*)?
                    })*
                }
            }
            fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
                Ok(match u8::load(reader)? {
                    $($tag => {
                        $($(let $part = part(reader)?;)*)?
                        $($(let $field = part(reader)?;)*)?
                        Self::$name $(($($part),*))? $({$($field),*})?
                    })*
                    _ => return Err(bad($unknown)),
                })
            }
        }
    };
}

variants!(Command: "a command is unknown" {
    0 => AddBody(body),
    1 => RemoveBody(body),
    2 => Body(body, command),
    3 => AddShape(body, shape),
    4 => AddChain(body, chain),
    5 => AddOutline(body, outline, like),
    6 => RemoveShape(shape),
    7 => Shape(shape, command),
    8 => AddJoint(a, b, def),
    9 => SetJoint(joint, def),
    10 => RemoveJoint(joint),
    11 => AddTiles(grid),
    12 => SetTile(grid, x, y, value),
    13 => RemoveTiles(grid),
    14 => Explode(explosion, filter),
    15 => ApplyWater(water, filter, dt),
    16 => ApplyZone(zone, filter, dt),
    17 => MoveCharacter(character, input, dt),
    18 => SetGravity(gravity),
    19 => SetSettings(settings),
    20 => RestoreBytes(bytes),
});

variants!(BodyCommand: "a command to a body is unknown" {
    0 => SetPosition(position),
    1 => SetAngle(radians),
    2 => SetPose(pose),
    3 => SetVelocity(velocity),
    4 => SetAngularVelocity(speed),
    5 => SetTarget(target, dt),
    6 => ApplyForce(force, point),
    7 => ApplyForceToCenter(force),
    8 => ApplyTorque(torque),
    9 => ApplyImpulse(impulse, point),
    10 => ApplyImpulseToCenter(impulse),
    11 => ApplyAngularImpulse(impulse),
    12 => ApplyWind(wind, dt),
    13 => Wake,
    14 => Sleep,
    15 => SetKind(kind),
    16 => SetEnabled(enabled),
    17 => SetLocks(locks),
    18 => SetMass(mass),
    19 => SetGravityScale(scale),
    20 => SetDamping(linear, angular),
    21 => SetCanSleep(can_sleep),
    22 => SetSleepSpeed(speed),
    23 => SetBullet(bullet),
    24 => SetUserData(data),
    25 => SetCenter(center),
    26 => SetInertia(inertia),
});

variants!(ShapeCommand: "a command to a shape is unknown" {
    0 => SetShape(shape),
    1 => SetLocal(offset, angle),
    2 => SetMaterial(material),
    3 => SetFilter(filter),
    4 => SetSensor(sensor),
    5 => SetOneWay(direction),
    6 => SetEvents(contact, hit),
    7 => SetUserData(data),
});

variants!(ZoneForce: "a force of a zone is unknown" {
    0 => Acceleration(acceleration),
    1 => Attraction { center, acceleration },
    2 => Wind(wind),
    3 => Damping { linear, angular },
});

data!(FilterData { filter, exclude_body, sensors });
data!(Explosion { center, radius, falloff, impulse_per_metre });
data!(Wind { velocity, density, drag });
data!(Water { surface, normal, density, flow, linear_drag, angular_drag, area });
data!(ForceZone { shape, pose, force, wakes });
data!(MoverInput { walk, jump, drop });
