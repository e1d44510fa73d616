//! What the benchmark of ray tracing crates is made of: scenes that `raywise_bench --export` wrote, and one subject for each
//! crate.

mod peers;
mod raywise_subject;
mod scene;

pub use peers::{BvhCrate, ObvhsBvh2, ObvhsCwBvh, Parry};
pub use raywise_subject::Raywise;
pub use scene::{scenes_in, Ray, Scene, RAY_KINDS};

/// A structure over a scene that can be asked ray by ray.
pub trait Subject: Sized {
    const NAME: &'static str;
    /// A ray in the crate's own form, made before the clock starts.
    type OwnRay;

    fn build(scene: &Scene) -> Self;
    fn prepare(ray: &Ray) -> Self::OwnRay;
    fn closest(&self, ray: &Self::OwnRay) -> bool;
    fn any(&self, ray: &Self::OwnRay) -> bool;
}
