//! One ray.

use raywise_sys as sys;

/// One ray (`rw_ray`). `f32` coordinates convert without loss.
///
/// t is measured in units of the direction's length; a hit counts when `tmin <= t <= tmax`. A ray with a NaN anywhere, a
/// zero direction, an infinite origin or direction, or `tmin > tmax` misses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where t is 0.
    pub origin: [f64; 3],
    /// Where to; any length but zero.
    pub direction: [f64; 3],
    /// The least t that counts.
    pub tmin: f64,
    /// The greatest t that counts.
    pub tmax: f64,
}

impl Ray {
    /// A ray that starts at its origin and has no end.
    #[must_use]
    pub fn new(origin: [f64; 3], direction: [f64; 3]) -> Self {
        Ray { origin, direction, tmin: 0.0, tmax: f64::INFINITY }
    }

    /// The part of a ray from `tmin` to `tmax`.
    #[must_use]
    pub fn between(self, tmin: f64, tmax: f64) -> Self {
        Ray { tmin, tmax, ..self }
    }

    /// The point at t.
    #[must_use]
    pub fn at(&self, t: f64) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.origin[axis] + t * self.direction[axis])
    }

    pub(crate) fn raw(&self) -> sys::rw_ray {
        sys::rw_ray { origin: self.origin, tmin: self.tmin, direction: self.direction, tmax: self.tmax }
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
