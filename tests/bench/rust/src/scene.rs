//! Scenes and rays in files; `tests/bench/export_scene.h` says how they are laid out.

use std::fs;
use std::io;
use std::path::Path;

/// The kinds of rays in the order of the file, and whether they ask for any hit.
pub const RAY_KINDS: [(&str, bool); 4] = [("random", false), ("camera", false), ("shadow", true), ("diffuse", false)];

pub struct Ray {
    pub origin: [f32; 3],
    pub direction: [f32; 3],
    pub tmin: f32,
    pub tmax: f32,
}

impl Ray {
    /// For crates whose rays begin at their origin.
    #[must_use]
    pub fn start(&self) -> [f32; 3] {
        [0, 1, 2].map(|axis| self.origin[axis] + self.tmin * self.direction[axis])
    }
}

pub struct Scene {
    pub name: String,
    pub vertices: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
    /// As in [`RAY_KINDS`].
    pub rays: Vec<Vec<Ray>>,
}

impl Scene {
    #[must_use]
    pub fn corners(&self, triangle: usize) -> [[f32; 3]; 3] {
        self.triangles[triangle].map(|corner| self.vertices[corner as usize])
    }

    fn read(path: &Path) -> io::Result<Self> {
        let bytes = fs::read(path)?;
        let mut file = File { rest: &bytes };
        let vertices = triples(&file.values(f32::from_le_bytes)?);
        let triangles = triples(&file.values(u32::from_le_bytes)?);
        let mut rays = Vec::new();
        for _ in RAY_KINDS {
            let origin = triples(&file.values(f32::from_le_bytes)?);
            let direction = triples(&file.values(f32::from_le_bytes)?);
            let tmin = file.values(f32::from_le_bytes)?;
            let tmax = file.values(f32::from_le_bytes)?;
            rays.push(
                (0..tmin.len())
                    .map(|i| Ray { origin: origin[i], direction: direction[i], tmin: tmin[i], tmax: tmax[i] })
                    .collect(),
            );
        }
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Scene { name, vertices, triangles, rays })
    }
}

/// All scenes of a folder, by name.
///
/// # Errors
/// A file that cannot be read or breaks off.
pub fn scenes_in(folder: &Path) -> io::Result<Vec<Scene>> {
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|ending| ending == "scene") {
            paths.push(path);
        }
    }
    paths.sort();
    paths.iter().map(|path| Scene::read(path)).collect()
}

struct File<'a> {
    rest: &'a [u8],
}

impl File<'_> {
    fn take(&mut self, count: usize) -> io::Result<&[u8]> {
        let (taken, rest) = self.rest.split_at_checked(count).ok_or(io::ErrorKind::UnexpectedEof)?;
        self.rest = rest;
        Ok(taken)
    }

    fn values<T>(&mut self, value: impl Fn([u8; 4]) -> T) -> io::Result<Vec<T>> {
        let mut count = [0; 8];
        count.copy_from_slice(self.take(8)?);
        let bytes = self.take(4 * u64::from_le_bytes(count) as usize)?;
        Ok(bytes.chunks_exact(4).map(|four| value([four[0], four[1], four[2], four[3]])).collect())
    }
}

fn triples<T: Copy>(values: &[T]) -> Vec<[T; 3]> {
    values.chunks_exact(3).map(|three| [three[0], three[1], three[2]]).collect()
}
