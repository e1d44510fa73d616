//! Whatever the triangles and the rays are, every structure gives the same answers in every form.

mod common;

use common::{bits, columns, scenes, TestMesh};
use proptest::prelude::*;
use raywise::{Ray, RayQueries, Rays, SceneBuilder, Triangles};

/// Coordinates from a coarse lattice, where edges, corners, planes and ties are met all the time, or from anywhere.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![3 => (-4_i32..=4).prop_map(|whole| f64::from(whole) / 2.0), 1 => -2.0..2.0]
}

fn point() -> impl Strategy<Value = [f64; 3]> {
    [coordinate(), coordinate(), coordinate()]
}

fn mesh() -> impl Strategy<Value = TestMesh> {
    let vertices = proptest::collection::vec(point(), 3..40);
    vertices.prop_flat_map(|vertices| {
        let count = vertices.len() as u32;
        let triangle = [0..count, 0..count, 0..count];
        proptest::collection::vec(triangle, 0..60)
            .prop_map(move |triangles| TestMesh { vertices: vertices.clone(), triangles })
    })
}

fn ray() -> impl Strategy<Value = Ray> {
    let end = prop_oneof![3 => Just(f64::INFINITY), 1 => 0.0..3.0];
    (point(), point(), prop_oneof![3 => Just(0.0), 1 => -1.0..1.0], end)
        .prop_map(|(origin, direction, tmin, tmax)| Ray::new(origin, direction).between(tmin, tmax))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    #[test]
    fn all_structures_give_identical_answers(mesh in mesh(), rays in proptest::collection::vec(ray(), 1..40)) {
        let scenes = scenes(&mesh).unwrap();
        let (_, judge) = scenes.iter().find(|(name, _)| *name == "linear_scan").unwrap();
        let closest: Vec<_> = rays.iter().map(|ray| bits(judge.intersect(ray).unwrap())).collect();
        let all: Vec<Vec<_>> = rays
            .iter()
            .map(|ray| judge.intersect_all(ray).unwrap().into_iter().map(|hit| bits(Some(hit))).collect())
            .collect();

        let (origins, directions) = columns(&rays);
        let tmin: Vec<f64> = rays.iter().map(|ray| ray.tmin).collect();
        let tmax: Vec<f64> = rays.iter().map(|ray| ray.tmax).collect();
        let batch = Rays::new(&origins, &directions).unwrap().with_tmin(&tmin).unwrap().with_tmax(&tmax).unwrap();

        for (ray, (closest, all)) in rays.iter().zip(closest.iter().zip(&all)) {
            prop_assert_eq!(closest.is_some(), !all.is_empty(), "{:?}", ray);
            if let Some(first) = all.first() {
                prop_assert_eq!(closest, first, "{:?}", ray);
            }
        }
        for (structure, scene) in &scenes {
            for (index, ray) in rays.iter().enumerate() {
                prop_assert_eq!(bits(scene.intersect(ray).unwrap()), closest[index], "{} {:?}", structure, ray);
                prop_assert_eq!(scene.occluded(ray).unwrap(), closest[index].is_some(), "{} {:?}", structure, ray);
                let found: Vec<_> =
                    scene.intersect_all(ray).unwrap().into_iter().map(|hit| bits(Some(hit))).collect();
                prop_assert_eq!(&found, &all[index], "{} {:?}", structure, ray);
            }
            let hits: Vec<_> = scene.intersect_batch(&batch).unwrap().iter().map(bits).collect();
            prop_assert_eq!(&hits, &closest, "{}", structure);
            let found = scene.intersect_all_batch(&batch).unwrap();
            for (index, expected) in all.iter().enumerate() {
                let of_ray: Vec<_> = found.of_ray(index).map(|hit| bits(Some(hit))).collect();
                prop_assert_eq!(&of_ray, expected, "{}, ray {}", structure, index);
            }
        }
    }

    /// No bytes make adding a mesh do anything but succeed or say what is wrong.
    #[test]
    fn any_numbers_are_added_or_refused(
        vertices in proptest::collection::vec([any::<f64>(), any::<f64>(), any::<f64>()], 0..12),
        triangles in proptest::collection::vec([0_u64..14, 0_u64..14, 0_u64..14], 0..12),
    ) {
        let mut builder = SceneBuilder::new().unwrap();
        let triangles = Triangles::new(&vertices, &triangles);
        if let Err(error) = builder.add(&triangles) {
            prop_assert!(error.status().is_some() && !error.to_string().is_empty());
        }
        builder.add(&triangles.skip_invalid()).unwrap();
        let scene = builder.commit().unwrap();
        scene.intersect(&Ray::new([0.0; 3], [1.0, 2.0, 3.0])).unwrap();
    }
}
