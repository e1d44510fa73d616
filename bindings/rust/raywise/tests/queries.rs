//! The questions: one ray or many, closest, any or all, fresh vectors or the caller's slices; always the same answers.

mod common;

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicI32, Ordering};
use std::sync::Mutex;

use common::{bits, columns, icosphere, scene_with, scenes, square, Numbers, Result};
use raywise::{Error, Hit, Hits, HitsMut, QueryOptions, Ray, RayOptions, Rays, Status, Workspace};

const DOWN: [f64; 3] = [0.0, 0.0, -1.0];

#[test]
fn a_hit_tells_point_and_triangle() -> Result {
    let scene = scene_with("linear_scan", &square())?;
    let ray = Ray::new([0.75, 0.25, 3.0], [0.0, 0.0, -2.0]);
    let hit = scene.intersect(&ray)?.unwrap();
    assert_eq!(hit.t, 1.5);
    assert_eq!(ray.at(hit.t), [0.75, 0.25, 0.0]);
    // Triangle (0, 0), (1, 0), (1, 1): the point is u of the way to the second corner and v to the third.
    assert_eq!((hit.u, hit.v), (0.5, 0.25));
    assert_eq!((hit.instance, hit.geometry, hit.primitive), (None, 0, 0));
    Ok(())
}

#[test]
fn the_interval_counts_its_ends() -> Result {
    let scene = scene_with("bvh", &square())?;
    let ray = Ray::new([0.75, 0.25, 2.0], DOWN);
    for (tmin, tmax, is_hit) in [
        (0.0, 2.0, true),
        (2.0, 2.0, true),
        (2.0, 9.0, true),
        (0.0, 1.999, false),
        (2.001, 9.0, false),
        (5.0, 1.0, false),
        (f64::NAN, 9.0, false),
    ] {
        let part = ray.between(tmin, tmax);
        assert_eq!(scene.intersect(&part)?.is_some(), is_hit, "{tmin} {tmax}");
        assert_eq!(scene.occluded(&part)?, is_hit, "{tmin} {tmax}");
        assert_eq!(scene.intersect_all(&part)?.len(), usize::from(is_hit), "{tmin} {tmax}");
    }
    Ok(())
}

#[test]
fn rays_that_are_none_miss() -> Result {
    let scene = scene_with("bvh", &icosphere(1))?;
    for (origin, direction) in [
        ([f64::NAN, 0.0, 0.0], DOWN),
        ([0.0; 3], [0.0, f64::NAN, 1.0]),
        ([0.0; 3], [0.0; 3]),
        ([f64::INFINITY, 0.0, 0.0], DOWN),
        ([0.0; 3], [f64::INFINITY, 0.0, 0.0]),
    ] {
        assert_eq!(scene.intersect(&Ray::new(origin, direction))?, None, "{origin:?} {direction:?}");
    }
    Ok(())
}

