//! One shot: a batch against meshes that are not kept.

mod common;

use common::{columns, icosphere, scenes, square, Numbers, Result};
use raywise::{Error, HitsMut, OneShot, Profile, QueryOptions, Ray, RayKind, Rays, Status};

#[test]
fn one_shot_answers_as_a_scene_does() -> Result {
    let mesh = icosphere(3);
    let mut numbers = Numbers::new(31);
    let rays: Vec<Ray> = (0..300).map(|_| numbers.ray()).collect();
    let (origins, directions) = columns(&rays);
    let batch = Rays::new(&origins, &directions)?;
    let profile = Profile::find()?.profile;
    for (structure, scene) in scenes(&mesh)? {
        let expected = scene.intersect_batch(&batch)?;
        let forced = OneShot::new().structure(structure).kind(RayKind::Random);
        assert_eq!(forced.intersect(&[mesh.triangles()], &batch)?, expected, "{structure}");
        let free = OneShot::new().profile(&profile).query(QueryOptions::new().threads(1));
        assert_eq!(free.intersect(&[mesh.triangles()], &batch)?, expected, "{structure}");
        assert_eq!(free.occluded(&[mesh.triangles()], &batch)?, scene.occluded_batch(&batch)?, "{structure}");
    }
    Ok(())
}

#[test]
fn hits_name_the_mesh() -> Result {
    let low = square();
    let mut high = square();
    for vertex in &mut high.vertices {
        vertex[2] = 1.0;
    }
    let origins = [[0.5, 0.25, 0.5], [0.5, 0.25, 5.0]];
    let rays = Rays::new(&origins, [0.0, 0.0, -1.0])?;
    let hits = OneShot::new().intersect(&[low.triangles(), high.triangles()], &rays)?;
    assert_eq!(hits.geometry, [0, 1]);
    assert_eq!(OneShot::new().intersect(&[], &rays)?.get(0), None);
    Ok(())
}

#[test]
fn answers_go_into_the_callers_slices() -> Result {
    let mesh = square();
    let directions = [[0.0, 0.0, -1.0], [f64::NAN, 0.0, 0.0]];
    let rays = Rays::new([0.5, 0.25, 2.0], &directions)?;
    let mut t = [0.0_f32; 2];
    let invalid = OneShot::new().intersect_into(&[mesh.triangles()], &rays, HitsMut::new().t(&mut t))?;
    assert_eq!((invalid, t), (1, [2.0, f32::INFINITY]));
    let mut flags = [9_u32; 2];
    assert_eq!(OneShot::new().occluded_into(&[mesh.triangles()], &rays, &mut flags)?, 1);
    assert_eq!(flags, [1, 0]);

    let error = OneShot::new().occluded_into(&[mesh.triangles()], &rays, &mut [0_u8; 3]).unwrap_err();
    assert_eq!(error, Error::Length { what: "output occluded", expected: 2, found: 3 });
    Ok(())
}

#[test]
fn a_wrong_mesh_is_refused() -> Result {
    let mut mesh = square();
    mesh.triangles[1] = [0, 2, 4];
    let rays = Rays::new([0.5, 0.25, 2.0], &[[0.0, 0.0, -1.0]])?;
    let error = OneShot::new().intersect(&[mesh.triangles()], &rays).unwrap_err();
    assert_eq!(error.status(), Some(Status::INDEX_OUT_OF_RANGE));
    let hits = OneShot::new().intersect(&[mesh.triangles().skip_invalid()], &rays)?;
    assert_eq!(hits.primitive, [0]);
    Ok(())
}
