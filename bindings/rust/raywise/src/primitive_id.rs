//! The name of a triangle.

use std::fmt;
use std::mem::{align_of, size_of};

use raywise_sys as sys;

use crate::hit::id;
use crate::Hit;

/// A triangle by its ids (`rw_primitive_id`), e.g. one that a ray [skips](crate::RayOptions::skip).
///
/// ```
/// use raywise::{Hit, PrimitiveId};
/// fn met(hits: &[Hit]) -> Vec<PrimitiveId> {
///     hits.iter().map(PrimitiveId::from).collect()
/// }
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(C)]
pub struct PrimitiveId {
    // As in `rw_primitive_id`, so that C can read a slice of these where it lies.
    instance: u32,
    geometry: u32,
    primitive: u32,
}

const _: () = assert!(size_of::<PrimitiveId>() == size_of::<sys::rw_primitive_id>());
const _: () = assert!(align_of::<PrimitiveId>() == align_of::<sys::rw_primitive_id>());

impl PrimitiveId {
    /// No triangle: a place in a list that stands for nothing.
    pub const NOTHING: PrimitiveId = PrimitiveId::new(sys::RW_INVALID_ID, sys::RW_INVALID_ID);

    /// A triangle of a mesh, in a scene without instances.
    #[must_use]
    pub const fn new(geometry: u32, primitive: u32) -> Self {
        PrimitiveId { instance: sys::RW_INVALID_ID, geometry, primitive }
    }

    /// Which instance; `None` in a scene without instances.
    #[must_use]
    pub fn instance(&self) -> Option<u32> {
        id(self.instance)
    }

    /// Which mesh: the number that adding it returned.
    #[must_use]
    pub const fn geometry(&self) -> u32 {
        self.geometry
    }

    /// Which triangle of the mesh.
    #[must_use]
    pub const fn primitive(&self) -> u32 {
        self.primitive
    }

    pub(crate) fn slice_as_raw(ids: &[PrimitiveId]) -> *const sys::rw_primitive_id {
        ids.as_ptr().cast()
    }
}

impl<T: Copy> From<&Hit<T>> for PrimitiveId {
    fn from(hit: &Hit<T>) -> Self {
        let instance = hit.instance.unwrap_or(sys::RW_INVALID_ID);
        PrimitiveId { instance, geometry: hit.geometry, primitive: hit.primitive }
    }
}

impl<T: Copy> From<Hit<T>> for PrimitiveId {
    fn from(hit: Hit<T>) -> Self {
        PrimitiveId::from(&hit)
    }
}

impl fmt::Debug for PrimitiveId {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("PrimitiveId")
            .field("instance", &self.instance())
            .field("geometry", &self.geometry)
            .field("primitive", &self.primitive)
            .finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn c_reads_the_ids_where_they_are() {
        let hit = Hit { t: 1.0, u: 0.0, v: 0.0, instance: Some(7), geometry: 8, primitive: 9 };
        let ids = [PrimitiveId::new(5, 6), hit.into()];
        let raw = PrimitiveId::slice_as_raw(&ids);
        // SAFETY: the slice lives, has two elements, and its type has the layout of the one in C.
        let [first, second] = unsafe { [*raw, *raw.add(1)] };
        assert_eq!((first.instance, first.geometry, first.primitive), (sys::RW_INVALID_ID, 5, 6));
        assert_eq!((second.instance, second.geometry, second.primitive), (7, 8, 9));
    }

    #[test]
    fn ids_show_what_is_not_there() {
        assert_eq!(PrimitiveId::NOTHING.instance(), None);
        assert_eq!(
            format!("{:?}", PrimitiveId::new(1, 2)),
            "PrimitiveId { instance: None, geometry: 1, primitive: 2 }"
        );
    }
}
