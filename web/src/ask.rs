//! Questions to a world: what is where.

use crate::handles::Handle;
use crate::outcome::Outcome;
use crate::read::point;
use crate::shelf::Shelf;
use crate::with;
use serde::Deserialize;
use tiny_physics::record::FilterData;
use tiny_physics::{Aabb, BodyId, DVec2, Pose, QueryFilter, Rot, Shape, ShapeId, Vec2};

/// What a query sees, and the shape that it is about where it is about one.
#[derive(Deserialize, Default)]
#[serde(default, deny_unknown_fields)]
struct Question {
    filter: FilterData,
    shape: Option<Shape>,
    angle: f32,
}

/// The question in the input; the default where there is none.
fn question(shelf: &Shelf) -> Outcome<Question> {
    if shelf.input.is_empty() { Ok(Question::default()) } else { shelf.read() }
}

fn sees(filter: FilterData) -> QueryFilter<'static> {
    let FilterData { filter, exclude_body, sensors } = filter;
    QueryFilter { filter, exclude_body, sensors, ..QueryFilter::new() }
}

fn hit(shape: ShapeId, body: BodyId, at: DVec2, normal: Vec2, fraction: f32) -> [f64; 7] {
    let [x, y] = point(at);
    let [nx, ny, fraction] = [normal.x, normal.y, fraction].map(f64::from);
    [shape.number(), body.number(), x, y, nx, ny, fraction]
}

/// Casts a ray, or the shape in the input: all hits of a ray by nearness where `all`, else the first. A row is: shape,
/// body, point, normal, fraction.
#[unsafe(no_mangle)]
pub extern "C" fn tp_cast(session: u32, x: f64, y: f64, dx: f32, dy: f32, all: bool) -> bool {
    with(session, |session, shelf| {
        let Question { filter, shape, angle } = question(shelf)?;
        let (filter, start, way) = (sees(filter), DVec2::new(x, y), Vec2::new(dx, dy));
        let world = session.world();
        if let Some(shape) = shape {
            let pose = Pose::new(start, Rot::from_angle(angle));
            let first = world.cast_shape(&shape, pose, way, &filter);
            let row = first.map(|h| hit(h.shape, h.body, h.point, h.normal, h.fraction));
            shelf.count(row.into_iter().flatten());
            return Ok(());
        }
        let hits = if all {
            world.ray_cast_all(start, way, &filter)
        } else {
            world.ray_cast(start, way, &filter).into_iter().collect()
        };
        shelf.count(hits.iter().flat_map(|h| hit(h.shape, h.body, h.point, h.normal, h.fraction)));
        Ok(())
    })
}

/// Handles of the shapes that overlap the shape in the input at a point, or hold the point where there is none.
#[unsafe(no_mangle)]
pub extern "C" fn tp_overlap(session: u32, x: f64, y: f64) -> bool {
    with(session, |session, shelf| {
        let Question { filter, shape, angle } = question(shelf)?;
        let (filter, at, world) = (sees(filter), DVec2::new(x, y), session.world());
        let pose = Pose::new(at, Rot::from_angle(angle));
        let found = match shape {
            Some(shape) => world.overlap_shape(&shape, pose, &filter),
            None => world.overlap_point(at, &filter),
        };
        shelf.count(found.into_iter().map(Handle::number));
        Ok(())
    })
}

/// Handles of the shapes whose boxes overlap a box.
#[unsafe(no_mangle)]
pub extern "C" fn tp_overlap_aabb(
    session: u32,
    left: f32,
    bottom: f32,
    right: f32,
    top: f32,
) -> bool {
    with(session, |session, shelf| {
        let filter = sees(question(shelf)?.filter);
        let bounds = Aabb::new(Vec2::new(left, bottom), Vec2::new(right, top));
        shelf.count(session.world().overlap_aabb(bounds, &filter).into_iter().map(Handle::number));
        Ok(())
    })
}

/// The shape closest to a point: shape, body, point, distance; none within reach gives no numbers.
#[unsafe(no_mangle)]
pub extern "C" fn tp_closest(session: u32, x: f64, y: f64, reach: f32) -> bool {
    with(session, |session, shelf| {
        let filter = sees(question(shelf)?.filter);
        let closest = session.world().closest_point(DVec2::new(x, y), reach, &filter);
        shelf.count(closest.into_iter().flat_map(|c| {
            let [x, y] = point(c.point);
            [c.shape.number(), c.body.number(), x, y, c.distance.into()]
        }));
        Ok(())
    })
}
