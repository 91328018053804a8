//! What the kernels of all joints share: lanes of a stride, pairs of bodies, small linear systems.

use crate::describe::JointDef;
use crate::dynamics::{
    AngleLanes, DirectionLanes, FrameLanes, Slot, SoftLanes, give_along, inverse_mass_along, locked,
};
use crate::math::{Pose, Rot};
use crate::simd::{BLOCK, Lanes};
use crate::threads::SharedRows;

/// Position error that a substep takes away, metres (times the length unit) or radians. Of 1,500 sliders made
/// anywhere one got faster than 17 m/s at 0.02 and 12,000 without such a bound; a hundred ragdolls in a pit
/// come to rest at 0.005, and never at 0.05.
pub(super) const SNAP: f32 = 0.005;
/// And this part of it: what is far out of place is there within a second.
pub(super) const SNAP_SHARE: f32 = 0.015;

/// Length of a substep, seconds, its inverse, the length unit, metres, and whether the length is another than in the step before.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Substep {
    pub(crate) h: f32,
    pub(crate) inv_h: f32,
    pub(crate) unit: f32,
    pub(crate) leaps: bool,
}

impl Substep {
    pub(crate) fn new(h: f32, unit: f32, leaps: bool) -> Self {
        Self { h, inv_h: 1.0 / h, unit, leaps }
    }
}

/// Where in a block a kernel works, and constants in lanes.
#[derive(Clone, Copy)]
pub(super) struct Stride<L: Lanes> {
    pub(super) token: L::Token,
    pub(super) at: usize,
    pub(super) zero: L,
    pub(super) one: L,
    /// Substep length, seconds, and its inverse.
    pub(super) h: L,
    pub(super) inv_h: L,
    /// [`SNAP`] a substep, metres and radians a second.
    pub(super) snap: L,
    pub(super) snap_turn: L,
    /// Length unit, metres.
    pub(super) unit: L,
    /// Is the part of the block used that joints of its class rarely have?
    pub(super) extras: bool,
}

impl<L: Lanes> Stride<L> {
    #[inline(always)]
    pub(super) fn new(token: L::Token, at: usize, Substep { h, inv_h, unit, .. }: Substep) -> Self {
        Self {
            token,
            at,
            zero: L::splat(token, 0.0),
            one: L::splat(token, 1.0),
            h: L::splat(token, h),
            inv_h: L::splat(token, inv_h),
            snap: L::splat(token, SNAP * unit * inv_h),
            snap_turn: L::splat(token, SNAP * inv_h),
            unit: L::splat(token, unit),
            extras: false,
        }
    }

    #[inline(always)]
    pub(super) fn splat(&self, value: f32) -> L {
        L::splat(self.token, value)
    }

    #[inline(always)]
    pub(super) fn load(&self, lanes: &[f32; BLOCK]) -> L {
        L::load(self.token, &lanes[self.at..])
    }

    #[inline(always)]
    pub(super) fn load2(&self, x: &[f32; BLOCK], y: &[f32; BLOCK]) -> [L; 2] {
        [self.load(x), self.load(y)]
    }

    #[inline(always)]
    pub(super) fn store(&self, value: L, lanes: &mut [f32; BLOCK]) {
        value.store(&mut lanes[self.at..]);
    }

    #[inline(always)]
    pub(super) fn store2(&self, value: [L; 2], x: &mut [f32; BLOCK], y: &mut [f32; BLOCK]) {
        self.store(value[0], x);
        self.store(value[1], y);
    }

    /// 1 / value; 0 where the value is not above 0.
    #[inline(always)]
    pub(super) fn invert(&self, value: L) -> L {
        L::select(value.gt(self.zero), self.one / value, self.zero)
    }
}

#[inline(always)]
pub(super) fn dot<L: Lanes>(a: [L; 2], b: [L; 2]) -> L {
    a[0] * b[0] + a[1] * b[1]
}

#[inline(always)]
pub(super) fn cross<L: Lanes>(a: [L; 2], b: [L; 2]) -> L {
    a[0] * b[1] - a[1] * b[0]
}

