//! Bodies: hot rows for the solver, poses, and everything else.

use super::body_rows::{Slot, inverses};
use super::pace::{PLAIN, is_jointed};
use super::places::{claim, put};
use crate::codec::{Data, Generations, Reader, Sink, kept_as_described, record, store};
use crate::describe::{BodyKind, Locks, RigidBody};
use crate::error::Error;
use crate::math::{DVec2, Pose, Rot, Vec2};
use crate::simd::Row;

/// No record: the end of a list.
pub(crate) const NULL: u32 = u32::MAX;

/// What a substep adds to a body's velocity; computed once a step.
#[derive(Clone, Copy, Default, PartialEq, Debug)]
#[repr(C, align(32))]
pub(crate) struct Motion {
    /// Velocity gained from gravity and forces in a substep: x, y, angular. 0 on locked axes. Then whether (1 or 0) what a
    /// substep's impulses add is carried into the next.
    pub(crate) gain: [f32; 4],
    /// Factor of damping in a substep: x, y, angular, and 1. 0 on locked axes.
    pub(crate) factor: [f32; 4],
}

record! {
    /// All of a body that a step does not touch in its inner loops. What it does touch once a step lies in the
    /// first cache line.
    #[derive(Clone, Copy, PartialEq, Debug)]
    #[repr(C, align(64))]
    pub(crate) struct BodyInfo {
        pub(crate) kind: BodyKind = BodyKind::Static,
        pub(crate) alive: bool = false,
        pub(crate) enabled: bool = true,
        pub(crate) awake: bool = false,
        pub(crate) bullet: bool = false,
        pub(crate) can_sleep: bool = true,
        /// Some shape of the body turns with nothing: rotation is locked for good.
        pub(crate) never_turns: bool = false,
        /// How finely its island is solved, see [`pace`](super::pace).
        pub(crate) pace: u8 = PLAIN as u8,
        /// How nearly it has settled, 255 is wholly; see [`rests`](crate::stages::rests).
        pub(crate) calm: u8 = 0,
        pub(crate) locks: Locks = Locks::default(),
        pub(crate) force: Vec2 = Vec2::ZERO,
        pub(crate) torque: f32 = 0.0,
        pub(crate) gravity_scale: f32 = 1.0,
        pub(crate) linear_damping: f32 = 0.0,
        pub(crate) angular_damping: f32 = 0.0,
        /// Seconds below the sleep speed; below zero as long as it may be turning back, see [`finalize`](crate::stages::finalize).
        pub(crate) sleep_time: f32 = 0.0,
        /// Seconds for which its island counts as stirred, see [`paces`](crate::stages::paces).
        pub(crate) stirred: f32 = 0.0,
        pub(crate) sleep_speed: f32 = 0.05,
        /// Smallest half width of a shape: how far it may move before it could jump over something.
        pub(crate) min_extent: f32 = 0.0,
        /// Greatest distance of a point of a shape from the centre of mass. Both of what is solid: sensors change no motion.
        pub(crate) max_extent: f32 = 0.0,
        pub(crate) first_shape: u32 = NULL,
        /// Centre of mass in the body's frame.
        pub(crate) local_center: Vec2 = Vec2::ZERO,
        pub(crate) mass: f32 = 0.0,
        pub(crate) inertia: f32 = 0.0,
        /// First joint edge: joint index * 2 + side.
        pub(crate) first_joint: u32 = NULL,
        /// Mass given by the user, if any.
        pub(crate) fixed_mass: Given = Given::default(),
        pub(crate) fixed_center: GivenPoint = GivenPoint::default(),
        pub(crate) fixed_inertia: Given = Given::default(),
        pub(crate) generation: u32 as apart = 0,
        pub(crate) shape_count: u32 = 0,
        /// First contact edge: contact index * 2 + side.
        pub(crate) first_contact: u32 = NULL,
        /// Colours of the constraint graph that its contacts use, as bits.
        pub(crate) contact_colours: u32 = 0,
        /// Colours that its joints use, as bits.
        pub(crate) joint_colours: u32 = 0,
        /// Next body of the same sleeping island, in a ring; NULL while awake.
        pub(crate) island_next: u32 = NULL,
        pub(crate) user_data: u64 = 0,
    }
}

kept_as_described!(BodyInfo of RigidBody {
    kind, enabled, bullet, can_sleep, locks, gravity_scale, linear_damping, angular_damping, sleep_speed, user_data,
});

const _: () = assert!(core::mem::offset_of!(BodyInfo, local_center) <= 64);
const _: () = assert!(size_of::<BodyInfo>() == 128);

