//! Contact data in blocks of lanes: structure of arrays, sixteen contacts a block.
//!
//! A block has the same layout at every SIMD level; narrower levels walk it in strides. Lanes past
//! the end of a bucket point to body 0 and have zero effective masses, so kernels need no tail code.

use crate::codec::{Data, Reader, Sink, record};
use crate::error::Error;
use crate::simd::BLOCK;

/// Arrays of one value a lane.
pub(crate) trait LaneBlock: Copy {
    /// All lanes empty.
    const NULL: Self;
    /// Copies one lane of a block into a lane of this one.
    fn copy_lane(&mut self, to: usize, source: &Self, from: usize);
    /// Writes one lane.
    fn save_lane(&self, lane: usize, sink: &mut Sink);
    /// Reads one lane.
    fn load_lane(&mut self, lane: usize, reader: &mut Reader<'_>) -> Result<(), Error>;
}

/// Copies lane `last` over lane `hole` and empties lane `last`; both by block and lane.
pub(super) fn move_lane<B: LaneBlock>(
    blocks: &mut [B],
    hole: (usize, usize),
    last: (usize, usize),
) {
    match blocks.get_disjoint_mut([hole.0, last.0]) {
        Ok([to, from]) => to.copy_lane(hole.1, from, last.1),
        // One and the same block.
        Err(_) => {
            let source = blocks[last.0];
            blocks[hole.0].copy_lane(hole.1, &source, last.1);
        }
    }
    blocks[last.0].copy_lane(last.1, &B::NULL, 0);
}

/// Saves the lanes of so many slots: those after them mean nothing, and depend on how many lanes kernels take at a time.
pub(super) fn save_lanes<B: LaneBlock>(blocks: &[B], slots: usize, sink: &mut Sink) {
    let slots = slots.min(blocks.len() * BLOCK);
    (slots as u32).save(sink);
    (0..slots).for_each(|slot| blocks[slot / BLOCK].save_lane(slot % BLOCK, sink));
}

/// Reads what [`save_lanes`] saved.
pub(super) fn load_lanes<B: LaneBlock>(reader: &mut Reader<'_>) -> Result<Vec<B>, Error> {
    let mut blocks = Vec::new();
    for slot in 0..u32::load(reader)? as usize {
        if slot.is_multiple_of(BLOCK) {
            blocks.push(B::NULL);
        }
        blocks[slot / BLOCK].load_lane(slot % BLOCK, reader)?;
    }
    Ok(blocks)
}

impl<B: LaneBlock> LaneBlock for [B; 2] {
    const NULL: Self = [B::NULL; 2];

    fn copy_lane(&mut self, to: usize, source: &Self, from: usize) {
        self.iter_mut().zip(source).for_each(|(part, source)| part.copy_lane(to, source, from));
    }

    fn save_lane(&self, lane: usize, sink: &mut Sink) {
        self.iter().for_each(|part| part.save_lane(lane, sink));
    }

