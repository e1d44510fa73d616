//! Whatever the triangles and the rays are, every structure gives the same answers in every form.

mod common;

use common::{bits, columns, scene_with, scenes, TestMesh};
use proptest::prelude::*;
use raywise::{PrimitiveId, Ray, RayOptions, Rays, SceneBuilder, SkipLists, Triangles};

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

    /// To a ray that skips a triangle it is as one without area: in every structure and in every form, also where the
    /// ray passes exactly through edges and corners.
    #[test]
    fn a_skipped_triangle_is_as_one_without_area(
        mesh in mesh(),
        rays in proptest::collection::vec(ray(), 1..20),
        chosen in proptest::collection::vec(any::<proptest::sample::Index>(), 0..8),
    ) {
        let (mut whole, count) = (mesh.clone(), mesh.triangles.len());
        let skip: Vec<u32> = chosen.iter().filter(|_| count > 0).map(|index| index.index(count) as u32).collect();
        // One triangle more keeps the bounds of both scenes the same.
        let first = whole.vertices.len() as u32;
        whole.vertices.extend([[-9.0, -9.0, -9.0], [-9.0, 9.0, 9.0], [9.0, 9.0, 8.0]]);
        whole.triangles.push([first, first + 1, first + 2]);
        let mut holed = whole.clone();
        for triangle in &skip {
            holed.triangles[*triangle as usize] = [0; 3];
        }
        let judge = scene_with("linear_scan", &holed).unwrap();

        let (origins, directions) = columns(&rays);
        let tmin: Vec<f64> = rays.iter().map(|ray| ray.tmin).collect();
        let tmax: Vec<f64> = rays.iter().map(|ray| ray.tmax).collect();
        let offsets: Vec<u64> = (0..=rays.len()).map(|ray| (ray * skip.len()) as u64).collect();
        let primitive = skip.repeat(rays.len());
        let plain = Rays::new(&origins, &directions).unwrap().with_tmin(&tmin).unwrap().with_tmax(&tmax).unwrap();
        let skipping = plain.with_skip(SkipLists::lists(&offsets, &primitive)).unwrap();
        let ids: Vec<PrimitiveId> = skip.iter().map(|triangle| PrimitiveId::new(0, *triangle)).collect();
        let options = RayOptions::new().skip(&ids);

        for (structure, scene) in scenes(&whole).unwrap() {
            prop_assert_eq!(scene.intersect_batch(&skipping).unwrap(), judge.intersect_batch(&plain).unwrap());
            prop_assert_eq!(scene.occluded_batch(&skipping).unwrap(), judge.occluded_batch(&plain).unwrap());
            prop_assert_eq!(scene.intersect_all_batch(&skipping).unwrap(), judge.intersect_all_batch(&plain).unwrap());
            for ray in &rays {
                let (found, expected) = (scene.intersect_with(ray, &options).unwrap(), judge.intersect(ray).unwrap());
                prop_assert_eq!(bits(found), bits(expected), "{} {:?}", structure, ray);
                let occluded = scene.occluded_with(ray, &options).unwrap();
                prop_assert_eq!(occluded, expected.is_some(), "{} {:?}", structure, ray);
                let found = scene.intersect_all_with(ray, &options).unwrap();
                prop_assert_eq!(found, judge.intersect_all(ray).unwrap(), "{} {:?}", structure, ray);
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
