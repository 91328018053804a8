/**
 * tiny-physics: a small, fast 2D rigid-body physics engine.
 *
 * Metres, kilograms, seconds, radians anticlockwise; y points up. Descriptions are the JSON of
 * scene files, so what you write here can be written to a file and the other way round. What is wrong in
 * one throws a {@link PhysicsError} that names the field and the value.
 */

/** What the engine refused, in its words. The world has not changed then. */
export declare class PhysicsError extends Error {}

/**
 * Loads the WebAssembly module; call it once before anything else. Without a source it takes the file beside this module
 * (read in Node, fetched elsewhere).
 */
export declare function init(
  source?: string | URL | Response | BufferSource | WebAssembly.Module | Promise<Response | BufferSource>,
): Promise<void>;
/** The same at once, where the bytes are at hand already. */
export declare function initSync(source: BufferSource | WebAssembly.Module): void;

/** Horizontal and vertical part; y points up. */
export type Vec = readonly [x: number, y: number];
export interface Point {
  x: number;
  y: number;
}

/** Handle of a body. It goes stale when the body is removed and never means another body. */
export type BodyId = number;
/** Handle of a shape. */
export type ShapeId = number;
/** Handle of a joint. */
export type JointId = number;
/** Handle of a tile map. */
export type TileGridId = number;

export type BodyKind = "static" | "kinematic" | "dynamic";

/** The geometry of a shape, in its own frame, metres. */
export type Shape =
  | { circle: { radius: number } }
  /** A box that turns; read back as a polygon. */
  | { rect: { half_extents: Vec; center?: Vec; angle?: number; radius?: number } }
  /** A polygon of `count` (3 to 8) equal sides, `size` from its middle to a corner; read back as a polygon. */
  | { regular: { count: number; size: number; radius?: number } }
  /** A box that never turns: its body cannot rotate. */
  | { aabb: { half_extents: Vec } }
  | { capsule: { a: Vec; b: Vec; radius: number } }
  /** No thickness and no mass, for static bodies. */
  | { segment: { a: Vec; b: Vec } }
  /** 3 to 8 vertices, convex, anticlockwise, else their hull; `radius` rounds the corners outwards. */
  | { polygon: { vertices: readonly Vec[]; radius?: number } };

export interface Material {
  /** Kilograms a square metre; 1 where not said. */
  density?: number;
  /** Coulomb friction; 0.6 where not said. */
  friction?: number;
  /** Bounce, 0 to 1. */
  restitution?: number;
  /** Resistance of round shapes against rolling, as a fraction of their radius. */
  rolling_resistance?: number;
  /** A conveyor belt: speed of the surface along itself, metres a second. */
  tangent_speed?: number;
  /** How its friction mixes with that of others, instead of {@link Settings.friction_mix}. */
  friction_mix?: Mix | null;
  /** How its restitution mixes with that of others, instead of {@link Settings.restitution_mix}; a trampoline takes `"max"`. */
  restitution_mix?: Mix | null;
}

/** Two shapes collide where each one's mask has the other's category; the same positive group always, a negative never. */
export interface Filter {
  category?: number | bigint;
  mask?: number | bigint;
  group?: number;
}

/** One shape of a body. */
export interface ShapeDef {
  shape: Shape;
  /** Origin of the shape's frame in the body's frame, metres. */
  offset?: Vec;
  /** Angle of the shape's frame, radians. */
  angle?: number;
  material?: Material;
  filter?: Filter;
  /** Sees what overlaps it and collides with nothing. */
  sensor?: boolean;
  /** Does this sensor see other sensors too? */
  sees_sensors?: boolean;
  /** One-way platform: the direction out of its solid side, in the body's frame. */
  one_way?: Vec | null;
  /** A segment of a chain: start of the segment before it and end of the one after it. {@link World.addChain} sets it. */
  link?: { previous?: Vec | null; next?: Vec | null } | null;
  /** Are contact begin and end events sent? */
  contact_events?: boolean;
  /** Are hit events (fast approach) sent? */
  hit_events?: boolean;
  /** Free for you. */
  user_data?: number;
}

