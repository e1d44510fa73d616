use raywise::{CommitOptions, SceneBuilder};

use crate::{Ray, Scene, Subject};

/// raywise through its crate, with its bvh, built in one thread like the others.
pub struct Raywise(raywise::Scene);

impl Subject for Raywise {
    const NAME: &'static str = "raywise bvh";
    type OwnRay = raywise::Ray;

    fn build(scene: &Scene) -> Self {
        let mut builder = SceneBuilder::new().expect("a scene");
        builder.add_triangles(&scene.vertices, &scene.triangles).expect("a mesh");
        builder.set_structure("bvh").expect("a structure");
        Raywise(builder.commit_with(CommitOptions::new().threads(1)).expect("a committed scene"))
    }

    fn prepare(ray: &Ray) -> raywise::Ray {
        raywise::Ray::new(ray.origin.map(f64::from), ray.direction.map(f64::from))
            .between(f64::from(ray.tmin), f64::from(ray.tmax))
    }

    fn closest(&self, ray: &raywise::Ray) -> bool {
        self.0.intersect(ray).expect("an answer").is_some()
    }

    fn any(&self, ray: &raywise::Ray) -> bool {
        self.0.occluded(ray).expect("an answer")
    }
}
