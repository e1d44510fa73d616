//! Ray queries against triangle meshes, with a structure chosen by measurement.
//!
//! raywise knows what each structure costs on this machine and how many rays are coming, and takes what answers soonest.
//! The choice changes how long an answer takes and never a bit of it.
//!
//! ```
//! use raywise::{ExpectedRays, Ray, RayKind, Rays, SceneBuilder};
//!
//! // A square of two triangles at z = 0.
//! let vertices = [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
//! let triangles = [[0_u32, 1, 2], [0, 2, 3]];
//!
//! let mut builder = SceneBuilder::new()?;
//! builder.add_triangles(&vertices, &triangles)?;
//! builder.expect_rays(&ExpectedRays::new(10_000).kind(RayKind::Camera))?;
//! let scene = builder.commit()?;
//!
//! // One ray.
//! let hit = scene.intersect(&Ray::new([0.5, 0.25, 2.0], [0.0, 0.0, -1.0]))?.expect("the square is below");
//! assert_eq!((hit.t, hit.primitive, scene.normal(&hit)?), (2.0, 0, [0.0, 0.0, 1.0]));
//!
//! // Many rays: one origin for all, one direction each.
//! let directions = [[0.0_f32, 0.0, -1.0], [0.0, 0.0, 1.0]];
//! let hits = scene.intersect_batch(&Rays::new([0.5, 0.25, 2.0], &directions)?)?;
//! assert!(hits.get(0).is_some() && hits.get(1).is_none());
//!
//! // Why this structure?
//! println!("{}", scene.explain()?);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Where things are
//!
//! * [`SceneBuilder`] is filled and committed; [`Scene`] is what comes out and has the questions: closest hit,
//!   any hit, all hits, for one ray and for many. [`Scene::view`] makes a scene that is seen from one place.
//! * [`Ray`] and [`Hit`] are of `f64`, or of `f32`: [`Precision`].
//! * [`RayOptions::skip`] and [`Rays::with_skip`] name triangles that single rays pass through, e.g. those they start
//!   on: there are no epsilons.
//! * [`OneShot`] answers one batch and keeps nothing.
//! * [`Profile`] holds the constants that decide; [`Scene::candidates`] and [`Scene::explain`] tell how.
//!
//! Each item names the function of the C library behind it; `raywise.h` holds the contract.
//!
//! # Threads
//!
//! Scenes, views, profiles and meshes can be shared and sent freely. A batch uses as many threads as the process may use,
//! or as many as [`QueryOptions::threads`] allows, or the host's own ([`QueryOptions::parallel_for`]).

#![deny(missing_docs)]
#![warn(missing_debug_implementations)]

mod arrays;
mod builder;
mod candidate;
mod element;
mod error;
mod expected;
mod handle;
mod hit;
mod hits;
mod library;
mod memory;
mod mesh;
mod once;
mod options;
mod parallel;
mod precision;
mod primitive_id;
mod profile;
mod questions;
mod ray;
mod rays;
mod scene;
mod skip;
mod statistics;
mod status;
mod structures;
mod text;
mod triangles;
mod view;
mod workspace;

pub use arrays::{Ids, Indices, Scalars, Vectors};
pub use builder::{CommitError, SceneBuilder};
pub use candidate::Candidate;
pub use element::{Flag, Float, Index};
pub use error::{Error, Result};
pub use expected::{Effort, ExpectedRays, RayKind, Rule};
pub use hit::Hit;
pub use hits::{AllHits, Hits, HitsMut};
pub use library::{abi_version, version, Version, HEADER_VERSION};
pub use memory::{keep_memory, kept_memory};
pub use mesh::Mesh;
pub use once::OneShot;
pub use options::{CommitOptions, QueryOptions, RefitPolicy};
pub use parallel::ParallelFor;
pub use precision::Precision;
pub use primitive_id::PrimitiveId;
pub use profile::{LoadedProfile, Profile, ProfileInfo, ProfileSource, ProfileWarning};
pub use ray::Ray;
pub use rays::{PerRayNumber, PerRayVector, Rays};
pub use scene::{Bounds, Scene};
pub use skip::{PerEntryId, RayOptions, SkipLists};
pub use statistics::{GridStatistics, SceneStatistics};
pub use status::Status;
pub use structures::structures;
pub use triangles::{SharedTriangles, Triangles};
pub use view::ViewOptions;
pub use workspace::Workspace;
