//! Measures a ball with rays, and checks every answer against geometry.
//!
//! Exit code 0: all is as it should be. 1: an answer is wrong. 2: a call failed.

mod ball;

use std::process::ExitCode;

use ball::{difference, dot, length, sum, Ball, Point};
use raywise::{ExpectedRays, Hit, Ray, RayKind, Rays, Scene, SceneBuilder, ViewOptions};

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Rays along each side of the square from -1.05 to 1.05.
const SIDE: usize = 400;
const HALF_WIDTH: f64 = 1.05;
const EYE: Point = [0.4, -0.3, 3.0];

fn main() -> ExitCode {
    match run() {
        Ok(wrong) if wrong.is_empty() => {
            println!("all answers are right");
            ExitCode::SUCCESS
        }
        Ok(wrong) => {
            for what in wrong {
                eprintln!("wrong: {what}");
            }
            ExitCode::from(1)
        }
        Err(error) => {
            eprintln!("failed: {error}");
            ExitCode::from(2)
        }
    }
}

/// Returns what is wrong.
fn run() -> Result<Vec<String>> {
    let ball = Ball::new(6);
    let ray_count = 2 * SIDE * SIDE;

    let mut builder = SceneBuilder::new()?;
    builder.add_triangles(&ball.vertices, &ball.triangles)?;
    builder.expect_rays(&ExpectedRays::new(ray_count as u64).kind(RayKind::Camera))?;
    let scene = builder.commit()?;

    let statistics = scene.statistics()?;
    println!("raywise {}: {} triangles, {ray_count} rays expected", raywise::version()?, statistics.triangle_count);
    println!("structure {}, built in {:.1} ms", statistics.structure, statistics.build_ns / 1e6);

    let mut wrong = Vec::new();
    check_volume(&ball, &scene, &mut wrong)?;
    check_camera(&ball, &scene, &mut wrong)?;
    check_inside(&ball, &scene, &mut wrong)?;
    Ok(wrong)
}

/// Parallel rays find where they enter and leave the ball; the lengths inside add up to its volume.
fn check_volume(ball: &Ball, scene: &Scene, wrong: &mut Vec<String>) -> Result<()> {
    let step = 2.0 * HALF_WIDTH / SIDE as f64;
    let origins: Vec<Point> = grid(step).map(|(x, y)| [x, y, 2.0]).collect();
    let found = scene.intersect_all_batch(&Rays::new(&origins, [0.0, 0.0, -1.0])?)?;

    let inner = ball.inner_radius();
    let mut inside = 0.0;
    for (ray, origin) in origins.iter().enumerate() {
        let t: Vec<f64> = found.of_ray(ray).map(|hit| hit.t).collect();
        // Between ball and circumscribed ball lies the truth about a polyhedron.
        let from_axis = origin[0].hypot(origin[1]);
        let bounds = [inner, 1.0].map(|radius: f64| 2.0 * (radius * radius - from_axis * from_axis).max(0.0).sqrt());
        let chord = t.last().copied().unwrap_or(0.0) - t.first().copied().unwrap_or(0.0);
        if chord < bounds[0] - 1e-9 || chord > bounds[1] + 1e-9 {
            wrong.push(format!("ray {ray} is {chord} long inside the ball, not {} to {}", bounds[0], bounds[1]));
        }
        inside += chord;
    }
    let measured = inside * step * step;
    let exact = ball.volume();
    println!("volume: {measured:.5} by {} rays, {exact:.5} by geometry", origins.len());
    if (measured / exact - 1.0).abs() > 1e-3 {
        wrong.push(format!("the volume is {measured}, not {exact}"));
    }
    Ok(())
}

/// Rays from an eye meet the surface where the triangle they name says; seen through a view it is the same.
fn check_camera(ball: &Ball, scene: &Scene, wrong: &mut Vec<String>) -> Result<()> {
    let towards = difference([0.0; 3], EYE);
    let view = scene.view(&ViewOptions::from_point(EYE).towards(towards).half_angle(0.5).rays((SIDE * SIDE) as u64))?;
    let directions: Vec<Point> = grid(2.4 / SIDE as f64).map(|(x, y)| sum(towards, [x, y, 0.0])).collect();
    let rays = Rays::new(EYE, &directions)?;
    let hits = view.intersect_batch(&rays)?;
    if hits != scene.intersect_batch(&rays)? {
        wrong.push("the view answers otherwise than its scene".to_owned());
    }

    let inner = ball.inner_radius();
    for ((direction, hit), normal) in directions.iter().zip(hits.iter()).zip(&hits.normal) {
        let along = -dot(EYE, *direction) / dot(*direction, *direction);
        let nearest = length(Ray::new(EYE, *direction).at(along));
        match hit {
            Some(hit) => check_hit(ball, *direction, hit, *normal, wrong),
            None if nearest < inner => wrong.push(format!("the ray along {direction:?} should hit")),
            None => {}
        }
        if hit.is_some() && nearest > 1.0 + 1e-9 {
            wrong.push(format!("the ray along {direction:?} should miss"));
        }
    }
    let seen = hits.iter().flatten().count();
    println!("camera: {seen} of {} rays meet the ball", hits.len());
    Ok(())
}

fn check_hit(ball: &Ball, direction: Point, hit: Hit, normal: Point, wrong: &mut Vec<String>) {
    let triangle = hit.primitive as usize;
    let by_ray = Ray::new(EYE, direction).at(hit.t);
    let by_triangle = ball.point(triangle, hit.u, hit.v);
    if length(difference(by_ray, by_triangle)) > 1e-9 {
        wrong.push(format!("triangle {triangle}: the ray is at {by_ray:?}, u and v say {by_triangle:?}"));
    }
    if length(difference(normal, ball.normal(triangle))) > 1e-9 || dot(normal, direction) >= 0.0 {
        wrong.push(format!("triangle {triangle}: the normal is {:?}, not {:?}", normal, ball.normal(triangle)));
    }
}

/// From the middle every ray hits once, and never before the inner radius.
fn check_inside(ball: &Ball, scene: &Scene, wrong: &mut Vec<String>) -> Result<()> {
    let inner = ball.inner_radius();
    for &corner in ball.vertices.iter().step_by(37) {
        // Straight at a corner, where six triangles meet: a ray that slipped through would leave the ball unseen.
        let hits = scene.intersect_all(&Ray::new([0.0; 3], corner))?;
        let closest = hits.first().map(|hit| hit.t);
        if !closest.is_some_and(|t| (t - 1.0).abs() < 1e-9) {
            wrong.push(format!("the ray at the corner {corner:?} hits at {closest:?}"));
        }
        if scene.occluded(&Ray::new([0.0; 3], corner).between(0.0, inner - 1e-9))? {
            wrong.push(format!("something is on the way to the corner {corner:?}"));
        }
    }
    Ok(())
}

/// The middles of the cells of a square grid around the origin.
fn grid(step: f64) -> impl Iterator<Item = (f64, f64)> {
    let place = move |index: usize| (index as f64 + 0.5 - SIDE as f64 / 2.0) * step;
    (0..SIDE * SIDE).map(move |index| (place(index % SIDE), place(index / SIDE)))
}