#[test]
fn all_structures_answer_with_the_same_bits_in_every_form() -> Result {
    let mut numbers = Numbers::new(1);
    for mesh in [icosphere(3), numbers.soup(700)] {
        let rays: Vec<Ray> = (0..400).map(|_| numbers.ray()).collect();
        let (origins, directions) = columns(&rays);
        let batch = Rays::new(&origins, &directions)?;
        let judge = scene_with("linear_scan", &mesh)?;
        let closest: Vec<_> = rays.iter().map(|ray| judge.intersect(ray).unwrap()).map(bits).collect();
        let all: Vec<Vec<_>> = rays
            .iter()
            .map(|ray| judge.intersect_all(ray).unwrap().into_iter().map(|hit| bits(Some(hit))).collect())
            .collect();
        assert!(closest.iter().flatten().count() > 40, "the rays should hit now and then");

        for (structure, scene) in scenes(&mesh)? {
            for (ray, expected) in rays.iter().zip(&closest) {
                assert_eq!(bits(scene.intersect(ray)?), *expected, "{structure} {ray:?}");
                assert_eq!(scene.occluded(ray)?, expected.is_some(), "{structure} {ray:?}");
            }
            for (ray, expected) in rays.iter().zip(&all) {
                let found: Vec<_> = scene.intersect_all(ray)?.into_iter().map(|hit| bits(Some(hit))).collect();
                assert_eq!(found, *expected, "{structure} {ray:?}");
            }
            for threads in [1, 0] {
                let options = QueryOptions::new().threads(threads);
                let hits = scene.intersect_batch_with(&batch, &options)?;
                assert_eq!(hits.iter().map(bits).collect::<Vec<_>>(), closest, "{structure}");
                let occluded = scene.occluded_batch_with(&batch, &options)?;
                let expected: Vec<bool> = closest.iter().map(Option::is_some).collect();
                assert_eq!(occluded, expected, "{structure}");
                let found = scene.intersect_all_batch_with(&batch, &options)?;
                for (ray, expected) in all.iter().enumerate() {
                    let of_ray: Vec<_> = found.of_ray(ray).map(|hit| bits(Some(hit))).collect();
                    assert_eq!(of_ray, *expected, "{structure}, ray {ray}");
                }
            }
        }
    }
    Ok(())
}

#[test]
fn one_origin_or_one_direction_serves_all_rays() -> Result {
    let scene = scene_with("bvh", &icosphere(3))?;
    let mut numbers = Numbers::new(2);
    let points: Vec<[f64; 3]> = (0..300).map(|_| numbers.point()).collect();
    let narrow: Vec<[f32; 3]> = points.iter().map(|point| point.map(|x| x as f32)).collect();

    let fan = scene.intersect_batch(&Rays::new([0.1, 0.2, 0.3], &points)?)?;
    for (direction, hit) in points.iter().zip(fan.iter()) {
        assert_eq!(bits(hit), bits(scene.intersect(&Ray::new([0.1, 0.2, 0.3], *direction))?));
    }
    let parallel = scene.intersect_batch(&Rays::new(&narrow, DOWN)?)?;
    for (origin, hit) in narrow.iter().zip(parallel.iter()) {
        assert_eq!(bits(hit), bits(scene.intersect(&Ray::new(origin.map(f64::from), DOWN))?));
    }
    Ok(())
}

#[test]
fn bounds_of_rays_come_one_for_all_or_one_each() -> Result {
    let scene = scene_with("kd_tree", &icosphere(3))?;
    let mut numbers = Numbers::new(3);
    let rays: Vec<Ray> = (0..300).map(|_| numbers.ray()).collect();
    let (origins, directions) = columns(&rays);
    let tmin: Vec<f32> = (0..300).map(|_| 0.5 * numbers.fraction() as f32).collect();
    let tmax: Vec<f64> = (0..300).map(|_| numbers.fraction()).collect();

    let each = scene.intersect_batch(&Rays::new(&origins, &directions)?.with_tmin(&tmin)?.with_tmax(&tmax)?)?;
    let same = scene.intersect_batch(&Rays::new(&origins, &directions)?.with_tmin(0.25)?.with_tmax(0.75)?)?;
    for (index, ray) in rays.iter().enumerate() {
        let own = ray.between(f64::from(tmin[index]), tmax[index]);
        assert_eq!(bits(each.get(index)), bits(scene.intersect(&own)?));
        assert_eq!(bits(same.get(index)), bits(scene.intersect(&ray.between(0.25, 0.75))?));
    }
    Ok(())
}