#[inline(always)]
pub(super) fn add<L: Lanes>(a: [L; 2], b: [L; 2]) -> [L; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

#[inline(always)]
pub(super) fn sub<L: Lanes>(a: [L; 2], b: [L; 2]) -> [L; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

#[inline(always)]
pub(super) fn scale<L: Lanes>(a: [L; 2], factor: L) -> [L; 2] {
    [a[0] * factor, a[1] * factor]
}

#[inline(always)]
pub(super) fn rotate<L: Lanes>(q: [L; 2], v: [L; 2]) -> [L; 2] {
    [q[0] * v[0] - q[1] * v[1], q[1] * v[0] + q[0] * v[1]]
}

/// Turned anticlockwise by a quarter.
#[inline(always)]
pub(super) fn perp<L: Lanes>(v: [L; 2]) -> [L; 2] {
    [-v[1], v[0]]
}

/// Cosine and sine of a body's turn since the start of the step: the same formula as
/// [`Rot::integrate`](crate::math::Rot::integrate), so that joints see the pose that the body will have.
#[inline(always)]
fn turn<L: Lanes>(stride: &Stride<L>, angle: L) -> [L; 2] {
    let half = stride.splat(0.5) * angle;
    let half_sq = half * half;
    let cubic = stride.splat(1.0 / 3.0) + half_sq * stride.splat(2.0 / 15.0);
    let t = half + half * half_sq * cubic;
    let t_sq = t * t;
    let inv = stride.one / (stride.one + t_sq);
    let series = [(stride.one - t_sq) * inv, (t + t) * inv];
    let large = angle.abs().gt(stride.splat(Rot::SMALL_TURN));
    if L::bits(large) == 0 {
        return series;
    }
    let mut angles = [0.0; BLOCK];
    angle.store(&mut angles);
    let turns = large_turns(&angles[..L::WIDTH]);
    let choose = |k: usize| L::select(large, L::load(stride.token, &turns[k]), series[k]);
    [choose(0), choose(1)]
}

/// Cosines and sines of angles that are too large for the series.
#[cold]
fn large_turns(angles: &[f32]) -> [[f32; BLOCK]; 2] {
    let mut turns = [[0.0; BLOCK]; 2];
    for (lane, &angle) in angles.iter().enumerate() {
        let Rot { c, s } = Rot::from_angle(angle);
        (turns[0][lane], turns[1][lane]) = (c, s);
    }
    turns
}

/// Turn in a substep, for what goes with its square. It fades out towards [`FASTEST_SWING`]: chains under
/// a load a thousand times their weight, which shake anyway, exploded without.
#[inline(always)]
pub(super) fn slow_turn<L: Lanes>(stride: &Stride<L>, turn_rate: L) -> L {
    let turn = stride.h * turn_rate;
    let fade = stride.one - turn * turn * stride.splat(1.0 / (FASTEST_SWING * FASTEST_SWING));
    L::select(fade.gt(stride.zero), turn * fade, stride.zero)
}

/// Velocity towards the centre of mass that an anchor's circle adds on the mean of a substep, to second
/// order: `-h w^2 r / 2`.
#[inline(always)]
fn inward<L: Lanes>(stride: &Stride<L>, w: L, anchor: [L; 2]) -> [L; 2] {
    scale(anchor, stride.splat(-0.5) * w * slow_turn(stride, w))
}

/// Turn in a substep up to which the circles of anchors are followed, radians.
const FASTEST_SWING: f32 = 0.2;

/// Rotations of a joint's bodies at the start of the step.
pub(super) struct Start<L> {
    pub(super) turn_a: [L; 2],
    pub(super) turn_b: [L; 2],
}

impl<L: Lanes> Start<L> {
    /// Gathers poses, and writes what all joints take from them.
    #[inline(always)]
    pub(super) fn prepare(stride: &Stride<L>, frame: &mut FrameLanes, poses: &[Pose]) -> Self {
        let mut lanes = [[0.0; BLOCK]; 4];
        for i in stride.at..stride.at + L::WIDTH {
            let a = poses[frame.body_a[i] as usize];
            let b = poses[frame.body_b[i] as usize];
            let between = b.p.relative_to(a.p);
            frame.between_x[i] = between.x;
            frame.between_y[i] = between.y;
            for (lane, value) in lanes.iter_mut().zip([a.q.c, a.q.s, b.q.c, b.q.s]) {
                lane[i] = value;
            }
        }
        let start = Self {
            turn_a: stride.load2(&lanes[0], &lanes[1]),
            turn_b: stride.load2(&lanes[2], &lanes[3]),
        };
        let local_a = stride.load2(&frame.local_a_x, &frame.local_a_y);
        let local_b = stride.load2(&frame.local_b_x, &frame.local_b_y);
        stride.store2(rotate(start.turn_a, local_a), &mut frame.a_x, &mut frame.a_y);
        stride.store2(rotate(start.turn_b, local_b), &mut frame.b_x, &mut frame.b_y);
        start
    }

    /// Angle of B against A in [-pi, pi], plus the turn of the description.
    #[inline(always)]
    pub(super) fn angle(&self, stride: &Stride<L>, description: [L; 2]) -> L {
        let back = [self.turn_a[0], -self.turn_a[1]];
        let [c, s] = rotate(rotate(back, self.turn_b), description);
        atan2(stride, s, c)
    }

    /// Writes the angle at the start of the step.
    #[inline(always)]
    pub(super) fn prepare_angle(&self, stride: &Stride<L>, lanes: &mut AngleLanes) {
        let angle = self.angle(stride, stride.load2(&lanes.turn_c, &lanes.turn_s));
        stride.store(angle, &mut lanes.start);
    }
}

/// Writes what a description adds to the angle.
pub(super) fn describe_angle(angle: &mut AngleLanes, lane: usize, def: &JointDef) {
    let turn = Rot::from_angle(def.angle_b).relative_to(Rot::from_angle(def.angle_a));
    angle.turn_c[lane] = turn.c;
    angle.turn_s[lane] = turn.s;
}

/// Arc tangent of s / c in lanes, in [-pi, pi], within 3e-7; 0 for the zero vector.
///
/// Polynomial 4.4.49 of Abramowitz and Stegun, "Handbook of Mathematical Functions" (1964).
#[inline(always)]
pub(super) fn atan2<L: Lanes>(stride: &Stride<L>, s: L, c: L) -> L {
    const TERMS: [f32; 9] = [
        0.002_866_225_7,
        -0.016_165_737,
        0.042_909_614,
        -0.075_289_64,
        0.106_562_64,
        -0.142_089,
        0.199_935_51,
        -0.333_331_45,
        1.0,
    ];
    let (ax, ay) = (c.abs(), s.abs());
    let steep = ay.gt(ax);
    let small = L::select(steep, ax, ay);
    let large = L::select(steep, ay, ax);
    let t = L::select(large.gt(stride.zero), small / large, stride.zero);
    let z = t * t;
    let mut sum = stride.zero;
    for term in TERMS {
        sum = sum * z + stride.splat(term);
    }
    let angle = t * sum;
    let angle = L::select(steep, stride.splat(core::f32::consts::FRAC_PI_2) - angle, angle);
    let angle = L::select(c.lt(stride.zero), stride.splat(core::f32::consts::PI) - angle, angle);
    L::select(s.lt(stride.zero), -angle, angle)
}

/// An angle in [-3 pi, 3 pi] brought into [-pi, pi] by a whole turn.
#[inline(always)]
pub(super) fn wrap<L: Lanes>(stride: &Stride<L>, angle: L) -> L {
    let (pi, tau) = (stride.splat(core::f32::consts::PI), stride.splat(core::f32::consts::TAU));
    let angle = L::select(angle.gt(pi), angle - tau, angle);
    L::select(angle.lt(-pi), angle + tau, angle)
}

/// The coefficients of a soft constraint in the pass at hand.
#[derive(Clone, Copy)]
pub(super) struct Soft<L, const BIAS: bool> {
    pub(super) push: L,
    pub(super) mass_scale: L,
    pub(super) impulse_scale: L,
    /// Above 0 where something is held rigid: that snaps in as [`SNAP`] says; springs pull as they will.
    pub(super) held: L,
}

impl<L: Lanes, const BIAS: bool> Soft<L, BIAS> {
    /// As described in the solve pass; in the relax pass without bias, exact or, of springs, what is left of their
    /// damping.
    #[inline(always)]
    pub(super) fn load(stride: &Stride<L>, lanes: &SoftLanes) -> Self {
        let mass_scale = stride.load(if BIAS { &lanes.mass_scale } else { &lanes.ease });
        if !BIAS {
            let zero = stride.zero;
            return Self { push: zero, mass_scale, impulse_scale: zero, held: zero };
        }
        let impulse_scale = stride.load(&lanes.impulse_scale);
        let (push, held) = (stride.load(&lanes.push), stride.load(&lanes.rigid));
        Self { push, mass_scale, impulse_scale, held }
    }

    /// Overrun from which on limits are firm: never where the user has asked for a softness.
    #[inline(always)]
    pub(super) fn overrun(&self, stride: &Stride<L>, usual: L) -> L {
        L::select(self.held.gt(stride.one), stride.splat(f32::MAX), usual)
    }

    /// The velocity that the constraint takes away. Errors are no matter of the relax pass.
    #[inline(always)]
    pub(super) fn demand(&self, velocity: L, error: L) -> L {
        let part = self.mass_scale * velocity;
        if BIAS { part + self.push * error } else { part }
    }

    /// The part of its push that is left where errors of what is held go no faster than `snap` and a share of themselves.
    #[inline(always)]
    pub(super) fn part(&self, stride: &Stride<L>, error: L, snap: L) -> L {
        if !BIAS {
            return stride.one;
        }
        let snap = snap + error.abs() * (stride.inv_h * stride.splat(SNAP_SHARE));
        let part = snap / (self.push * error).abs().max(snap);
        L::select(self.held.gt(stride.zero), part, stride.one)
    }

    /// The same where only a part of push and decay is left. One without the other would let go: the push stands for what
    /// decays of the impulse that bears a load.
    #[inline(always)]
    pub(super) fn in_part(self, part: L) -> Self {
        Self { push: self.push * part, impulse_scale: self.impulse_scale * part, ..self }
    }

    /// The same that lets go of so much, see [`torn`](super::torn).
    #[inline(always)]
    pub(super) fn yielding(self, part: L) -> Self {
        if BIAS { Self { impulse_scale: self.impulse_scale.max(part), ..self } } else { self }
    }

    /// The same for a point that is so far off.
    #[inline(always)]
    pub(super) fn hold2(self, stride: &Stride<L>, error: [L; 2], yields: L) -> Self {
        let x = self.part(stride, error[0], stride.snap);
        let part = x.min(self.part(stride, error[1], stride.snap));
        self.in_part(part).yielding(yields)
    }

    /// The velocities that a point takes away.
    #[inline(always)]
    pub(super) fn demand2(&self, velocity: [L; 2], error: [L; 2]) -> [L; 2] {
        [self.demand(velocity[0], error[0]), self.demand(velocity[1], error[1])]
    }

    /// Less the decay of the impulses so far.
    #[inline(always)]
    pub(super) fn less(&self, change: [L; 2], old: [L; 2]) -> [L; 2] {
        if BIAS { sub(change, scale(old, self.impulse_scale)) } else { change }
    }
}

/// A joint pushes in one point where so many times the square of its gap is less than half of those of its arms, and at its anchors where it
/// is more than three halves.
const TORN: f32 = 8.0;

/// The two bodies of each lane's joint, and its anchors as they are now.
pub(super) struct Pair<L: Lanes> {
    token: L::Token,
    pub(super) a: [L; 8],
    pub(super) b: [L; 8],
    /// Turn of A since the start of the step.
    pub(super) turn_a: [L; 2],
    /// Anchors relative to the centres of mass, world axes.
    pub(super) anchor_a: [L; 2],
    pub(super) anchor_b: [L; 2],
    /// From anchor A to anchor B.
    pub(super) gap: [L; 2],
    /// Inverse masses of A and B along x and y, where some are locked along one of them.
    locked: Option<[[L; 2]; 2]>,
}

/// The lanes whose body something can move, as bits.
#[inline(always)]
fn movable<L: Lanes>(stride: &Stride<L>, body: &[L; 8]) -> u32 {
    L::bits(stride.zero.lt(body[Slot::INV_MASS].abs() + body[Slot::INV_INERTIA]))
}

impl<L: Lanes> Pair<L> {
    #[inline(always)]
    pub(super) fn load(stride: &Stride<L>, rows: SharedRows<'_>, frame: &FrameLanes) -> Self {
        let mut a = L::gather(stride.token, rows, &frame.body_a[stride.at..]);
        let mut b = L::gather(stride.token, rows, &frame.body_b[stride.at..]);
        let locked = locked(stride.token, [&mut a, &mut b]);
        let (turn_a, turn_b) = (turn(stride, a[Slot::DA]), turn(stride, b[Slot::DA]));
        let anchor_a = rotate(turn_a, stride.load2(&frame.a_x, &frame.a_y));
        let anchor_b = rotate(turn_b, stride.load2(&frame.b_x, &frame.b_y));
        let between = stride.load2(&frame.between_x, &frame.between_y);
        let moved = [b[Slot::DX] - a[Slot::DX], b[Slot::DY] - a[Slot::DY]];
        let gap = add(add(between, moved), sub(anchor_b, anchor_a));
        Self { token: stride.token, turn_a, anchor_a, anchor_b, gap, locked, a, b }
    }

    /// Lets the anchors meet in one point between them, the nearer to each the lighter its body. Impulses on both bodies there keep their
    /// angular momentum, and a gap that turns along with its bodies has no velocity. What is torn open by more than a quarter of its arms
    /// closes sooner at its own anchors.
    #[inline(always)]
    pub(super) fn meet(&mut self, stride: &Stride<L>) {
        let [a, b] = [self.a[Slot::INV_MASS].abs(), self.b[Slot::INV_MASS].abs()];
        let all = a + b;
        let way = scale(self.gap, b / L::select(all.gt(stride.zero), all, stride.one));
        let arms = dot(self.anchor_a, self.anchor_a) + dot(self.anchor_b, self.anchor_b);
        let open = dot(self.gap, self.gap) * stride.splat(TORN) / arms.max(stride.splat(1.0e-20));
        let part = (stride.splat(1.5) - open).clamp(stride.zero, stride.one);
        self.anchor_a = add(self.anchor_a, scale(way, part));
        self.anchor_b = add(self.anchor_b, scale(sub(way, self.gap), part));
    }

    /// Writes the velocities back, except to bodies that nothing moves.
    #[inline(always)]
    pub(super) fn store(self, stride: &Stride<L>, rows: SharedRows<'_>, frame: &FrameLanes) {
        let (write_a, write_b) = (movable(stride, &self.a), movable(stride, &self.b));
        let ([ax, ay, aw, am, ..], [bx, by, bw, bm, ..]) = (self.a, self.b);
        L::scatter([ax, ay, aw, am], rows, &frame.body_a[stride.at..], write_a);
        L::scatter([bx, by, bw, bm], rows, &frame.body_b[stride.at..], write_b);
    }

    /// Inverse masses of A and B along x and y.
    #[inline(always)]
    fn inv_masses(&self) -> [[L; 2]; 2] {
        let [a, b] = [self.a[Slot::INV_MASS], self.b[Slot::INV_MASS]];
        self.locked.unwrap_or([[a, a], [b, b]])
    }

    /// Sum of the inverse masses along a direction.
    #[inline(always)]
    fn inv_mass(&self, direction: [L; 2]) -> L {
        match self.locked {
            None => self.a[Slot::INV_MASS] + self.b[Slot::INV_MASS],
            Some([a, b]) => {
                inverse_mass_along(self.token, direction, a)
                    + inverse_mass_along(self.token, direction, b)
            }
        }
    }

    /// Sum of the inverse moments of inertia.
    #[inline(always)]
    pub(super) fn inv_inertia(&self) -> L {
        self.a[Slot::INV_INERTIA] + self.b[Slot::INV_INERTIA]
    }

    /// Turn of B against A since the start of the step.
    #[inline(always)]
    fn turned(&self) -> L {
        self.b[Slot::DA] - self.a[Slot::DA]
    }

    /// Angular velocity of B against A.
    #[inline(always)]
    pub(super) fn spin(&self) -> L {
        self.b[Slot::W] - self.a[Slot::W]
    }

    /// Velocity of anchor B against anchor A.
    #[inline(always)]
    pub(super) fn anchor_velocity(&self) -> [L; 2] {
        let (a, b) = (&self.a, &self.b);
        [
            (b[Slot::VX] - b[Slot::W] * self.anchor_b[1])
                - (a[Slot::VX] - a[Slot::W] * self.anchor_a[1]),
            (b[Slot::VY] + b[Slot::W] * self.anchor_b[0])
                - (a[Slot::VY] + a[Slot::W] * self.anchor_a[0]),
        ]
    }

    /// What the circles of the anchors add to the mean of [`Self::anchor_velocity`] over the coming
    /// substep.
    #[inline(always)]
    pub(super) fn inward(&self, stride: &Stride<L>) -> [L; 2] {
        let inward_a = inward(stride, self.a[Slot::W], self.anchor_a);
        let inward_b = inward(stride, self.b[Slot::W], self.anchor_b);
        sub(inward_b, inward_a)
    }

    /// Velocity of anchor B against anchor A that a pass solves for: its mean over the coming substep
    /// in the solve pass, that of now in the relax pass.
    ///
    /// Solving for where the anchors will be, then for their velocity there, is the scheme RATTLE
    /// (Andersen 1983), which neither gains nor loses energy. With the velocity of now in both passes a
    /// pendulum of 1 m lost 10 mm of height in a minute at 4 substeps.
    #[inline(always)]
    pub(super) fn anchor_velocity_in<const BIAS: bool>(&self, stride: &Stride<L>) -> [L; 2] {
        let now = self.anchor_velocity();
        if BIAS { add(now, self.inward(stride)) } else { now }
    }

    /// Velocity along a direction with lever arms on A and B.
    #[inline(always)]
    pub(super) fn velocity_along(&self, row: &Row<L>) -> L {
        let (a, b) = (&self.a, &self.b);
        row.direction[0] * (b[Slot::VX] - a[Slot::VX])
            + row.direction[1] * (b[Slot::VY] - a[Slot::VY])
            + (row.arm_b * b[Slot::W] - row.arm_a * a[Slot::W])
    }

    /// Inverse effective mass along a direction.
    #[inline(always)]
    pub(super) fn inv_mass_along(&self, row: &Row<L>) -> L {
        self.inv_mass(row.direction)
            + self.a[Slot::INV_INERTIA] * row.arm_a * row.arm_a
            + self.b[Slot::INV_INERTIA] * row.arm_b * row.arm_b
    }

    /// Applies an impulse on B (the opposite on A), and angular impulses on both as the lever arms
    /// make them.
    #[inline(always)]
    pub(super) fn apply(&mut self, impulse: [L; 2], angular_a: L, angular_b: L) {
        let [mass_a, mass_b] = self.inv_masses();
        let (a, b) = (&mut self.a, &mut self.b);
        a[Slot::VX] = a[Slot::VX] - mass_a[0] * impulse[0];
        a[Slot::VY] = a[Slot::VY] - mass_a[1] * impulse[1];
        a[Slot::W] = a[Slot::W] - a[Slot::INV_INERTIA] * angular_a;
        b[Slot::VX] = b[Slot::VX] + mass_b[0] * impulse[0];
        b[Slot::VY] = b[Slot::VY] + mass_b[1] * impulse[1];
        b[Slot::W] = b[Slot::W] + b[Slot::INV_INERTIA] * angular_b;
    }

    /// Applies an impulse at the anchors and an angular impulse.
    #[inline(always)]
    pub(super) fn apply_at_anchors(&mut self, impulse: [L; 2], angular: L) {
        let angular_a = cross(self.anchor_a, impulse) + angular;
        let angular_b = cross(self.anchor_b, impulse) + angular;
        self.apply(impulse, angular_a, angular_b);
    }

    /// Applies an impulse along a direction.
    #[inline(always)]
    pub(super) fn apply_along(&mut self, row: &Row<L>, impulse: L) {
        self.apply(scale(row.direction, impulse), row.arm_a * impulse, row.arm_b * impulse);
    }

    /// Response of the anchors' velocity to an impulse there, inverted:
    ///
    /// ```text
    /// K = mA + mB + iA [ay^2 -ax ay; -ax ay ax^2] + iB [by^2 -bx by; -bx by bx^2]
    /// ```
    #[inline(always)]
    pub(super) fn point_mass(&self, stride: &Stride<L>) -> Symmetric<L> {
        let inertias = [self.a[Slot::INV_INERTIA], self.b[Slot::INV_INERTIA]];
        self.answer(stride, inertias, [self.anchor_a, self.anchor_b])
    }

    /// The same where, if `held` is above 0, the bodies do not turn against each other. The response is `K - k k^T / (iA + iB)` then, with
    /// k as in [`Self::twist`]: K with the arm from anchor to anchor, and both inertias together.
    #[inline(always)]
    pub(super) fn point_mass_where(&self, stride: &Stride<L>, held: L) -> Symmetric<L> {
        let (ia, ib, held) =
            (self.a[Slot::INV_INERTIA], self.b[Slot::INV_INERTIA], held.gt(stride.zero));
        let together = ia * ib * stride.invert(ia + ib);
        let inertias = [L::select(held, together, ia), L::select(held, stride.zero, ib)];
        let ([ax, ay], [x, y]) = (self.anchor_a, sub(self.anchor_a, self.anchor_b));
        let arm = [L::select(held, x, ax), L::select(held, y, ay)];
        self.answer(stride, inertias, [arm, self.anchor_b])
    }

    #[inline(always)]
    fn answer(&self, stride: &Stride<L>, [ia, ib]: [L; 2], arms: [[L; 2]; 2]) -> Symmetric<L> {
        let [mass_a, mass_b] = self.inv_masses();
        let ([mx, my], [[ax, ay], [bx, by]]) = (add(mass_a, mass_b), arms);
        Symmetric::invert(
            stride,
            mx + ia * ay * ay + ib * by * by,
            -(ia * ax * ay) - ib * bx * by,
            my + ia * ax * ax + ib * bx * bx,
        )
    }

    /// Response of the angular velocity to an impulse at the anchors.
    #[inline(always)]
    pub(super) fn twist(&self) -> [L; 2] {
        let (ia, ib) = (self.a[Slot::INV_INERTIA], self.b[Slot::INV_INERTIA]);
        [
            -(ia * self.anchor_a[1]) - ib * self.anchor_b[1],
            ia * self.anchor_a[0] + ib * self.anchor_b[0],
        ]
    }

    /// A joint's direction as it is now.
    #[inline(always)]
    pub(super) fn direction(&self, stride: &Stride<L>, lanes: &DirectionLanes) -> [L; 2] {
        rotate(self.turn_a, stride.load2(&lanes.x, &lanes.y))
    }

    /// The Jacobian of the gap along a direction, from a point on A to the anchor on B.
    #[inline(always)]
    pub(super) fn row(&self, from_a: [L; 2], direction: [L; 2]) -> Row<L> {
        let (arm_a, arm_b) = (cross(from_a, direction), cross(self.anchor_b, direction));
        let reach = [dot(from_a, direction), dot(self.anchor_b, direction)];
        Row { direction, arm_a, arm_b, reach }
    }

    /// The angle now.
    #[inline(always)]
    pub(super) fn angle(&self, stride: &Stride<L>, lanes: &AngleLanes) -> L {
        stride.load(&lanes.start) + self.turned()
    }
}

/// The Jacobian of one coordinate: linear part on B (the opposite on A), angular parts.
pub(super) struct Row<L> {
    pub(super) direction: [L; 2],
    pub(super) arm_a: L,
    pub(super) arm_b: L,
    /// Lever arms along the direction: how the force turns a body further when that has turned.
    pub(super) reach: [L; 2],
}

/// The Jacobian of a joint that moves each body along a direction of its own.
pub(super) struct Sides<L> {
    /// Linear parts on A and B.
    pub(super) directions: [[L; 2]; 2],
    /// Angular parts.
    pub(super) arms: [L; 2],
}

impl<L: Lanes> Sides<L> {
    #[inline(always)]
    pub(super) fn velocity(&self, pair: &Pair<L>) -> L {
        let (a, b) = (&pair.a, &pair.b);
        dot(self.directions[0], [a[Slot::VX], a[Slot::VY]])
            + dot(self.directions[1], [b[Slot::VX], b[Slot::VY]])
            + self.arms[0] * a[Slot::W]
            + self.arms[1] * b[Slot::W]
    }

    #[inline(always)]
    pub(super) fn inv_mass(&self, pair: &Pair<L>) -> L {
        let (a, b) = (&pair.a, &pair.b);
        let [on_a, on_b] = &self.directions;
        let [linear_a, linear_b] = match pair.locked {
            None => [a[Slot::INV_MASS] * dot(*on_a, *on_a), b[Slot::INV_MASS] * dot(*on_b, *on_b)],
            Some([a, b]) => [give_along(pair.token, *on_a, a), give_along(pair.token, *on_b, b)],
        };
        linear_a
            + linear_b
            + a[Slot::INV_INERTIA] * self.arms[0] * self.arms[0]
            + b[Slot::INV_INERTIA] * self.arms[1] * self.arms[1]
    }

    #[inline(always)]
    pub(super) fn apply(&self, pair: &mut Pair<L>, impulse: L) {
        let masses = pair.inv_masses();
        for (side, body) in [&mut pair.a, &mut pair.b].into_iter().enumerate() {
            let [x, y] = scale(masses[side], impulse);
            body[Slot::VX] = body[Slot::VX] + self.directions[side][0] * x;
            body[Slot::VY] = body[Slot::VY] + self.directions[side][1] * y;
            body[Slot::W] = body[Slot::W] + body[Slot::INV_INERTIA] * (self.arms[side] * impulse);
        }
    }
}

/// A determinant below this part of the diagonal's product is rounding.
const SINGULAR: f32 = 4.0e-7;
/// And so it is below this part of the square of their sum: a body that is locked along an axis would be turned about an arm as
/// short as that until it is somewhere along it.
const FLAT: f32 = 1.0e-9;

/// A symmetric 2 x 2 matrix.
pub(super) struct Symmetric<L> {
    xx: L,
    xy: L,
    yy: L,
}

impl<L: Lanes> Symmetric<L> {
    /// The inverse of a matrix. Of one that answers along one direction alone, as where a body is locked along an axis, the
    /// inverse along that; zero where it answers nothing.
    #[inline(always)]
    pub(super) fn invert(stride: &Stride<L>, xx: L, xy: L, yy: L) -> Self {
        let (product, square) = (xx * yy, (xx + yy) * (xx + yy));
        let det = product - xy * xy;
        let whole = det.gt((stride.splat(SINGULAR) * product).max(stride.splat(FLAT) * square));
        let inv = stride.invert(L::select(whole, det, square));
        let [x, cross, y] =
            [L::select(whole, yy, xx), L::select(whole, -xy, xy), L::select(whole, xx, yy)];
        Self { xx: x * inv, xy: cross * inv, yy: y * inv }
    }

    #[inline(always)]
    pub(super) fn apply(&self, v: [L; 2]) -> [L; 2] {
        [self.xx * v[0] + self.xy * v[1], self.xy * v[0] + self.yy * v[1]]
    }
}

/// Least part of an inverse mass that Schur's complement may leave: below is rounding.
pub(super) const LEAST_COMPLEMENT: f32 = 1.0e-4;
