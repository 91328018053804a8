//! What vectors of 32 and of 64 bits have in common.

/// The functions and operators of a vector with parts `x` and `y` of a type.
macro_rules! vector {
    ($vector:ident, $scalar:ident) => {
        impl $vector {
            /// (0, 0).
            pub const ZERO: Self = Self::new(0.0, 0.0);

            /// A vector of the two parts.
            #[inline]
            pub const fn new(x: $scalar, y: $scalar) -> Self {
                Self { x, y }
            }

            /// Both parts equal.
            #[inline]
            pub const fn splat(value: $scalar) -> Self {
                Self::new(value, value)
            }

            /// Scalar product.
            #[inline]
            pub fn dot(self, other: Self) -> $scalar {
                self.x * other.x + self.y * other.y
            }

            /// Signed area of the parallelogram from `self` to `other`, positive anticlockwise.
            #[inline]
            pub fn cross(self, other: Self) -> $scalar {
                self.x * other.y - self.y * other.x
            }

            /// Quarter turn anticlockwise.
            #[inline]
            pub fn perp(self) -> Self {
                Self::new(-self.y, self.x)
            }

            /// Squared length.
            #[inline]
            pub fn length_sq(self) -> $scalar {
                self.dot(self)
            }

            /// Length.
            #[inline]
            pub fn length(self) -> $scalar {
                self.length_sq().sqrt()
            }

            /// Distance to another point.
            #[inline]
            pub fn distance(self, other: Self) -> $scalar {
                (self - other).length()
            }

            /// Neither part is NaN or infinite.
            #[inline]
            pub fn is_finite(self) -> bool {
                self.x.is_finite() && self.y.is_finite()
            }
        }

        impl core::fmt::Debug for $vector {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                write!(f, "({:?}, {:?})", self.x, self.y)
            }
        }

        impl core::fmt::Display for $vector {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                write!(f, "({}, {})", self.x, self.y)
            }
        }

        impl core::ops::Add for $vector {
            type Output = Self;
            #[inline]
            fn add(self, other: Self) -> Self {
                Self::new(self.x + other.x, self.y + other.y)
            }
        }

        impl core::ops::Sub for $vector {
            type Output = Self;
            #[inline]
            fn sub(self, other: Self) -> Self {
                Self::new(self.x - other.x, self.y - other.y)
            }
        }

        impl core::ops::Neg for $vector {
            type Output = Self;
            #[inline]
            fn neg(self) -> Self {
                Self::new(-self.x, -self.y)
            }
        }

        impl core::ops::Mul<$scalar> for $vector {
            type Output = Self;
            #[inline]
            fn mul(self, scale: $scalar) -> Self {
                Self::new(self.x * scale, self.y * scale)
            }
        }

        impl<T: Copy> core::ops::AddAssign<T> for $vector
        where
            Self: core::ops::Add<T, Output = Self>,
        {
            #[inline]
            fn add_assign(&mut self, other: T) {
                *self = *self + other;
            }
        }

        impl From<[$scalar; 2]> for $vector {
            fn from([x, y]: [$scalar; 2]) -> Self {
                Self::new(x, y)
            }
        }

        impl From<$vector> for [$scalar; 2] {
            fn from(v: $vector) -> Self {
                [v.x, v.y]
            }
        }
    };
}
pub(super) use vector;
