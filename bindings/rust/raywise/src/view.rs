//! From where a scene is seen, or along which direction.

use std::ffi::CString;
use std::ptr;

use raywise_sys as sys;

use crate::expected::count_or_unknown;
use crate::library::size_of_struct;
use crate::{text, RayKind, Result};

/// From where, and for how many rays (`rw_view_options`), for [`Scene::view`](crate::Scene::view).
///
/// ```
/// use raywise::{RayKind, ViewOptions};
/// let camera = ViewOptions::from_point([0.0, 0.0, 5.0]).towards([0.0, 0.0, -1.0]).half_angle(0.5).rays(1_000_000);
/// let lamp = ViewOptions::from_point([0.0, 9.0, 0.0]).kind(RayKind::Shadow);
/// let sun = ViewOptions::along([0.3, -1.0, 0.2]).kind(RayKind::Shadow);
/// ```
#[derive(Clone, Debug)]
pub struct ViewOptions {
    place: Place,
    count: Option<u64>,
    kind: RayKind,
    structure: Option<String>,
}

#[derive(Clone, Copy, Debug)]
enum Place {
    Point { origin: [f64; 3], direction: [f64; 3], half_angle: f64 },
    Direction([f64; 3]),
}

impl ViewOptions {
    /// Rays that start at, or aim at, one point. All around, unless told [`towards`](ViewOptions::towards) where.
    #[must_use]
    pub fn from_point(origin: [f64; 3]) -> Self {
        Self::new(Place::Point { origin, direction: [0.0; 3], half_angle: 0.0 })
    }

    /// Rays that run along one direction, forwards or backwards.
    #[must_use]
    pub fn along(direction: [f64; 3]) -> Self {
        Self::new(Place::Direction(direction))
    }

    fn new(place: Place) -> Self {
        ViewOptions { place, count: None, kind: RayKind::Any, structure: None }
    }

    /// Where a view from a point looks.
    #[must_use]
    pub fn towards(mut self, towards: [f64; 3]) -> Self {
        match &mut self.place {
            Place::Point { direction, .. } | Place::Direction(direction) => *direction = towards,
        }
        self
    }

    /// The angle in radians from the direction to the farthest ray of a view from a point, below pi / 2; pi / 4 if not
    /// told. Rays outside are answered as by the scene.
    #[must_use]
    pub fn half_angle(mut self, radians: f64) -> Self {
        if let Place::Point { half_angle, .. } = &mut self.place {
            *half_angle = radians;
        }
        self
    }

    /// How many rays are coming; unknown if not told.
    #[must_use]
    pub fn rays(mut self, count: u64) -> Self {
        self.count = Some(count);
        self
    }

    /// [`RayKind::Camera`] or [`RayKind::Shadow`].
    #[must_use]
    pub fn kind(mut self, kind: RayKind) -> Self {
        self.kind = kind;
        self
    }

    /// Forces a structure by name.
    #[must_use]
    pub fn structure(mut self, name: impl Into<String>) -> Self {
        self.structure = Some(name.into());
        self
    }

    /// Makes a C call with the options in the form C takes them.
    pub(crate) fn with_raw<R>(&self, call: impl FnOnce(&sys::rw_view_options) -> Result<R>) -> Result<R> {
        let structure: Option<CString> =
            self.structure.as_deref().map(|name| text::to_c("structure", name)).transpose()?;
        let mut raw = sys::rw_view_options {
            struct_size: size_of_struct::<sys::rw_view_options>(),
            count: count_or_unknown(self.count),
            ray_kind: self.kind.raw(),
            structure: structure.as_deref().map_or(ptr::null(), std::ffi::CStr::as_ptr),
            ..sys::rw_view_options::default()
        };
        match self.place {
            Place::Point { origin, direction, half_angle } => {
                raw.kind = sys::RW_VIEW_POINT;
                raw.origin = origin;
                raw.direction = direction;
                raw.half_angle = half_angle;
            }
            Place::Direction(direction) => {
                raw.kind = sys::RW_VIEW_DIRECTION;
                raw.direction = direction;
            }
        }
        call(&raw)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_become_the_c_struct() {
        let camera = ViewOptions::from_point([1.0, 2.0, 3.0]).towards([0.0, 0.0, 1.0]).half_angle(0.25).rays(9);
        let seen = camera.with_raw(|raw| {
            assert_eq!((raw.kind, raw.count, raw.half_angle), (sys::RW_VIEW_POINT, 9, 0.25));
            assert_eq!((raw.origin, raw.direction), ([1.0, 2.0, 3.0], [0.0, 0.0, 1.0]));
            assert!(raw.structure.is_null());
            Ok(())
        });
        assert_eq!(seen, Ok(()));

        let sun = ViewOptions::along([0.0, -1.0, 0.0]).kind(RayKind::Shadow).structure("projected_bvh");
        let seen = sun.with_raw(|raw| {
            assert_eq!((raw.kind, raw.count), (sys::RW_VIEW_DIRECTION, sys::RW_RAYS_UNKNOWN));
            assert_eq!((raw.direction, raw.ray_kind), ([0.0, -1.0, 0.0], sys::RW_RAYS_SHADOW));
            assert!(!raw.structure.is_null());
            Ok(())
        });
        assert_eq!(seen, Ok(()));
    }
}
