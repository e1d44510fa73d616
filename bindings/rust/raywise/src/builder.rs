//! Scenes that are being filled.

use std::fmt;
use std::ptr;

use raywise_sys as sys;

use crate::arrays::{Indices, Vectors};
use crate::handle::Handle;
use crate::library::{check, ensure_abi};
use crate::triangles::Keep;
use crate::{
    text, CommitOptions, Effort, Error, ExpectedRays, Profile, Result, Rule, Scene, SharedTriangles, Triangles,
};

/// A scene that is being filled. Add meshes, say what is expected of it, and [`commit`](SceneBuilder::commit) it; from
/// then on it is a [`Scene`] and never changes.
///
/// ```
/// use raywise::{ExpectedRays, Ray, SceneBuilder};
/// let mut builder = SceneBuilder::new()?;
/// builder.add_triangles(&[[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0_u32, 1, 2]])?;
/// builder.expect_rays(&ExpectedRays::new(1000))?;
/// let scene = builder.commit()?;
/// let hit = scene.intersect(&Ray::new([0.2, 0.2, 1.0], [0.0, 0.0, -1.0]))?;
/// assert_eq!(hit.map(|hit| (hit.t, hit.primitive)), Some((1.0, 0)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// A builder is gone once it is committed:
///
/// ```compile_fail,E0382
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let builder = raywise::SceneBuilder::new()?;
/// let scene = builder.commit()?;
/// builder.commit()?; // used after it was moved
/// # Ok(())
/// # }
/// ```
///
/// ```compile_fail,E0382
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mut builder = raywise::SceneBuilder::new()?;
/// let scene = builder.commit()?;
/// builder.set_memory_limit(0)?; // a committed scene cannot be changed
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct SceneBuilder {
    // Released first: the scene reads what is kept.
    handle: Handle<sys::rw_scene>,
    keep: Vec<KeepAlive>,
}

/// What a scene reads in place.
#[derive(Clone)]
pub(crate) struct KeepAlive(#[allow(dead_code)] Keep);

impl fmt::Debug for KeepAlive {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str("..")
    }
}

/// A commit that failed, with the builder it was asked of. The scene in it is as it was and can be committed again.
#[derive(Debug, thiserror::Error)]
#[error("{error}")]
pub struct CommitError {
    /// What went wrong.
    pub error: Error,
    /// The scene, still to be committed.
    pub builder: SceneBuilder,
}

impl From<CommitError> for Error {
    fn from(failed: CommitError) -> Error {
        failed.error
    }
}

impl SceneBuilder {
    /// An empty scene, which decides with the constants that [`Profile::find`] finds. Wraps `rw_scene_create`.
    ///
    /// # Errors
    /// [`Error::AbiMismatch`] when the library is of another binary interface.
    pub fn new() -> Result<Self> {
        Self::create(ptr::null())
    }

    /// An empty scene which decides with the constants of `profile`. Wraps `rw_scene_create`.
    ///
    /// # Errors
    /// As [`SceneBuilder::new`].
    pub fn with_profile(profile: &Profile) -> Result<Self> {
        Self::create(profile.as_ptr())
    }

    fn create(profile: *const sys::rw_profile) -> Result<Self> {
        ensure_abi()?;
        // SAFETY: the profile is NULL or lives through the call, in which the scene takes a reference of its own.
        let handle = Handle::create(|scene| unsafe { sys::rw_scene_create(profile, scene) })?;
        Ok(SceneBuilder { handle, keep: Vec::new() })
    }