#[test]
fn answers_go_into_the_callers_slices_and_types() -> Result {
    let scene = scene_with("bvh", &icosphere(2))?;
    let mut numbers = Numbers::new(4);
    let rays: Vec<Ray> = (0..200).map(|_| numbers.ray()).collect();
    let (origins, directions) = columns(&rays);
    let batch = Rays::new(&origins, &directions)?;
    let full = scene.intersect_batch(&batch)?;

    let mut t = vec![0.0_f32; 200];
    let mut uv = vec![[0.0_f64; 2]; 200];
    let mut normal = vec![[0.0_f32; 3]; 200];
    let mut geometry = vec![0_u64; 200];
    let mut primitive = vec![0_u32; 200];
    let wanted =
        HitsMut::new().t(&mut t).uv(&mut uv).normal(&mut normal).geometry(&mut geometry).primitive(&mut primitive);
    let invalid = scene.intersect_batch_into(&batch, wanted, &QueryOptions::new())?;
    assert_eq!(invalid, 0);
    assert_eq!(t, full.t.iter().map(|t| *t as f32).collect::<Vec<_>>());
    assert_eq!(uv, full.uv);
    assert_eq!(normal, full.normal.iter().map(|normal| normal.map(|x| x as f32)).collect::<Vec<_>>());
    assert_eq!(primitive, full.primitive);
    for (wide, narrow) in geometry.iter().zip(&full.geometry) {
        assert_eq!(*wide, if *narrow == Hits::NOTHING { u64::MAX } else { u64::from(*narrow) });
    }

    let mut flags = vec![9_u64; 200];
    scene.occluded_batch_into(&batch, &mut flags, &QueryOptions::new())?;
    let expected: Vec<u64> = full.iter().map(|hit| u64::from(hit.is_some())).collect();
    assert_eq!(flags, expected);
    Ok(())
}

#[test]
fn slices_of_the_wrong_length_are_refused_before_the_library_is_asked() -> Result {
    let scene = scene_with("bvh", &square())?;
    let rays = Rays::new([0.5, 0.25, 1.0], &[DOWN; 3])?;
    let options = QueryOptions::new();

    let error = scene.intersect_batch_into(&rays, HitsMut::new().t(&mut [0.0; 2]), &options).unwrap_err();
    assert_eq!(error, Error::Length { what: "output t", expected: 3, found: 2 });
    let error = scene.occluded_batch_into(&rays, &mut [0_u8; 4], &options).unwrap_err();
    assert_eq!(error, Error::Length { what: "output occluded", expected: 3, found: 4 });
    let error = scene.intersect_all_batch_into(&rays, &mut [0; 3], HitsMut::new(), &options).unwrap_err();
    assert_eq!(error, Error::Length { what: "offsets", expected: 4, found: 3 });
    Ok(())
}

#[test]
fn all_hits_can_be_counted_first_and_fetched_later() -> Result {
    let scene = scene_with("uniform_grid", &icosphere(2))?;
    let mut numbers = Numbers::new(6);
    let rays: Vec<Ray> = (0..100).map(|_| numbers.ray()).collect();
    let (origins, directions) = columns(&rays);
    let batch = Rays::new(&origins, &directions)?;
    let expected = scene.intersect_all_batch(&batch)?;
    let options = QueryOptions::new();

    let mut offsets = vec![0; 101];
    let count = scene.intersect_all_batch_into(&batch, &mut offsets, HitsMut::new(), &options)?;
    assert_eq!(offsets, expected.offsets);
    assert_eq!(count, expected.hits.len() as u64);
    assert!(count > 20);

    let mut t = vec![0.0_f64; count as usize];
    let mut offsets = vec![0; 101];
    scene.intersect_all_batch_into(&batch, &mut offsets, HitsMut::new().t(&mut t), &options)?;
    assert_eq!(t, expected.hits.t);

    let mut short = vec![-1.0_f64; count as usize - 1];
    let mut offsets = vec![0; 101];
    let error =
        scene.intersect_all_batch_into(&batch, &mut offsets, HitsMut::new().t(&mut short), &options).unwrap_err();
    assert_eq!(error, Error::Capacity { needed: count, capacity: count - 1 });
    assert_eq!(offsets, expected.offsets);
    assert!(short.iter().all(|t| *t == -1.0), "no hit is written when there is no room for all");
    Ok(())
}

