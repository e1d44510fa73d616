//! One answer.

use raywise_sys as sys;

/// Where a ray meets a triangle (`rw_hit`; `rw_hit_f32` for `Hit<f32>`). The point is `origin + t * direction`, which is also
/// `(1 - u - v) * v0 + u * v1 + v * v2`. [`Scene::normal`](crate::Scene::normal) tells the normal there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit<T = f64> {
    /// In units of the direction's length.
    pub t: T,
    /// The weight of the triangle's second corner.
    pub u: T,
    /// The weight of the triangle's third corner.
    pub v: T,
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
