//! Skip lists: a ray passes through the triangles it names, and through no others.

mod common;

use common::{bits, columns, icosphere, scene_with, scenes, square, Bits, Numbers, Result, TestMesh};
use raywise::{
    Error, Hit, HitsMut, OneShot, PrimitiveId, QueryOptions, Ray, RayOptions, Rays, Scene, SceneBuilder, SkipLists,
    Status, ViewOptions,
};

const DOWN: [f64; 3] = [0.0, 0.0, -1.0];

fn ids(hits: &[Hit]) -> Vec<PrimitiveId> {
    hits.iter().map(PrimitiveId::from).collect()
}

fn all_bits(hits: impl IntoIterator<Item = Hit>) -> Vec<Bits> {
    hits.into_iter().map(|hit| bits(Some(hit))).collect()
}

fn refusal<T: std::fmt::Debug>(result: raywise::Result<T>) -> String {
    match result {
        Err(Error::Library { status: Status::INDEX_OUT_OF_RANGE, message }) => message,
        other => panic!("{other:?}"),
    }
}

/// Squares on top of each other, each a mesh of its own: number i is at z = -i.
fn stack(layers: u32) -> Result<Scene> {
    let mut builder = SceneBuilder::new()?;
    for layer in 0..layers {
        let mut mesh = square();
        mesh.vertices.iter_mut().for_each(|vertex| vertex[2] = -f64::from(layer));
        assert_eq!(builder.add(&mesh.triangles())?, layer);
    }
    Ok(builder.commit()?)
}

/// Meshes, and rays that meet no edge of them exactly: numbers like these do not.
fn samples() -> Vec<(TestMesh, Vec<Ray>)> {
    let mut numbers = Numbers::new(51);
    let soup = numbers.soup(400);
    let mut with_rays = |mesh: TestMesh| (mesh, (0..150).map(|_| numbers.ray()).collect());
    vec![with_rays(icosphere(3)), with_rays(soup)]
}

#[test]
fn what_is_left_are_the_hits_that_are_not_skipped() -> Result {
    for (mesh, rays) in samples() {
        for (structure, scene) in scenes(&mesh)? {
            let mut skipped_some = 0;
            for (index, ray) in rays.iter().enumerate() {
                let all = scene.intersect_all(ray)?;
                // Every other hit, the closest one among them for every other ray; backwards and twice.
                let (left, met): (Vec<_>, Vec<_>) =
                    all.iter().enumerate().partition(|(place, _)| (place + index) % 2 == 0);
                let left: Vec<Hit> = left.into_iter().map(|(_, hit)| *hit).collect();
                let mut skip = vec![PrimitiveId::NOTHING];
                skip.extend(met.into_iter().rev().map(|(_, hit)| PrimitiveId::from(hit)));
                skip.extend_from_within(..);
                let options = RayOptions::new().skip(&skip);

                let found = scene.intersect_with(ray, &options)?;
                assert_eq!(bits(found), bits(left.first().copied()), "{structure} {ray:?}");
                assert_eq!(scene.occluded_with(ray, &options)?, !left.is_empty(), "{structure} {ray:?}");
                assert_eq!(all_bits(scene.intersect_all_with(ray, &options)?), all_bits(left), "{structure} {ray:?}");
                skipped_some += usize::from(skip.len() > 2);
            }
            assert!(skipped_some > 30, "the rays should hit now and then");
        }
    }
    Ok(())
}

#[test]
fn without_a_list_the_answers_are_those_of_the_plain_questions() -> Result {
    for (mesh, rays) in samples() {
        let scene = scene_with("bvh", &mesh)?;
        for ray in &rays {
            for skip in [&[][..], &[PrimitiveId::NOTHING; 3]] {
                let options = RayOptions::new().skip(skip);
                assert_eq!(bits(scene.intersect_with(ray, &options)?), bits(scene.intersect(ray)?));
                assert_eq!(scene.occluded_with(ray, &options)?, scene.occluded(ray)?);
                assert_eq!(scene.intersect_all_with(ray, &options)?, scene.intersect_all(ray)?);
            }
        }
    }
    Ok(())
}

