//! raywise beside ray tracing crates, ray by ray in one thread, and what building takes.
//!
//! `RAYWISE_BENCH_SCENES` names the folder with the scenes, `RAYWISE_BENCH_QUICK=1` asks fewer rays for a shorter time. Criterion
//! runs one subject after the other; hits are compared before, and a difference beyond one ray in ten thousand is told.

use std::path::Path;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use raywise_bench::{scenes_in, BvhCrate, ObvhsBvh2, ObvhsCwBvh, Parry, Raywise, Scene, Subject, RAY_KINDS};

struct Plan {
    most_rays: usize,
    warm_up: Duration,
    measurement: Duration,
}

fn plan() -> Plan {
    if std::env::var("RAYWISE_BENCH_QUICK").is_ok_and(|value| value == "1") {
        Plan { most_rays: 2000, warm_up: Duration::from_millis(100), measurement: Duration::from_millis(300) }
    } else {
        Plan { most_rays: 20_000, warm_up: Duration::from_millis(500), measurement: Duration::from_secs(3) }
    }
}

fn group<'a>(criterion: &'a mut Criterion, name: String, plan: &Plan) -> BenchmarkGroup<'a, WallTime> {
    let mut group = criterion.benchmark_group(name);
    group.sample_size(10).warm_up_time(plan.warm_up).measurement_time(plan.measurement);
    group
}

/// Every ray of a kind, thinned out to the number that is asked.
fn prepared<S: Subject>(scene: &Scene, kind: usize, plan: &Plan) -> Vec<S::OwnRay> {
    let stride = scene.rays[kind].len().div_ceil(plan.most_rays).max(1);
    scene.rays[kind].iter().step_by(stride).map(S::prepare).collect()
}

fn hits<S: Subject>(subject: &S, rays: &[S::OwnRay], any: bool) -> usize {
    if any {
        rays.iter().filter(|ray| subject.any(ray)).count()
    } else {
        rays.iter().filter(|ray| subject.closest(ray)).count()
    }
}

/// `expected`: hits of the first subject, kind by kind; empty for the first.
fn measure<S: Subject>(criterion: &mut Criterion, scene: &Scene, plan: &Plan, expected: &mut Vec<usize>) {
    let mut building = group(criterion, format!("{}/build", scene.name), plan);
    building.throughput(Throughput::Elements(scene.triangles.len() as u64));
    building.bench_function(S::NAME, |bencher| bencher.iter_with_large_drop(|| S::build(scene)));
    building.finish();

    let subject = S::build(scene);
    for (kind, &(name, any)) in RAY_KINDS.iter().enumerate() {
        let rays = prepared::<S>(scene, kind, plan);
        if rays.is_empty() {
            continue;
        }
        let found = hits(&subject, &rays, any);
        match expected.get(kind) {
            None => expected.push(found),
            Some(&right) if found.abs_diff(right) * 10_000 > rays.len() => {
                eprintln!(
                    "warning: {}, {name}: {} finds {found} hits of {} rays, raywise {right}",
                    scene.name,
                    S::NAME,
                    rays.len()
                );
            }
            Some(_) => {}
        }
        let mut asking = group(criterion, format!("{}/{name}", scene.name), plan);
        asking.throughput(Throughput::Elements(rays.len() as u64));
        asking.bench_function(S::NAME, |bencher| bencher.iter(|| hits(&subject, &rays, any)));
        asking.finish();
    }
}

fn main() {
    let folder = std::env::var("RAYWISE_BENCH_SCENES").expect("RAYWISE_BENCH_SCENES names the folder with the scenes");
    let plan = plan();
    let mut criterion = Criterion::default().configure_from_args();
    for scene in scenes_in(Path::new(&folder)).expect("scenes that can be read") {
        let mut expected = Vec::new();
        measure::<Raywise>(&mut criterion, &scene, &plan, &mut expected);
        measure::<BvhCrate>(&mut criterion, &scene, &plan, &mut expected);
        measure::<ObvhsBvh2>(&mut criterion, &scene, &plan, &mut expected);
        measure::<ObvhsCwBvh>(&mut criterion, &scene, &plan, &mut expected);
        measure::<Parry>(&mut criterion, &scene, &plan, &mut expected);
    }
    criterion.final_summary();
}
