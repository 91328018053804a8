//! The level for the character: the scripted run ends at the same place at every rate, and nothing jitters.

use tiny_physics::{BodyId, CharacterMover, DVec2, QueryFilter, Vec2, World};
use tiny_physics_scenes::{Character, Host, Options, Run, Scene, Script, WorldHost, find};

/// Half the character's height and its skin.
const FLOOR: f64 = 0.91;

/// The scene without its script, and the script.
fn level() -> (Scene, Character) {
    let mut scene = find("character").unwrap().build(Options::default());
    let Some(Script::Character(script)) = scene.script.take() else { panic!("no script") };
    (scene, script)
}

/// A run by hand, so that the character can be looked at after every step.
struct Walk {
    run: Run,
    script: Character,
    hero: CharacterMover,
    bodies: Vec<usize>,
    dt: f32,
    step: u32,
}

impl Walk {
    fn new(hertz: u32) -> Self {
        let (scene, script) = level();
        let run = Run::start(&scene).unwrap();
        let (hero, bodies) = (script.mover(), run.bodies().to_vec());
        Self { run, script, hero, bodies, dt: 1.0 / hertz as f32, step: 0 }
    }

    fn time(&self) -> f64 {
        f64::from(self.step) * f64::from(self.dt)
    }

    fn step(&mut self) {
        let (time, dt) = (self.time(), self.dt);
        self.script.move_platforms(self.run.host_mut(), &self.bodies, time, dt);
        self.run.world_mut().step(dt);
        self.hero.update(self.run.world_mut(), self.script.input(time, dt), dt);
        self.step += 1;
    }

    fn world(&self) -> &World {
        self.run.world()
    }

    /// Position of the platform of a ride.
    fn platform(&self, ride: usize) -> DVec2 {
        self.run.host().position(self.bodies[self.script.rides[ride].body])
    }

    /// The only dynamic body.
    fn crate_(&self) -> BodyId {
        let host: &WorldHost = self.run.host();
        host.body_id(self.bodies[self.script.body - 1]).unwrap()
    }

    /// From the middle of the foot's arc to the nearest surface, less what it should be.
    fn gap(&self) -> f32 {
        let hero = &self.hero;
        let foot = hero.position - Vec2::new(0.0, 0.5 * hero.height - hero.radius);
        let filter = QueryFilter::from(hero.filter);
        let nearest = self.world().closest_point(foot, 1.0, &filter).unwrap();
        nearest.point.relative_to(foot).length() - hero.radius - hero.skin
    }
}

/// Places of the character and the crate at whole seconds.
fn places(hertz: u32) -> Vec<[DVec2; 2]> {
    let mut walk = Walk::new(hertz);
    let mut places = Vec::new();
    while walk.time() < 37.5 {
        walk.step();
        if walk.step.is_multiple_of(hertz) {
            let crate_ = walk.world().body(walk.crate_()).unwrap().position_f64();
            places.push([walk.hero.position, crate_]);
        }
    }
    walk.world().validate().unwrap();
    places
}

#[test]
fn the_run_ends_at_the_same_place_at_every_rate() {
    let runs = [30, 60, 120].map(places);
    let at = |seconds: usize| runs[1][seconds - 1][0];
    assert!((at(7).x - 28.0).abs() < 0.01, "over hills and stairs: {:?}", at(7));
    assert!((at(8).y - 5.0 - FLOOR).abs() < 0.01, "on the one-way platform: {:?}", at(8));
    assert!((at(13).y - 4.2 - FLOOR).abs() < 0.02, "up on the lift: {:?}", at(13));
    assert!((at(23).x - 46.0).abs() < 0.02, "over the pit: {:?}", at(23));
    let crate_ = runs[1].last().unwrap()[1];
    assert!((59.2..60.2).contains(&crate_.x), "the crate was pushed: {crate_:?}");
    for other in [&runs[0], &runs[2]] {
        for (second, (a, b)) in runs[1].iter().zip(other).enumerate() {
            let [hero, crate_] = [0, 1].map(|k| a[k].relative_to(b[k]).length());
            let second = second + 1;
            assert!(hero < 0.01, "after {second} s the runs are {hero} m apart: {a:?} {b:?}");
            // It is pushed one step longer than asked for, then it slides freely.
            let most = if second <= 34 { 0.01 } else { 2.0 / 30.0 };
            assert!(crate_ < most, "after {second} s the crates are {crate_} m apart: {a:?} {b:?}");
        }
    }
}