    fn load_lane(&mut self, lane: usize, reader: &mut Reader<'_>) -> Result<(), Error> {
        self.iter_mut().try_for_each(|part| part.load_lane(lane, reader))
    }
}

/// Declares a block: arrays of one value a lane, then smaller blocks.
macro_rules! lane_block {
    ($(#[$meta:meta])* $vis:vis struct $name:ident {
        $($(#[$field_meta:meta])* $field:ident : $type:ty = $null:expr),* $(,)?
    } $(parts { $($(#[$part_meta:meta])* $part:ident : $part_type:ty),* $(,)? })?) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[repr(C, align(64))]
        $vis struct $name {
            $($(#[$field_meta])* pub(crate) $field: [$type; BLOCK],)*
            $($($(#[$part_meta])* pub(crate) $part: $part_type,)*)?
        }

        impl LaneBlock for $name {
            const NULL: Self = Self {
                $($field: [$null; BLOCK],)*
                $($($part: <$part_type as LaneBlock>::NULL,)*)?
            };

            fn copy_lane(&mut self, to: usize, source: &Self, from: usize) {
                $(self.$field[to] = source.$field[from];)*
                $($(self.$part.copy_lane(to, &source.$part, from);)*)?
            }

            fn save_lane(&self, lane: usize, sink: &mut Sink) {
                $($crate::codec::Data::save(&self.$field[lane], sink);)*
                $($(self.$part.save_lane(lane, sink);)*)?
            }

            fn load_lane(&mut self, lane: usize, reader: &mut Reader<'_>) -> Result<(), Error> {
                $(self.$field[lane] = $crate::codec::Data::load(reader)?;)*
                $($(self.$part.load_lane(lane, reader)?;)*)?
                Ok(())
            }
        }
    };
}
pub(super) use lane_block;

lane_block! {
    /// What the narrow phase keeps of a contact from step to step.
    pub(crate) struct ManifoldBlock {
        /// Body indices.
        body_a: u32 = 0,
        body_b: u32 = 0,
        /// Shape indices.
        shape_a: u32 = 0,
        shape_b: u32 = 0,
        /// Feature ids of the points, as floats; -1 is no point.
        id_1: f32 = -1.0,
        id_2: f32 = -1.0,
        /// Mixed friction.
        friction: f32 = 0.0,
    }
}

lane_block! {
    /// One contact point as the solver sees it.
    pub(crate) struct PointLanes {
        /// Separation at the start of the step, metres.
        separation: f32 = 0.0,
        /// Cross product of anchor and normal, on A and on B, metres.
        normal_arm_a: f32 = 0.0,
        normal_arm_b: f32 = 0.0,
        /// Cross product of anchor and tangent, on A and on B, metres.
        tangent_arm_a: f32 = 0.0,
        tangent_arm_b: f32 = 0.0,
        /// Effective masses, kilograms; zero where there is no point.
        normal_mass: f32 = 0.0,
        tangent_mass: f32 = 0.0,
        /// Impulses of the last substep, newton seconds.
        normal_impulse: f32 = 0.0,
        tangent_impulse: f32 = 0.0,
        /// The normal impulse after the last relax pass: what friction goes by. That of a solve pass has the
        /// push that takes overlaps apart in it, which relaxing takes out again.
        load: f32 = 0.0,
    }
}

lane_block! {
    /// The contact constraints of a block: all that the substeps read and write.
    pub(crate) struct ConstraintBlock {
        body_a: u32 = 0,
        body_b: u32 = 0,
        /// Unit normal from A to B, world.
        normal_x: f32 = 0.0,
        normal_y: f32 = 0.0,
        friction: f32 = 0.0,
    }
    parts {
        points: [PointLanes; 2],
    }
}

const _: () = assert!(size_of::<ConstraintBlock>() == 25 * BLOCK * 4);

lane_block! {
    /// The rarer properties of a contact, read only in blocks whose [`flags`] ask for them.
    pub(crate) struct SurfaceBlock {
        restitution: f32 = 0.0,
        rolling_resistance: f32 = 0.0,
        tangent_speed: f32 = 0.0,
        rolling_impulse: f32 = 0.0,
        /// Normal velocity of the points at the start of the step, negative when approaching.
        approach_1: f32 = 0.0,
        approach_2: f32 = 0.0,
        /// Sum of the normal impulses of the substeps and of bounces, where hits are asked for.
        total_1: f32 = 0.0,
        total_2: f32 = 0.0,
        /// Rests of the points, metres; see [`rests`](crate::stages::rests).
        rest_1: f32 = 0.0,
        rest_2: f32 = 0.0,
    }
}

/// What lanes of a block use beyond plain friction contact.
pub(crate) mod flags {
    /// Some lane bounces.
    pub(crate) const RESTITUTION: u8 = 1;
    /// Some lane resists rolling.
    pub(crate) const ROLLING: u8 = 2;
    /// Some lane has a moving surface.
    pub(crate) const TANGENT_SPEED: u8 = 4;
    /// Some lane's hits are events.
    pub(crate) const HIT: u8 = 8;
    /// Some point has a rest.
    pub(crate) const RESTS: u8 = 16;
    /// All lanes are solved elsewhere, for the length of the substeps.
    pub(crate) const TAKEN: u8 = 32;
    /// Some lane's contact was predicted for this step.
    pub(crate) const WATCHED: u8 = 64;
    /// The impulses of a step are summed up.
    pub(crate) const SUMMED: u8 = HIT | WATCHED;
}

record! {
    /// What is known of a block as a whole.
    #[derive(Clone, Copy, Debug, PartialEq, Default)]
    pub(crate) struct BlockHead {
        /// Which lanes touched in the last narrow phase, as bits.
        pub(crate) touching: u16,
        /// Which lanes close in so fast that they may hit in the step, as bits; none between steps.
        pub(crate) closing: u16,
        /// What lanes use, see [`flags`].
        pub(crate) flags: u8,
        /// Lanes whose body A has joints, as bits, as of the last narrow phase.
        pub(crate) jointed_a: u16,
        /// Lanes whose body B has joints.
        pub(crate) jointed_b: u16,
    }
}

impl BlockHead {
    /// Copies what another head knows of one of its lanes into a lane of this one.
    pub(super) fn copy_lane(&mut self, to: usize, source: &Self, from: usize) {
        let set = |all: u16, lanes: u16| all & !(1 << to) | (lanes >> from & 1) << to;
        self.touching = set(self.touching, source.touching);
        self.closing = set(self.closing, source.closing);
        self.jointed_a = set(self.jointed_a, source.jointed_a);
        self.jointed_b = set(self.jointed_b, source.jointed_b);
        self.flags |= source.flags;
    }

    /// That of a block whose first lane is this one, and whose others are empty.
    pub(crate) fn lane(&self, lane: usize) -> Self {
        let first = |lanes: u16| lanes >> lane & 1;
        Self {
            touching: first(self.touching),
            closing: first(self.closing),
            flags: self.flags,
            jointed_a: first(self.jointed_a),
            jointed_b: first(self.jointed_b),
        }
    }
}
