//! Triangle meshes for a scene: borrowed ones, which the scene copies, and shared ones, which it reads in place.

use std::any::Any;
use std::fmt;
use std::marker::PhantomData;
use std::sync::Arc;

use raywise_sys as sys;

use crate::arrays::{Indices, Vectors};
use crate::element::{Float, Index};
use crate::library::size_of_struct;
use crate::Mesh;

/// A triangle mesh in the caller's memory (`rw_triangles`). Hits name a triangle by its position in the indices.
///
/// ```
/// use raywise::Triangles;
/// let corners = [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
/// let mesh = Triangles::new(&corners, &[[0_u32, 1, 2]]);
/// assert_eq!(mesh.len(), 1);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Triangles<'a> {
    raw: sys::rw_triangles,
    data: PhantomData<&'a [u8]>,
}

// SAFETY: a shared borrow of plain numbers that nothing writes to.
unsafe impl Send for Triangles<'_> {}
// SAFETY: as above.
unsafe impl Sync for Triangles<'_> {}

impl<'a> Triangles<'a> {
    /// Vertices (`f32` or `f64`) and the three corners of each triangle (`u32` or `u64`). They are checked when the mesh
    /// is added to a scene. Degenerate triangles are legal and are never hit.
    pub fn new(vertices: impl Into<Vectors<'a>>, indices: impl Into<Indices<'a>>) -> Self {
        let (vertices, indices) = (vertices.into(), indices.into());
        let raw = sys::rw_triangles {
            vertex_count: vertices.len() as u64,
            vertices: vertices.raw(),
            triangle_count: indices.len() as u64,
            indices: indices.raw(),
            ..Default::default()
        };
        // SAFETY: both arrays are borrowed during 'a.
        unsafe { Self::from_raw(raw) }
    }

    /// Triangles without indices: triangle i has the vertices 3i, 3i + 1 and 3i + 2.
    pub fn soup(vertices: impl Into<Vectors<'a>>) -> Self {
        let vertices = vertices.into();
        let raw = sys::rw_triangles {
            vertex_count: vertices.len() as u64,
            vertices: vertices.raw(),
            triangle_count: vertices.len() as u64 / 3,
            ..Default::default()
        };
        // SAFETY: the array is borrowed during 'a.
        unsafe { Self::from_raw(raw) }
    }

    /// The vertices alone of a mesh of so many triangles that has moved, for [`Scene::refit`](crate::Scene::refit): it keeps
    /// the indices that it has in the scene, and has to have as many vertices as there.
    pub fn moved(vertices: impl Into<Vectors<'a>>, triangles: usize) -> Self {
        let vertices = vertices.into();
        let raw = sys::rw_triangles {
            vertex_count: vertices.len() as u64,
            vertices: vertices.raw(),
            triangle_count: triangles as u64,
            ..Default::default()
        };
        // SAFETY: the array is borrowed during 'a.
        unsafe { Self::from_raw(raw) }
    }

    /// Lets triangles with a NaN, infinite or out-of-range vertex or index be never hit, instead of an error. Ids do not
    /// shift. `RW_TRIANGLES_SKIP_INVALID`.
    #[must_use]
    pub fn skip_invalid(mut self) -> Self {
        self.raw.flags |= sys::RW_TRIANGLES_SKIP_INVALID;
        self
    }

    /// How many triangles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.raw.triangle_count as usize
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.raw.triangle_count == 0
    }

    /// How many vertices.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.raw.vertex_count as usize
    }

    /// # Safety
    /// The arrays that `raw` names stay as they are during `'a`.
    pub(crate) unsafe fn from_raw(raw: sys::rw_triangles) -> Self {
        Triangles {
            raw: sys::rw_triangles { struct_size: size_of_struct::<sys::rw_triangles>(), ..raw },
            data: PhantomData,
        }
    }

    pub(crate) fn raw(&self) -> sys::rw_triangles {
        self.raw
    }
}

