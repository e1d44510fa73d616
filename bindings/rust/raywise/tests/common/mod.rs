//! What the integration tests share: meshes, rays, and scenes with a forced structure.

#![allow(dead_code)] // each test program uses some of it

use std::collections::HashMap;

use raywise::{Hit, Ray, Scene, SceneBuilder, Triangles};

pub type Result<T = (), E = Box<dyn std::error::Error>> = std::result::Result<T, E>;

/// A triangle mesh at float64.
#[derive(Clone, Debug)]
pub struct TestMesh {
    pub vertices: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

impl TestMesh {
    pub fn triangles(&self) -> Triangles<'_> {
        Triangles::new(&self.vertices, &self.triangles)
    }

    pub fn vertices_f32(&self) -> Vec<[f32; 3]> {
        self.vertices.iter().map(|vertex| vertex.map(|x| x as f32)).collect()
    }
}

/// The square from (0, 0, 0) to (1, 1, 0), seen from above.
pub fn square() -> TestMesh {
    TestMesh {
        vertices: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    }
}

/// A ball of triangles around the origin with corners at distance 1: 20 * 4^steps of them.
pub fn icosphere(steps: u32) -> TestMesh {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let mut vertices = Vec::new();
    for (a, b) in [(1.0, golden), (-1.0, golden), (1.0, -golden), (-1.0, -golden)] {
        vertices.extend([[0.0, a, b], [a, b, 0.0], [b, 0.0, a]].map(unit));
    }
    // The faces are the triples of corners that are all one edge apart, turned outwards.
    let edge = 2.0 / (golden * golden + 1.0).sqrt();
    let near = |a: [f64; 3], b: [f64; 3]| (length(minus(a, b)) - edge).abs() < 1e-9;
    let mut triangles = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                let [p, q, r] = [a, b, c].map(|corner| vertices[corner]);
                if near(p, q) && near(q, r) && near(r, p) {
                    let outwards = dot(cross(minus(q, p), minus(r, p)), p) > 0.0;
                    triangles.push(if outwards { [a, b, c] } else { [a, c, b] }.map(|corner| corner as u32));
                }
            }
        }
    }
    let mut mesh = TestMesh { vertices, triangles };
    for _ in 0..steps {
        mesh = split(mesh);
    }
    mesh
}

fn split(mesh: TestMesh) -> TestMesh {
    let mut vertices = mesh.vertices;
    let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            let (p, q) = (vertices[a as usize], vertices[b as usize]);
            vertices.push(unit([p[0] + q[0], p[1] + q[1], p[2] + q[2]]));
            vertices.len() as u32 - 1
        })
    };
    let mut triangles = Vec::new();
    for [a, b, c] in mesh.triangles {
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        triangles.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
    }
    TestMesh { vertices, triangles }
}

/// Numbers that look random and are the same in every run.
pub struct Numbers(u64);

impl Numbers {
    pub fn new(seed: u64) -> Self {
        Numbers(seed)
    }

    /// From 0 to 1 (splitmix64).
    pub fn fraction(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// In the cube from -1 to 1.
    pub fn point(&mut self) -> [f64; 3] {
        [(); 3].map(|()| 2.0 * self.fraction() - 1.0)
    }

    /// A chord through the cube from -1.5 to 1.5.
    pub fn ray(&mut self) -> Ray {
        let (from, to) = (self.point(), self.point());
        Ray::new(from.map(|x| 1.5 * x), minus(to, from).map(|x| 1.5 * x))
    }

    /// Triangles without any order.
    pub fn soup(&mut self, count: usize) -> TestMesh {
        let mut vertices = Vec::new();
        for _ in 0..count {
            let middle = self.point();
            for _ in 0..3 {
                let corner = self.point();
                vertices.push([0, 1, 2].map(|axis| middle[axis] + 0.3 * corner[axis]));
            }
        }
        let triangles = (0..count as u32).map(|triangle| [0, 1, 2].map(|corner| 3 * triangle + corner)).collect();
        TestMesh { vertices, triangles }
    }
}

/// A scene of one mesh with a structure forced.
pub fn scene_with(structure: &str, mesh: &TestMesh) -> Result<Scene> {
    let mut builder = SceneBuilder::new()?;
    builder.add(&mesh.triangles())?;
    builder.set_structure(structure)?;
    Ok(builder.commit()?)
}

/// The same scene once per structure, with the structure's name.
pub fn scenes(mesh: &TestMesh) -> Result<Vec<(&'static str, Scene)>> {
    raywise::structures()?.into_iter().map(|structure| Ok((structure, scene_with(structure, mesh)?))).collect()
}

/// A hit as bits, for comparisons that let nothing pass.
pub type Bits = Option<([u64; 3], [Option<u32>; 3])>;

pub fn bits(hit: Option<Hit>) -> Bits {
    hit.map(|hit| {
        let numbers = [hit.t, hit.u, hit.v].map(f64::to_bits);
        (numbers, [hit.instance, Some(hit.geometry), Some(hit.primitive)])
    })
}

/// The origins and the directions of rays, as a batch wants them.
pub fn columns(rays: &[Ray]) -> (Vec<[f64; 3]>, Vec<[f64; 3]>) {
    rays.iter().map(|ray| (ray.origin, ray.direction)).unzip()
}

pub fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

pub fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = length(a);
    a.map(|x| x / length)
}
