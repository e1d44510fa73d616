//! Committed scenes.

use std::sync::Arc;

use raywise_sys as sys;

use crate::builder::KeepAlive;
use crate::handle::Handle;
use crate::library::{check, size_of_struct};
use crate::{CommitOptions, GridStatistics, Result, SceneStatistics, Triangles, ViewOptions};

/// Geometry with the structure chosen for it (`rw_scene`). It never changes, and any number of threads may ask it at the
/// same time. A [`view`](Scene::view) of a scene is a scene as well. Cloning shares the scene (`rw_scene_retain`).
///
/// ```
/// fn can_be_shared<T: Send + Sync + Clone>() {}
/// can_be_shared::<raywise::Scene>();
/// ```
#[derive(Clone, Debug)]
pub struct Scene {
    // Released first: the scene reads what is kept.
    handle: Handle<sys::rw_scene>,
    _keep: Arc<[KeepAlive]>,
}

/// The box around all triangles that can be hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The least coordinates; infinite in an empty scene.
    pub lower: [f64; 3],
    /// The greatest coordinates; minus infinite in an empty scene.
    pub upper: [f64; 3],
}

impl Bounds {
    /// Whether there is nothing inside.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        (0..3).any(|axis| self.lower[axis] > self.upper[axis])
    }
}

impl Scene {
    pub(crate) fn new(handle: Handle<sys::rw_scene>, keep: Vec<KeepAlive>) -> Self {
        Scene { handle, _keep: keep.into() }
    }

    pub(crate) fn as_ptr(&self) -> *const sys::rw_scene {
        self.handle.as_ptr()
    }

    /// Tells the box around all triangles that can be hit. Wraps `rw_scene_bounds`.
    pub fn bounds(&self) -> Result<Bounds> {
        let mut bounds = Bounds { lower: [0.0; 3], upper: [0.0; 3] };
        // SAFETY: the scene lives, and both places have room for three numbers.
        check(unsafe { sys::rw_scene_bounds(self.as_ptr(), bounds.lower.as_mut_ptr(), bounds.upper.as_mut_ptr()) })?;
        Ok(bounds)
    }

    /// Tells what is in the scene and what it has cost. Wraps `rw_scene_get_statistics`.
    pub fn statistics(&self) -> Result<SceneStatistics> {
        let mut raw = sys::rw_scene_statistics {
            struct_size: size_of_struct::<sys::rw_scene_statistics>(),
            ..sys::rw_scene_statistics::default()
        };
        // SAFETY: the scene lives, and `raw` says how large it is.
        check(unsafe { sys::rw_scene_get_statistics(self.as_ptr(), &mut raw) })?;
        // SAFETY: the library has just filled it, and its texts are constants.
        Ok(unsafe { SceneStatistics::from_raw(&raw) })
    }

    /// Tells the statistics of the grid in use. Wraps `rw_scene_get_grid_statistics`.
    ///
    /// # Errors
    /// [`Status::WRONG_STRUCTURE`](crate::Status::WRONG_STRUCTURE) when the structure is not the uniform grid.
    pub fn grid_statistics(&self) -> Result<GridStatistics> {
        let mut raw = sys::rw_grid_statistics {
            struct_size: size_of_struct::<sys::rw_grid_statistics>(),
            ..sys::rw_grid_statistics::default()
        };
        // SAFETY: the scene lives, and `raw` says how large it is.
        check(unsafe { sys::rw_scene_get_grid_statistics(self.as_ptr(), &mut raw) })?;
        Ok(GridStatistics::from_raw(&raw))
    }

