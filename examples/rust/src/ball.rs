//! A ball of triangles, and what geometry knows about it.

use std::collections::HashMap;

pub type Point = [f64; 3];

/// A closed mesh around the origin, all corners at distance 1.
pub struct Ball {
    pub vertices: Vec<Point>,
    pub triangles: Vec<[u32; 3]>,
}

impl Ball {
    /// An octahedron whose triangles are cut into four, `steps` times.
    pub fn new(steps: u32) -> Self {
        let vertices = vec![
            [1.0, 0.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.0, 0.0, -1.0],
        ];
        let triangles = vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
        let mut ball = Ball { vertices, triangles };
        for _ in 0..steps {
            ball.refine();
        }
        ball
    }

    fn refine(&mut self) {
        let mut middles: HashMap<[u32; 2], u32> = HashMap::new();
        let vertices = &mut self.vertices;
        let mut middle = |a: u32, b: u32| {
            *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                let (p, q) = (vertices[a as usize], vertices[b as usize]);
                vertices.push(scaled(sum(p, q), 1.0 / length(sum(p, q))));
                vertices.len() as u32 - 1
            })
        };
        let mut refined = Vec::with_capacity(4 * self.triangles.len());
        for &[a, b, c] in &self.triangles {
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            refined.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        self.triangles = refined;
    }

    fn corners(&self, triangle: usize) -> [Point; 3] {
        self.triangles[triangle].map(|corner| self.vertices[corner as usize])
    }

    /// The volume inside, from the tetrahedra between the origin and each triangle.
    pub fn volume(&self) -> f64 {
        (0..self.triangles.len())
            .map(|triangle| {
                let [a, b, c] = self.corners(triangle);
                dot(a, cross(b, c)) / 6.0
            })
            .sum()
    }

    /// The distance from the origin to the nearest triangle's plane: a smaller ball that fits inside.
    pub fn inner_radius(&self) -> f64 {
        (0..self.triangles.len())
            .map(|triangle| {
                let [a, b, c] = self.corners(triangle);
                let normal = cross(difference(b, a), difference(c, a));
                dot(normal, a) / length(normal)
            })
            .fold(f64::INFINITY, f64::min)
    }

    /// The outward unit normal of a triangle.
    pub fn normal(&self, triangle: usize) -> Point {
        let [a, b, c] = self.corners(triangle);
        let normal = cross(difference(b, a), difference(c, a));
        scaled(normal, 1.0 / length(normal))
    }

    /// The point of a triangle with weight u for its second corner and v for its third.
    pub fn point(&self, triangle: usize, u: f64, v: f64) -> Point {
        let [a, b, c] = self.corners(triangle);
        sum(scaled(a, 1.0 - u - v), sum(scaled(b, u), scaled(c, v)))
    }
}

pub fn sum(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub fn difference(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub fn scaled(a: Point, factor: f64) -> Point {
    a.map(|x| factor * x)
}

pub fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn length(a: Point) -> f64 {
    dot(a, a).sqrt()
}