/** A body to be added. */
export interface BodyDef {
  /** `"dynamic"` where not said. */
  kind?: BodyKind;
  /** Origin of the body's frame in the world, metres. */
  position?: Vec;
  angle?: number;
  velocity?: Vec;
  angular_velocity?: number;
  linear_damping?: number;
  angular_damping?: number;
  gravity_scale?: number;
  locks?: { x?: boolean; y?: boolean; rotation?: boolean };
  /** Kilograms; from the densities of the shapes where not said. */
  mass?: number | null;
  /** Centre of mass in the body's frame, metres; from the shapes where not said. */
  center?: Vec | null;
  /** Moment of inertia about the centre of mass, kilogram square metres; from the shapes and the mass where not said. */
  inertia?: number | null;
  can_sleep?: boolean;
  awake?: boolean;
  sleep_speed?: number;
  /** Kept and given back; it changes nothing: whatever is fast is looked out for. */
  bullet?: boolean;
  enabled?: boolean;
  user_data?: number;
  shapes?: readonly ShapeDef[];
}

export interface Spring {
  hertz: number;
  damping_ratio: number;
}
export interface Limits {
  lower: number;
  upper: number;
}
export interface Motor {
  /** Metres or radians a second. */
  speed: number;
  /** Newtons or newton metres. */
  max: number;
}

export type JointKind =
  | { distance: { length: number; spring?: Spring | null; limits?: Limits | null; motor?: Motor | null } }
  | { revolute: { spring?: Spring | null; target_angle?: number; limits?: Limits | null; motor?: Motor | null } }
  | { prismatic: { spring?: Spring | null; target?: number; limits?: Limits | null; motor?: Motor | null } }
  | { weld: { linear?: Spring | null; angular?: Spring | null } }
  | { wheel: { spring?: Spring | null; limits?: Limits | null; motor?: Motor | null } }
  | {
      motor: {
        velocity?: Vec;
        max_force?: number;
        angular_velocity?: number;
        max_torque?: number;
        linear_spring?: Spring | null;
        max_spring_force?: number;
        angular_spring?: Spring | null;
        max_spring_torque?: number;
      };
    }
  | { mouse: { target: Vec; spring: Spring; max_force: number } }
  | { pulley: { ground_a: Vec; ground_b: Vec; length: number; ratio: number } }
  | { gear: { ratio: number; slide_a?: Vec | null; slide_b?: Vec | null } }
  | "filter";

export interface JointDef {
  kind: JointKind;
  /** Anchor in the frame of body A, metres. */
  anchor_a?: Vec;
  anchor_b?: Vec;
  /** Anchors on A and B in the world, metres, instead of those in the bodies' frames; read back as those. */
  anchors_at?: readonly [Vec, Vec] | null;
  /** Direction of the joint's frame in that of body A, radians: the line of `prismatic` and `wheel`. `angle_b` is it in B's. */
  angle_a?: number;
  angle_b?: number;
  /** Do the two bodies collide? */
  collide_connected?: boolean;
  softness?: Spring | null;
  /** Breaks beyond this, newtons and newton metres. */
  break_at?: { force: number; torque: number } | null;
  /** One that is not enabled is kept and does nothing; true where not said. */
  enabled?: boolean;
  user_data?: number;
}

export type Mix = "geometric_mean" | "average" | "min" | "max" | "multiply";

/** Settings of a world; the defaults are good. Set `length_unit` to 100 where a crate is 100 units (pixels) wide. */
export interface Settings {
  substeps: number;
  iterations: number;
  refine_up_to: number;
  length_unit: number;
  contact_hertz: number;
  contact_damping_ratio: number;
  push_speed: number;
  restitution_threshold: number;
  hit_event_threshold: number;
  max_speed: number;
  sleep: boolean;
  time_to_sleep: number;
  continuous: boolean;
  friction_mix: Mix;
  restitution_mix: Mix;
}

/** A scene as in a file: see docs/scene-files.md of the project. */
export interface Scene {
  $schema?: string;
  version: 1;
  name?: string;
  description?: string;
  gravity?: Vec;
  settings?: Partial<Settings>;
  steps?: number;
  dt?: number;
  /** What a picture shows: lower left and upper right, metres. */
  view?: readonly [Vec, Vec];
  bodies?: readonly BodyDef[];
  joints?: readonly (JointDef & { a: number; b: number })[];
  script?: unknown;
}

/** What a query sees; everything but sensors where not said. */
export interface QueryFilter extends Filter {
  sensors?: boolean;
  excludeBody?: BodyId;
}

