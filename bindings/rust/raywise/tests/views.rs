//! Views answer as their scene does, only sooner.

mod common;

use std::ops::ControlFlow;

use common::{bits, columns, icosphere, scene_with, Numbers, Result};
use raywise::{CommitOptions, Ray, RayKind, Rays, Scene, Status, ViewOptions};

const EYE: [f64; 3] = [0.3, -0.2, 3.0];

/// Rays of the view and rays that have nothing to do with it.
fn rays() -> Vec<Ray> {
    let mut numbers = Numbers::new(21);
    let mut rays: Vec<Ray> = (0..300).map(|_| numbers.ray()).collect();
    for _ in 0..300 {
        let target = numbers.point();
        rays.push(Ray::new(EYE, common::minus(target, EYE)));
        rays.push(Ray::new(target, common::minus(EYE, target)).between(0.0, 1.0));
        rays.push(Ray::new([1.5 * target[0], 1.5 * target[1], 4.0], [0.0, 0.0, -1.0]));
    }
    rays
}

fn assert_same_answers(view: &Scene, scene: &Scene, name: &str) -> Result {
    let rays = rays();
    for ray in &rays {
        assert_eq!(bits(view.intersect(ray)?), bits(scene.intersect(ray)?), "{name} {ray:?}");
        assert_eq!(view.occluded(ray)?, scene.occluded(ray)?, "{name} {ray:?}");
        assert_eq!(view.intersect_all(ray)?, scene.intersect_all(ray)?, "{name} {ray:?}");
    }
    let (origins, directions) = columns(&rays);
    let tmax: Vec<f64> = rays.iter().map(|ray| ray.tmax).collect();
    let batch = Rays::new(&origins, &directions)?.with_tmax(&tmax)?;
    assert_eq!(view.intersect_batch(&batch)?, scene.intersect_batch(&batch)?, "{name}");
    assert_eq!(view.occluded_batch(&batch)?, scene.occluded_batch(&batch)?, "{name}");
    assert_eq!(view.intersect_all_batch(&batch)?, scene.intersect_all_batch(&batch)?, "{name}");
    Ok(())
}

#[test]
fn a_view_answers_every_ray_as_its_scene_does() -> Result {
    let mut numbers = Numbers::new(20);
    for mesh in [icosphere(3), numbers.soup(500)] {
        let scene = scene_with("bvh", &mesh)?;
        for structure in raywise::structures()?.into_iter().map(Some).chain([None]) {
            for (name, options) in [
                ("camera", ViewOptions::from_point(EYE).towards([0.0, 0.0, -1.0]).half_angle(0.4).rays(1_000_000)),
                ("all around", ViewOptions::from_point(EYE).kind(RayKind::Shadow)),
                ("along", ViewOptions::along([0.0, 0.0, -5.0]).kind(RayKind::Shadow).rays(100)),
            ] {
                let options = match structure {
                    Some(structure) => options.structure(structure),
                    None => options,
                };
                assert_same_answers(&scene.view(&options)?, &scene, &format!("{name} {structure:?}"))?;
            }
        }
    }
    Ok(())
}

#[test]
fn a_view_keeps_its_scene() -> Result {
    let view = {
        let scene = scene_with("kd_tree", &icosphere(2))?;
        scene.view(&ViewOptions::from_point(EYE))?
    };
    assert!(view.occluded(&Ray::new(EYE, common::minus([0.0; 3], EYE)))?);
    Ok(())
}

#[test]
fn a_view_explains_its_choice() -> Result {
    let scene = scene_with("bvh", &icosphere(2))?;
    let view = scene.view(&ViewOptions::from_point(EYE).structure("projected_bvh").rays(1000))?;
    let candidates = view.candidates()?;
    let chosen: Vec<_> = candidates.iter().filter(|candidate| candidate.chosen).collect();
    assert_eq!(chosen.len(), 1);
    assert_eq!((chosen[0].structure, chosen[0].forced), ("projected_bvh", true));
    assert!(view.explain()?.contains("projected_bvh"));
    assert!(serde_json::from_str::<serde_json::Value>(&view.explain_json()?)?.is_object());
    Ok(())
}

#[test]
fn a_view_can_be_cancelled() -> Result {
    let scene = scene_with("bvh", &icosphere(4))?;
    let options = ViewOptions::from_point(EYE).structure("projected_bvh");
    let stop = CommitOptions::new().progress(|_, _| ControlFlow::Break(()));
    let error = scene.view_with(&options, stop).unwrap_err();
    assert_eq!(error.status(), Some(Status::CANCELLED));
    assert!(scene.view_with(&options, CommitOptions::new().threads(1)).is_ok());
    Ok(())
}

#[test]
fn a_view_is_a_scene_with_facts_of_its_own_and_views_of_its_own() -> Result {
    let scene = scene_with("bvh", &icosphere(3))?;
    let view = scene.view(&ViewOptions::from_point(EYE).structure("projected_bvh"))?;
    assert_eq!((view.statistics()?.structure, scene.statistics()?.structure), ("projected_bvh", "bvh"));
    assert_eq!(view.bounds()?, scene.bounds()?);
    let (origins, directions) = columns(&rays());
    view.intersect_batch(&Rays::new(&origins, &directions)?)?;
    assert_eq!((view.statistics()?.rays, scene.statistics()?.rays), (origins.len() as u64, 0));

    let again = view.view(&ViewOptions::along([0.0, 0.0, -1.0]).structure("projected_bvh"))?;
    assert_same_answers(&again, &scene, "a view of a view")
}

#[test]
fn a_refitted_view_is_a_view_of_the_refitted_scene() -> Result {
    let mesh = icosphere(2);
    let scene = scene_with("bvh", &mesh)?;
    let view = scene.view(&ViewOptions::from_point(EYE).structure("projected_bvh"))?;
    let mut moved = mesh;
    moved.vertices.iter_mut().for_each(|vertex| vertex[2] += 0.25);
    let refitted = view.refit(&[moved.triangles()])?;
    assert_eq!(refitted.statistics()?.structure, "projected_bvh");
    assert_same_answers(&refitted, &scene_with("linear_scan", &moved)?, "refitted")
}