#[test]
fn more_hits_than_were_guessed_are_all_returned() -> Result {
    // 100 squares on top of each other: more than the room that is tried first.
    let mut mesh = square();
    for layer in 1..100 {
        let first = mesh.vertices.len() as u32;
        mesh.vertices.extend(square().vertices.iter().map(|[x, y, _]| [*x, *y, f64::from(-layer)]));
        mesh.triangles.extend(square().triangles.iter().map(|corners| corners.map(|corner| first + corner)));
    }
    for (structure, scene) in scenes(&mesh)? {
        let hits = scene.intersect_all(&Ray::new([0.5, 0.25, 1.0], DOWN))?;
        let expected: Vec<f64> = (1..=100).map(f64::from).collect();
        assert_eq!(hits.iter().map(|hit| hit.t).collect::<Vec<_>>(), expected, "{structure}");
        let all = scene.intersect_all_batch(&Rays::new([0.5, 0.25, 1.0], &[DOWN, DOWN])?)?;
        assert_eq!(all.offsets, [0, 100, 200], "{structure}");
    }
    Ok(())
}

#[test]
fn a_batch_without_rays_is_answered() -> Result {
    let scene = scene_with("bvh", &square())?;
    let none: [[f64; 3]; 0] = [];
    let rays = Rays::new(&none, &none)?;
    assert!(scene.intersect_batch(&rays)?.is_empty());
    assert!(scene.occluded_batch(&rays)?.is_empty());
    assert_eq!(scene.intersect_all_batch(&rays)?.offsets, [0]);
    Ok(())
}

#[test]
fn rays_with_a_nan_are_counted() -> Result {
    let scene = scene_with("bvh", &square())?;
    let directions = [DOWN, [f64::NAN, 0.0, 0.0], DOWN, [0.0, 0.0, f64::NAN]];
    let rays = Rays::new([0.5, 0.25, 1.0], &directions)?;
    let hits = scene.intersect_batch(&rays)?;
    assert_eq!(hits.invalid_rays, 2);
    assert_eq!(hits.iter().map(|hit| hit.is_some()).collect::<Vec<_>>(), [true, false, true, false]);
    assert_eq!(scene.occluded_batch_into(&rays, &mut [0_u8; 4], &QueryOptions::new())?, 2);
    assert_eq!(scene.intersect_all_batch(&rays)?.hits.invalid_rays, 2);
    Ok(())
}

#[test]
fn one_ray_in_f32_is_answered_as_in_f64_and_rounded() -> Result {
    let mut numbers = Numbers::new(31);
    let mesh = numbers.soup(300);
    for (structure, scene) in scenes(&mesh)? {
        let mut met = 0;
        for _ in 0..300 {
            let wide = numbers.ray();
            let ray = Ray::new(wide.origin.map(|x| x as f32), wide.direction.map(|x| x as f32));
            let wide = Ray::new(ray.origin.map(f64::from), ray.direction.map(f64::from));
            let rounded = |hit: Hit| Hit {
                t: hit.t as f32,
                u: hit.u as f32,
                v: hit.v as f32,
                instance: hit.instance,
                geometry: hit.geometry,
                primitive: hit.primitive,
            };
            let (hit, right) = (scene.intersect(&ray)?, scene.intersect(&wide)?);
            assert_eq!(hit, right.map(rounded), "{structure} {ray:?}");
            assert_eq!(scene.occluded(&ray)?, hit.is_some(), "{structure} {ray:?}");
            let all: Vec<Hit<f32>> = scene.intersect_all(&wide)?.into_iter().map(rounded).collect();
            assert_eq!(scene.intersect_all(&ray)?, all, "{structure} {ray:?}");
            if let (Some(hit), Some(right)) = (hit, right) {
                met += 1;
                assert_eq!(scene.normal(&hit)?, scene.normal(&right)?.map(|x| x as f32));
                let skip = [hit.into()];
                let behind = scene.intersect_with(&ray, &RayOptions::new().skip(&skip))?;
                assert_eq!(behind.map(|hit| hit.primitive), all.get(1).map(|hit| hit.primitive));
            }
        }
        assert!(met > 20, "{structure}");
    }
    Ok(())
}