/** Where something is in the world: its origin, metres, and cosine and sine of its angle. */
export interface Pose {
  p: Vec;
  q: { c: number; s: number };
}

/** Everything below a surface, or what of that lies in an area. */
export interface Water {
  /** A point of the surface: world, metres. */
  surface: Vec;
  /** Direction out of the water; up where not said. */
  normal?: Vec;
  /** Kilograms a square metre, 1000 where not said: what is lighter floats. */
  density?: number;
  /** Velocity of the water, metres a second. */
  flow?: Vec;
  /** How fast a body takes on the flow, and stops turning, 1/s. */
  linear_drag?: number;
  angular_drag?: number;
  /** Only shapes that overlap this box (world, metres) are in the water. */
  area?: { min: Vec; max: Vec } | null;
}

/** What a zone does to the bodies in it. */
export type ZoneForce =
  /** Metres a second squared: gravity of its own. */
  | { acceleration: Vec }
  /** Towards a point of the world, away from it where negative, metres a second squared. */
  | { attraction: { center: Vec; acceleration: number } }
  /** Metres a second; kilograms a square metre (1.2 where not said); about 1 for blunt shapes. */
  | { wind: { velocity?: Vec; density?: number; drag?: number } }
  /** Slows motion and turning, 1/s. */
  | { damping: { linear: number; angular: number } };

/** An area in which a force acts on every body that overlaps it. */
export interface Zone {
  shape: Shape;
  pose: Pose;
  force: ZoneForce;
  /** Does it wake sleeping bodies? Otherwise it leaves them alone. */
  wakes: boolean;
}

/** What a character stands on. */
export interface CharacterGround {
  body: BodyId;
  shape: ShapeId;
  /** Unit, world. */
  normal: Vec;
  /** The place under the foot: world, metres. */
  point: Vec;
}

/** What stopped a character on its way. */
export interface CharacterHit {
  body: BodyId;
  shape: ShapeId;
  /** World, metres. */
  point: Vec;
  /** Unit, out of what was hit. */
  normal: Vec;
}

/**
 * A capsule that walks, climbs slopes and steps, jumps, rides on platforms and pushes things; {@link character} makes one. It
 * is a value beside the world and no body: keep what {@link World.moveCharacter} gives, which has more in it than is said
 * here.
 */
export interface Character {
  /** The middle of the capsule: world, metres. Set it to teleport. */
  position: Vec;
  /** Metres a second. */
  velocity: Vec;
  /** Of the whole capsule, metres. */
  height: number;
  radius: number;
  /** Steepest slope that it walks on, radians from level; 0.9 at first. */
  max_slope: number;
  /** Highest step that it climbs, metres; 0.35 at first. */
  step_height: number;
  /** Greatest drop over which it stays on the ground at a standstill, metres; 0.1 at first. */
  snap_distance: number;
  /** Greatest force with which it pushes dynamic bodies, newtons; 500 at first. */
  push_force: number;
  /** Mass with which it weighs on what it stands on, kilograms; 70 at first. */
  mass: number;
  gravity_scale: number;
  /** Gap that it keeps to everything, metres; 0.01 at first. */
  skin: number;
  /** What it collides with. */
  filter: Filter;
  /** A body of its own, which it takes along and does not collide with: for what is to notice it. */
  body?: BodyId | null;
  /** What it stands on; `null` in the air. */
  ground?: CharacterGround | null;
  /** What stopped it in the last update. */
  hits?: readonly CharacterHit[];
}

/** A character with its middle at a place; all metres. */
export declare function character(x: number, y: number, height: number, radius: number): Character;

export interface CastHit {
  shape: ShapeId;
  body: BodyId;
  /** World, metres. */
  point: Point;
  /** Unit, out of what was hit. */
  normal: Point;
  /** Part of the way until the hit, 0 to 1. */
  fraction: number;
}

/** Rows of all bodies, in the order of `ids`: views of the module's memory, valid until the next call of anything. */
export interface Bodies {
  count: number;
  ids: Float64Array;
  /** x, y, angle of each. */
  poses: Float32Array;
  /** x, y, angular velocity of each. */
  velocities: Float32Array;
  /** Bits 0 and 1: 0 static, 1 kinematic, 2 dynamic; 4 awake, 8 enabled, 16 bullet. */
  states: Uint8Array;
}

