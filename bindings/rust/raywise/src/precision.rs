//! The two precisions of single rays. C has a struct and a function for each; here they are one generic function.

use std::ops::{Add, Mul};

use raywise_sys as sys;

use crate::element::Float;
use crate::hit::id;
use crate::{Hit, Ray};

mod sealed {
    use super::{sys, Add, Float, Hit, Mul, Ray};

    pub type Scene = *const sys::rw_scene;
    pub type Options = *const sys::rw_ray_options;

    /// What C has for one precision.
    ///
    /// # Safety
    /// Each function has the contract of the C function for this precision.
    pub unsafe trait Raw: Float + Add<Output = Self> + Mul<Output = Self> {
        const ZERO: Self;
        const INFINITY: Self;
        type Ray;
        type Hit: Copy + Default;
        const INTERSECT: unsafe extern "C" fn(Scene, *const Self::Ray, Options, *mut Self::Hit) -> i32;
        const OCCLUDED: unsafe extern "C" fn(Scene, *const Self::Ray, Options, *mut i32) -> i32;
        const INTERSECT_ALL: unsafe extern "C" fn(
            Scene,
            *const Self::Ray,
            Options,
            *mut Self::Hit,
            u64,
            *mut u64,
        ) -> i32;
        const NORMAL: unsafe extern "C" fn(Scene, *const Self::Hit, *mut Self) -> i32;

        fn raw_ray(ray: &Ray<Self>) -> Self::Ray;
        fn raw_hit(hit: &Hit<Self>) -> Self::Hit;
        /// `None` for a miss.
        fn hit(raw: &Self::Hit) -> Option<Hit<Self>>;
    }
}

pub(crate) use sealed::Raw;
use sealed::{Options, Scene};

/// `f32` or `f64`: of a single ray and what it meets. An `f32` ray is the `f64` ray of the same numbers, and its answers
/// are the `f64` answers, rounded to nearest. A t beyond the range of `f32` is infinite, and a hit all the same.
pub trait Precision: Raw {}

impl Precision for f32 {}
impl Precision for f64 {}

macro_rules! precision {
    ($number:ident, $ray:ident, $hit:ident, {$($rest:ident: $zero:expr)?},
     $intersect:ident, $occluded:ident, $intersect_all:ident, $normal:ident) => {
        // SAFETY: each function is the C function of that name for that precision.
        unsafe impl Raw for $number {
            const ZERO: Self = 0.0;
            const INFINITY: Self = $number::INFINITY;
            type Ray = sys::$ray;
            type Hit = sys::$hit;
            const INTERSECT: unsafe extern "C" fn(Scene, *const sys::$ray, Options, *mut sys::$hit) -> i32 =
                sys::$intersect;
            const OCCLUDED: unsafe extern "C" fn(Scene, *const sys::$ray, Options, *mut i32) -> i32 = sys::$occluded;
            const INTERSECT_ALL: unsafe extern "C" fn(
                Scene,
                *const sys::$ray,
                Options,
                *mut sys::$hit,
                u64,
                *mut u64,
            ) -> i32 = sys::$intersect_all;
            const NORMAL: unsafe extern "C" fn(Scene, *const sys::$hit, *mut $number) -> i32 = sys::$normal;

            fn raw_ray(ray: &Ray<Self>) -> sys::$ray {
                sys::$ray { origin: ray.origin, tmin: ray.tmin, direction: ray.direction, tmax: ray.tmax }
            }

            fn raw_hit(hit: &Hit<Self>) -> sys::$hit {
                sys::$hit {
                    t: hit.t,
                    u: hit.u,
                    v: hit.v,
                    instance: hit.instance.unwrap_or(sys::RW_INVALID_ID),
                    geometry: hit.geometry,
                    primitive: hit.primitive,
                    $($rest: $zero,)?
                }
            }

            fn hit(raw: &sys::$hit) -> Option<Hit<Self>> {
                Some(Hit {
                    t: raw.t,
                    u: raw.u,
                    v: raw.v,
                    instance: id(raw.instance),
                    geometry: id(raw.geometry)?,
                    primitive: raw.primitive,
                })
            }
        }
    };
}

precision!(
    f64,
    rw_ray,
    rw_hit,
    {reserved: 0},
    rw_scene_intersect,
    rw_scene_occluded,
    rw_scene_intersect_all,
    rw_scene_normal
);
precision!(
    f32,
    rw_ray_f32,
    rw_hit_f32,
    {},
    rw_scene_intersect_f32,
    rw_scene_occluded_f32,
    rw_scene_intersect_all_f32,
    rw_scene_normal_f32
);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_miss_is_none_and_a_missing_instance_is_none() {
        let nothing = sys::RW_INVALID_ID;
        let miss = sys::rw_hit {
            t: f64::INFINITY,
            instance: nothing,
            geometry: nothing,
            primitive: nothing,
            ..Default::default()
        };
        assert_eq!(f64::hit(&miss), None);

        let raw = sys::rw_hit_f32 { t: 2.0, instance: nothing, geometry: 0, primitive: 3, ..Default::default() };
        let hit = f32::hit(&raw).unwrap();
        assert_eq!((hit.t, hit.instance, hit.geometry, hit.primitive), (2.0, None, 0, 3));
        let again = f32::raw_hit(&hit);
        assert_eq!((again.t, again.instance, again.geometry, again.primitive), (2.0, nothing, 0, 3));
    }
}