/// A number above 0 that the user has given, or none, in four bytes.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(crate) struct Given(f32);

impl Given {
    pub(crate) fn new(number: Option<f32>) -> Self {
        Self(number.unwrap_or(0.0))
    }

    pub(crate) fn get(self) -> Option<f32> {
        (self.0 != 0.0).then_some(self.0)
    }
}

impl Data for Given {
    fn save(&self, sink: &mut Sink) {
        self.get().save(sink);
    }
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        Option::load(reader).map(Self::new)
    }
}

/// A point that the user has given, or none, in eight bytes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct GivenPoint(Vec2);

impl GivenPoint {
    /// No point that a user may give.
    const NONE: Vec2 = Vec2::splat(f32::MAX);

    pub(crate) fn new(point: Option<Vec2>) -> Self {
        Self(point.unwrap_or(Self::NONE))
    }

    pub(crate) fn get(self) -> Option<Vec2> {
        (self.0 != Self::NONE).then_some(self.0)
    }
}

impl Default for GivenPoint {
    fn default() -> Self {
        Self(Self::NONE)
    }
}

impl Data for GivenPoint {
    fn save(&self, sink: &mut Sink) {
        self.get().save(sink);
    }
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        Option::load(reader).map(Self::new)
    }
}

impl BodyInfo {
    /// How far turning takes the outline of the body into what was free before, metres: no further than its points
    /// go, nor than they stick out of the disk that it has in any case.
    #[inline]
    pub(crate) fn turned_reach(&self, turn: f32) -> f32 {
        let (way, rim) = (turn.abs() * self.max_extent, self.max_extent - self.min_extent);
        if way < rim { way } else { rim }
    }
}

store! {
    /// All bodies of a world, by stable index. Body 0 is always there, static and without shapes: empty
    /// lanes of constraint blocks point to it, so its row must never be written.
    #[derive(Debug, PartialEq)]
    pub(crate) struct Bodies {
        /// Velocity, motion since the start of the step, inverse masses: see [`Slot`].
        pub(crate) rows: Vec<Row>,
        /// Frame of the centre of mass.
        pub(crate) poses: Vec<Pose>,
        /// Poses at the start of the last step, for drawing in between; the current ones of bodies that sleep
        /// or were placed by the user.
        pub(crate) previous: Vec<Pose>,
        pub(crate) motions: Vec<Motion> as derived,
        /// Velocity before the impulses of the substep, and nothing.
        pub(crate) starts: Vec<[f32; 4]> as derived,
        pub(crate) infos: Vec<BodyInfo>,
        /// How often each has turned back, see [`rocking`](crate::stages::rocking).
        pub(crate) swings: Vec<u8>,
        /// Moving (dynamic or kinematic) bodies that are awake and enabled, ascending.
        pub(crate) awake: Vec<u32>,
        /// `awake` may not be ascending: it has been changed since it was last sorted.
        pub(crate) awake_unsorted: bool,
        /// Where in `awake` each body is, or NULL.
        pub(super) awake_places: Vec<u32> as derived,
        pub(crate) free: Vec<u32>,
        pub(crate) count: usize,
        /// Bodies of another pace than the plain one, sleeping ones too.
        pub(crate) refined: usize,
        /// Light bodies that heavy ones pressed at the end of the last step, with the inverse mass of those, see
        /// [`squeezed`](crate::stages::ahead).
        pub(crate) pressed: Vec<(u32, f32)>,
        /// Light bodies that heavy ones lie on, on static ground, with the inverse mass of those: see
        /// [`paces`](crate::stages::paces).
        pub(crate) laden: Vec<(u32, f32)>,
        generations: Generations,
    }
    load with Bodies::settle
}

impl Default for Bodies {
    /// None but body 0.
    fn default() -> Self {
        Self {
            rows: vec![[0.0; 8]],
            poses: vec![Pose::default()],
            previous: vec![Pose::default()],
            motions: vec![Motion::default()],
            starts: vec![[0.0; 4]],
            infos: vec![BodyInfo::default()],
            swings: vec![0],
            awake: Vec::new(),
            awake_unsorted: false,
            awake_places: vec![NULL],
            free: Vec::new(),
            count: 0,
            refined: 0,
            pressed: Vec::new(),
            laden: Vec::new(),
            generations: Generations::default(),
        }
    }
}

impl Bodies {
    /// Finds out what follows from the rest, for bodies that were read.
    fn settle(&mut self) -> Result<(), Error> {
        self.motions.resize(self.infos.len(), Motion::default());
        self.starts.resize(self.infos.len(), [0.0; 4]);
        self.find_awake_places()
    }