#[test]
fn the_normal_of_a_triangle_that_is_not_there_is_an_error() -> Result {
    let (_, scene) = scenes(&icosphere(1))?.remove(0);
    let hit = Hit { t: 1.0, u: 0.0, v: 0.0, instance: None, geometry: 0, primitive: 99_999 };
    assert_eq!(scene.normal(&hit).unwrap_err().status(), Some(Status::INDEX_OUT_OF_RANGE));
    Ok(())
}

#[test]
fn a_workspace_serves_batches_of_any_scene_one_at_a_time() -> Result {
    let mut numbers = Numbers::new(33);
    let rays: Vec<Ray> = (0..5000).map(|_| numbers.ray()).collect();
    let (origins, directions) = columns(&rays);
    let batch = Rays::new(&origins, &directions)?;
    let workspace = Workspace::new()?;
    let kept = QueryOptions::new().workspace(&workspace);
    for (structure, scene) in scenes(&icosphere(3))? {
        assert_eq!(scene.intersect_batch_with(&batch, &kept)?, scene.intersect_batch(&batch)?, "{structure}");
        let refused = Mutex::new(0);
        let meanwhile = |_: f64, _: &str| {
            let error = scene.occluded_batch_with(&batch, &kept).unwrap_err();
            assert_eq!(error.status(), Some(Status::IN_USE), "{structure}");
            *refused.lock().unwrap() += 1;
            ControlFlow::Continue(())
        };
        scene.intersect_batch_with(&batch, &kept.progress(&meanwhile))?;
        assert!(*refused.lock().unwrap() >= 2, "{structure}: at the beginning and at the end");
        assert_eq!(scene.occluded_batch_with(&batch, &kept)?, scene.occluded_batch(&batch)?, "{structure}");
    }
    Ok(())
}

#[test]
fn batches_are_watched_and_stopped() -> Result {
    let mut numbers = Numbers::new(32);
    let rays: Vec<Ray> = (0..5000).map(|_| numbers.ray()).collect();
    let (origins, directions) = columns(&rays);
    let batch = Rays::new(&origins, &directions)?;
    for (structure, scene) in scenes(&icosphere(3))? {
        let right = scene.intersect_batch(&batch)?;
        let told = Mutex::new(Vec::new());
        let go_on = |fraction: f64, stage: &str| {
            assert!(!stage.is_empty());
            told.lock().unwrap().push(fraction);
            ControlFlow::Continue(())
        };
        let flag = AtomicI32::new(0);
        let options = QueryOptions::new().progress(&go_on).cancel(&flag);
        assert_eq!(scene.intersect_batch_with(&batch, &options)?, right, "{structure}");
        assert_eq!(told.lock().unwrap().last(), Some(&1.0), "{structure}");

        flag.store(1, Ordering::Relaxed);
        let mut t = vec![-7.0_f64; rays.len()];
        let error = scene.intersect_batch_into(&batch, HitsMut::new().t(&mut t), &options).unwrap_err();
        assert_eq!(error.status(), Some(Status::CANCELLED), "{structure}");
        assert!(t.iter().all(|t| *t == -7.0), "{structure}: nothing was answered");

        let stop = |_: f64, _: &str| ControlFlow::Break(());
        let error = scene.occluded_batch_with(&batch, &QueryOptions::new().progress(&stop)).unwrap_err();
        assert_eq!(error.status(), Some(Status::CANCELLED), "{structure}");
        let error = scene.intersect_all_batch_with(&batch, &QueryOptions::new().progress(&stop)).unwrap_err();
        assert_eq!(error.status(), Some(Status::CANCELLED), "{structure}");
    }
    Ok(())
}
