//! Triangles that single rays pass through without a hit: the one a ray starts on, say, or those it has met before.

use std::ptr;

use raywise_sys as sys;

use crate::arrays::{repeated, Ids};
use crate::element::Index;
use crate::library::size_of_struct;
use crate::rays::{each_from_rows, same_length};
use crate::{AllHits, Error, Hits, PrimitiveId, Result};

/// What else there is to say of one ray (`rw_ray_options`).
///
/// ```
/// use raywise::{PrimitiveId, Ray, RayOptions, SceneBuilder};
/// # let triangle = |z: f32| [[0.0, 0.0, z], [1.0, 0.0, z], [0.0, 1.0, z]];
/// # let mut builder = SceneBuilder::new()?;
/// # builder.add_triangles(&[triangle(0.0), triangle(1.0)].concat(), &[[0_u32, 1, 2], [3, 4, 5]])?;
/// # let scene = builder.commit()?;
/// // On from where a ray has hit, without an epsilon: only the triangle it starts on is left out.
/// let ray = Ray::new([0.2, 0.2, 3.0], [0.0, 0.0, -1.0]);
/// let hit = scene.intersect(&ray)?.expect("two triangles are below");
/// let on = Ray::new(ray.at(hit.t), ray.direction);
/// let next = scene.intersect_with(&on, &RayOptions::new().skip(&[PrimitiveId::from(hit)]))?;
/// assert_eq!(next.map(|next| (next.t, next.primitive)), Some((1.0, 0)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct RayOptions<'a> {
    skip: &'a [PrimitiveId],
}

impl<'a> RayOptions<'a> {
    /// Nothing is skipped.
    #[must_use]
    pub fn new() -> Self {
        RayOptions::default()
    }

    /// Triangles that the ray passes through without a hit, in any order. [`PrimitiveId::NOTHING`] and repeats do no
    /// harm.
    #[must_use]
    pub fn skip(mut self, triangles: &'a [PrimitiveId]) -> Self {
        self.skip = triangles;
        self
    }

    /// The options as C takes them, good as long as the slice is.
    pub(crate) fn raw(&self) -> Result<sys::rw_ray_options> {
        Ok(sys::rw_ray_options {
            struct_size: size_of_struct::<sys::rw_ray_options>(),
            skip_count: count_in_32_bits("skip", self.skip.len())?,
            skip: if self.skip.is_empty() { ptr::null() } else { PrimitiveId::slice_as_raw(self.skip) },
        })
    }
}

fn count_in_32_bits(what: &'static str, found: usize) -> Result<u32> {
    u32::try_from(found).map_err(|_| Error::TooMany { what, found, limit: u32::MAX as usize })
}

/// An id for every entry, or one for all of them.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum PerEntryId<'a> {
    /// The same for every entry.
    One([u32; 1]),
    /// One each.
    Each(Ids<'a>),
}

impl PerEntryId<'_> {
    fn raw(&self) -> sys::rw_array {
        match self {
            PerEntryId::One(id) => repeated(id),
            PerEntryId::Each(ids) => ids.raw(),
        }
    }
}

impl From<u32> for PerEntryId<'_> {
    fn from(id: u32) -> Self {
        PerEntryId::One([id])
    }
}

each_from_rows!(PerEntryId, Ids, Index, T);

/// Which triangles the rays of a batch pass through without a hit, in the caller's arrays (`rw_rays`). Nothing is
/// copied.
///
/// Ids are as hits carry them, so that the answers to one batch can be the skip list of the next: `&Hits` and
/// `&AllHits` are skip lists as they are. A primitive that is the greatest number of its type, as in the answer of a
/// miss, stands for nothing.
///
/// ```
/// use raywise::{Rays, SkipLists};
/// let directions = [[0.0_f32, 0.0, -1.0], [0.0, 0.1, -1.0], [0.1, 0.0, -1.0]];
/// let rays = Rays::new([0.0, 0.0, 5.0], &directions)?;
/// // One each: the first ray skips triangle 7, the last one triangle 8, both of mesh 0.
/// rays.with_skip(SkipLists::each(&[7_u32, u32::MAX, 8]))?;
/// // Any number: the first ray skips 7 and 8 of mesh 3, the last one 9.
/// rays.with_skip(SkipLists::lists(&[0, 2, 2, 3], &[7_u32, 8, 9]).geometry(3))?;
/// # Ok::<(), raywise::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SkipLists<'a> {
    offsets: Option<&'a [u64]>,
    geometry: PerEntryId<'a>,
    primitive: PerEntryId<'a>,
}

