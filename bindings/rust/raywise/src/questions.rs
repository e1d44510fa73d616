//! What a scene and a view can be asked: the same questions, with the same answers.

use raywise_sys as sys;

use crate::hits::Output;
use crate::library::check;
use crate::rays::same_length;
use crate::{AllHits, Candidate, Error, Flag, Hit, Hits, HitsMut, QueryOptions, Ray, RayOptions, Rays, Result};

use functions::Asked;

/// The questions that a [`Scene`](crate::Scene) and a [`View`](crate::View) answer, from any number of threads at a time.
///
/// The bits of an answer do not depend on the structure, on the call (one ray, many, scene or view), on the order or on
/// the number of threads.
///
/// Where a method names a C function `rw_scene_x`, a view asks `rw_view_x`.
pub trait RayQueries: Asked {
    /// Finds the closest hit of one ray. Wraps `rw_scene_intersect`.
    fn intersect(&self, ray: &Ray) -> Result<Option<Hit>> {
        let mut hit = sys::rw_hit::default();
        // SAFETY: the handle lives, and ray and hit live through the call.
        check(unsafe { (Self::FUNCTIONS.intersect)(self.as_ptr(), &ray.raw(), &mut hit) })?;
        Ok(Hit::from_raw(&hit))
    }

    /// Tells whether a ray hits anything. Wraps `rw_scene_occluded`.
    fn occluded(&self, ray: &Ray) -> Result<bool> {
        let mut occluded = 0;
        // SAFETY: the handle lives, and ray and answer live through the call.
        check(unsafe { (Self::FUNCTIONS.occluded)(self.as_ptr(), &ray.raw(), &mut occluded) })?;
        Ok(occluded != 0)
    }

    /// Finds every hit of one ray, closest first. A surface that is crossed at an edge or a corner counts once; the first
    /// hit is the one that [`intersect`](RayQueries::intersect) finds. Wraps `rw_scene_intersect_all`.
    fn intersect_all(&self, ray: &Ray) -> Result<Vec<Hit>> {
        let ray = ray.raw();
        all_of_ray(|hits, capacity, needed| {
            // SAFETY: the handle and the ray live, and there is room for `capacity` answers.
            unsafe { (Self::FUNCTIONS.intersect_all)(self.as_ptr(), &ray, hits, capacity, needed) }
        })
    }

    /// Finds the closest hit of a ray that skips triangles. Wraps `rw_scene_intersect_with`.
    ///
    /// # Errors
    /// [`Status::INDEX_OUT_OF_RANGE`](crate::Status::INDEX_OUT_OF_RANGE) for a triangle that is not there.
    fn intersect_with(&self, ray: &Ray, options: &RayOptions<'_>) -> Result<Option<Hit>> {
        let (options, mut hit) = (options.raw()?, sys::rw_hit::default());
        // SAFETY: the handle lives, and ray, options with their list, and hit live through the call.
        check(unsafe { (Self::FUNCTIONS.intersect_with)(self.as_ptr(), &ray.raw(), &options, &mut hit) })?;
        Ok(Hit::from_raw(&hit))
    }

    /// Tells whether a ray that skips triangles hits any other. Wraps `rw_scene_occluded_with`.
    ///
    /// # Errors
    /// As [`intersect_with`](RayQueries::intersect_with).
    fn occluded_with(&self, ray: &Ray, options: &RayOptions<'_>) -> Result<bool> {
        let (options, mut occluded) = (options.raw()?, 0);
        // SAFETY: as in `intersect_with`.
        check(unsafe { (Self::FUNCTIONS.occluded_with)(self.as_ptr(), &ray.raw(), &options, &mut occluded) })?;
        Ok(occluded != 0)
    }

    /// Finds every hit of a ray that skips triangles, closest first. Wraps `rw_scene_intersect_all_with`.
    ///
    /// # Errors
    /// As [`intersect_with`](RayQueries::intersect_with).
    fn intersect_all_with(&self, ray: &Ray, options: &RayOptions<'_>) -> Result<Vec<Hit>> {
        let (ray, options) = (ray.raw(), options.raw()?);
        all_of_ray(|hits, capacity, needed| {
            // SAFETY: handle, ray and options with their list live, and there is room for `capacity` answers.
            unsafe { (Self::FUNCTIONS.intersect_all_with)(self.as_ptr(), &ray, &options, hits, capacity, needed) }
        })
    }