/// A triangle mesh that a scene reads in place instead of copying it (`RW_TRIANGLES_SHARED`). The scene keeps its part of
/// the ownership, so there is no lifetime to look after.
///
/// ```
/// use std::sync::Arc;
/// use raywise::SharedTriangles;
/// let vertices: Arc<[[f32; 3]]> = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].into();
/// let indices: Arc<[[u32; 3]]> = vec![[0, 1, 2]].into();
/// let mesh = SharedTriangles::new(vertices.clone(), indices);
/// ```
#[derive(Clone)]
pub struct SharedTriangles {
    raw: Triangles<'static>,
    keep: Keep,
}

/// What has to stay alive as long as a scene does.
pub(crate) type Keep = Arc<dyn Any + Send + Sync>;

impl SharedTriangles {
    /// Vertices and corners that are shared with the caller.
    #[must_use]
    pub fn new<F: Float, I: Index>(vertices: Arc<[[F; 3]]>, indices: Arc<[[I; 3]]>) -> Self {
        let raw = Triangles::new(&*vertices, &*indices).raw;
        // SAFETY: the arrays lie behind the two `Arc`s: they do not move with them, and cannot change while they are
        // shared. What is made from the result keeps the `Arc`s as long as it uses the arrays.
        let raw = unsafe { Triangles::from_raw(raw) };
        SharedTriangles { raw, keep: Arc::new((vertices, indices)) }
    }

    /// A mesh that lives as long as the program.
    #[must_use]
    pub fn from_static(triangles: Triangles<'static>) -> Self {
        SharedTriangles { raw: triangles, keep: Arc::new(()) }
    }

    /// The triangles of a mesh read from a file.
    #[must_use]
    pub fn from_mesh(mesh: &Mesh) -> Self {
        let raw = mesh.triangles().raw;
        // SAFETY: the arrays belong to the mesh and never change, and the clone keeps it.
        let raw = unsafe { Triangles::from_raw(raw) };
        SharedTriangles { raw, keep: Arc::new(mesh.clone()) }
    }

    /// As [`Triangles::skip_invalid`].
    #[must_use]
    pub fn skip_invalid(mut self) -> Self {
        self.raw = self.raw.skip_invalid();
        self
    }

    /// How many triangles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.raw.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.raw.is_empty()
    }

    pub(crate) fn into_parts(self) -> (sys::rw_triangles, Keep) {
        let mut raw = self.raw.raw;
        raw.flags |= sys::RW_TRIANGLES_SHARED;
        (raw, self.keep)
    }
}

impl fmt::Debug for SharedTriangles {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("SharedTriangles")
            .field("vertices", &self.raw.vertex_count())
            .field("triangles", &self.len())
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_soup_has_a_third_as_many_triangles_as_vertices() {
        let vertices = [[0.0_f64; 3]; 6];
        let soup = Triangles::soup(&vertices);
        assert_eq!((soup.len(), soup.vertex_count()), (2, 6));
        assert!(soup.raw().indices.data.is_null());
        assert_eq!(soup.raw().flags, 0);
        assert_eq!(soup.skip_invalid().raw().flags, sys::RW_TRIANGLES_SKIP_INVALID);
    }

    #[test]
    fn a_shared_mesh_keeps_its_arrays() {
        let vertices: Arc<[[f32; 3]]> = vec![[0.0; 3]; 3].into();
        let indices: Arc<[[u64; 3]]> = vec![[0, 1, 2]].into();
        let shared = SharedTriangles::new(vertices.clone(), indices);
        assert_eq!(Arc::strong_count(&vertices), 2);
        let (raw, keep) = shared.into_parts();
        assert_eq!(raw.vertices.data, vertices.as_ptr().cast());
        assert_eq!(raw.flags, sys::RW_TRIANGLES_SHARED);
        assert_eq!(Arc::strong_count(&vertices), 2);
        drop(keep);
        assert_eq!(Arc::strong_count(&vertices), 1);
    }
}
