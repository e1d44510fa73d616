//! Scenes made of committed ones whose meshes have moved.

mod common;

use std::ops::ControlFlow;
use std::sync::Arc;

use common::{icosphere, square, Result, TestMesh};
use raywise::{CommitOptions, Ray, RefitPolicy, Scene, SceneBuilder, SharedTriangles, Status, Triangles};

fn scene_of(mesh: &TestMesh, structure: &str) -> Result<Scene> {
    let mut builder = SceneBuilder::new()?;
    builder.add(&mesh.triangles())?;
    builder.set_structure(structure)?;
    Ok(builder.commit()?)
}

fn moved(mesh: &TestMesh, by: impl Fn([f64; 3]) -> [f64; 3]) -> TestMesh {
    TestMesh { vertices: mesh.vertices.iter().copied().map(by).collect(), triangles: mesh.triangles.clone() }
}

fn twisted([x, y, z]: [f64; 3]) -> [f64; 3] {
    [z.cos() * x - z.sin() * y, z.sin() * x + z.cos() * y, z]
}

/// From corner to corner, and past them.
fn rays_at(mesh: &TestMesh) -> Vec<Ray> {
    let corner = |i: usize| mesh.vertices[i * 31 % mesh.vertices.len()];
    (0..200)
        .map(|i| {
            let (from, a, b) = (corner(i), corner(i + 7), corner(i / 2 + 3));
            Ray::new(from, [0, 1, 2].map(|axis| 0.5 * a[axis] + 0.5 * b[axis] - from[axis]))
        })
        .collect()
}

#[test]
fn answers_are_those_of_a_new_scene() -> Result {
    let rest = icosphere(2);
    let moves: [fn([f64; 3]) -> [f64; 3]; 5] = [
        |p| p.map(|x| x + 1e9),
        |p| p.map(|x| x * 1e-20),
        twisted,
        |p| if p[0] > 0.5 { [0.5; 3] } else { p },
        |_| [1.0; 3],
    ];
    for structure in raywise::structures()? {
        let scene = scene_of(&rest, structure)?;
        let mut last = scene.clone();
        for by in moves {
            let now = moved(&rest, by);
            let fresh = scene_of(&now, "linear_scan")?;
            let kept = scene.refit(&[Triangles::moved(&now.vertices, now.triangles.len())])?;
            let given = scene.refit(&[now.triangles()])?;
            last = last.refit(&[now.triangles()])?;
            for ray in rays_at(&now) {
                let wanted = fresh.intersect(&ray)?;
                for refitted in [&kept, &given, &last] {
                    assert_eq!(refitted.intersect(&ray)?, wanted, "{structure}");
                    assert_eq!(refitted.occluded(&ray)?, wanted.is_some(), "{structure}");
                }
            }
            assert_eq!(kept.statistics()?.structure, structure);
        }
        assert_eq!(scene.statistics()?.refits, 0);
    }
    Ok(())
}

#[test]
fn the_old_scene_may_go_and_its_shared_arrays_with_it() -> Result {
    let mesh = square();
    let vertices: Arc<[[f64; 3]]> = mesh.vertices.clone().into();
    let triangles: Arc<[[u32; 3]]> = mesh.triangles.clone().into();
    let mut builder = SceneBuilder::new()?;
    builder.add_shared(SharedTriangles::new(vertices.clone(), triangles.clone()))?;
    builder.set_structure("bvh")?;
    let scene = builder.commit()?;
    let lifted = moved(&mesh, |[x, y, z]| [x, y, z + 0.5]);
    let refitted = scene.refit(&[Triangles::moved(&lifted.vertices, 2)])?;
    drop(scene);
    assert_eq!((Arc::strong_count(&vertices), Arc::strong_count(&triangles)), (1, 1));
    drop((vertices, triangles, lifted));
    let hit = refitted.intersect(&Ray::new([0.75, 0.25, 2.0], [0.0, 0.0, -1.0]))?.expect("it lies below");
    assert_eq!((hit.t, hit.primitive), (1.5, 0));
    assert_eq!(refitted.statistics()?.refits, 1);
    Ok(())
}

