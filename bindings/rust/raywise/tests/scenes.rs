//! Filling and committing scenes, and what is told about them.

mod common;

use std::ops::ControlFlow;
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::Arc;
use std::time::Duration;

use common::{icosphere, square, Result};
use raywise::{
    CommitOptions, Effort, ExpectedRays, Mesh, Profile, Ray, RayKind, Rays, Rule, SceneBuilder, SharedTriangles,
    Status, Triangles, Vectors,
};

const DOWN: [f64; 3] = [0.0, 0.0, -1.0];

fn assert_square_is_hit(builder: SceneBuilder) -> Result {
    let scene = builder.commit()?;
    for (x, y, primitive) in [(0.75, 0.25, 0), (0.25, 0.75, 1)] {
        let hit = scene.intersect(&Ray::new([x, y, 2.0], DOWN))?.expect("the square lies below");
        assert_eq!((hit.t, scene.normal(&hit)?, hit.geometry, hit.primitive), (2.0, [0.0, 0.0, 1.0], 0, primitive));
    }
    assert_eq!(scene.intersect(&Ray::new([1.5, 0.5, 2.0], DOWN))?, None);
    Ok(())
}

#[test]
fn meshes_come_in_all_types() -> Result {
    let mesh = square();
    let narrow = mesh.vertices_f32();
    let long: Vec<[u64; 3]> = mesh.triangles.iter().map(|corners| corners.map(u64::from)).collect();

    let mut builder = SceneBuilder::new()?;
    builder.add_triangles(&mesh.vertices, &mesh.triangles)?;
    assert_square_is_hit(builder)?;

    let mut builder = SceneBuilder::new()?;
    builder.add_triangles(narrow.as_slice(), long.as_slice())?;
    assert_square_is_hit(builder)
}

#[test]
fn meshes_come_in_all_layouts() -> Result {
    let mesh = square();
    let with_normals: Vec<f32> =
        mesh.vertices_f32().iter().flat_map(|[x, y, z]| [9.0, 9.0, 9.0, *x, *y, *z, 9.0]).collect();
    let mut builder = SceneBuilder::new()?;
    builder.add_triangles(Vectors::interleaved(&with_normals, 3, 7)?, &mesh.triangles)?;
    assert_square_is_hit(builder)?;

    let planar: Vec<f64> = (0..3).flat_map(|axis| mesh.vertices.iter().map(move |vertex| vertex[axis])).collect();
    let mut builder = SceneBuilder::new()?;
    builder.add_triangles(Vectors::planar(&planar)?, &mesh.triangles)?;
    assert_square_is_hit(builder)?;

    let soup: Vec<[f64; 3]> = mesh.triangles.iter().flatten().map(|&corner| mesh.vertices[corner as usize]).collect();
    let mut builder = SceneBuilder::new()?;
    builder.add(&Triangles::soup(&soup))?;
    assert_square_is_hit(builder)
}

#[test]
fn copied_meshes_may_go_away() -> Result {
    let mut builder = SceneBuilder::new()?;
    {
        let mut mesh = square();
        builder.add(&mesh.triangles())?;
        mesh.vertices.fill([f64::NAN; 3]);
        mesh.triangles.fill([77; 3]);
    }
    assert_square_is_hit(builder)
}

#[test]
fn shared_meshes_live_as_long_as_the_scene_and_its_views() -> Result {
    let vertices: Arc<[[f64; 3]]> = square().vertices.into();
    let triangles: Arc<[[u32; 3]]> = square().triangles.into();

    let mut builder = SceneBuilder::new()?;
    builder.add_shared(SharedTriangles::new(vertices.clone(), triangles.clone()))?;
    let scene = builder.commit()?;
    assert!(Arc::strong_count(&vertices) > 1);

    let view = scene.view(&raywise::ViewOptions::from_point([0.5, 0.25, 2.0]))?;
    let again = view.clone();
    drop((scene, view, triangles));
    let hit = again.intersect(&Ray::new([0.5, 0.25, 2.0], DOWN))?;
    assert_eq!(hit.map(|hit| hit.t), Some(2.0));
    drop(again);
    assert_eq!(Arc::strong_count(&vertices), 1);
    Ok(())
}