impl<'a> SkipLists<'a> {
    /// One triangle for each ray: a slice of `u32` or `u64` with one element per ray, or a single `u32` for all rays.
    /// Of mesh 0, unless [`geometry`](SkipLists::geometry) says otherwise.
    #[must_use]
    pub fn each(primitive: impl Into<PerEntryId<'a>>) -> Self {
        SkipLists { offsets: None, geometry: PerEntryId::One([0]), primitive: primitive.into() }
    }

    /// Any number of triangles for each ray: ray i skips the entries `offsets[i] .. offsets[i + 1]` of `primitive`. Of
    /// mesh 0, unless [`geometry`](SkipLists::geometry) says otherwise.
    #[must_use]
    pub fn lists(offsets: &'a [u64], primitive: impl Into<PerEntryId<'a>>) -> Self {
        SkipLists { offsets: Some(offsets), ..SkipLists::each(primitive) }
    }

    /// Of which meshes the triangles are: a slice of `u32` or `u64` with one element per entry, or a single `u32` for
    /// all.
    #[must_use]
    pub fn geometry(mut self, geometry: impl Into<PerEntryId<'a>>) -> Self {
        self.geometry = geometry.into();
        self
    }

    /// Whether there are lists for so many rays, and an id for each of their entries. The library does not know how
    /// long the arrays are; it looks at what the ids name.
    pub(crate) fn check(&self, rays: usize) -> Result<()> {
        if let Some(offsets) = self.offsets {
            same_length("skip offsets", rays + 1, offsets.len())?;
            if let Some(fall) = offsets.windows(2).position(|pair| pair[1] < pair[0]) {
                let (before, value) = (offsets[fall], offsets[fall + 1]);
                return Err(Error::Falling { what: "skip offsets", index: fall + 1, value, before });
            }
        }
        for (what, ids) in [("skip primitive", &self.primitive), ("skip geometry", &self.geometry)] {
            match (ids, self.offsets.and_then(<[u64]>::last)) {
                (PerEntryId::One(_), _) => {}
                (PerEntryId::Each(ids), None) => same_length(what, rays, ids.len())?,
                (PerEntryId::Each(ids), Some(end)) => {
                    let end = usize::try_from(*end).unwrap_or(usize::MAX);
                    // More ids than are used do no harm: the offsets may be a part of longer ones.
                    same_length(what, end.max(ids.len()), ids.len())?;
                }
            }
        }
        Ok(())
    }

    /// Adds the lists to rays of the number they were checked for. What stands for all entries lies in `self`, so the
    /// result is good as long as `self` stays where it is.
    pub(crate) fn add_to(&self, rays: &mut sys::rw_rays) {
        rays.skip_offsets = self.offsets.map_or(ptr::null(), <[u64]>::as_ptr);
        rays.skip_geometry = self.geometry.raw();
        rays.skip_primitive = self.primitive.raw();
    }
}

impl<'a> From<&'a Hits> for SkipLists<'a> {
    /// Each ray skips what the ray of the same number has hit.
    fn from(hits: &'a Hits) -> Self {
        SkipLists::each(&hits.primitive).geometry(&hits.geometry)
    }
}