    /// Adds a mesh from vertices and the corners of its triangles, and returns its number, which hits call the geometry.
    /// The arrays are copied. Wraps `rw_scene_add_triangles`.
    ///
    /// # Errors
    /// [`Status::NOT_FINITE`](crate::Status::NOT_FINITE), `COORDINATE_RANGE`, `INDEX_OUT_OF_RANGE`, `TOO_MANY` or
    /// `OUT_OF_MEMORY`; the scene is then as it was.
    pub fn add_triangles<'a>(
        &mut self,
        vertices: impl Into<Vectors<'a>>,
        indices: impl Into<Indices<'a>>,
    ) -> Result<u32> {
        self.add(&Triangles::new(vertices, indices))
    }

    /// Adds a mesh and returns its number, which hits call the geometry. The arrays are copied. Wraps
    /// `rw_scene_add_triangles`.
    ///
    /// # Errors
    /// As [`add_triangles`](SceneBuilder::add_triangles).
    pub fn add(&mut self, triangles: &Triangles<'_>) -> Result<u32> {
        self.add_raw(&triangles.raw())
    }

    /// Adds a mesh that is read in place for as long as the scene lives, instead of being copied. Wraps
    /// `rw_scene_add_triangles` with `RW_TRIANGLES_SHARED`.
    ///
    /// # Errors
    /// As [`add_triangles`](SceneBuilder::add_triangles).
    pub fn add_shared(&mut self, triangles: SharedTriangles) -> Result<u32> {
        let (raw, keep) = triangles.into_parts();
        // Kept before the scene knows of it, so that there is no moment in which it is not.
        self.keep.push(KeepAlive(keep));
        let added = self.add_raw(&raw);
        if added.is_err() {
            self.keep.pop();
        }
        added
    }

    fn add_raw(&mut self, raw: &sys::rw_triangles) -> Result<u32> {
        let mut geometry = 0;
        // SAFETY: nobody else has the scene; the arrays are borrowed through the call, and kept beyond it when shared.
        check(unsafe { sys::rw_scene_add_triangles(self.handle.as_mut_ptr(), raw, &mut geometry) })?;
        Ok(geometry)
    }

    /// Says how many rays of which kind are coming. Wraps `rw_scene_set_expected_rays`.
    ///
    /// # Errors
    /// [`Status::RAY_COUNT`](crate::Status::RAY_COUNT) for no rays or an absurd number of them.
    pub fn expect_rays(&mut self, expected: &ExpectedRays<'_>) -> Result<&mut Self> {
        let scene = self.handle.as_mut_ptr();
        // SAFETY: nobody else has the scene; the sample is borrowed through the call.
        expected.with_raw(|raw| check(unsafe { sys::rw_scene_set_expected_rays(scene, raw) }))?;
        Ok(self)
    }

    /// Bounds the bytes that the structure may take; 0: no limit. Wraps `rw_scene_set_memory_limit`.
    pub fn set_memory_limit(&mut self, bytes: u64) -> Result<&mut Self> {
        // SAFETY: nobody else has the scene.
        check(unsafe { sys::rw_scene_set_memory_limit(self.handle.as_mut_ptr(), bytes) })?;
        Ok(self)
    }

    /// Forces a structure by name, one of [`structures`](crate::structures()); `None`: the library chooses again. Wraps
    /// `rw_scene_set_structure`.
    ///
    /// # Errors
    /// [`Status::UNKNOWN_STRUCTURE`](crate::Status::UNKNOWN_STRUCTURE).
    pub fn set_structure<'a>(&mut self, name: impl Into<Option<&'a str>>) -> Result<&mut Self> {
        let name = name.into().map(|name| text::to_c("structure", name)).transpose()?;
        let name = name.as_deref().map_or(ptr::null(), std::ffi::CStr::as_ptr);
        // SAFETY: nobody else has the scene; the name is NULL or a zero-terminated text that lives through the call.
        check(unsafe { sys::rw_scene_set_structure(self.handle.as_mut_ptr(), name) })?;
        Ok(self)
    }

    /// Sets how hard to think before choosing, and by which rule. Wraps `rw_scene_set_effort`.
    pub fn set_effort(&mut self, effort: Effort, rule: Rule) -> Result<&mut Self> {
        let (effort, seconds) = effort.raw();
        // SAFETY: nobody else has the scene.
        check(unsafe { sys::rw_scene_set_effort(self.handle.as_mut_ptr(), effort, rule.raw(), seconds) })?;
        Ok(self)
    }

    /// Chooses a structure, builds it and makes the scene fit for questions. Wraps `rw_scene_commit`.
    ///
    /// # Errors
    /// As [`commit_with`](SceneBuilder::commit_with).
    pub fn commit(self) -> Result<Scene, CommitError> {
        self.commit_with(CommitOptions::new())
    }

    /// [`commit`](SceneBuilder::commit) with a number of threads, progress, cancelling or the host's threads. Wraps
    /// `rw_scene_commit`.
    ///
    /// # Errors
    /// [`Status::CANCELLED`](crate::Status::CANCELLED), `MEMORY_LIMIT`, `OUT_OF_MEMORY` or `HOST_PARALLEL`. The error
    /// holds the builder, which can be committed again.
    ///
    /// # Panics
    /// When the caller's closures panic; the build is stopped first.
    pub fn commit_with(mut self, options: CommitOptions<'_>) -> Result<Scene, CommitError> {
        let scene = self.handle.as_mut_ptr();
        // SAFETY: nobody else has the scene; the options live through the call.
        match options.with_raw(|raw| check(unsafe { sys::rw_scene_commit(scene, raw) })) {
            Ok(()) => Ok(Scene::new(self.handle, self.keep)),
            Err(error) => Err(CommitError { error, builder: self }),
        }
    }
}