#[test]
fn a_shared_mesh_that_is_refused_is_not_kept() -> Result {
    let vertices: Arc<[[f32; 3]]> = vec![[0.0; 3]; 3].into();
    let mut builder = SceneBuilder::new()?;
    let wrong = SharedTriangles::new(vertices.clone(), vec![[0_u32, 1, 3]].into());
    assert_eq!(builder.add_shared(wrong).unwrap_err().status(), Some(Status::INDEX_OUT_OF_RANGE));
    assert_eq!(Arc::strong_count(&vertices), 1);
    Ok(())
}

#[test]
fn static_meshes_can_be_shared() -> Result {
    static VERTICES: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    static TRIANGLES: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];
    let mut builder = SceneBuilder::new()?;
    builder.add_shared(SharedTriangles::from_static(Triangles::new(&VERTICES, &TRIANGLES)))?;
    assert_square_is_hit(builder)
}

#[test]
fn meshes_are_numbered_in_the_order_of_adding() -> Result {
    let mut builder = SceneBuilder::new()?;
    for number in 0..3 {
        let lifted: Vec<[f64; 3]> = square().vertices.iter().map(|[x, y, _]| [*x, *y, f64::from(number)]).collect();
        assert_eq!(builder.add_triangles(&lifted, &square().triangles)?, number);
    }
    let scene = builder.commit()?;
    let hits = scene.intersect_all(&Ray::new([0.5, 0.25, 10.0], DOWN))?;
    let found: Vec<_> = hits.iter().map(|hit| (hit.t, hit.geometry)).collect();
    assert_eq!(found, [(8.0, 2), (9.0, 1), (10.0, 0)]);
    Ok(())
}

#[test]
fn an_empty_scene_is_missed_by_every_ray() -> Result {
    let scene = SceneBuilder::new()?.commit()?;
    assert!(scene.bounds()?.is_empty());
    assert_eq!(scene.intersect(&Ray::new([0.0; 3], DOWN))?, None);
    assert!(!scene.occluded(&Ray::new([0.0; 3], DOWN))?);
    assert_eq!(scene.intersect_all(&Ray::new([0.0; 3], DOWN))?, []);
    let all = scene.intersect_all_batch(&Rays::new([0.0; 3], &[DOWN; 4])?)?;
    assert_eq!(all.offsets, [0; 5]);
    assert!(all.hits.is_empty());
    Ok(())
}

#[test]
fn statistics_and_bounds_tell_what_is_in_a_scene() -> Result {
    let vertices = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, f64::NAN], [0.0, 0.0, -1.0]];
    let triangles = [[0_u32, 1, 2], [0, 1, 1], [0, 1, 3], [0, 1, 99], [0, 1, 4]];
    let mut builder = SceneBuilder::new()?;
    builder.add(&Triangles::new(&vertices, &triangles).skip_invalid())?;
    let scene = builder.commit()?;

    let statistics = scene.statistics()?;
    assert_eq!((statistics.geometry_count, statistics.triangle_count), (1, 5));
    assert_eq!((statistics.degenerate_triangles, statistics.invalid_triangles), (1, 2));
    assert!(raywise::structures()?.contains(&statistics.structure));

    let bounds = scene.bounds()?;
    assert_eq!((bounds.lower, bounds.upper), ([0.0, 0.0, -1.0], [2.0, 3.0, 0.0]));

    // Ids do not shift when triangles are skipped.
    let hit = scene.intersect(&Ray::new([0.5, 1.0, -0.25], [0.0, -1.0, 0.0]))?;
    assert_eq!(hit.map(|hit| hit.primitive), Some(4));

    let rays = [[0.0, 0.0, -1.0], [f64::NAN, 0.0, 0.0]];
    let hits = scene.intersect_batch(&Rays::new([0.1, 0.1, 1.0], &rays)?)?;
    assert_eq!(hits.invalid_rays, 1);
    let after = scene.statistics()?;
    assert_eq!((after.rays, after.invalid_rays), (2, 1));
    Ok(())
}