    /// Finds the closest hit of many rays. Wraps `rw_scene_intersect_batch`.
    fn intersect_batch(&self, rays: &Rays<'_>) -> Result<Hits> {
        self.intersect_batch_with(rays, &QueryOptions::new())
    }

    /// [`intersect_batch`](RayQueries::intersect_batch) with options. Wraps `rw_scene_intersect_batch`.
    fn intersect_batch_with(&self, rays: &Rays<'_>, options: &QueryOptions<'_>) -> Result<Hits> {
        let mut hits = Hits::with_len(rays.len());
        hits.invalid_rays = self.intersect_batch_into(rays, hits.all_mut(), options)?;
        Ok(hits)
    }

    /// Finds the closest hit of many rays and writes the answers into the caller's slices. Returns how many of the rays
    /// held a NaN. Wraps `rw_scene_intersect_batch`.
    ///
    /// # Errors
    /// [`Error::Length`] when a slice is not as long as there are rays.
    fn intersect_batch_into(&self, rays: &Rays<'_>, mut hits: HitsMut<'_>, options: &QueryOptions<'_>) -> Result<u64> {
        let hits = hits.raw(rays.len())?;
        let mut invalid_rays = 0;
        options.with_raw(&mut invalid_rays, |options| {
            // SAFETY: the handle lives; rays are borrowed and outputs exclusively borrowed through the call, and each
            // output has room for one answer per ray.
            check(unsafe { (Self::FUNCTIONS.intersect_batch)(self.as_ptr(), &rays.raw(), &hits, options) })
        })?;
        Ok(invalid_rays)
    }

    /// Tells for many rays whether they hit anything. Wraps `rw_scene_occluded_batch`.
    fn occluded_batch(&self, rays: &Rays<'_>) -> Result<Vec<bool>> {
        self.occluded_batch_with(rays, &QueryOptions::new())
    }

    /// [`occluded_batch`](RayQueries::occluded_batch) with options. Wraps `rw_scene_occluded_batch`.
    fn occluded_batch_with(&self, rays: &Rays<'_>, options: &QueryOptions<'_>) -> Result<Vec<bool>> {
        let mut flags = vec![0_u8; rays.len()];
        self.occluded_batch_into(rays, &mut flags, options)?;
        Ok(flags.into_iter().map(|flag| flag != 0).collect())
    }

    /// Tells for many rays whether they hit anything, 1 or 0, in the caller's slice of `u8`, `u32` or `u64`. Returns how
    /// many of the rays held a NaN. Wraps `rw_scene_occluded_batch`.
    ///
    /// # Errors
    /// [`Error::Length`] when the slice is not as long as there are rays.
    fn occluded_batch_into<T: Flag>(
        &self,
        rays: &Rays<'_>,
        occluded: &mut [T],
        options: &QueryOptions<'_>,
    ) -> Result<u64> {
        let occluded = Output::flags(occluded).raw("output occluded", rays.len())?;
        let mut invalid_rays = 0;
        options.with_raw(&mut invalid_rays, |options| {
            // SAFETY: as in `intersect_batch_into`.
            check(unsafe { (Self::FUNCTIONS.occluded_batch)(self.as_ptr(), &rays.raw(), &occluded, options) })
        })?;
        Ok(invalid_rays)
    }

    /// Finds every hit of many rays; as [`intersect_all`](RayQueries::intersect_all) for each. Wraps
    /// `rw_scene_intersect_all_batch`.
    fn intersect_all_batch(&self, rays: &Rays<'_>) -> Result<AllHits> {
        self.intersect_all_batch_with(rays, &QueryOptions::new())
    }

    /// [`intersect_all_batch`](RayQueries::intersect_all_batch) with options. Wraps `rw_scene_intersect_all_batch`.
    fn intersect_all_batch_with(&self, rays: &Rays<'_>, options: &QueryOptions<'_>) -> Result<AllHits> {
        let mut offsets = vec![0_u64; rays.len() + 1];
        // A first guess; when it was too small, the library has said how much room it takes.
        let mut hits = Hits::with_len(2 * rays.len());
        loop {
            let mut invalid_rays = 0;
            match all_batch(self, rays, &mut offsets, hits.all_mut(), options, &mut invalid_rays) {
                Ok(found) => {
                    hits.truncate(found as usize);
                    hits.invalid_rays = invalid_rays;
                    return Ok(AllHits { offsets, hits });
                }
                Err(Error::Capacity { needed, capacity }) if needed > capacity => {
                    hits = Hits::with_len(needed as usize);
                }
                Err(error) => return Err(error),
            }
        }
    }

