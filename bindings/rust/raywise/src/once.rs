//! One shot: the number of rays is known and nothing is kept.

use std::ffi::{CStr, CString};
use std::ptr;

use raywise_sys as sys;

use crate::hits::Output;
use crate::library::{check, ensure_abi, size_of_struct};
use crate::{text, Flag, Hits, HitsMut, Profile, QueryOptions, RayKind, Rays, Result, Triangles};

/// Answers a batch against meshes that are used in place and forgotten afterwards. The structure is chosen for exactly
/// the number of rays in the batch.
///
/// ```
/// use raywise::{OneShot, Rays, Triangles};
/// let vertices = [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
/// let mesh = Triangles::new(&vertices, &[[0_u32, 1, 2]]);
/// let rays = Rays::new([0.2, 0.2, 1.0], &[[0.0_f32, 0.0, -1.0], [0.0, 0.0, 1.0]])?;
/// let hits = OneShot::new().intersect(&[mesh], &rays)?;
/// assert_eq!(hits.get(0).map(|hit| hit.t), Some(1.0));
/// assert_eq!(hits.get(1), None);
/// # Ok::<(), raywise::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct OneShot<'a> {
    kind: RayKind,
    profile: Option<&'a Profile>,
    structure: Option<String>,
    memory_limit: u64,
    query: QueryOptions<'a>,
}

impl<'a> OneShot<'a> {
    /// The library chooses, with the constants that [`Profile::find`] finds.
    #[must_use]
    pub fn new() -> Self {
        OneShot::default()
    }

    /// Of which kind the rays are.
    #[must_use]
    pub fn kind(mut self, kind: RayKind) -> Self {
        self.kind = kind;
        self
    }

    /// The constants to decide with.
    #[must_use]
    pub fn profile(mut self, profile: &'a Profile) -> Self {
        self.profile = Some(profile);
        self
    }

    /// Forces a structure by name.
    #[must_use]
    pub fn structure(mut self, name: impl Into<String>) -> Self {
        self.structure = Some(name.into());
        self
    }

    /// Bounds the bytes that the structure may take; 0: no limit.
    #[must_use]
    pub fn memory_limit(mut self, bytes: u64) -> Self {
        self.memory_limit = bytes;
        self
    }

    /// Threads and the like.
    #[must_use]
    pub fn query(mut self, options: QueryOptions<'a>) -> Self {
        self.query = options;
        self
    }

    /// Finds the closest hit of many rays. Wraps `rw_once_intersect`.
    ///
    /// # Errors
    /// What adding, committing and asking may fail with; see [`SceneBuilder`](crate::SceneBuilder).
    pub fn intersect(&self, meshes: &[Triangles<'_>], rays: &Rays<'_>) -> Result<Hits> {
        let mut hits = Hits::with_len(rays.len());
        hits.invalid_rays = self.intersect_into(meshes, rays, hits.all_mut())?;
        Ok(hits)
    }

    /// Finds the closest hit of many rays and writes the answers into the caller's slices. Returns how many of the rays
    /// held a NaN. Wraps `rw_once_intersect`.
    ///
    /// # Errors
    /// As [`intersect`](OneShot::intersect), and [`Error::Length`](crate::Error::Length) when a slice is not as long as
    /// there are rays.
    pub fn intersect_into(&self, meshes: &[Triangles<'_>], rays: &Rays<'_>, mut hits: HitsMut<'_>) -> Result<u64> {
        let hits = hits.raw(rays.len())?;
        self.ask(meshes, |meshes, count, options| {
            // SAFETY: meshes and rays are borrowed and outputs exclusively borrowed through the call, and each output
            // has room for one answer per ray.
            unsafe { sys::rw_once_intersect(meshes, count, &rays.raw(), &hits, options) }
        })
    }

    /// Tells for many rays whether they hit anything. Wraps `rw_once_occluded`.
    ///
    /// # Errors
    /// As [`intersect`](OneShot::intersect).
    pub fn occluded(&self, meshes: &[Triangles<'_>], rays: &Rays<'_>) -> Result<Vec<bool>> {
        let mut flags = vec![0_u8; rays.len()];
        self.occluded_into(meshes, rays, &mut flags)?;
        Ok(flags.into_iter().map(|flag| flag != 0).collect())
    }

    /// Tells for many rays whether they hit anything, 1 or 0, in the caller's slice of `u8`, `u32` or `u64`. Returns how
    /// many of the rays held a NaN. Wraps `rw_once_occluded`.
    ///
    /// # Errors
    /// As [`intersect_into`](OneShot::intersect_into).
    pub fn occluded_into<T: Flag>(&self, meshes: &[Triangles<'_>], rays: &Rays<'_>, occluded: &mut [T]) -> Result<u64> {
        let occluded = Output::flags(occluded).raw("output occluded", rays.len())?;
        self.ask(meshes, |meshes, count, options| {
            // SAFETY: as in `intersect_into`.
            unsafe { sys::rw_once_occluded(meshes, count, &rays.raw(), &occluded, options) }
        })
    }

    fn ask(
        &self,
        meshes: &[Triangles<'_>],
        call: impl FnOnce(*const sys::rw_triangles, u32, &sys::rw_once_options) -> i32,
    ) -> Result<u64> {
        ensure_abi()?;
        let structure: Option<CString> =
            self.structure.as_deref().map(|name| text::to_c("structure", name)).transpose()?;
        let meshes: Vec<sys::rw_triangles> = meshes.iter().map(Triangles::raw).collect();
        let mut invalid_rays = 0;
        self.query.with_raw(&mut invalid_rays, |query| {
            let options = sys::rw_once_options {
                struct_size: size_of_struct::<sys::rw_once_options>(),
                kind: self.kind.raw(),
                profile: self.profile.map_or(ptr::null(), Profile::as_ptr),
                structure: structure.as_deref().map_or(ptr::null(), CStr::as_ptr),
                memory_limit: self.memory_limit,
                query,
            };
            // The library counts meshes in 32 bits; more than that would not fit into memory.
            check(call(meshes.as_ptr(), meshes.len() as u32, &options))
        })?;
        Ok(invalid_rays)
    }
}