#[test]
fn every_structure_can_be_forced() -> Result {
    let structures = raywise::structures()?;
    for needed in ["linear_scan", "uniform_grid", "kd_tree", "bvh", "projected_bvh", "bvh_quality", "bvh_morton"] {
        assert!(structures.contains(&needed), "{needed}");
    }
    for structure in structures {
        let scene = common::scene_with(structure, &icosphere(2))?;
        let chosen: Vec<_> = scene.candidates()?.into_iter().filter(|candidate| candidate.chosen).collect();
        assert_eq!(chosen.len(), 1, "{structure}");
        assert!(scene.explain()?.contains(chosen[0].structure), "{structure}");
    }
    Ok(())
}

#[test]
fn a_forced_structure_can_be_taken_back() -> Result {
    let mut builder = SceneBuilder::new()?;
    builder.add(&icosphere(2).triangles())?;
    builder.set_structure("bvh")?.set_structure(None)?;
    let scene = builder.commit()?;
    assert!(scene.candidates()?.iter().all(|candidate| !candidate.forced));
    Ok(())
}

#[test]
fn the_grid_tells_its_statistics() -> Result {
    let grid = common::scene_with("uniform_grid", &icosphere(3))?.grid_statistics()?;
    let [x, y, z] = grid.resolution.map(u64::from);
    assert_eq!(grid.cells, x * y * z);
    assert!((grid.sparseness - grid.empty_cells as f64 / grid.cells as f64).abs() < 1e-12);
    assert!((grid.mean - grid.references as f64 / grid.cells as f64).abs() < 1e-9);
    assert!((grid.standard_deviation.powi(2) - grid.variance).abs() <= 1e-9 * grid.variance);
    assert!(grid.max_references >= 1);

    let error = common::scene_with("bvh", &icosphere(1))?.grid_statistics().unwrap_err();
    assert_eq!(error.status(), Some(Status::WRONG_STRUCTURE));
    Ok(())
}

#[test]
fn the_choice_is_explained() -> Result {
    let mesh = icosphere(3);
    let directions = vec![DOWN; 50];
    let sample = Rays::new([0.0, 0.0, 5.0], &directions)?;
    for (effort, rule) in [
        (Effort::Estimate, Rule::SmallestTotal),
        (Effort::Probe, Rule::SmallestTotal),
        (Effort::Probe, Rule::Hapala),
        (Effort::Measure { limit: Some(Duration::from_secs(20)) }, Rule::SmallestTotal),
    ] {
        let mut builder = SceneBuilder::new()?;
        builder.add(&mesh.triangles())?;
        builder.expect_rays(&ExpectedRays::new(100_000).kind(RayKind::Camera).sample(&sample))?;
        builder.set_effort(effort, rule)?.set_memory_limit(1 << 30)?;
        let scene = builder.commit()?;

        let candidates = scene.candidates()?;
        let names: Vec<&str> = candidates.iter().map(|candidate| candidate.structure).collect();
        assert_eq!(names, raywise::structures()?);
        let chosen: Vec<_> = candidates.iter().filter(|candidate| candidate.chosen).collect();
        assert_eq!(chosen.len(), 1, "{effort:?} {rule:?}");
        assert_eq!(chosen[0].structure, scene.statistics()?.structure);
        assert_eq!(chosen[0].break_even_rays, None);

        assert!(names.iter().all(|name| scene.explain().unwrap().contains(name)));
        let json: serde_json::Value = serde_json::from_str(&scene.explain_json()?)?;
        assert!(json.is_object(), "{json}");
    }
    Ok(())
}

#[test]
fn a_profile_can_be_given() -> Result {
    let profile = Profile::find()?.profile;
    let mut builder = SceneBuilder::with_profile(&profile)?;
    drop(profile);
    builder.add(&square().triangles())?;
    assert_square_is_hit(builder)
}