    /// Finds every hit of many rays and writes the answers into the caller's slices, which all have the same length of
    /// their choice; without any slice only the offsets are written. Returns the number of hits. Wraps
    /// `rw_scene_intersect_all_batch`.
    ///
    /// # Errors
    /// [`Error::Length`] when `offsets` has not one element more than there are rays or the slices are not equally long;
    /// [`Error::Capacity`] when there are more hits than room. The offsets are written then, and no hit.
    fn intersect_all_batch_into(
        &self,
        rays: &Rays<'_>,
        offsets: &mut [u64],
        hits: HitsMut<'_>,
        options: &QueryOptions<'_>,
    ) -> Result<u64> {
        all_batch(self, rays, offsets, hits, options, &mut 0)
    }

    /// All structures as the decision saw them. Wraps `rw_scene_candidate_count` and `rw_scene_get_candidate`.
    fn candidates(&self) -> Result<Vec<Candidate>> {
        let mut count = 0;
        // SAFETY: the handle lives, and the place lives through the call.
        check(unsafe { (Self::FUNCTIONS.candidate_count)(self.as_ptr(), &mut count) })?;
        let one = |index| {
            let mut raw = Candidate::blank();
            // SAFETY: the handle lives, and `raw` says how large it is.
            check(unsafe { (Self::FUNCTIONS.get_candidate)(self.as_ptr(), index, &mut raw) })?;
            // SAFETY: the library has just filled it.
            Ok(unsafe { Candidate::from_raw(&raw) })
        };
        (0..count).map(one).collect()
    }

    /// Why this structure, for people. Wraps `rw_scene_explain`.
    fn explain(&self) -> Result<String> {
        explain(self, sys::RW_FORMAT_TEXT)
    }

    /// Why this structure, as JSON. Wraps `rw_scene_explain`.
    fn explain_json(&self) -> Result<String> {
        explain(self, sys::RW_FORMAT_JSON)
    }
}

/// Asks for all hits of one ray, by a function of (place for hits, capacity, place for the number needed).
fn all_of_ray(ask: impl Fn(*mut sys::rw_hit, u64, &mut u64) -> i32) -> Result<Vec<Hit>> {
    let mut hits = vec![sys::rw_hit::default(); 16];
    loop {
        let (capacity, mut needed) = (hits.len() as u64, 0);
        let status = ask(hits.as_mut_ptr(), capacity, &mut needed);
        if status == sys::RW_ERROR_CAPACITY && needed > capacity {
            hits.resize(needed as usize, sys::rw_hit::default());
            continue;
        }
        check(status)?;
        hits.truncate(needed as usize);
        return Ok(hits.iter().filter_map(Hit::from_raw).collect());
    }
}

fn all_batch<A: Asked + ?Sized>(
    asked: &A,
    rays: &Rays<'_>,
    offsets: &mut [u64],
    mut hits: HitsMut<'_>,
    options: &QueryOptions<'_>,
    invalid_rays: &mut u64,
) -> Result<u64> {
    same_length("offsets", rays.len() + 1, offsets.len())?;
    let room = hits.common_len()?;
    let capacity = room.unwrap_or(0);
    let raw_hits = hits.raw(capacity)?;
    let raw_hits = if room.is_some() { &raw_hits } else { std::ptr::null() };
    let mut needed = 0;
    options.with_raw(invalid_rays, |options| {
        let (rays, offsets, capacity) = (rays.raw(), offsets.as_mut_ptr(), capacity as u64);
        // SAFETY: as in `intersect_batch_into`; there is room for one offset more than rays and `capacity` answers.
        let status = unsafe {
            (A::FUNCTIONS.intersect_all_batch)(asked.as_ptr(), &rays, offsets, raw_hits, capacity, &mut needed, options)
        };
        if status == sys::RW_ERROR_CAPACITY {
            return Err(Error::Capacity { needed, capacity });
        }
        check(status)
    })?;
    Ok(needed)
}

