//! One answer.

use raywise_sys as sys;

/// Where a ray meets a triangle (`rw_hit`). The point is `origin + t * direction`, which is also
/// `(1 - u - v) * v0 + u * v1 + v * v2`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// In units of the direction's length.
    pub t: f64,
    /// The weight of the triangle's second corner.
    pub u: f64,
    /// The weight of the triangle's third corner.
    pub v: f64,
    /// Geometric, of unit length, right-handed: along `(v1 - v0) x (v2 - v0)`.
    pub normal: [f64; 3],
    /// Which instance; `None` in a scene without instances.
    pub instance: Option<u32>,
    /// Which mesh: the number that adding it returned.
    pub geometry: u32,
    /// Which triangle of the mesh.
    pub primitive: u32,
}

/// Ids of nothing are `RW_INVALID_ID` in C.
pub(crate) fn id(raw: u32) -> Option<u32> {
    (raw != sys::RW_INVALID_ID).then_some(raw)
}

impl Hit {
    /// `None` for a miss.
    pub(crate) fn from_raw(raw: &sys::rw_hit) -> Option<Hit> {
        Some(Hit {
            t: raw.t,
            u: raw.u,
            v: raw.v,
            normal: raw.normal,
            instance: id(raw.instance),
            geometry: id(raw.geometry)?,
            primitive: raw.primitive,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_miss_is_none_and_a_missing_instance_is_none() {
        let nothing = sys::RW_INVALID_ID;
        let miss = sys::rw_hit {
            t: f64::INFINITY,
            instance: nothing,
            geometry: nothing,
            primitive: nothing,
            ..Default::default()
        };
        assert_eq!(Hit::from_raw(&miss), None);

        let hit = sys::rw_hit { t: 2.0, instance: nothing, geometry: 0, primitive: 3, ..Default::default() };
        let hit = Hit::from_raw(&hit).unwrap();
        assert_eq!((hit.t, hit.instance, hit.geometry, hit.primitive), (2.0, None, 0, 3));
    }
}