#[test]
fn from_hit_to_hit_a_ray_finds_all_of_them() -> Result {
    for (mesh, rays) in samples() {
        for (structure, scene) in scenes(&mesh)? {
            let mut longest = 0;
            for ray in &rays {
                let all = scene.intersect_all(ray)?;
                let mut found: Vec<Hit> = Vec::new();
                let mut on = *ray;
                while let Some(hit) =
                    scene.intersect_with(&on, &RayOptions::new().skip(&ids(&found[found.len().saturating_sub(1)..])))?
                {
                    found.push(hit);
                    on = Ray::new(on.at(hit.t), ray.direction);
                    assert!(found.len() <= all.len(), "{structure} {ray:?}");
                }
                assert_eq!(ids(&found), ids(&all), "{structure} {ray:?}");
                let way: f64 = found.iter().map(|hit| hit.t).sum();
                let last = all.last().map_or(0.0, |hit| hit.t);
                assert!((way - last).abs() < 1e-12, "{structure} {ray:?}: {way} instead of {last}");
                longest = longest.max(all.len());
            }
            assert!(longest >= 2, "{structure}");
        }
    }
    Ok(())
}

#[test]
fn hit_by_hit_the_same_ray_finds_all_of_them_with_the_same_bits() -> Result {
    for (mesh, rays) in samples() {
        let scene = scene_with("kd_tree", &mesh)?;
        for ray in &rays {
            let all = scene.intersect_all(ray)?;
            let mut found: Vec<Hit> = Vec::new();
            while let Some(hit) = scene.intersect_with(ray, &RayOptions::new().skip(&ids(&found)))? {
                found.push(hit);
            }
            assert_eq!(all_bits(found), all_bits(all), "{ray:?}");
        }
    }
    Ok(())
}

#[test]
fn more_hits_than_were_guessed_are_all_returned() -> Result {
    let scene = stack(100)?;
    let ray = Ray::new([0.75, 0.25, 1.0], DOWN);
    let skip: Vec<_> = (0..100).step_by(5).map(|layer| PrimitiveId::new(layer, 0)).collect();
    let left: Vec<u32> = (0..100).filter(|layer| layer % 5 != 0).collect();
    let found = scene.intersect_all_with(&ray, &RayOptions::new().skip(&skip))?;
    assert_eq!(found.iter().map(|hit| hit.geometry).collect::<Vec<_>>(), left);
    Ok(())
}