/** Two shapes that began or ceased to touch, as they were then: one of them may have been removed since. */
export interface Touch {
  shapeA: ShapeId;
  shapeB: ShapeId;
  bodyA: BodyId;
  bodyB: BodyId;
  shapeDataA: number;
  bodyDataA: number;
  shapeDataB: number;
  bodyDataB: number;
}

/** A touch faster than `hit_event_threshold`: where (world, metres), along what, from A to B, and how hard. */
export interface Hit extends Touch {
  x: number;
  y: number;
  normalX: number;
  normalY: number;
  /** Of the approach, metres a second. */
  speed: number;
  /** Newton seconds, by which loudness and damage go. */
  impulse: number;
  /** Kilograms, 0 of what is not dynamic. */
  massA: number;
  massB: number;
}

/** A sensor, and a shape that came into it or left it. */
export interface Sight {
  sensor: ShapeId;
  visitor: ShapeId;
  sensorBody: BodyId;
  visitorBody: BodyId;
  sensorData: number;
  sensorBodyData: number;
  visitorData: number;
  visitorBodyData: number;
}

/** A joint that bore more than it can, and is gone. */
export interface JointBreak {
  joint: JointId;
  /** Newtons on body B, and newton metres. */
  forceX: number;
  forceY: number;
  torque: number;
  userData: number;
  bodyA: BodyId;
  bodyB: BodyId;
}

/** What each kind of event tells. */
export interface EventOf {
  contactBegin: Touch;
  contactEnd: Touch;
  hits: Hit;
  sensorBegin: Sight;
  sensorEnd: Sight;
  jointBreaks: JointBreak;
  woke: { body: BodyId };
  fellAsleep: { body: BodyId };
}

export type EventKind = keyof EventOf;

export interface Counts {
  bodies: number;
  awake: number;
  shapes: number;
  joints: number;
  contacts: number;
  steps: number;
  /** Metres. */
  deepest: number;
  /** Joules. */
  kinetic: number;
  potential: number;
  momentum: Point;
}

export interface WorldDef {
  /** Metres a second squared; [0, -9.8] where not said. */
  gravity?: Vec;
  settings?: Partial<Settings>;
}

declare global {
  /** As in TypeScript's own library of later years. */
  interface SymbolConstructor {
    readonly dispose: unique symbol;
  }
}

/** A world of bodies. */
export declare class World {
  constructor(def?: WorldDef);
  /** A scene file, as text or object, at its beginning; its script goes on with every step. */
  static loadScene(scene: string | Scene): World;
  /**
   * The world of {@link World.save}: it goes on bit for bit as the original does, and handles are valid in it. The length of a step
   * is not in a frame: pass the {@link World.dt} of the original where it is not 1/60 s.
   */
  static fromBytes(frame: Uint8Array, dt?: number): World;
  /** A recording at its beginning; {@link World.goTo} plays it. `budget` is for its history, bytes. */
  static openRecording(recording: Uint8Array, budget?: number): World;

  /** Handles of the bodies of the scene that it was loaded from, by their index there. */
  readonly sceneBodies: readonly BodyId[];
  /** Its number in the module. */
  readonly session: number;
  /** Length of a step of its scene, or as {@link World.fromBytes} was told; seconds. */
  readonly dt: number;

  /** Moves on by `dt` seconds; by the scene's own step (1/60 s) where it is not said. */
  step(dt?: number): void;
  /** A copy that goes on by itself. */
  clone(): World;
  /** Gives the memory back; the garbage collector does it late, or never. */
  free(): void;
  /** The same: `using world = new World()` frees it at the end of the block. */
  [Symbol.dispose](): void;

  readonly gravity: Point;
  setGravity(x: number, y: number): void;
  readonly settings: Settings;
  setSettings(settings: Partial<Settings>): void;

