//! What is heard: loud by the impulse of a hit, low by the masses.

use tiny_physics::World;

/// A sound to play now.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Sound {
    /// Which of [`NAMES`].
    pub which: usize,
    /// 0 to 1.
    pub volume: f32,
}

/// What there is to hear. Thuds are of light, middling and heavy things.
pub const NAMES: [&str; 7] = ["coin", "jump", "fuse", "blast", "tick", "knock", "thud"];

impl Sound {
    /// A coin is found.
    pub const COIN: Self = Self { which: 0, volume: 0.5 };
    /// The hero jumps.
    pub const JUMP: Self = Self { which: 1, volume: 0.3 };
    /// A fuse is lit.
    pub const FUSE: Self = Self { which: 2, volume: 0.5 };
    /// Powder blows up.
    pub const BLAST: Self = Self { which: 3, volume: 1.0 };
}

/// Impulse that is as loud as can be, newton seconds; masses above which things knock and thud, kilograms.
const LOUDEST: f32 = 300.0;
const KNOCKS: f32 = 5.0;
const THUDS: f32 = 30.0;

/// Hits of the last step.
pub fn of_hits(world: &World) -> impl Iterator<Item = Sound> + '_ {
    world.events().hits().iter().map(|hit| {
        let mass = if hit.mass_a > 0.0 && hit.mass_b > 0.0 {
            hit.mass_a.min(hit.mass_b)
        } else {
            hit.mass_a.max(hit.mass_b)
        };
        let which = 4 + usize::from(mass > KNOCKS) + usize::from(mass > THUDS);
        Sound { which, volume: (hit.impulse / LOUDEST).min(1.0).sqrt() }
    })
}

/// Samples a second of [`wave`].
pub const RATE: u32 = 22050;

/// A sound as a WAV file, made of a tone that falls and noise that dies away.
pub fn wave(which: usize) -> Vec<u8> {
    let (seconds, tone, fall, noise) = match NAMES[which % NAMES.len()] {
        "coin" => (0.25, 1200.0, -900.0, 0.0),
        "jump" => (0.15, 300.0, -1200.0, 0.0),
        "fuse" => (0.9, 0.0, 0.0, 0.4),
        "blast" => (1.0, 90.0, 60.0, 1.0),
        "tick" => (0.08, 700.0, 900.0, 0.3),
        "knock" => (0.12, 260.0, 500.0, 0.3),
        _ => (0.2, 110.0, 200.0, 0.5),
    };
    let count = (seconds * RATE as f32) as u32;
    let mut random = 12345u32;
    let samples = (0..count).map(|i| {
        let time = i as f32 / RATE as f32;
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let hiss = (random >> 8) as f32 / (1u32 << 23) as f32 - 1.0;
        let hum = (std::f32::consts::TAU * (tone * time - 0.5 * fall * time * time)).sin();
        let fade = (1.0 - time / seconds).powi(2);
        (0.6 * fade * ((1.0 - 0.6 * noise) * hum * f32::from(tone > 0.0) + noise * hiss))
            * f32::from(i16::MAX)
    });
    wav(samples.map(|sample| sample as i16))
}

/// The bytes of a WAV file: one channel of 16 bits.
fn wav(samples: impl Iterator<Item = i16>) -> Vec<u8> {
    let data: Vec<u8> = samples.flat_map(i16::to_le_bytes).collect();
    let mut file = b"RIFF".to_vec();
    file.extend((36 + data.len() as u32).to_le_bytes());
    file.extend(b"WAVEfmt ");
    file.extend(16u32.to_le_bytes());
    file.extend(1u16.to_le_bytes());
    file.extend(1u16.to_le_bytes());
    file.extend(RATE.to_le_bytes());
    file.extend((2 * RATE).to_le_bytes());
    file.extend(2u16.to_le_bytes());
    file.extend(16u16.to_le_bytes());
    file.extend(b"data");
    file.extend((data.len() as u32).to_le_bytes());
    file.extend(data);
    file
}
