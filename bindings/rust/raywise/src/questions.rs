//! What a scene can be asked, one that is a view as well.

use raywise_sys as sys;

use crate::hits::Output;
use crate::library::check;
use crate::rays::same_length;
use crate::{
    AllHits, Candidate, Error, Flag, Hit, Hits, HitsMut, Precision, QueryOptions, Ray, RayOptions, Rays, Result, Scene,
};

/// Questions, from any number of threads at a time.
///
/// The bits of an answer do not depend on the structure, on the call (one ray, many, scene or view), on the order or on
/// the number of threads.
impl Scene {
    /// Finds the closest hit of one ray. Wraps `rw_scene_intersect`; `rw_scene_intersect_f32` for a `Ray<f32>`.
    pub fn intersect<T: Precision>(&self, ray: &Ray<T>) -> Result<Option<Hit<T>>> {
        closest(self, ray, std::ptr::null())
    }

    /// Tells whether a ray hits anything. Wraps `rw_scene_occluded`; `rw_scene_occluded_f32` for a `Ray<f32>`.
    pub fn occluded<T: Precision>(&self, ray: &Ray<T>) -> Result<bool> {
        any(self, ray, std::ptr::null())
    }

    /// Finds every hit of one ray, closest first. A surface that is crossed at an edge or a corner counts once; the first
    /// hit is the one that [`intersect`](Scene::intersect) finds. Wraps `rw_scene_intersect_all`;
    /// `rw_scene_intersect_all_f32` for a `Ray<f32>`.
    pub fn intersect_all<T: Precision>(&self, ray: &Ray<T>) -> Result<Vec<Hit<T>>> {
        all(self, ray, std::ptr::null())
    }

    /// Finds the closest hit of a ray that skips triangles. Wraps `rw_scene_intersect`.
    ///
    /// # Errors
    /// [`Status::INDEX_OUT_OF_RANGE`](crate::Status::INDEX_OUT_OF_RANGE) for a triangle that is not there.
    pub fn intersect_with<T: Precision>(&self, ray: &Ray<T>, options: &RayOptions<'_>) -> Result<Option<Hit<T>>> {
        closest(self, ray, &options.raw()?)
    }

    /// Tells whether a ray that skips triangles hits any other. Wraps `rw_scene_occluded`.
    ///
    /// # Errors
    /// As [`intersect_with`](Scene::intersect_with).
    pub fn occluded_with<T: Precision>(&self, ray: &Ray<T>, options: &RayOptions<'_>) -> Result<bool> {
        any(self, ray, &options.raw()?)
    }

    /// Finds every hit of a ray that skips triangles, closest first. Wraps `rw_scene_intersect_all`.
    ///
    /// # Errors
    /// As [`intersect_with`](Scene::intersect_with).
    pub fn intersect_all_with<T: Precision>(&self, ray: &Ray<T>, options: &RayOptions<'_>) -> Result<Vec<Hit<T>>> {
        all(self, ray, &options.raw()?)
    }

    /// Tells the normal of the triangle that was hit: along `(v1 - v0) x (v2 - v0)`, right-handed, of unit length. Wraps
    /// `rw_scene_normal`; `rw_scene_normal_f32` for a `Hit<f32>`.
    ///
    /// # Errors
    /// [`Status::INDEX_OUT_OF_RANGE`](crate::Status::INDEX_OUT_OF_RANGE) for a triangle that is not there,
    /// `INVALID_ARGUMENT` for one that no ray hits.
    pub fn normal<T: Precision>(&self, hit: &Hit<T>) -> Result<[T; 3]> {
        let mut normal = [T::ZERO; 3];
        // SAFETY: the scene lives, and there is room for three numbers.
        check(unsafe { (T::NORMAL)(self.as_ptr(), &T::raw_hit(hit), normal.as_mut_ptr()) })?;
        Ok(normal)
    }