  addBody(body: BodyDef): BodyId;
  removeBody(body: BodyId): void;
  /** A body to read and to act on; `undefined` where it has been removed. */
  body(id: BodyId): Body | undefined;
  addShape(body: BodyId, shape: ShapeDef): ShapeId;
  /** Ground of segments without bumps: `points`, and `closed` for a loop. */
  addChain(body: BodyId, chain: { points: readonly Vec[]; closed?: boolean } & Record<string, unknown>): ShapeId[];
  /** The convex pieces of an outline that may be concave, each a copy of `like` with another geometry. */
  addOutline(body: BodyId, outline: readonly Vec[], like?: ShapeDef): ShapeId[];
  shape(id: ShapeId): (ShapeDef & { id: ShapeId; body: BodyId }) | undefined;
  shapeIds(): ShapeId[];
  /**
   * For example `{ set_material: { friction: 0 } }`, `{ set_shape: { circle: { radius: 2 } } }`, `{ set_sensor: true }`. What is
   * not said of a material or filter stays as it is.
   */
  changeShape(id: ShapeId, change: Record<string, unknown>): void;
  removeShape(id: ShapeId): void;
  addJoint(a: BodyId, b: BodyId, joint: JointDef): JointId;
  joint(id: JointId):
    | {
        id: JointId;
        bodyA: BodyId;
        bodyB: BodyId;
        /** World, metres. */
        anchorA: Point;
        anchorB: Point;
        /** On body B in the last step, newtons. */
        force: Point;
        torque: number;
        def: JointDef;
      }
    | undefined;
  jointIds(): JointId[];
  setJoint(id: JointId, joint: JointDef): void;
  removeJoint(id: JointId): void;
  addTiles(grid: Record<string, unknown>): TileGridId;
  setTile(grid: TileGridId, x: number, y: number, value: number): void;
  removeTiles(grid: TileGridId): void;
  /** Impulses away from a point, on what the filter shows. */
  explode(explosion: { center: Vec; radius: number; falloff: number; impulse_per_metre: number }, filter?: QueryFilter): void;
  /** Call it before every step in which the water is there. */
  applyWater(water: Water, dt?: number, filter?: QueryFilter): void;
  /** Call it before every step in which the force acts. */
  applyZone(zone: Zone, dt?: number, filter?: QueryFilter): void;
  /**
   * Moves a character on; call it after a step and keep what it gives. `walk` and `jump` are metres a second; `drop` lets it
   * fall through the one-way platforms that it stands on.
   */
  moveCharacter(character: Character, input: { walk?: number; jump?: number; drop?: boolean }, dt?: number): Character;
  /** Any command of a recording, as JSON; the handles of what it made. */
  apply(command: Record<string, unknown>): number[];

  /** All bodies, between the start (`alpha` 0) and the end (1) of the last step. */
  bodies(alpha?: number): Bodies;
  /** Events of the last step. */
  eventList<K extends EventKind>(kind: K): EventOf[K][];
  /**
   * The same as rows of numbers, which cost no objects, each in the order of the fields of {@link EventOf}: a view of the module's
   * memory, valid until the next call of anything.
   */
  events(kind: EventKind): Float64Array;
  /** Contact points: [shape, shape, body, body, normal x, normal y, x, y, separation, normal impulse, tangent impulse]. */
  contacts(): Float64Array;
  counts(): Counts;
  sensorOverlaps(sensor: ShapeId): ShapeId[];

  /** The first shape on the way from a point along (dx, dy). */
  rayCast(x: number, y: number, dx: number, dy: number, filter?: QueryFilter): CastHit | undefined;
  rayCastAll(x: number, y: number, dx: number, dy: number, filter?: QueryFilter): CastHit[];
  castShape(
    shape: Shape,
    x: number,
    y: number,
    angle: number,
    dx: number,
    dy: number,
    filter?: QueryFilter,
  ): CastHit | undefined;
  overlapPoint(x: number, y: number, filter?: QueryFilter): ShapeId[];
  overlapShape(shape: Shape, x: number, y: number, angle?: number, filter?: QueryFilter): ShapeId[];
  overlapAabb(left: number, bottom: number, right: number, top: number, filter?: QueryFilter): ShapeId[];
  closestPoint(
    x: number,
    y: number,
    maxDistance: number,
    filter?: QueryFilter,
  ): { shape: ShapeId; body: BodyId; point: Point; distance: number } | undefined;

  /** Takes the dynamic body at a point: every step pulls it to where {@link World.drag} says. */
  grab(x: number, y: number): BodyId | undefined;
  /** Where the held body is to go; gives where it is held. */
  drag(x: number, y: number): Point | undefined;
  release(): void;

