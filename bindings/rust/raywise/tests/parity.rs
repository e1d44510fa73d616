//! The cases that the C, Python and Rust interfaces answer alike, bit by bit: tests/parity/cases.json of the project.

mod common;

use std::collections::BTreeMap;
use std::path::Path;

use common::{bits, columns, scene_with, Bits, Result, TestMesh};
use raywise::{Hit, OneShot, PrimitiveId, Ray, RayOptions, Rays, SkipLists};
use serde_json::Value;

struct Case {
    mesh: String,
    ray: Ray,
    skip: Vec<PrimitiveId>,
    /// Closest first.
    hits: Vec<Bits>,
    normals: Vec<[f64; 3]>,
}

impl Case {
    fn closest(&self) -> Bits {
        self.hits.first().copied().flatten()
    }

    fn is_hit(&self) -> bool {
        !self.hits.is_empty()
    }
}

fn number(value: &Value) -> f64 {
    match value {
        Value::String(text) if text == "inf" => f64::INFINITY,
        Value::String(text) if text == "-inf" => f64::NEG_INFINITY,
        Value::String(text) if text == "nan" => f64::NAN,
        other => other.as_f64().unwrap_or_else(|| panic!("{other} is not a number")),
    }
}

fn three<T: Copy + Default>(value: &Value, read: impl Fn(&Value) -> T) -> [T; 3] {
    let list = value.as_array().unwrap_or_else(|| panic!("{value} is not a list"));
    assert_eq!(list.len(), 3, "{value}");
    [0, 1, 2].map(|index| read(&list[index]))
}

/// A float64 as the hexadecimal digits of its bits.
fn from_bits(value: &Value) -> f64 {
    let text = value.as_str().unwrap_or_else(|| panic!("{value} is not a text"));
    let digits = text.strip_prefix("0x").unwrap_or_else(|| panic!("{text} does not begin with 0x"));
    f64::from_bits(u64::from_str_radix(digits, 16).unwrap_or_else(|cause| panic!("{text}: {cause}")))
}

fn id(value: &Value) -> u32 {
    value.as_u64().and_then(|id| id.try_into().ok()).unwrap_or_else(|| panic!("{value} is not an id"))
}

fn hit_of(hit: &Value) -> Hit {
    Hit {
        t: from_bits(&hit["t"]),
        u: from_bits(&hit["u"]),
        v: from_bits(&hit["v"]),
        instance: None,
        geometry: id(&hit["geometry"]),
        primitive: id(&hit["primitive"]),
    }
}

fn read() -> (BTreeMap<String, TestMesh>, Vec<Case>) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../tests/parity/cases.json");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|cause| panic!("{}: {cause}", path.display()));
    let file: Value = serde_json::from_str(&text).unwrap();
    let list = |value: &Value| value.as_array().unwrap_or_else(|| panic!("{value} is not a list")).clone();

    let meshes = list(&file["meshes"]).into_iter().map(|mesh| {
        let vertices = list(&mesh["vertices"]).iter().map(|vertex| three(vertex, number)).collect();
        let triangles = list(&mesh["triangles"]).iter().map(|corners| three(corners, id)).collect();
        (mesh["name"].as_str().unwrap().to_owned(), TestMesh { vertices, triangles })
    });
    let cases = list(&file["cases"]).into_iter().map(|case| Case {
        mesh: case["mesh"].as_str().unwrap().to_owned(),
        ray: Ray::new(three(&case["origin"], number), three(&case["direction"], number))
            .between(number(&case["tmin"]), number(&case["tmax"])),
        skip: list(&case["skip"]).iter().map(|pair| PrimitiveId::new(id(&pair[0]), id(&pair[1]))).collect(),
        hits: list(&case["hits"]).iter().map(|hit| bits(Some(hit_of(hit)))).collect(),
        normals: list(&case["hits"]).iter().map(|hit| three(&hit["normal"], from_bits)).collect(),
    });
    (meshes.collect(), cases.collect())
}