fn explain<A: Asked + ?Sized>(asked: &A, format: i32) -> Result<String> {
    crate::text::read(|buffer, capacity, needed| {
        // SAFETY: the handle lives; the buffer has room for `capacity` bytes.
        unsafe { (A::FUNCTIONS.explain)(asked.as_ptr(), format, buffer, capacity, needed) }
    })
}

/// The C functions behind the questions. The trait is public so that it can stand above [`RayQueries`], in a private
/// module so that nobody else can implement it.
pub(crate) mod functions {
    use std::os::raw::c_char;

    use raywise_sys as sys;

    /// The C functions that ask a handle of type `R`.
    #[allow(missing_debug_implementations)]
    pub struct Functions<R> {
        pub(crate) intersect: unsafe extern "C" fn(*const R, *const sys::rw_ray, *mut sys::rw_hit) -> i32,
        pub(crate) occluded: unsafe extern "C" fn(*const R, *const sys::rw_ray, *mut i32) -> i32,
        pub(crate) intersect_all:
            unsafe extern "C" fn(*const R, *const sys::rw_ray, *mut sys::rw_hit, u64, *mut u64) -> i32,
        pub(crate) intersect_with:
            unsafe extern "C" fn(*const R, *const sys::rw_ray, *const sys::rw_ray_options, *mut sys::rw_hit) -> i32,
        pub(crate) occluded_with:
            unsafe extern "C" fn(*const R, *const sys::rw_ray, *const sys::rw_ray_options, *mut i32) -> i32,
        pub(crate) intersect_all_with: unsafe extern "C" fn(
            *const R,
            *const sys::rw_ray,
            *const sys::rw_ray_options,
            *mut sys::rw_hit,
            u64,
            *mut u64,
        ) -> i32,
        pub(crate) intersect_batch: unsafe extern "C" fn(
            *const R,
            *const sys::rw_rays,
            *const sys::rw_hits,
            *const sys::rw_query_options,
        ) -> i32,
        pub(crate) occluded_batch: unsafe extern "C" fn(
            *const R,
            *const sys::rw_rays,
            *const sys::rw_output,
            *const sys::rw_query_options,
        ) -> i32,
        pub(crate) intersect_all_batch: unsafe extern "C" fn(
            *const R,
            *const sys::rw_rays,
            *mut u64,
            *const sys::rw_hits,
            u64,
            *mut u64,
            *const sys::rw_query_options,
        ) -> i32,
        pub(crate) candidate_count: unsafe extern "C" fn(*const R, *mut u32) -> i32,
        pub(crate) get_candidate: unsafe extern "C" fn(*const R, u32, *mut sys::rw_candidate) -> i32,
        pub(crate) explain: unsafe extern "C" fn(*const R, i32, *mut c_char, u64, *mut u64) -> i32,
    }

    /// Something that C functions can be asked about.
    pub trait Asked {
        /// The type of the handle.
        type Raw;
        /// The functions that take it.
        const FUNCTIONS: Functions<Self::Raw>;
        /// The handle, alive as long as `self`.
        fn as_ptr(&self) -> *const Self::Raw;
    }
}

impl<A: Asked> RayQueries for A {}

/// The table of one handle type, from the C names.
macro_rules! functions_of {
    ($intersect:ident, $occluded:ident, $all:ident, $with:ident, $occluded_with:ident, $all_with:ident,
     $batch:ident, $occluded_batch:ident, $all_batch:ident, $count:ident, $candidate:ident, $explain:ident) => {
        $crate::questions::functions::Functions {
            intersect: raywise_sys::$intersect,
            occluded: raywise_sys::$occluded,
            intersect_all: raywise_sys::$all,
            intersect_with: raywise_sys::$with,
            occluded_with: raywise_sys::$occluded_with,
            intersect_all_with: raywise_sys::$all_with,
            intersect_batch: raywise_sys::$batch,
            occluded_batch: raywise_sys::$occluded_batch,
            intersect_all_batch: raywise_sys::$all_batch,
            candidate_count: raywise_sys::$count,
            get_candidate: raywise_sys::$candidate,
            explain: raywise_sys::$explain,
        }
    };
}
pub(crate) use functions_of;