#[test]
fn batches_answer_as_single_rays_whatever_the_form_of_their_lists() -> Result {
    for (mesh, rays) in samples() {
        let (origins, directions) = columns(&rays);
        let batch = Rays::new(&origins, &directions)?;
        for (structure, scene) in scenes(&mesh)? {
            let (closest, all) = (scene.intersect_batch(&batch)?, scene.intersect_all_batch(&batch)?);
            let wide: Vec<u64> = closest
                .primitive
                .iter()
                .map(|id| if *id == raywise::Hits::NOTHING { u64::MAX } else { u64::from(*id) })
                .collect();
            // All but the last hit of each ray, in the middle of longer arrays.
            let mut offsets = vec![2_u64];
            let mut primitive = vec![7_u64, 7];
            for ray in 0..rays.len() {
                let range = all.range(ray);
                primitive.extend(
                    all.hits.primitive[range.start..range.end.max(1) - usize::from(!range.is_empty())]
                        .iter()
                        .copied()
                        .map(u64::from),
                );
                offsets.push(primitive.len() as u64);
            }
            primitive.push(u64::from(u32::MAX) + 5); // beyond the lists: nobody looks at it

            let own = |ray: usize| all.of_ray(ray).collect::<Vec<Hit>>();
            let first = |ray: usize| own(ray).into_iter().take(1).collect::<Vec<Hit>>();
            let but_last = |ray: usize| own(ray)[..own(ray).len().saturating_sub(1)].to_vec();
            type Skipped<'a> = &'a dyn Fn(usize) -> Vec<Hit>;
            let forms: [(&str, SkipLists<'_>, Skipped<'_>); 5] = [
                ("hits", SkipLists::from(&closest), &first),
                ("64 bits", SkipLists::each(&wide).geometry(0), &first),
                ("all hits", SkipLists::from(&all), &own),
                ("lists", SkipLists::lists(&offsets, &primitive), &but_last),
                ("nothing", SkipLists::each(raywise::Hits::NOTHING).geometry(77), &|_| Vec::new()),
            ];
            for (name, skip, skipped) in forms {
                let batch = batch.with_skip(skip)?;
                let hits = scene.intersect_batch(&batch)?;
                let occluded = scene.occluded_batch(&batch)?;
                let every = scene.intersect_all_batch_with(&batch, &QueryOptions::new().threads(1))?;
                let once = OneShot::new().structure(structure);
                assert_eq!(once.intersect(&[mesh.triangles()], &batch)?, hits, "{structure}, {name}");
                assert_eq!(once.occluded(&[mesh.triangles()], &batch)?, occluded, "{structure}, {name}");
                for (index, ray) in rays.iter().enumerate() {
                    let skip = ids(&skipped(index));
                    let options = RayOptions::new().skip(&skip);
                    let what = || format!("{structure}, {name}, ray {index}");
                    assert_eq!(bits(hits.get(index)), bits(scene.intersect_with(ray, &options)?), "{}", what());
                    assert_eq!(occluded[index], scene.occluded_with(ray, &options)?, "{}", what());
                    let expected = scene.intersect_all_with(ray, &options)?;
                    assert_eq!(all_bits(every.of_ray(index)), all_bits(expected), "{}", what());
                }
            }
        }
    }
    Ok(())
}

#[test]
fn one_triangle_can_be_skipped_by_all_rays() -> Result {
    let scene = stack(3)?;
    let rays = Rays::new([0.75, 0.25, 1.0], &[DOWN; 4])?.with_skip(SkipLists::each(0).geometry(0))?;
    assert_eq!(scene.intersect_batch(&rays)?.geometry, [1; 4]);
    // For each of two rays the same list, of which the ids are one for all and the meshes are not.
    let rays = Rays::new([0.75, 0.25, 1.0], &[DOWN; 2])?;
    let rays = rays.with_skip(SkipLists::lists(&[0, 2, 3], 0).geometry(&[1_u64, 0, 0]))?;
    assert_eq!(scene.intersect_batch(&rays)?.geometry, [2, 1]);
    Ok(())
}

#[test]
fn a_view_skips_as_its_scene_does() -> Result {
    let eye = [0.3, -0.2, 3.0];
    for (mesh, rays) in samples() {
        let scene = scene_with("linear_scan", &mesh)?;
        let towards: Vec<Ray> = rays.iter().map(|ray| Ray::new(eye, common::minus(ray.origin, eye))).collect();
        let (origins, directions) = columns(&towards);
        let batch = Rays::new(&origins, &directions)?;
        let previous = scene.intersect_batch(&batch)?;
        let batch = batch.with_skip(&previous)?;
        for structure in raywise::structures()? {
            let view = scene.view(&ViewOptions::from_point(eye).structure(structure))?;
            assert_eq!(view.intersect_batch(&batch)?, scene.intersect_batch(&batch)?, "{structure}");
            assert_eq!(view.occluded_batch(&batch)?, scene.occluded_batch(&batch)?, "{structure}");
            assert_eq!(view.intersect_all_batch(&batch)?, scene.intersect_all_batch(&batch)?, "{structure}");
            for (ray, met) in towards.iter().zip(previous.iter()) {
                let skip: Vec<_> = met.into_iter().map(PrimitiveId::from).collect();
                let options = RayOptions::new().skip(&skip);
                assert_eq!(bits(view.intersect_with(ray, &options)?), bits(scene.intersect_with(ray, &options)?));
                assert_eq!(view.occluded_with(ray, &options)?, scene.occluded_with(ray, &options)?);
                assert_eq!(view.intersect_all_with(ray, &options)?, scene.intersect_all_with(ray, &options)?);
            }
        }
    }
    Ok(())
}

