//! Vectors and poses from and to those of other crates.

#[cfg(any(test, feature = "glam", feature = "mint"))]
use super::Vec2;
use super::{DVec2, Pose, Rot};

impl From<(f64, f64)> for DVec2 {
    fn from((x, y): (f64, f64)) -> Self {
        Self::new(x, y)
    }
}

impl<P: Into<DVec2>> From<(P, f32)> for Pose {
    /// A place and an angle in radians.
    fn from((place, radians): (P, f32)) -> Self {
        Self::new(place.into(), Rot::from_angle(radians))
    }
}

/// Both ways, part by part.
#[cfg(any(feature = "glam", feature = "mint"))]
macro_rules! same_parts {
    ($($theirs:ty, $ours:ty;)+) => {$(
        impl From<$theirs> for $ours {
            #[inline]
            fn from(v: $theirs) -> Self {
                Self::new(v.x, v.y)
            }
        }

        impl From<$ours> for $theirs {
            #[inline]
            fn from(v: $ours) -> Self {
                Self { x: v.x, y: v.y }
            }
        }
    )+};
}

/// 32 bits into 64.
#[cfg(any(feature = "glam", feature = "mint"))]
macro_rules! wider {
    ($($theirs:ty),+) => {$(
        impl From<$theirs> for DVec2 {
            #[inline]
            fn from(v: $theirs) -> Self {
                Vec2::new(v.x, v.y).into()
            }
        }
    )+};
}

#[cfg(feature = "glam")]
mod with_glam {
    use super::{DVec2, Pose, Rot, Vec2};
    use crate::math::Transform;
    use glam::{Affine2, DAffine2, DMat2, Mat2};

    same_parts!(glam::Vec2, Vec2; glam::DVec2, DVec2;);
    wider!(glam::Vec2);

    impl From<Rot> for Mat2 {
        fn from(rot: Rot) -> Self {
            Self::from_cols(rot.x_axis().into(), rot.y_axis().into())
        }
    }

    impl From<Transform> for Affine2 {
        fn from(frame: Transform) -> Self {
            Self::from_mat2_translation(frame.q.into(), frame.p.into())
        }
    }

    impl From<Pose> for DAffine2 {
        fn from(pose: Pose) -> Self {
            let matrix: Mat2 = pose.q.into();
            let columns = DMat2::from_cols(matrix.x_axis.as_dvec2(), matrix.y_axis.as_dvec2());
            Self::from_mat2_translation(columns, pose.p.into())
        }
    }
}

#[cfg(feature = "mint")]
mod with_mint {
    use super::{DVec2, Vec2};
    use mint::{Point2, Vector2};

    same_parts!(
        Vector2<f32>, Vec2; Point2<f32>, Vec2;
        Vector2<f64>, DVec2; Point2<f64>, DVec2;
    );
    wider!(Vector2<f32>, Point2<f32>);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tuples_are_vectors_and_poses() {
        assert_eq!(DVec2::from((1.0, 2.0)), DVec2::new(1.0, 2.0));
        let pose = Pose::from((Vec2::new(1.0, 2.0), 0.5));
        assert_eq!((pose.p, pose.q), (DVec2::new(1.0, 2.0), Rot::from_angle(0.5)));
    }

    #[cfg(feature = "glam")]
    #[test]
    fn glam_and_back() {
        let (v, d) = (glam::Vec2::new(1.5, -2.0), glam::DVec2::new(1.0e9 + 0.5, 2.0));
        assert_eq!(glam::Vec2::from(Vec2::from(v)), v);
        assert_eq!(glam::DVec2::from(DVec2::from(d)), d);
        assert_eq!(DVec2::from(v), DVec2::new(1.5, -2.0));
        let pose = Pose::from((DVec2::from(d), 0.3));
        let point = glam::DAffine2::from(pose).transform_point2(glam::DVec2::new(1.0, 2.0));
        let ours = pose.apply(Vec2::new(1.0, 2.0));
        assert!((point - glam::DVec2::from(ours)).length() < 1e-6);
    }

    #[cfg(feature = "mint")]
    #[test]
    fn mint_and_back() {
        let (v, p) = (mint::Vector2 { x: 1.5_f32, y: -2.0 }, mint::Point2 { x: 1.0e9, y: 2.0 });
        assert_eq!(mint::Vector2::from(Vec2::from(v)), v);
        assert_eq!(mint::Point2::from(DVec2::from(p)), p);
        assert_eq!(DVec2::from(v), DVec2::new(1.5, -2.0));
    }
}