#[test]
fn every_structure_answers_the_shared_cases_bit_by_bit() -> Result {
    let (meshes, cases) = read();
    assert!(cases.iter().any(|case| !case.skip.is_empty()) && cases.iter().any(|case| case.hits.len() > 1));
    for (name, mesh) in &meshes {
        let cases: Vec<&Case> = cases.iter().filter(|case| case.mesh == *name).collect();
        assert!(!cases.is_empty(), "no case asks the mesh {name}");
        let rays: Vec<Ray> = cases.iter().map(|case| case.ray).collect();
        let (origins, directions) = columns(&rays);
        let tmin: Vec<f64> = rays.iter().map(|ray| ray.tmin).collect();
        let tmax: Vec<f64> = rays.iter().map(|ray| ray.tmax).collect();
        let skipped: Vec<PrimitiveId> = cases.iter().flat_map(|case| case.skip.iter().copied()).collect();
        let geometry: Vec<u32> = skipped.iter().map(PrimitiveId::geometry).collect();
        let primitive: Vec<u32> = skipped.iter().map(PrimitiveId::primitive).collect();
        let ends = cases.iter().scan(0, |end, case| {
            *end += case.skip.len() as u64;
            Some(*end)
        });
        let offsets: Vec<u64> = std::iter::once(0).chain(ends).collect();
        let batch = Rays::new(&origins, &directions)?
            .with_tmin(&tmin)?
            .with_tmax(&tmax)?
            .with_skip(SkipLists::lists(&offsets, &primitive).geometry(&geometry))?;

        for structure in raywise::structures()? {
            let scene = scene_with(structure, mesh)?;
            let (hits, all) = (scene.intersect_batch(&batch)?, scene.intersect_all_batch(&batch)?);
            let occluded = scene.occluded_batch(&batch)?;
            let once = OneShot::new().structure(structure).intersect(&[mesh.triangles()], &batch)?;
            for (index, case) in cases.iter().enumerate() {
                let what = format!("{structure}, mesh {name}, case {index}: {:?}, skip {:?}", case.ray, case.skip);
                let options = RayOptions::new().skip(&case.skip);
                let as_bits = |hits: Vec<Hit>| hits.into_iter().map(|hit| bits(Some(hit))).collect::<Vec<_>>();
                assert_eq!(bits(hits.get(index)), case.closest(), "batch, {what}");
                assert_eq!(occluded[index], case.is_hit(), "batch, {what}");
                assert_eq!(as_bits(all.of_ray(index).collect()), case.hits, "batch, {what}");
                assert_eq!(bits(once.get(index)), case.closest(), "once, {what}");
                assert_eq!(bits(scene.intersect_with(&case.ray, &options)?), case.closest(), "{what}");
                assert_eq!(scene.occluded_with(&case.ray, &options)?, case.is_hit(), "{what}");
                assert_eq!(as_bits(scene.intersect_all_with(&case.ray, &options)?), case.hits, "{what}");
                let found = scene.intersect_all_with(&case.ray, &options)?;
                let normals: Vec<_> = found.iter().map(|hit| scene.normal(hit)).collect::<raywise::Result<_>>()?;
                assert_eq!(normals, case.normals, "{what}");
                assert_eq!(hits.normal[index], case.normals.first().copied().unwrap_or_default(), "batch, {what}");
                if case.skip.is_empty() {
                    assert_eq!(bits(scene.intersect(&case.ray)?), case.closest(), "{what}");
                    assert_eq!(scene.occluded(&case.ray)?, case.is_hit(), "{what}");
                    assert_eq!(as_bits(scene.intersect_all(&case.ray)?), case.hits, "{what}");
                }
            }
        }
    }
    assert!(cases.iter().all(|case| meshes.contains_key(&case.mesh)), "a case asks a mesh that is not there");
    Ok(())
}
