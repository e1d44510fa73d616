//! The other crates, each used as its documentation shows.

use std::hint::black_box;
use std::time::Duration;

use bvh::aabb::{Aabb, Bounded};
use bvh::bounding_hierarchy::BHShape;
use glam::Vec3A;
use nalgebra::{Point3, Vector3};
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::bvh2::Bvh2;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::cwbvh::CwBvh;
use obvhs::ray::RayHit;
use obvhs::triangle::Triangle;
use obvhs::BvhBuildParams;
use parry3d::query::RayCast;
use parry3d::shape::TriMesh;

use crate::{Ray, Scene, Subject};

/// `bvh`: a binary hierarchy that hands out the shapes whose boxes a ray meets, nearest first. Its own triangle test knows no
/// back faces, so the test is ours: Moeller and Trumbore (1997).
pub struct BvhCrate {
    hierarchy: bvh::bvh::Bvh<f32, 3>,
    shapes: Vec<Shape>,
}

struct Shape {
    corner: Vector3<f32>,
    edges: [Vector3<f32>; 2],
    bounds: Aabb<f32, 3>,
    node: usize,
}

impl Bounded<f32, 3> for Shape {
    fn aabb(&self) -> Aabb<f32, 3> {
        self.bounds
    }
}

impl BHShape<f32, 3> for Shape {
    fn set_bh_node_index(&mut self, index: usize) {
        self.node = index;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

impl Shape {
    fn new(corners: [[f32; 3]; 3]) -> Self {
        let [a, b, c] = corners.map(Vector3::from);
        let bounds = Aabb::with_bounds(a.inf(&b).inf(&c).into(), a.sup(&b).sup(&c).into());
        Shape { corner: a, edges: [b - a, c - a], bounds, node: 0 }
    }

    /// The distance along a direction of unit length.
    fn meets(&self, ray: &bvh::ray::Ray<f32, 3>) -> Option<f32> {
        let p = ray.direction.cross(&self.edges[1]);
        let determinant = self.edges[0].dot(&p);
        let inverse = 1.0 / determinant;
        let from = ray.origin.coords - self.corner;
        let u = from.dot(&p) * inverse;
        let q = from.cross(&self.edges[0]);
        let v = ray.direction.dot(&q) * inverse;
        let inside = determinant != 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        inside.then(|| self.edges[1].dot(&q) * inverse)
    }
}

/// A ray of unit length and where it begins and ends.
pub struct Interval {
    ray: bvh::ray::Ray<f32, 3>,
    first: f32,
    last: f32,
}

impl Subject for BvhCrate {
    const NAME: &'static str = "bvh";
    type OwnRay = Interval;

    fn build(scene: &Scene) -> Self {
        let mut shapes: Vec<Shape> = (0..scene.triangles.len()).map(|i| Shape::new(scene.corners(i))).collect();
        let hierarchy = bvh::bvh::Bvh::build(&mut shapes);
        BvhCrate { hierarchy, shapes }
    }

    fn prepare(ray: &Ray) -> Interval {
        let direction = Vector3::from(ray.direction);
        let length = direction.norm();
        Interval {
            ray: bvh::ray::Ray::new(Point3::from(ray.origin), direction),
            first: ray.tmin * length,
            last: ray.tmax * length,
        }
    }

    fn closest(&self, ray: &Interval) -> bool {
        let mut last = ray.last;
        let mut hit = false;
        for shape in self.hierarchy.nearest_traverse_iterator(&ray.ray, &self.shapes) {
            // Boxes come in the order in which the ray enters them.
            if ray.ray.intersection_slice_for_aabb(&shape.bounds).is_some_and(|(enters, _)| enters > last) {
                break;
            }
            if let Some(t) = shape.meets(&ray.ray).filter(|t| *t >= ray.first && *t <= last) {
                last = t;
                hit = true;
            }
        }
        black_box(last);
        hit
    }

    fn any(&self, ray: &Interval) -> bool {
        self.hierarchy
            .traverse_iterator(&ray.ray, &self.shapes)
            .any(|shape| shape.meets(&ray.ray).is_some_and(|t| t >= ray.first && t <= ray.last))
    }
}

fn obvhs_triangles(scene: &Scene) -> Vec<Triangle> {
    (0..scene.triangles.len())
        .map(|i| {
            let [v0, v1, v2] = scene.corners(i).map(Vec3A::from);
            Triangle { v0, v1, v2 }
        })
        .collect()
}

fn obvhs_ray(ray: &Ray) -> obvhs::ray::Ray {
    obvhs::ray::Ray::new(ray.origin.into(), ray.direction.into(), ray.tmin, ray.tmax)
}

/// A structure of `obvhs` with its medium preset, triangles in the order of its leaves, as its examples advise.
macro_rules! obvhs_subject {
    ($subject:ident, $structure:ty, $build:ident, $name:literal) => {
        pub struct $subject {
            structure: $structure,
            triangles: Vec<Triangle>,
        }

        impl Subject for $subject {
            const NAME: &'static str = $name;
            type OwnRay = obvhs::ray::Ray;

            fn build(scene: &Scene) -> Self {
                let given = obvhs_triangles(scene);
                let structure = $build(&given, BvhBuildParams::medium_build(), &mut Duration::default());
                let triangles = structure.primitive_indices.iter().map(|&i| given[i as usize]).collect();
                $subject { structure, triangles }
            }

            fn prepare(ray: &Ray) -> obvhs::ray::Ray {
                obvhs_ray(ray)
            }

            fn closest(&self, ray: &obvhs::ray::Ray) -> bool {
                let mut hit = RayHit::none();
                let any = self.structure.ray_traverse(*ray, &mut hit, |ray, i| self.triangles[i].intersect(ray));
                black_box(hit.t);
                any
            }

            fn any(&self, ray: &obvhs::ray::Ray) -> bool {
                !self.structure.ray_traverse_miss(*ray, |ray, i| self.triangles[i].intersect(ray))
            }
        }
    };
}

obvhs_subject!(ObvhsBvh2, Bvh2, build_bvh2_from_tris, "obvhs BVH2");
obvhs_subject!(ObvhsCwBvh, CwBvh, build_cwbvh_from_tris, "obvhs CWBVH");

/// `parry3d`: a collision library whose rays begin at their origin.
pub struct Parry(TriMesh);

impl Subject for Parry {
    const NAME: &'static str = "parry3d";
    type OwnRay = (parry3d::query::Ray, f32);

    fn build(scene: &Scene) -> Self {
        let vertices = scene.vertices.iter().map(|&v| v.into()).collect();
        Parry(TriMesh::new(vertices, scene.triangles.clone()).expect("a mesh"))
    }

    fn prepare(ray: &Ray) -> Self::OwnRay {
        (parry3d::query::Ray::new(ray.start().into(), ray.direction.into()), (ray.tmax - ray.tmin).min(f32::MAX))
    }

    fn closest(&self, (ray, length): &Self::OwnRay) -> bool {
        self.0.cast_local_ray_and_get_normal(ray, *length, false).is_some()
    }

    fn any(&self, (ray, length): &Self::OwnRay) -> bool {
        self.0.intersects_local_ray(ray, *length)
    }
}
