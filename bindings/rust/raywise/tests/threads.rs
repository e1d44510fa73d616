//! Scenes and views are shared between threads, and hosts bring their own.

mod common;

use std::panic::{catch_unwind, AssertUnwindSafe};

use common::{bits, columns, icosphere, scene_with, scenes, Numbers, Result};
use rayon::prelude::*;
use raywise::{
    CommitOptions, Error, Hits, HitsMut, Mesh, Profile, QueryOptions, Ray, Rays, Scene, SceneBuilder, SharedTriangles,
    Triangles, ViewOptions,
};

#[allow(dead_code)]
fn what_may_cross_threads() {
    fn sent<T: Send>() {}
    fn shared<T: Send + Sync>() {}
    fn cloned<T: Send + Sync + Clone>() {}
    cloned::<Scene>();
    cloned::<Profile>();
    cloned::<Mesh>();
    cloned::<SharedTriangles>();
    cloned::<Hits>();
    cloned::<Rays<'static>>();
    cloned::<Triangles<'static>>();
    cloned::<QueryOptions<'static>>();
    shared::<Error>();
    sent::<SceneBuilder>();
    sent::<HitsMut<'static>>();
    sent::<CommitOptions<'static>>();
}

#[test]
fn many_threads_ask_one_scene_and_get_the_same_answers() -> Result {
    let mut numbers = Numbers::new(11);
    let rays: Vec<Ray> = (0..600).map(|_| numbers.ray()).collect();
    let (origins, directions) = columns(&rays);
    for (structure, scene) in scenes(&icosphere(3))? {
        let expected: Vec<_> = rays.iter().map(|ray| scene.intersect(ray).map(bits)).collect::<Result<_, _>>()?;
        std::thread::scope(|scope| {
            for thread in 0..8 {
                let (scene, rays, expected) = (scene.clone(), &rays, &expected);
                let (origins, directions) = (&origins, &directions);
                scope.spawn(move || {
                    if thread % 2 == 0 {
                        for (ray, expected) in rays.iter().zip(expected) {
                            assert_eq!(bits(scene.intersect(ray).unwrap()), *expected, "{structure}");
                        }
                    } else {
                        let hits = scene.intersect_batch(&Rays::new(origins, directions).unwrap()).unwrap();
                        assert_eq!(hits.iter().map(bits).collect::<Vec<_>>(), *expected, "{structure}");
                    }
                });
            }
        });
    }
    Ok(())
}

#[test]
fn the_last_owner_may_be_any_thread() -> Result {
    let scene = scene_with("bvh", &icosphere(2))?;
    let view = scene.view(&ViewOptions::from_point([0.0, 0.0, 4.0]))?;
    let threads: Vec<_> = (0..8)
        .map(|_| {
            let (scene, view) = (scene.clone(), view.clone());
            std::thread::spawn(move || {
                let ray = Ray::new([0.0, 0.0, 4.0], [0.01, 0.02, -1.0]);
                let both = (scene.intersect(&ray).unwrap(), view.intersect(&ray).unwrap());
                assert_eq!(bits(both.0), bits(both.1));
                both.0.is_some()
            })
        })
        .collect();
    drop((scene, view));
    assert!(threads.into_iter().all(|thread| thread.join().unwrap()));
    Ok(())
}

#[test]
fn rayon_builds_and_asks() -> Result {
    let run = |count: u64, task: &(dyn Fn(u64) + Sync)| (0..count).into_par_iter().for_each(task);
    let mesh = icosphere(5);
    let directions: Vec<[f32; 3]> = {
        let mut numbers = Numbers::new(12);
        (0..50_000).map(|_| numbers.point().map(|x| x as f32)).collect()
    };
    let rays = Rays::new([0.1, 0.2, 0.3], &directions)?;
    for structure in raywise::structures()? {
        if structure == "linear_scan" {
            continue; // 20,480 triangles times 50,000 rays
        }
        let mut builder = SceneBuilder::new()?;
        builder.add(&mesh.triangles())?;
        builder.set_structure(structure)?;
        let scene = builder.commit_with(CommitOptions::new().parallel_for(&run))?;
        let theirs = scene.intersect_batch_with(&rays, &QueryOptions::new().parallel_for(&run))?;
        let ours = scene.intersect_batch(&rays)?;
        assert_eq!(theirs, ours, "{structure}");
        assert!(ours.iter().all(|hit| hit.is_some()), "from inside a closed ball every ray hits");
    }
    Ok(())
}

#[test]
fn a_host_that_runs_backwards_and_twice_gets_the_same_answers() -> Result {
    let run = |count: u64, task: &(dyn Fn(u64) + Sync)| {
        (0..count).rev().for_each(task);
        (0..count + 2).for_each(task);
    };
    let scene = scene_with("bvh", &icosphere(3))?;
    let mut numbers = Numbers::new(13);
    let directions: Vec<[f64; 3]> = (0..30_000).map(|_| numbers.point()).collect();
    let rays = Rays::new([0.1, 0.2, 0.3], &directions)?;
    let theirs = scene.intersect_batch_with(&rays, &QueryOptions::new().parallel_for(&run))?;
    assert_eq!(theirs, scene.intersect_batch(&rays)?);
    Ok(())
}

#[test]
fn a_panic_of_the_host_comes_out_of_the_call() -> Result {
    let run = |_: u64, _: &(dyn Fn(u64) + Sync)| panic!("no threads left");
    let scene = scene_with("bvh", &icosphere(3))?;
    let directions = vec![[0.0, 0.0, -1.0]; 200_000];
    let rays = Rays::new([0.1, 0.2, 3.0], &directions)?;
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        scene.intersect_batch_with(&rays, &QueryOptions::new().parallel_for(&run)).is_ok()
    }));
    assert_eq!(outcome.unwrap_err().downcast_ref(), Some(&"no threads left"));
    // The scene is none the worse for it.
    assert!(scene.intersect(&Ray::new([0.1, 0.2, 3.0], [0.0, 0.0, -1.0]))?.is_some());
    Ok(())
}