  /** Hash of the whole state, 16 hexadecimal digits: the same on every platform. */
  hash(): string;
  /** The whole world as bytes; without the script of the scene that it was loaded from. */
  save(): Uint8Array;
  /**
   * Goes back to a frame of {@link World.save} in place. A script is not in a frame: it goes on from where it is.
   * {@link World.clone} and {@link World.goTo} take it along.
   */
  restore(frame: Uint8Array): void;
  /** What differs from an earlier frame: 80 to 250 bytes a moving body. */
  deltaFrom(frame: Uint8Array): Uint8Array;
  restoreDelta(frame: Uint8Array, delta: Uint8Array): void;
  /** From now on everything that is done is recorded. */
  startRecording(): void;
  /** The recording so far, as the program `tiny-physics` writes and replays it. */
  recording(): Uint8Array;

  /** From now on the run can be gone back in; about `budget` bytes are kept (64 MiB where not said). */
  keepHistory(budget?: number): void;
  /** Steps to here, steps that are kept, bytes. */
  readonly history: { at: number; length: number; bytes: number };
  /** Goes to a step of the history, bit for bit. */
  goTo(step: number): void;
  /** Forgets what came after the current step. Doing anything to the world, or stepping it, does that too. */
  forgetLater(): void;
  /** Throws where the world's data are not sound: for tests. */
  validate(): void;
}

/**
 * A body of a world. Reading a body that has been removed throws. So does a method that is given fewer numbers than it takes,
 * something else, or a number that is not finite or too large.
 */
export declare class Body {
  readonly world: World;
  readonly id: BodyId;
  /** World, metres, 64 bits. */
  readonly position: Point;
  readonly angle: number;
  readonly velocity: Point;
  readonly angularVelocity: number;
  readonly mass: number;
  readonly inertia: number;
  /** Centre of mass: world, metres. */
  readonly center: Point;
  readonly kind: BodyKind;
  readonly isAwake: boolean;
  readonly isEnabled: boolean;
  readonly isBullet: boolean;
  readonly gravityScale: number;
  readonly damping: { linear: number; angular: number };
  readonly locks: { x: boolean; y: boolean; rotation: boolean };
  readonly sleepSpeed: number;
  readonly canSleep: boolean;
  readonly userData: number;
  readonly shapes: ShapeId[];
  readonly joints: JointId[];
  remove(): void;

  setPosition(x: number, y: number): this;
  setAngle(radians: number): this;
  setPose(x: number, y: number, radians: number): this;
  setVelocity(x: number, y: number): this;
  setAngularVelocity(radiansPerSecond: number): this;
  /** Gives it the velocity that takes it there within `dt` seconds: for moving platforms, before every step. */
  setTarget(x: number, y: number, radians: number, dt: number): this;
  applyForce(fx: number, fy: number, x: number, y: number): this;
  applyForceToCenter(fx: number, fy: number): this;
  applyTorque(torque: number): this;
  applyImpulse(ix: number, iy: number, x: number, y: number): this;
  applyImpulseToCenter(ix: number, iy: number): this;
  applyAngularImpulse(impulse: number): this;
  wake(): this;
  sleep(): this;
  setKind(kind: BodyKind): this;
  setEnabled(enabled: boolean): this;
  setLocks(locks: { x?: boolean; y?: boolean; rotation?: boolean }): this;
  /** Kilograms, above 0; `undefined` takes it from the densities of the shapes. */
  setMass(mass?: number): this;
  setGravityScale(scale: number): this;
  setDamping(linear: number, angular: number): this;
  setCanSleep(canSleep: boolean): this;
  setSleepSpeed(metresPerSecond: number): this;
  setBullet(bullet: boolean): this;
  /** A whole number from 0 to 2^53 - 1. */
  setUserData(data: number): this;
}

/** Turns the uneven times between pictures into even steps. */
export declare class FixedStep {
  /** Steps of 1/60 s and at most 8 in a picture, where nothing else is said; time beyond is dropped. */
  constructor(dt?: number, maxSteps?: number);
  dt: number;
  maxSteps: number;
  /** How many steps are due after so many seconds. */
  advance(elapsed: number): number;
  /** How far the picture is between the last two steps, 0 to 1: for {@link World.bodies}. */
  readonly alpha: number;
}

/** Plays a recording and compares every step; gives how many there are, throws where one differs. */
export declare function checkRecording(recording: Uint8Array): number;

/** The module's own functions, for code that goes without these classes. */
export declare function exports(): Record<string, (...args: never[]) => unknown>;