impl<'a> From<&'a AllHits> for SkipLists<'a> {
    /// Each ray skips all that the ray of the same number has hit.
    fn from(all: &'a AllHits) -> Self {
        SkipLists::lists(&all.offsets, &all.hits.primitive).geometry(&all.hits.geometry)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rays;

    fn raw(skip: SkipLists<'_>) -> sys::rw_rays {
        let mut rays = sys::rw_rays::default();
        skip.add_to(&mut rays);
        rays
    }

    #[test]
    fn options_become_the_c_struct() {
        let none = RayOptions::new().raw().unwrap();
        assert_eq!((none.skip_count, none.skip), (0, ptr::null()));
        let ids = [PrimitiveId::new(0, 1), PrimitiveId::NOTHING];
        let two = RayOptions::new().skip(&ids).raw().unwrap();
        assert_eq!((two.skip_count, two.skip.cast()), (2, ids.as_ptr()));
    }

    #[test]
    fn what_cannot_be_counted_in_32_bits_is_refused() {
        assert_eq!(count_in_32_bits("skip", 7), Ok(7));
        let error = count_in_32_bits("skip", 1 << 32).unwrap_err();
        assert_eq!(error, Error::TooMany { what: "skip", found: 1 << 32, limit: (1 << 32) - 1 });
    }

    #[test]
    fn ids_are_read_where_they_are() {
        let (offsets, primitive, geometry) = ([0, 1, 3], [5_u64, 6, 7], vec![1_u32, 1, 2]);
        let lists = SkipLists::lists(&offsets, &primitive).geometry(&geometry);
        let rays = raw(lists);
        assert_eq!(rays.skip_offsets, offsets.as_ptr());
        assert_eq!((rays.skip_primitive.data, rays.skip_primitive.type_), (primitive.as_ptr().cast(), sys::RW_UINT64));
        assert_eq!((rays.skip_geometry.data, rays.skip_geometry.stride), (geometry.as_ptr().cast(), 4));

        let one = SkipLists::each(9).geometry(4);
        let mut rays = sys::rw_rays::default();
        one.add_to(&mut rays);
        assert!(rays.skip_offsets.is_null());
        for (array, value) in [(rays.skip_primitive, 9), (rays.skip_geometry, 4)] {
            assert_eq!((array.stride, array.type_), (sys::RW_REPEAT, sys::RW_UINT32));
            // SAFETY: `one` is still where it was.
            assert_eq!(unsafe { *array.data.cast::<u32>() }, value);
        }
    }

    #[test]
    fn there_has_to_be_a_list_for_each_ray_and_an_id_for_each_entry() {
        let rays = Rays::new([0.0; 3], &[[0.0, 0.0, 1.0]; 3]).unwrap();
        let refused = |skip: SkipLists<'_>| rays.with_skip(skip).unwrap_err();
        let length = |what, expected, found| Error::Length { what, expected, found };
        let four = [0_u32; 4];

        assert_eq!(refused(SkipLists::each(&four)), length("skip primitive", 3, 4));
        assert_eq!(refused(SkipLists::each(0).geometry(&four)), length("skip geometry", 3, 4));
        assert_eq!(refused(SkipLists::lists(&[0, 1, 2], &four)), length("skip offsets", 4, 3));
        assert_eq!(refused(SkipLists::lists(&[0, 1, 2, 5], &four)), length("skip primitive", 5, 4));
        assert_eq!(refused(SkipLists::lists(&[0, 1, 2, 5], 0).geometry(&four)), length("skip geometry", 5, 4));
        assert_eq!(refused(SkipLists::lists(&[0, 0, 0, u64::MAX], &four)), length("skip primitive", usize::MAX, 4));
        // The end alone would be inside.
        let falling = Error::Falling { what: "skip offsets", index: 2, value: 1, before: 99 };
        assert_eq!(refused(SkipLists::lists(&[0, 99, 1, 2], &four)), falling);

        assert!(rays.with_skip(SkipLists::lists(&[1, 2, 3, 3], &four).geometry(&four)).is_ok());
        let mut hits = Hits::with_len(3);
        hits.geometry.pop();
        assert_eq!(refused(SkipLists::from(&hits)), length("skip geometry", 3, 2));
    }
}
