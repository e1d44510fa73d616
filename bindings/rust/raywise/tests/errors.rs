//! Every way to fail that safe code can reach, with a text that names the argument or the element.
//!
//! Not here: RW_ERROR_ALREADY_COMMITTED and RW_ERROR_NOT_COMMITTED, which the types rule out (see the tests in the
//! documentation of `SceneBuilder`); RW_ERROR_TOO_MANY, which needs 2^32 elements; RW_ERROR_OUT_OF_MEMORY and
//! RW_ERROR_INTERNAL, which need a failing machine. The profile's statuses are in profile.rs, those of files in files.rs.

mod common;

use common::{icosphere, square};
use raywise::{Error, ExpectedRays, OneShot, QueryOptions, Rays, Result, SceneBuilder, Status, Triangles, ViewOptions};

fn refused(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> (Status, String) {
    let mut builder = SceneBuilder::new().unwrap();
    let (status, message) = library_error(builder.add_triangles(vertices, triangles));
    // On an error the scene is as it was.
    assert_eq!(builder.add(&square().triangles()), Ok(0));
    (status, message)
}

/// What the library said about its refusal.
fn library_error<T: std::fmt::Debug>(result: Result<T, Error>) -> (Status, String) {
    match result {
        Err(Error::Library { status, message }) => (status, message),
        other => panic!("{other:?}"),
    }
}

const CORNERS: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

#[test]
fn a_vertex_that_is_not_finite() {
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut vertices = CORNERS;
        vertices[2][1] = wrong;
        let (status, message) = refused(&vertices, &[[0, 1, 2]]);
        assert_eq!(status, Status::NOT_FINITE);
        assert!(message.contains('2'), "{message}");
    }
}

#[test]
fn a_vertex_that_is_too_far_out() {
    let mut vertices = CORNERS;
    vertices[1][0] = 1e300;
    let (status, message) = refused(&vertices, &[[0, 1, 2]]);
    assert_eq!(status, Status::COORDINATE_RANGE);
    assert!(message.contains("vertex 1"), "{message}");
}

#[test]
fn an_index_that_is_out_of_range() {
    let (status, message) = refused(&CORNERS, &[[0, 1, 2], [2, 9000, 0]]);
    assert_eq!(status, Status::INDEX_OUT_OF_RANGE);
    assert!(message.contains("triangle 1") && message.contains("9000"), "{message}");
}

#[test]
fn a_soup_that_is_not_of_whole_triangles() -> Result<()> {
    let mut builder = SceneBuilder::new()?;
    let (status, message) = library_error(builder.add(&Triangles::soup(&[[0.0_f32; 3]; 4])));
    assert_eq!(status, Status::INVALID_ARGUMENT);
    assert!(!message.is_empty());
    Ok(())
}

#[test]
fn a_structure_that_nobody_knows() -> Result<()> {
    let mut builder = SceneBuilder::new()?;
    let (status, message) = library_error(builder.set_structure("octopus").map(drop));
    assert_eq!(status, Status::UNKNOWN_STRUCTURE);
    assert!(message.contains("octopus"), "{message}");

    let scene = builder.commit().map_err(|failed| failed.error)?;
    let options = ViewOptions::from_point([0.0; 3]).structure("octopus");
    assert_eq!(library_error(scene.view(&options)).0, Status::UNKNOWN_STRUCTURE);

    let mesh = square();
    let rays = Rays::new([0.0; 3], &CORNERS)?;
    let asked = OneShot::new().structure("octopus").intersect(&[mesh.triangles()], &rays);
    assert_eq!(library_error(asked).0, Status::UNKNOWN_STRUCTURE);
    Ok(())
}

#[test]
fn a_name_with_a_zero_inside() -> Result<()> {
    let mut builder = SceneBuilder::new()?;
    assert!(matches!(builder.set_structure("b\0vh"), Err(Error::Text { what: "structure", .. })));
    let scene = builder.commit().map_err(|failed| failed.error)?;
    let options = ViewOptions::from_point([0.0; 3]).structure("b\0vh");
    assert!(matches!(scene.view(&options), Err(Error::Text { what: "structure", .. })));
    let rays = Rays::new([0.0; 3], &CORNERS)?;
    let asked = OneShot::new().structure("b\0vh").occluded(&[], &rays);
    assert!(matches!(asked, Err(Error::Text { what: "structure", .. })));
    Ok(())
}