    /// Finds the closest hit of many rays. Wraps `rw_scene_intersect_batch`.
    pub fn intersect_batch(&self, rays: &Rays<'_>) -> Result<Hits> {
        self.intersect_batch_with(rays, &QueryOptions::new())
    }

    /// [`intersect_batch`](Scene::intersect_batch) with options. Wraps `rw_scene_intersect_batch`.
    pub fn intersect_batch_with(&self, rays: &Rays<'_>, options: &QueryOptions<'_>) -> Result<Hits> {
        let mut hits = Hits::with_len(rays.len());
        hits.invalid_rays = self.intersect_batch_into(rays, hits.all_mut(), options)?;
        Ok(hits)
    }

    /// Finds the closest hit of many rays and writes the answers into the caller's slices. Returns how many of the rays
    /// held a NaN. Wraps `rw_scene_intersect_batch`.
    ///
    /// # Errors
    /// [`Error::Length`] when a slice is not as long as there are rays.
    pub fn intersect_batch_into(
        &self,
        rays: &Rays<'_>,
        mut hits: HitsMut<'_>,
        options: &QueryOptions<'_>,
    ) -> Result<u64> {
        let hits = hits.raw(rays.len())?;
        let mut invalid_rays = 0;
        options.with_raw(&mut invalid_rays, |options| {
            // SAFETY: the handle lives; rays are borrowed and outputs exclusively borrowed through the call, and each
            // output has room for one answer per ray.
            check(unsafe { sys::rw_scene_intersect_batch(self.as_ptr(), &rays.raw(), &hits, options) })
        })?;
        Ok(invalid_rays)
    }

    /// Tells for many rays whether they hit anything. Wraps `rw_scene_occluded_batch`.
    pub fn occluded_batch(&self, rays: &Rays<'_>) -> Result<Vec<bool>> {
        self.occluded_batch_with(rays, &QueryOptions::new())
    }

    /// [`occluded_batch`](Scene::occluded_batch) with options. Wraps `rw_scene_occluded_batch`.
    pub fn occluded_batch_with(&self, rays: &Rays<'_>, options: &QueryOptions<'_>) -> Result<Vec<bool>> {
        let mut flags = vec![0_u8; rays.len()];
        self.occluded_batch_into(rays, &mut flags, options)?;
        Ok(flags.into_iter().map(|flag| flag != 0).collect())
    }

    /// Tells for many rays whether they hit anything, 1 or 0, in the caller's slice of `u8`, `u32` or `u64`. Returns how
    /// many of the rays held a NaN. Wraps `rw_scene_occluded_batch`.
    ///
    /// # Errors
    /// [`Error::Length`] when the slice is not as long as there are rays.
    pub fn occluded_batch_into<T: Flag>(
        &self,
        rays: &Rays<'_>,
        occluded: &mut [T],
        options: &QueryOptions<'_>,
    ) -> Result<u64> {
        let occluded = Output::flags(occluded).raw("output occluded", rays.len())?;
        let mut invalid_rays = 0;
        options.with_raw(&mut invalid_rays, |options| {
            // SAFETY: as in `intersect_batch_into`.
            check(unsafe { sys::rw_scene_occluded_batch(self.as_ptr(), &rays.raw(), &occluded, options) })
        })?;
        Ok(invalid_rays)
    }

    /// Finds every hit of many rays; as [`intersect_all`](Scene::intersect_all) for each. Wraps
    /// `rw_scene_intersect_all_batch`.
    pub fn intersect_all_batch(&self, rays: &Rays<'_>) -> Result<AllHits> {
        self.intersect_all_batch_with(rays, &QueryOptions::new())
    }

