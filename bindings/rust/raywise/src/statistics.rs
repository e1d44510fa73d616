//! Figures about a scene.

use raywise_sys as sys;

use crate::text;

/// What is in a scene and what it has cost (`rw_scene_statistics`).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SceneStatistics {
    /// How many meshes.
    pub geometry_count: u32,
    /// All triangles, degenerate and invalid ones included.
    pub triangle_count: u64,
    /// Triangles without area, which are never hit.
    pub degenerate_triangles: u64,
    /// Triangles that were skipped as invalid, which are never hit.
    pub invalid_triangles: u64,
    /// The structure in use.
    pub structure: &'static str,
    /// Time spent on choosing, ns.
    pub decide_ns: f64,
    /// Time spent on building what is in use, ns.
    pub build_ns: f64,
    /// Memory of the structure.
    pub structure_bytes: u64,
    /// Memory of copied meshes.
    pub geometry_bytes: u64,
    /// Rays answered in batches so far.
    pub rays: u64,
    /// Rays with a NaN so far, single ones included.
    pub invalid_rays: u64,
    /// Wall time of those batches, ns.
    pub rays_ns: f64,
    /// How often the structure was refitted since it was built.
    pub refits: u64,
}

impl SceneStatistics {
    /// # Safety
    /// `raw` was filled by the library.
    pub(crate) unsafe fn from_raw(raw: &sys::rw_scene_statistics) -> Self {
        SceneStatistics {
            geometry_count: raw.geometry_count,
            triangle_count: raw.triangle_count,
            degenerate_triangles: raw.degenerate_triangles,
            invalid_triangles: raw.invalid_triangles,
            // SAFETY: texts in these statistics are constants.
            structure: unsafe { text::constant(raw.structure) },
            decide_ns: raw.decide_ns,
            build_ns: raw.build_ns,
            structure_bytes: raw.structure_bytes,
            geometry_bytes: raw.geometry_bytes,
            rays: raw.rays,
            invalid_rays: raw.invalid_rays,
            rays_ns: raw.rays_ns,
            refits: raw.refits,
        }
    }
}

/// Figures over the cells of a uniform grid (`rw_grid_statistics`; Hapala, Karlik, Havran 2011, equations 1 to 6).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct GridStatistics {
    /// Cells along x, y and z.
    pub resolution: [u32; 3],
    /// All cells.
    pub cells: u64,
    /// Cells without a triangle.
    pub empty_cells: u64,
    /// Triangles over all cells, counted once per cell.
    pub references: u64,
    /// The most triangles in one cell (equation 2).
    pub max_references: u64,
    /// Empty cells over cells (equation 1).
    pub sparseness: f64,
    /// Triangles per cell (equation 3).
    pub mean: f64,
    /// Equation 4.
    pub variance: f64,
    /// Its square root.
    pub standard_deviation: f64,
    /// Equation 5; 0 when the variance is 0.
    pub skewness: f64,
    /// Equation 6: excess kurtosis, minus 3; 0 when the variance is 0.
    pub kurtosis: f64,
}

impl GridStatistics {
    pub(crate) fn from_raw(raw: &sys::rw_grid_statistics) -> Self {
        GridStatistics {
            resolution: raw.resolution,
            cells: raw.cells,
            empty_cells: raw.empty_cells,
            references: raw.references,
            max_references: raw.max_references,
            sparseness: raw.sparseness,
            mean: raw.mean,
            variance: raw.variance,
            standard_deviation: raw.standard_deviation,
            skewness: raw.skewness,
            kurtosis: raw.kurtosis,
        }
    }
}