#[test]
fn a_triangle_that_is_not_there_is_named() -> Result {
    let scene = stack(3)?;
    let view = scene.view(&ViewOptions::along(DOWN))?;
    let ray = Ray::new([0.75, 0.25, 1.0], DOWN);
    for (wrong, words) in [
        (PrimitiveId::new(1, 2), ["primitive 2", "geometry 1"]),
        (PrimitiveId::new(3, 0), ["geometry 3", "has 3"]),
        (PrimitiveId::new(u32::MAX, 0), ["geometry 4294967295", "has 3"]),
        (
            Hit { t: 1.0, u: 0.0, v: 0.0, instance: Some(4), geometry: 0, primitive: 0 }.into(),
            ["instance 4", "no instances"],
        ),
    ] {
        let skip = [PrimitiveId::new(0, 1), PrimitiveId::NOTHING, wrong];
        let options = RayOptions::new().skip(&skip);
        for message in [
            refusal(scene.intersect_with(&ray, &options)),
            refusal(scene.occluded_with(&ray, &options)),
            refusal(scene.intersect_all_with(&ray, &options)),
            refusal(view.intersect_with(&ray, &options)),
            refusal(view.occluded_with(&ray, &options)),
            refusal(view.intersect_all_with(&ray, &options)),
        ] {
            assert!(message.contains("skip[2]"), "{message}");
            assert!(words.iter().all(|word| message.contains(word)), "{message}");
        }
    }

    let mesh = square();
    let rays = Rays::new([0.75, 0.25, 1.0], &[DOWN; 3])?;
    for (skip, words) in [
        (SkipLists::each(&[0_u32, u32::MAX, 2]), ["skip_primitive[2]", "primitive 2"]),
        (SkipLists::each(&[0_u64, u64::MAX, 1 << 40]), ["skip_primitive[2]", "primitive 1099511627776"]),
        (SkipLists::each(0).geometry(&[0_u64, 1 << 50, 0]), ["skip_primitive[1]", "geometry 1125899906842624"]),
        (SkipLists::lists(&[0, 1, 1, 2], &[1_u32, 9]), ["skip_primitive[1]", "primitive 9"]),
    ] {
        let rays = rays.with_skip(skip)?;
        let (mut t, mut flags, mut offsets) = ([-1.0_f64; 3], [7_u8; 3], [7_u64; 4]);
        let options = QueryOptions::new();
        for message in [
            refusal(scene.intersect_batch_into(&rays, HitsMut::new().t(&mut t), &options)),
            refusal(scene.occluded_batch_into(&rays, &mut flags, &options)),
            refusal(scene.intersect_all_batch_into(&rays, &mut offsets, HitsMut::new(), &options)),
            refusal(view.intersect_batch(&rays)),
            refusal(OneShot::new().intersect(&[mesh.triangles()], &rays)),
            refusal(OneShot::new().occluded(&[mesh.triangles()], &rays)),
        ] {
            assert!(words.iter().all(|word| message.contains(word)), "{message}");
        }
        assert_eq!((t, flags, offsets), ([-1.0; 3], [7; 3], [7; 4]), "nothing is written when a list is wrong");
    }
    Ok(())
}

#[test]
fn an_empty_batch_and_empty_lists_are_fine() -> Result {
    let scene = stack(1)?;
    let none: [[f64; 3]; 0] = [];
    let no_ids: [u32; 0] = [];
    let rays = Rays::new(&none, &none)?;
    assert!(scene.intersect_batch(&rays.with_skip(SkipLists::each(&no_ids))?)?.is_empty());
    assert!(scene.intersect_batch(&rays.with_skip(SkipLists::lists(&[0], &no_ids).geometry(&no_ids))?)?.is_empty());
    let rays = Rays::new([0.75, 0.25, 1.0], &[DOWN; 2])?;
    let hits = scene.intersect_batch(&rays.with_skip(SkipLists::lists(&[0; 3], &no_ids).geometry(&no_ids))?)?;
    assert_eq!(hits.primitive, [0, 0]);
    Ok(())
}