    /// [`intersect_all_batch`](Scene::intersect_all_batch) with options. Wraps `rw_scene_intersect_all_batch`.
    pub fn intersect_all_batch_with(&self, rays: &Rays<'_>, options: &QueryOptions<'_>) -> Result<AllHits> {
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
    pub fn intersect_all_batch_into(
        &self,
        rays: &Rays<'_>,
        offsets: &mut [u64],
        hits: HitsMut<'_>,
        options: &QueryOptions<'_>,
    ) -> Result<u64> {
        all_batch(self, rays, offsets, hits, options, &mut 0)
    }

    /// All structures as the decision saw them. Wraps `rw_scene_candidate_count` and `rw_scene_get_candidate`.
    pub fn candidates(&self) -> Result<Vec<Candidate>> {
        let mut count = 0;
        // SAFETY: the handle lives, and the place lives through the call.
        check(unsafe { sys::rw_scene_candidate_count(self.as_ptr(), &mut count) })?;
        let one = |index| {
            let mut raw = Candidate::blank();
            // SAFETY: the handle lives, and `raw` says how large it is.
            check(unsafe { sys::rw_scene_get_candidate(self.as_ptr(), index, &mut raw) })?;
            // SAFETY: the library has just filled it.
            Ok(unsafe { Candidate::from_raw(&raw) })
        };
        (0..count).map(one).collect()
    }

    /// Why this structure, for people. Wraps `rw_scene_explain`.
    pub fn explain(&self) -> Result<String> {
        explain(self, sys::RW_FORMAT_TEXT)
    }

    /// Why this structure, as JSON. Wraps `rw_scene_explain`.
    pub fn explain_json(&self) -> Result<String> {
        explain(self, sys::RW_FORMAT_JSON)
    }
}

/// `options`: those of the ray, which live through the call, or null.
fn closest<T: Precision>(scene: &Scene, ray: &Ray<T>, options: *const sys::rw_ray_options) -> Result<Option<Hit<T>>> {
    let mut hit = T::Hit::default();
    // SAFETY: the scene lives; ray, options with their list, and hit live through the call.
    check(unsafe { (T::INTERSECT)(scene.as_ptr(), &T::raw_ray(ray), options, &mut hit) })?;
    Ok(T::hit(&hit))
}

fn any<T: Precision>(scene: &Scene, ray: &Ray<T>, options: *const sys::rw_ray_options) -> Result<bool> {
    let mut occluded = 0;
    // SAFETY: as in `closest`.
    check(unsafe { (T::OCCLUDED)(scene.as_ptr(), &T::raw_ray(ray), options, &mut occluded) })?;
    Ok(occluded != 0)
}

fn all<T: Precision>(scene: &Scene, ray: &Ray<T>, options: *const sys::rw_ray_options) -> Result<Vec<Hit<T>>> {
    let ray = T::raw_ray(ray);
    let mut hits = vec![T::Hit::default(); 16];
    loop {
        let (capacity, mut needed) = (hits.len() as u64, 0);
        // SAFETY: as in `closest`, and there is room for `capacity` answers.
        let status =
            unsafe { (T::INTERSECT_ALL)(scene.as_ptr(), &ray, options, hits.as_mut_ptr(), capacity, &mut needed) };
        if status == sys::RW_ERROR_CAPACITY && needed > capacity {
            hits.resize(needed as usize, T::Hit::default());
            continue;
        }
        check(status)?;
        hits.truncate(needed as usize);
        return Ok(hits.iter().filter_map(T::hit).collect());
    }
}

fn all_batch(
    scene: &Scene,
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
            sys::rw_scene_intersect_all_batch(scene.as_ptr(), &rays, offsets, raw_hits, capacity, &mut needed, options)
        };
        if status == sys::RW_ERROR_CAPACITY {
            return Err(Error::Capacity { needed, capacity });
        }
        check(status)
    })?;
    Ok(needed)
}

fn explain(scene: &Scene, format: i32) -> Result<String> {
    crate::text::read(|buffer, capacity, needed| {
        // SAFETY: the handle lives; the buffer has room for `capacity` bytes.
        unsafe { sys::rw_scene_explain(scene.as_ptr(), format, buffer, capacity, needed) }
    })
}
