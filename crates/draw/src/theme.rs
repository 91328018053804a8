//! Colours of the presentation style.

use tiny_physics::Color;

/// The colours that [`Canvas::paint`](crate::Canvas::paint) paints with.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Theme {
    /// The sky at the upper and at the lower edge.
    pub sky: [Color; 2],
    /// Two rows of hills far behind, the farther one first.
    pub hills: [Color; 2],
    /// Static bodies, and their upper edge.
    pub ground: [Color; 2],
    /// Kinematic bodies.
    pub kinematic: Color,
    /// Moving bodies: what is joined together shares one.
    pub bodies: [Color; 8],
    /// What outlines are mixed with, and the colour of shadows.
    pub shade: Color,
    /// Links of chains, rods and springs.
    pub metal: Color,
    /// Ropes.
    pub rope: Color,
    /// Water.
    pub water: Color,
    /// Sensors, and areas where forces act.
    pub sensor: Color,
    /// Notes beside the picture: paper and ink.
    pub note: [Color; 2],
}

const BODIES: [Color; 8] = [
    Color::rgb(231, 111, 81),
    Color::rgb(42, 157, 143),
    Color::rgb(233, 190, 96),
    Color::rgb(91, 143, 201),
    Color::rgb(244, 158, 96),
    Color::rgb(157, 127, 190),
    Color::rgb(138, 177, 110),
    Color::rgb(222, 118, 148),
];

impl Theme {
    /// A bright day.
    pub const LIGHT: Self = Self {
        sky: [Color::rgb(196, 222, 238), Color::rgb(250, 243, 228)],
        hills: [Color::rgb(214, 227, 226), Color::rgb(198, 216, 208)],
        ground: [Color::rgb(78, 92, 104), Color::rgb(122, 168, 116)],
        kinematic: Color::rgb(126, 112, 168),
        bodies: BODIES,
        shade: Color::rgb(38, 44, 58),
        metal: Color::rgb(104, 114, 130),
        rope: Color::rgb(150, 112, 72),
        water: Color::rgb(64, 150, 210),
        sensor: Color::rgb(240, 180, 70),
        note: [Color::rgb(250, 247, 240), Color::rgb(70, 78, 92)],
    };

    /// A clear night.
    pub const DARK: Self = Self {
        sky: [Color::rgb(20, 24, 42), Color::rgb(52, 60, 96)],
        hills: [Color::rgb(40, 48, 80), Color::rgb(33, 40, 68)],
        ground: [Color::rgb(58, 66, 96), Color::rgb(104, 118, 164)],
        kinematic: Color::rgb(166, 150, 214),
        bodies: BODIES,
        shade: Color::rgb(10, 12, 24),
        metal: Color::rgb(170, 178, 196),
        rope: Color::rgb(206, 170, 122),
        water: Color::rgb(56, 132, 214),
        sensor: Color::rgb(250, 204, 110),
        note: [Color::rgb(16, 19, 32), Color::rgb(190, 198, 216)],
    };

    /// The colour of a moving body: of what it is joined to (a number for each group), a little lighter for every
    /// second body of it.
    pub(crate) fn body(&self, group: usize, place: usize) -> Color {
        let color = self.bodies[group * 3 % self.bodies.len()];
        color.mix(Color::WHITE, if place.is_multiple_of(2) { 0.0 } else { 0.16 })
    }

    /// The colour of an outline around a colour.
    pub(crate) fn outline(&self, color: Color) -> Color {
        color.mix(self.shade.with_alpha(color.a), 0.42)
    }
}