    /// Bodies alive, without body 0.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Indices of the bodies alive, ascending.
    pub(crate) fn indices(&self) -> impl Iterator<Item = u32> + '_ {
        (1..self.infos.len() as u32).filter(|&i| self.infos[i as usize].alive)
    }

    /// Puts a record in, under a generation that no record of this place had, and gives its index.
    pub(crate) fn insert(&mut self, mut info: BodyInfo, pose: Pose) -> u32 {
        self.count += 1;
        info.alive = true;
        info.generation = self.generations.next();
        let index = claim(&mut self.free, self.infos.len());
        put(&mut self.infos, index, info);
        put(&mut self.swings, index, 0);
        put(&mut self.poses, index, pose);
        put(&mut self.previous, index, pose);
        put(&mut self.rows, index, [0.0; 8]);
        put(&mut self.motions, index, Motion::default());
        put(&mut self.starts, index, [0.0; 4]);
        put(&mut self.awake_places, index, NULL);
        index
    }

    /// Takes a record out. The caller has unlinked everything that refers to it.
    pub(crate) fn remove(&mut self, index: u32) {
        self.count -= 1;
        self.set_pace(index, PLAIN as u8);
        self.disturb(index);
        self.infos[index as usize] = BodyInfo::default();
        self.rows[index as usize] = [0.0; 8];
        self.free.push(index);
    }

    /// Is the body dynamic? Only those have inverse masses, colours and islands.
    #[inline]
    pub(crate) fn is_dynamic(&self, index: u32) -> bool {
        self.infos[index as usize].kind == BodyKind::Dynamic
    }

    /// The user moves a body: what was known of how it rests, rocks and is pressed on holds no longer.
    pub(crate) fn disturb(&mut self, index: u32) {
        for list in [&mut self.pressed, &mut self.laden] {
            if let Ok(at) = list.binary_search_by_key(&index, |&(body, _)| body) {
                list.remove(at);
            }
        }
        self.swings[index as usize] = 0;
        self.infos[index as usize].sleep_time = 0.0;
    }

    /// Gives a body its pace.
    pub(crate) fn set_pace(&mut self, index: u32, pace: u8) {
        let old = core::mem::replace(&mut self.infos[index as usize].pace, pace);
        self.refined -= usize::from(usize::from(old) != PLAIN);
        self.refined += usize::from(usize::from(pace) != PLAIN);
    }

    /// The half thickness of the thinner one of two bodies, metres: of one that nothing moves and that has a line somewhere, the other's.
    #[inline]
    pub(crate) fn thinner_half(&self, pair: [u32; 2]) -> f32 {
        let [a, b] = pair.map(|body| match self.infos[body as usize].min_extent {
            0.0 if !self.is_dynamic(body) => f32::MAX,
            half => half,
        });
        if b < a { b } else { a }
    }

    /// Is any awake dynamic body of another pace than the plain one?
    pub(crate) fn any_refined(&self) -> bool {
        self.paces() & !(1 << PLAIN) != 0
    }

    /// The paces of awake dynamic bodies, as bits; nothing where all are of the plain one.
    pub(crate) fn paces(&self) -> u32 {
        let awake = if self.refined > 0 { &self.awake[..] } else { &[] };
        let dynamic = awake.iter().filter(|&&body| self.is_dynamic(body));
        dynamic.fold(0, |paces, &body| paces | 1 << self.infos[body as usize].pace)
    }

    /// Do two dynamic bodies have different paces? The next step brings them in line.
    #[inline]
    pub(crate) fn are_mixed(&self, a: u32, b: u32) -> bool {
        let (a, b) = (&self.infos[a as usize], &self.infos[b as usize]);
        let dynamic = a.kind == BodyKind::Dynamic && b.kind == BodyKind::Dynamic;
        dynamic && a.pace != b.pace
    }

    /// Has a body joints that are not solved together with contacts yet, and no contact? What has contacts, and still is not, is in
    /// an island that is too large.
    pub(crate) fn hangs_loose(&self, index: u32) -> bool {
        let info = &self.infos[index as usize];
        let joined = info.first_joint != NULL && info.kind == BodyKind::Dynamic;
        joined && info.contact_colours == 0 && !is_jointed(info.pace.into())
    }

    /// The pace at which what joins two bodies is solved.
    #[inline]
    pub(crate) fn common_pace(&self, a: u32, b: u32) -> usize {
        let dynamic = if self.is_dynamic(a) { a } else { b };
        if self.is_dynamic(dynamic) { self.infos[dynamic as usize].pace.into() } else { PLAIN }
    }

    /// Is the body dynamic and awake?
    pub(crate) fn is_solved(&self, index: u32) -> bool {
        self.is_dynamic(index) && self.infos[index as usize].awake
    }

    /// Linear velocity of the centre of mass.
    #[inline]
    pub(crate) fn velocity(&self, index: u32) -> Vec2 {
        let row = &self.rows[index as usize];
        Vec2::new(row[Slot::VX], row[Slot::VY])
    }

    /// From a body's centre of mass to a point of its frame, world axes.
    pub(crate) fn arm(&self, index: u32, point: Vec2) -> Vec2 {
        let arm = point - self.infos[index as usize].local_center;
        self.poses[index as usize].q.rotate(arm)
    }

    /// Angular velocity, radians a second.
    #[inline]
    pub(crate) fn angular_velocity(&self, index: u32) -> f32 {
        self.rows[index as usize][Slot::W]
    }

    /// Inverse masses along x and y and inverse inertia as the solver uses them.
    #[inline]
    pub(crate) fn inverses(&self, index: u32) -> [f32; 3] {
        inverses::<f32>((), &self.rows[index as usize])
    }

    /// Inverse mass and inverse inertia, where locks do not matter.
    #[inline]
    pub(crate) fn inverse_masses(&self, index: u32) -> (f32, f32) {
        let [x, y, turn] = self.inverses(index);
        (if x > y { x } else { y }, turn)
    }

    /// Takes velocity and the motion of the step from a body.
    pub(crate) fn stop(&mut self, index: u32) {
        let row = &mut self.rows[index as usize];
        Slot::MOTION.iter().for_each(|&slot| row[slot] = 0.0);
    }

    /// Stops what does not move by the solver and has got numbers that are not finite: nothing times infinity, from what blew up on it.
    pub(crate) fn stop_ground_that_is_not_finite(&mut self) {
        for index in 0..self.rows.len() as u32 {
            let row = &self.rows[index as usize];
            if !self.is_solved(index) && Slot::MOTION.iter().any(|&slot| !row[slot].is_finite()) {
                self.stop(index);
            }
        }
    }

    pub(crate) fn set_velocity(&mut self, index: u32, velocity: Vec2) {
        let row = &mut self.rows[index as usize];
        row[Slot::VX] = velocity.x;
        row[Slot::VY] = velocity.y;
    }

    pub(crate) fn set_angular_velocity(&mut self, index: u32, angular: f32) {
        self.rows[index as usize][Slot::W] = angular;
    }

    /// The frame the user knows: origin of the body, not its centre of mass.
    pub(crate) fn origin_pose(&self, index: u32) -> Pose {
        let pose = self.poses[index as usize];
        Pose::new(pose.apply(-self.infos[index as usize].local_center), pose.q)
    }

    /// Where its centre of mass is when its origin is there.
    pub(crate) fn pose_of_origin(&self, index: u32, position: DVec2, rotation: Rot) -> Pose {
        let center = self.infos[index as usize].local_center;
        Pose::new(position + rotation.rotate(center), rotation)
    }

    /// Places the body by its origin.
    pub(crate) fn set_origin_pose(&mut self, index: u32, position: DVec2, rotation: Rot) {
        let pose = self.pose_of_origin(index, position, rotation);
        (self.poses[index as usize], self.previous[index as usize]) = (pose, pose);
    }

    /// Writes the inverse masses that the solver works with.
    pub(crate) fn update_inverse_masses(&mut self, index: u32) {
        let info = &self.infos[index as usize];
        let dynamic = info.kind == BodyKind::Dynamic;
        let turns = dynamic && !info.locks.rotation && !info.never_turns && info.inertia > 0.0;
        let row = &mut self.rows[index as usize];
        let Locks { x, y, .. } = info.locks;
        let moves = dynamic && info.mass > 0.0 && !(x && y);
        let inv_inertia = if turns { 1.0 / info.inertia } else { 0.0 };
        let inv_mass = if moves { 1.0 / info.mass } else { 0.0 };
        row[Slot::INV_MASS] = if moves && (x || y) { -inv_mass } else { inv_mass };
        row[Slot::INV_INERTIA] =
            if moves && y { -inv_inertia.max(f32::MIN_POSITIVE) } else { inv_inertia };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reused_place_has_another_generation() {
        let mut bodies = Bodies::default();
        let a = bodies.insert(BodyInfo::default(), Pose::default());
        let generation = bodies.infos[a as usize].generation;
        bodies.remove(a);
        assert_eq!(bodies.insert(BodyInfo::default(), Pose::default()), a);
        assert_ne!(bodies.infos[a as usize].generation, generation);
    }
}