#[test]
fn what_differs_is_named() -> Result {
    let mesh = square();
    let scene = scene_of(&mesh, "bvh")?;
    let status_of = |meshes: &[Triangles<'_>], text: &str| {
        let error = scene.refit(meshes).expect_err(text);
        assert!(error.to_string().contains(text), "{error}");
        error.status()
    };
    let wrong = Some(Status::INVALID_ARGUMENT);
    assert_eq!(status_of(&[], "mesh_count: it is 0"), wrong);
    assert_eq!(status_of(&[mesh.triangles(), mesh.triangles()], "mesh_count: it is 2"), wrong);
    assert_eq!(status_of(&[Triangles::moved(&mesh.vertices, 3)], "meshes[0].triangle_count: it is 3"), wrong);
    assert_eq!(status_of(&[Triangles::moved(&mesh.vertices[1..], 2)], "meshes[0].vertex_count: it is 3"), wrong);
    let far = moved(&mesh, |[x, y, _]| [x, y, f64::NAN]);
    assert_eq!(status_of(&[far.triangles()], "meshes[0].vertices: vertex 0"), Some(Status::NOT_FINITE));
    let nothing = scene.refit(&[Triangles::moved(&far.vertices, 2).skip_invalid()])?;
    assert_eq!(nothing.statistics()?.invalid_triangles, 2);
    let outside = Triangles::new(&mesh.vertices, &[[0_u32, 1, 2], [0, 1, 9]]);
    assert_eq!(status_of(&[outside], "meshes[0].triangle 1: index 9"), Some(Status::INDEX_OUT_OF_RANGE));
    Ok(())
}

#[test]
fn progress_is_told_and_can_cancel() -> Result {
    let mesh = icosphere(3);
    let scene = scene_of(&mesh, "bvh")?;
    let mut told = 0;
    let options = CommitOptions::new().threads(2).progress(|fraction, _| {
        assert!((0.0..=1.0).contains(&fraction));
        told += 1;
        ControlFlow::Continue(())
    });
    scene.refit_with(&[mesh.triangles()], options)?;
    assert!(told > 0);
    let options = CommitOptions::new().progress(|_, _| ControlFlow::Break(()));
    let error = scene.refit_with(&[mesh.triangles()], options).expect_err("it was cancelled");
    assert_eq!(error.status(), Some(Status::CANCELLED));
    Ok(())
}

#[test]
fn structures_are_refitted_or_built_as_asked() -> Result {
    let rest = icosphere(2);
    let now = moved(&rest, twisted);
    for structure in raywise::structures()? {
        let scene = scene_of(&rest, structure)?;
        for policy in [RefitPolicy::WhereItPays, RefitPolicy::WherePossible, RefitPolicy::Never] {
            let next = scene.refit_with(&[now.triangles()], CommitOptions::new().refit(policy))?;
            let refitted = policy != RefitPolicy::Never && structure.starts_with("bvh");
            assert_eq!(next.statistics()?.refits, u64::from(refitted), "{structure}, {policy:?}");
        }
    }
    Ok(())
}

#[test]
fn numbers_may_change_where_all_is_built_anew() -> Result {
    let (two, three) = (icosphere(2), icosphere(3));
    let scene = scene_of(&two, "bvh")?;
    let error = scene.refit(&[three.triangles()]).unwrap_err();
    assert_eq!(error.status(), Some(Status::INVALID_ARGUMENT));
    let never = || CommitOptions::new().refit(RefitPolicy::Never);
    let more = scene.refit_with(&[three.triangles(), two.triangles()], never())?;
    assert_eq!(more.statistics()?.triangle_count as usize, three.triangles.len() + two.triangles.len());
    let fresh = scene_of(&three, "linear_scan")?;
    let one = more.refit_with(&[three.triangles()], never())?;
    for ray in rays_at(&three) {
        assert_eq!(one.intersect(&ray)?, fresh.intersect(&ray)?);
    }
    Ok(())
}

#[test]
fn memory_is_kept_as_told() -> Result {
    raywise::keep_memory(0)?;
    let mesh = icosphere(5);
    raywise::keep_memory(100 << 20)?;
    drop(scene_of(&mesh, "bvh")?);
    assert!((1..=100 << 20).contains(&raywise::kept_memory()?));
    raywise::keep_memory(0)?;
    Ok(())
}