#[test]
fn a_mesh_read_from_a_file_can_be_added_and_shared() -> Result {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("square_to_share.obj");
    std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")?;
    let mesh = Mesh::load(&path)?;
    let mut copied = SceneBuilder::new()?;
    copied.add(&mesh.triangles())?;
    let mut shared = SceneBuilder::new()?;
    shared.add_shared(SharedTriangles::from_mesh(&mesh))?;
    drop(mesh);
    assert_square_is_hit(copied)?;
    assert_square_is_hit(shared)
}

#[test]
fn progress_is_told_from_0_to_1_and_never_backwards() -> Result {
    let mut builder = SceneBuilder::new()?;
    builder.add(&icosphere(5).triangles())?;
    builder.set_structure("bvh")?;
    let mut told: Vec<(f64, String)> = Vec::new();
    builder.commit_with(CommitOptions::new().progress(|fraction, stage| {
        told.push((fraction, stage.to_owned()));
        ControlFlow::Continue(())
    }))?;
    assert!(!told.is_empty());
    assert!(told.iter().all(|(fraction, stage)| (0.0..=1.0).contains(fraction) && !stage.is_empty()), "{told:?}");
    Ok(())
}

#[test]
fn a_cancelled_commit_gives_the_builder_back() -> Result {
    let mesh = icosphere(4);
    for structure in raywise::structures()? {
        let mut builder = SceneBuilder::new()?;
        builder.add(&mesh.triangles())?;
        builder.set_structure(structure)?;
        let asked = AtomicU32::new(0);
        let failed = builder
            .commit_with(CommitOptions::new().progress(|_, _| {
                asked.fetch_add(1, Ordering::Relaxed);
                ControlFlow::Break(())
            }))
            .expect_err("the first word of progress stops it");
        assert_eq!(failed.error.status(), Some(Status::CANCELLED), "{structure}");
        assert!(failed.to_string().contains("RW_ERROR_CANCELLED"));
        assert!(asked.into_inner() >= 1);

        // Nothing is lost: more can be added, and it can be committed.
        let mut builder = failed.builder;
        assert_eq!(builder.add(&square().triangles())?, 1);
        let scene = builder.commit()?;
        assert_eq!(scene.statistics()?.triangle_count, mesh.triangles.len() as u64 + 2);
    }
    Ok(())
}

#[test]
fn a_panic_in_progress_comes_out_of_commit() -> Result {
    let mut builder = SceneBuilder::new()?;
    builder.add(&icosphere(4).triangles())?;
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        builder.commit_with(CommitOptions::new().progress(|_, _| panic!("told too much"))).is_ok()
    }));
    assert_eq!(outcome.unwrap_err().downcast_ref(), Some(&"told too much"));
    Ok(())
}

#[test]
fn the_number_of_threads_changes_nothing() -> Result {
    let mesh = icosphere(4);
    let mut numbers = common::Numbers::new(5);
    let rays: Vec<Ray> = (0..500).map(|_| numbers.ray()).collect();
    let mut answers = Vec::new();
    for threads in [1, 2, 7, 0] {
        let mut builder = SceneBuilder::new()?;
        builder.add(&mesh.triangles())?;
        builder.set_structure("bvh")?;
        let scene = builder.commit_with(CommitOptions::new().threads(threads))?;
        answers.push(rays.iter().map(|ray| scene.intersect(ray).map(common::bits)).collect::<Result<Vec<_>, _>>()?);
    }
    assert!(answers.iter().all(|answer| *answer == answers[0]));
    Ok(())
}

#[test]
fn a_builder_can_be_filled_on_one_thread_and_committed_on_another() -> Result {
    let mut builder = SceneBuilder::new()?;
    builder.add(&square().triangles())?;
    let scene = std::thread::spawn(move || builder.commit().map_err(|failed| failed.error)).join().unwrap()?;
    assert!(scene.occluded(&Ray::new([0.5, 0.25, 1.0], DOWN))?);
    Ok(())
}
