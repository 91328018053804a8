//! Pictures of tiny-physics worlds.
//!
//! One rasteriser, [`Canvas`], draws what the engine's [`DebugDraw`](tiny_physics::DebugDraw) says, or paints a world in a
//! presentation style ([`Canvas::paint`]) with the colours of a [`Theme`];
//! PNG files, GIF animations ([`Animation`]) and the [`Window`] all show its pixels. [`TextView`]
//! draws the same calls with letters.
//!
//! ```
//! use tiny_physics::{Color, DVec2, DebugDraw, Transform, Vec2};
//! use tiny_physics_draw::{Camera, Canvas};
//!
//! let camera = Camera::fit(DVec2::new(-2.0, -2.0), DVec2::new(2.0, 2.0), 320, 200);
//! let mut canvas = Canvas::new(320, 200)?;
//! canvas.begin(&camera);
//! canvas.circle(&Transform::IDENTITY, 1.0, Color::rgb(80, 160, 250));
//! assert!(!canvas.to_png()?.is_empty());
//! # Ok::<(), tiny_physics_draw::DrawError>(())
//! ```

mod animation;
mod camera;
mod canvas;
mod error;
mod font;
mod hud;
mod outline;
mod painting;
mod palette;
mod paths;
mod text_view;
mod theme;
#[cfg(feature = "window")]
mod window;

pub use animation::Animation;
pub use camera::Camera;
pub use canvas::Canvas;
pub use error::DrawError;
pub use painting::{Painting, Water};
pub use palette::ColorTable;
pub use text_view::TextView;
pub use theme::Theme;
#[cfg(feature = "window")]
pub use window::{Input, Key, Window};
