//! One ray.

use crate::Precision;

/// One ray (`rw_ray`; `rw_ray_f32` for `Ray<f32>`).
///
/// t is measured in units of the direction's length; a hit counts when `tmin <= t <= tmax`. A ray with a NaN anywhere, a
/// zero direction, an infinite origin or direction, or `tmin > tmax` misses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray<T = f64> {
    /// Where t is 0.
    pub origin: [T; 3],
    /// Where to; any length but zero.
    pub direction: [T; 3],
    /// The least t that counts.
    pub tmin: T,
    /// The greatest t that counts.
    pub tmax: T,
}

impl<T: Precision> Ray<T> {
    /// A ray that starts at its origin and has no end.
    #[must_use]
    pub fn new(origin: [T; 3], direction: [T; 3]) -> Self {
        Ray { origin, direction, tmin: T::ZERO, tmax: T::INFINITY }
    }

    /// The part of a ray from `tmin` to `tmax`.
    #[must_use]
    pub fn between(self, tmin: T, tmax: T) -> Self {
        Ray { tmin, tmax, ..self }
    }

    /// The point at t.
    #[must_use]
    pub fn at(&self, t: T) -> [T; 3] {
        [0, 1, 2].map(|axis| self.origin[axis] + t * self.direction[axis])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_ray_starts_at_its_origin_and_has_no_end() {
        let ray = Ray::new([1.0, 2.0, 3.0], [0.0, 0.0, 2.0]);
        assert_eq!((ray.tmin, ray.tmax), (0.0, f64::INFINITY));
        assert_eq!(ray.between(1.0, 2.0).tmax, 2.0);
        assert_eq!(ray.at(0.5), [1.0, 2.0, 4.0]);
    }
}
