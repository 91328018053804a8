use tiny_physics::*;
pub trait Host {
    fn add_body(&mut self, body: &RigidBody) -> usize;
    fn remove_body(&mut self, body: usize);
    fn add_joint(&mut self, a: usize, b: usize, joint: &JointDef) -> usize;
    fn remove_joint(&mut self, joint: usize);
    fn velocity(&self, body: usize) -> Vec2;
    fn set_velocity(&mut self, body: usize, velocity: Vec2);
    fn position(&self, body: usize) -> DVec2;
    fn is_awake(&self, body: usize) -> bool;
    fn wake(&mut self, body: usize);
    fn step(&mut self, dt: f32);
    fn ray_cast(&mut self, origin: Vec2, translation: Vec2, mask: u64) -> Option<f32>;
    fn circle_cast(&mut self, center: Vec2, radius: f32, translation: Vec2, mask: u64) -> Option<f32>;
    fn count_overlaps(&mut self, lower: Vec2, upper: Vec2, mask: u64) -> usize;
}
#[derive(Default)]
pub struct Scene {
    pub gravity: Vec2,
    pub settings: Settings,
    pub steps: u32,
    pub dt: f32,
    pub bodies: Vec<RigidBody>,
    pub joints: Vec<(usize, usize, JointDef)>,
}
fn rect(x: f32, y: f32) -> Shape {
    Polygon::rect(x, y).unwrap().into()
}
pub fn scene(name: &str) -> Option<Scene> {
    let settings = Settings { restitution_mix: Mix::Max, sleep: false, ..Default::default() };
    let mut s = Scene { gravity: Vec2::new(0.0, -10.0), settings, steps: 500, dt: 1.0 / 60.0, ..Default::default() };
    match name {
        "large_pyramid" => {
            s.bodies.push(RigidBody::fixed().position(Vec2::new(0.0, -1.0)).shape(rect(100.0, 1.0)));
            for i in 0..100 {
                for j in i..100 {
                    let p = Vec2::new(0.5 * (i + 1) as f32 + (j - i) as f32 - 50.0, i as f32 + 0.5);
                    s.bodies.push(RigidBody::dynamic().position(p).shape(rect(0.5, 0.5)));
                }
            }
        }
        "joint_grid" => {
            let filter = Filter { category: 2, mask: 0xFFFF_FFFD, group: 0 };
            for k in 0..100usize {
                for i in 0..100usize {
                    let fixed = i == 0 && (47..=53).contains(&k);
                    let b = if fixed { RigidBody::fixed() } else { RigidBody::dynamic() };
                    let n = s.bodies.len();
                    s.bodies.push(b.position(Vec2::new(k as f32, -(i as f32))).shape(ShapeDef::new(Shape::Circle { radius: 0.4 }).filter(filter)));
                    if i > 0 {
                        s.joints.push((n - 1, n, JointDef::revolute().anchors(Vec2::new(0.0, -0.5), Vec2::new(0.0, 0.5))));
                    }
                    if k > 0 {
                        s.joints.push((n - 100, n, JointDef::revolute().anchors(Vec2::new(0.5, 0.0), Vec2::new(-0.5, 0.0))));
                    }
                }
            }
        }
        "tumbler" => {
            s.steps = 750;
            s.settings.sleep = true;
            let w = |x, y, px, py| ShapeDef::new(rect(x, y)).offset(Vec2::new(px, py)).density(50.0);
            s.bodies.push(RigidBody::fixed());
            s.bodies.push(RigidBody::dynamic().position(Vec2::new(0.0, 10.0)).shape(w(0.5, 10.0, 10.0, 0.0)).shape(w(0.5, 10.0, -10.0, 0.0)).shape(w(10.0, 0.5, 0.0, 10.0)).shape(w(10.0, 0.5, 0.0, -10.0)));
            s.joints.push((0, 1, JointDef::revolute().anchors(Vec2::new(0.0, 10.0), Vec2::ZERO).motor(0.436332, 1e8)));
            for i in 0..45 {
                for j in 0..45 {
                    s.bodies.push(RigidBody::dynamic().position(Vec2::new(-9.0 + 0.4 * j as f32, 1.0 + 0.4 * i as f32)).shape(rect(0.125, 0.125)));
                }
            }
        }
        "smash" => {
            s.steps = 300;
            s.settings.sleep = true;
            s.gravity = Vec2::ZERO;
            s.bodies.push(RigidBody::dynamic().position(Vec2::new(-20.0, 0.0)).velocity(Vec2::new(40.0, 0.0)).shape(ShapeDef::new(rect(4.0, 4.0)).density(8.0)));
            for i in 0..120 {
                for j in 0..80 {
                    s.bodies.push(RigidBody::dynamic().position(Vec2::new(0.4 * i as f32 + 30.0, 0.4 * (j - 40) as f32)).shape(rect(0.2, 0.2)).asleep());
                }
            }
        }
        _ => return None,
    }
    Some(s)
}
pub fn scene_names() -> Vec<String> {
    ["large_pyramid", "joint_grid", "tumbler", "smash"].map(str::to_owned).to_vec()
}