#[test]
fn a_number_of_rays_that_cannot_be_meant() -> Result<()> {
    let mut builder = SceneBuilder::new()?;
    for count in [0, 1_000_000_000_000_001, u64::MAX - 1] {
        let (status, message) = library_error(builder.expect_rays(&ExpectedRays::new(count)).map(drop));
        assert_eq!(status, Status::RAY_COUNT, "{count}");
        assert!(!message.is_empty());
    }
    for fine in [ExpectedRays::new(1), ExpectedRays::new(1_000_000_000_000_000), ExpectedRays::unknown()] {
        builder.expect_rays(&fine)?;
    }
    let scene = builder.commit().map_err(|failed| failed.error)?;
    assert_eq!(library_error(scene.view(&ViewOptions::from_point([0.0; 3]).rays(0))).0, Status::RAY_COUNT);
    Ok(())
}

#[test]
fn a_structure_that_has_no_room() -> Result<()> {
    let mesh = icosphere(4);
    let mut builder = SceneBuilder::new()?;
    builder.add(&mesh.triangles())?;
    builder.set_memory_limit(1)?.set_structure("bvh")?;
    let failed = builder.commit().expect_err("one byte is too little");
    assert_eq!(failed.error.status(), Some(Status::MEMORY_LIMIT));

    // The builder is as it was: with more room it works.
    let mut builder = failed.builder;
    builder.set_memory_limit(0)?;
    let scene = builder.commit().map_err(|failed| failed.error)?;
    assert_eq!(scene.statistics()?.triangle_count, mesh.triangles.len() as u64);

    let rays = Rays::new([0.0; 3], &CORNERS)?;
    let asked = OneShot::new().structure("bvh").memory_limit(1).intersect(&[mesh.triangles()], &rays);
    assert_eq!(library_error(asked).0, Status::MEMORY_LIMIT);
    Ok(())
}

#[test]
fn a_view_from_nowhere() -> Result<()> {
    let scene = SceneBuilder::new()?.commit().map_err(|failed| failed.error)?;
    for options in [ViewOptions::from_point([f64::NAN, 0.0, 0.0]), ViewOptions::along([0.0, f64::INFINITY, 0.0])] {
        assert_eq!(library_error(scene.view(&options)).0, Status::NOT_FINITE);
    }
    for options in [
        ViewOptions::along([0.0; 3]),
        ViewOptions::from_point([0.0; 3]).towards([0.0, 0.0, 1.0]).half_angle(-1.0),
        ViewOptions::from_point([0.0; 3]).towards([0.0, 0.0, 1.0]).half_angle(2.0),
    ] {
        assert_eq!(library_error(scene.view(&options)).0, Status::INVALID_ARGUMENT, "{options:?}");
    }
    Ok(())
}

#[test]
fn a_parallel_for_that_leaves_tasks_out() -> Result<()> {
    let mut builder = SceneBuilder::new()?;
    builder.add(&icosphere(3).triangles())?;
    let scene = builder.commit().map_err(|failed| failed.error)?;
    let directions = vec![[0.0, 0.0, -1.0]; 200_000];
    let rays = Rays::new([0.1, 0.2, 3.0], &directions)?;
    let nothing = |_: u64, _: &(dyn Fn(u64) + Sync)| {};
    let asked = scene.intersect_batch_with(&rays, &QueryOptions::new().parallel_for(&nothing));
    assert_eq!(library_error(asked).0, Status::HOST_PARALLEL);
    Ok(())
}

#[test]
fn a_thread_does_not_see_another_threads_error() -> Result<()> {
    let outer = refused(&CORNERS, &[[0, 1, 7]]).1;
    let inner = std::thread::spawn(|| refused(&CORNERS, &[[0, 1, 2], [0, 1, 8]]).1).join().unwrap();
    assert!(outer.contains("triangle 0") && outer.contains('7'), "{outer}");
    assert!(inner.contains("triangle 1") && inner.contains('8'), "{inner}");
    Ok(())
}