#[test]
fn nothing_jitters_on_slopes_stairs_and_platforms() {
    for hertz in [30, 60, 120] {
        let mut walk = Walk::new(hertz);
        let mut before = (walk.hero.position, [0, 1, 2].map(|ride| walk.platform(ride)));
        while walk.time() < 30.5 {
            walk.step();
            let now = (walk.hero.position, [0, 1, 2].map(|ride| walk.platform(ride)));
            let time = walk.time();
            let within = |from: f64, to: f64| time > from + 0.05 && time < to - 1e-6;
            let place = format!("{hertz} Hz, {time:.3} s, {:?}", walk.hero.position);
            let moved = now.0.relative_to(before.0);
            if within(0.5, 5.9) {
                // Hills and stairs: always on the ground, and even to the right.
                assert!(walk.hero.ground().is_some(), "{place}");
                assert!((moved.x - 4.0 * walk.dt).abs() < 1e-4, "{place}: {moved:?}");
            }
            let grounded = walk.hero.ground().is_some();
            assert!(!grounded || walk.gap().abs() < 2e-3, "{place}: gap {}", walk.gap());
            for (ride, from, to) in [(0, 10.5, 16.5), (1, 17.5, 19.0), (1, 21.0, 23.5)] {
                if within(from, to) {
                    let carried = now.1[ride].relative_to(before.1[ride]);
                    let slip = moved - carried;
                    assert!(slip.length() < 1e-4, "{place}: slips by {slip:?}");
                }
            }
            if within(8.0, 8.5) || within(24.6, 25.0) {
                assert!(moved.length() < 1e-5, "{place}: stands still, but {moved:?}");
            }
            if within(25.0, 30.0) {
                // A round foot rolls on a plate that turns.
                let most = 0.2 * walk.dt * 0.6;
                assert!(grounded && moved.length() < most, "{place}: {moved:?}");
            }
            before = now;
        }
    }
}

#[test]
fn the_scene_shows_the_character_where_it_is() {
    let scene = find("character").unwrap().build(Options::default());
    let mut run = Run::start(&scene).unwrap();
    let mut walk = Walk::new(60);
    for _ in 0..600 {
        let last = walk.hero.position;
        run.step();
        walk.step();
        let shown = run.host().position(run.bodies()[walk.script.body]);
        let apart = shown.relative_to(last).length();
        assert!(walk.step < 2 || apart < 1e-3, "step {}: {apart} m apart", walk.step);
    }
}

/// A character comes down a shaft that is 2 % wider than it, wherever over it it starts, and through a platform that it
/// was told to drop from for one update.
#[test]
fn characters_pass_where_they_fit() {
    use tiny_physics::{CharacterMover, MoverInput, RigidBody, Shape, ShapeDef, Vec2, World};
    const DT: f32 = 1.0 / 60.0;
    for (radius, off) in [(0.4, 0.0), (0.4, 0.004), (0.3, 0.0), (0.3, -0.003), (1.0, 0.01)] {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        for side in [-1.0, 1.0] {
            let wall = Shape::rect(2.0, 20.0).unwrap();
            let place = Vec2::new(side * (1.02 * radius + 2.0), -20.0);
            world.add_body(RigidBody::fixed().position(place).shape(wall)).unwrap();
        }
        let mut hero = CharacterMover::new(Vec2::new(off, 3.0), 2.5 * radius, radius);
        for _ in 0..120 {
            world.step(DT);
            hero.update(&mut world, MoverInput::default(), DT);
        }
        assert!(hero.position.y < -5.0, "radius {radius}, off {off}: {:?}", hero.position);
    }
    for thickness in [0.02, 0.1, 0.5] {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let floor = Shape::rect(20.0, 1.0).unwrap();
        world.add_body(RigidBody::fixed().position(Vec2::new(0.0, -1.0)).shape(floor)).unwrap();
        let plank = ShapeDef::new(Shape::rect(3.0, thickness).unwrap()).one_way(Vec2::Y);
        world.add_body(RigidBody::fixed().position(Vec2::new(0.0, 4.0)).shape(plank)).unwrap();
        let mut hero = CharacterMover::new(Vec2::new(0.0, 5.5), 1.8, 0.3);
        for step in 0..200 {
            world.step(DT);
            let drop = step == 80;
            hero.update(&mut world, MoverInput { drop, ..MoverInput::default() }, DT);
            let stands = hero.position.y > 4.0;
            assert!(stands || step > 80, "fell through by itself: {:?}", hero.position);
        }
        assert!(hero.position.y < 1.0, "thickness {thickness}: {:?}", hero.position);
    }
}