    /// Makes a scene of the same triangles at new places, as for the next frame of meshes that deform. The structure is this
    /// scene's with new boxes where it has such a form (`bvh`) and that pays, which takes a fraction of building; else it is
    /// built anew. What was said before this scene's commit holds for the new one too; this one stays as it is. Wraps
    /// `rw_scene_refit`.
    ///
    /// `meshes`: all of the scene's, in the order of adding, each with as many triangles as before, copied;
    /// [`Triangles::moved`] keeps the indices.
    ///
    /// ```
    /// use raywise::{Ray, SceneBuilder, Triangles};
    /// let mut builder = SceneBuilder::new()?;
    /// builder.add_triangles(&[[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0_u32, 1, 2]])?;
    /// let scene = builder.commit()?;
    /// let lifted = [[0.0_f32, 0.0, 0.5], [1.0, 0.0, 0.5], [0.0, 1.0, 0.5]];
    /// let next = scene.refit(&[Triangles::moved(&lifted, 1)])?;
    /// let hit = next.intersect(&Ray::new([0.2, 0.2, 1.0], [0.0, 0.0, -1.0]))?;
    /// assert_eq!(hit.map(|hit| hit.t), Some(0.5));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`refit_with`](Scene::refit_with).
    pub fn refit(&self, meshes: &[Triangles<'_>]) -> Result<Scene> {
        self.refit_with(meshes, CommitOptions::new())
    }

    /// [`refit`](Scene::refit) with a number of threads, progress, cancelling or the host's threads, or with a
    /// [policy](crate::RefitPolicy): where all is built anew, numbers of triangles and meshes may change. From the second
    /// frame on the memory of dropped scenes is kept for the next ones. Wraps `rw_scene_refit`.
    ///
    /// ```
    /// use raywise::{CommitOptions, RefitPolicy, SceneBuilder, Triangles};
    /// let mut builder = SceneBuilder::new()?;
    /// builder.add_triangles(&[[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0_u32, 1, 2]])?;
    /// let mut scene = builder.commit()?;
    /// for frame in 1..4 {
    ///     let corner = [frame as f32, 0.0, 0.0];
    ///     let vertices = [[0.0, 0.0, 0.0], corner, [0.0, 1.0, 0.0]];
    ///     let indices = vec![[0_u32, 1, 2]; frame]; // one more in each frame
    ///     let options = CommitOptions::new().refit(RefitPolicy::Never);
    ///     scene = scene.refit_with(&[Triangles::new(&vertices, &indices)], options)?;
    ///     assert_eq!(scene.statistics()?.triangle_count, frame as u64);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Status::INVALID_ARGUMENT`](crate::Status::INVALID_ARGUMENT) for numbers that differ, `NOT_FINITE`,
    /// `COORDINATE_RANGE`, `INDEX_OUT_OF_RANGE`, `CANCELLED`, `MEMORY_LIMIT`, `OUT_OF_MEMORY` or `HOST_PARALLEL`.
    ///
    /// # Panics
    /// When the caller's closures panic; the build is stopped first.
    pub fn refit_with(&self, meshes: &[Triangles<'_>], commit: CommitOptions<'_>) -> Result<Scene> {
        let meshes: Vec<sys::rw_triangles> = meshes.iter().map(Triangles::raw).collect();
        // The library counts meshes in 32 bits; more than that would not fit into memory.
        let (first, count) = (meshes.as_ptr(), meshes.len() as u32);
        let handle = commit.with_raw(|commit| {
            // SAFETY: the scene lives; the meshes are borrowed through the call, in which all that is kept of them is
            // copied, the indices that this scene reads in place included.
            Handle::create(|scene| unsafe { sys::rw_scene_refit(self.as_ptr(), first, count, commit, scene) })
        })?;
        Ok(Scene::new(handle, Vec::new()))
    }

    /// Makes a scene of the same geometry, seen from a point (camera, point light) or along a direction (sun), and builds a
    /// structure for it when that pays. Rays that start at the point, or run along the direction, can be answered faster;
    /// all others are answered as by this scene, and either way with the same bits. A view of a view is one of the scene
    /// behind it, and refitted it is the same view of that scene, refitted. Wraps `rw_scene_view`.
    ///
    /// # Errors
    /// As [`view_with`](Scene::view_with).
    pub fn view(&self, options: &ViewOptions) -> Result<Scene> {
        self.view_with(options, CommitOptions::new())
    }

    /// [`view`](Scene::view) with a number of threads, progress, cancelling or the host's threads. Wraps
    /// `rw_scene_view`.
    ///
    /// # Errors
    /// [`Status::RAY_COUNT`](crate::Status::RAY_COUNT), `UNKNOWN_STRUCTURE`, `NOT_FINITE` (origin or direction),
    /// `MEMORY_LIMIT`, `CANCELLED`, `OUT_OF_MEMORY`, `HOST_PARALLEL` or `INVALID_ARGUMENT`.
    ///
    /// # Panics
    /// When the caller's closures panic; the build is stopped first.
    pub fn view_with(&self, options: &ViewOptions, commit: CommitOptions<'_>) -> Result<Scene> {
        let handle = options.with_raw(|options| {
            commit.with_raw(|commit| {
                // SAFETY: the scene lives; the options live through the call.
                Handle::create(|view| unsafe { sys::rw_scene_view(self.as_ptr(), options, commit, view) })
            })
        })?;
        // The arrays that the scene reads in place have to outlive the view as well.
        Ok(Scene { handle, _keep: Arc::clone(&self._keep) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_is_empty_when_it_is_inside_out() {
        let infinity = f64::INFINITY;
        assert!(Bounds { lower: [infinity; 3], upper: [-infinity; 3] }.is_empty());
        assert!(!Bounds { lower: [1.0; 3], upper: [1.0; 3] }.is_empty());
    }
}
