//! A window with a camera in metres, physics, and keys that all demos have.

use crate::picture;
use bevy::camera::ScalingMode;
use bevy::prelude::*;
use bevy::window::PrimaryWindow;
use bevy_tiny_physics::prelude::*;

/// What a demo begins with. F1 shows how physics sees it, Escape ends.
pub struct Demo {
    /// Title, with the keys.
    pub title: &'static str,
    /// Height of what is seen, metres.
    pub height: f32,
    /// The middle of what is seen at the start, metres.
    pub center: Vec2,
}

/// The camera's marker.
#[derive(Component)]
pub struct Camera;

/// Where the mouse points: world, metres. A picture that is taken may lead it.
#[derive(Resource, Default, Debug)]
pub struct Cursor {
    /// The place.
    pub at: Vec2,
    /// Is the left button down?
    pub held: bool,
    /// Did it go down in this frame?
    pub pressed: bool,
    /// Led by the demo itself, not by the mouse.
    pub led: bool,
}

impl Plugin for Demo {
    fn build(&self, app: &mut App) {
        let window =
            Window { title: self.title.into(), resolution: (960, 600).into(), ..default() };
        app.add_plugins(
            DefaultPlugins.set(WindowPlugin { primary_window: Some(window), ..default() }),
        )
        .add_plugins((PhysicsPlugin::default(), PhysicsDebugPlugin))
        .insert_resource(PhysicsDebug { enabled: false, ..default() })
        .insert_resource(Time::<Fixed>::from_hz(60.0))
        .insert_resource(ClearColor(Srgba::hex("1d2233").map_or(Color::BLACK, Color::from)))
        .init_resource::<Cursor>();
        let (height, center) = (self.height, self.center.extend(100.0));
        app.add_systems(Startup, move |mut commands: Commands| {
            let scaling_mode = ScalingMode::FixedVertical { viewport_height: height };
            let projection =
                OrthographicProjection { scaling_mode, ..OrthographicProjection::default_2d() };
            commands.spawn((
                Camera,
                Camera2d,
                Projection::from(projection),
                Transform::from_translation(center),
            ));
        });
        app.add_systems(PreUpdate, follow_mouse.run_if(|cursor: Res<Cursor>| !cursor.led));
        app.add_systems(Update, keys);
        picture::install(app);
    }
}

fn follow_mouse(
    mut cursor: ResMut<Cursor>,
    buttons: Res<ButtonInput<MouseButton>>,
    windows: Query<&Window, With<PrimaryWindow>>,
    cameras: Query<(&bevy::camera::Camera, &GlobalTransform)>,
) {
    cursor.held = buttons.pressed(MouseButton::Left);
    cursor.pressed = buttons.just_pressed(MouseButton::Left);
    let (Ok(window), Ok((camera, at))) = (windows.single(), cameras.single()) else { return };
    if let Some(place) =
        window.cursor_position().and_then(|place| camera.viewport_to_world_2d(at, place).ok())
    {
        cursor.at = place;
    }
}

fn keys(
    keys: Res<ButtonInput<KeyCode>>,
    mut debug: ResMut<PhysicsDebug>,
    mut exit: MessageWriter<AppExit>,
) {
    if keys.just_pressed(KeyCode::F1) {
        debug.enabled = !debug.enabled;
    }
    if keys.just_pressed(KeyCode::Escape) {
        exit.write(AppExit::Success);
    }
}
