//! Meshes read from files.

use std::path::Path;

use raywise_sys as sys;

use crate::handle::Handle;
use crate::library::{check, ensure_abi, size_of_struct};
use crate::{text, Result, Triangles};

/// A mesh read from an OBJ, PLY, OFF or STL file (`rw_mesh`). Cloning shares it.
#[derive(Clone, Debug)]
pub struct Mesh {
    _handle: Handle<sys::rw_mesh>,
    raw: RawTriangles,
    faces: *const u32,
    face_count: u64,
}

/// The arrays of a mesh, which belong to it and never change.
#[derive(Clone, Copy, Debug)]
struct RawTriangles(sys::rw_triangles);

// SAFETY: a mesh never changes after loading; the pointers lead to arrays that it owns, and it is kept beside them.
unsafe impl Send for Mesh {}
// SAFETY: as above.
unsafe impl Sync for Mesh {}

impl Mesh {
    /// Reads a file; its ending tells the format. A face of n corners becomes n - 2 triangles that cover its inside, also where
    /// it is concave; a convex one the fan about its first corner.
    /// Coordinates are as written: `f64` where `f32` would change any of them, else `f32` ([`Mesh::is_float64`]).
    /// Wraps `rw_mesh_load`, `rw_mesh_triangles` and `rw_mesh_faces`.
    ///
    /// # Errors
    /// [`Error::Text`](crate::Error::Text) for a path that is not UTF-8, else what the library says:
    /// [`Status::FILE_NOT_FOUND`](crate::Status::FILE_NOT_FOUND), `FILE_UNREADABLE`, `FILE_FORMAT`, `NO_FACES`,
    /// `BAD_POLYGON`, `INDEX_OUT_OF_RANGE`, `NOT_FINITE`, `TOO_MANY`, `OUT_OF_MEMORY`.
    pub fn load(path: impl AsRef<Path>) -> Result<Mesh> {
        ensure_abi()?;
        let path = text::path_to_c("path", path.as_ref())?;
        // SAFETY: the path is a zero-terminated text and lives through the call.
        let handle = Handle::create(|mesh| unsafe { sys::rw_mesh_load(path.as_ptr(), mesh) })?;

        let mut raw =
            sys::rw_triangles { struct_size: size_of_struct::<sys::rw_triangles>(), ..sys::rw_triangles::default() };
        // SAFETY: the mesh lives, and `raw` says how large it is.
        check(unsafe { sys::rw_mesh_triangles(handle.as_ptr(), &mut raw) })?;

        let (mut faces, mut face_count) = (std::ptr::null(), 0);
        // SAFETY: the mesh lives, and both places live through the call.
        check(unsafe { sys::rw_mesh_faces(handle.as_ptr(), &mut faces, &mut face_count) })?;
        Ok(Mesh { _handle: handle, raw: RawTriangles(raw), faces, face_count })
    }

    /// The mesh's own arrays, ready for [`SceneBuilder::add`](crate::SceneBuilder::add). Nothing is copied.
    #[must_use]
    pub fn triangles(&self) -> Triangles<'_> {
        // SAFETY: the arrays live as long as the mesh, which the result borrows, and never change.
        unsafe { Triangles::from_raw(self.raw.0) }
    }

    /// How many triangles.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.raw.0.triangle_count as usize
    }

    /// Whether the mesh holds its vertices as `f64`, because `f32` would change a coordinate of the file.
    #[must_use]
    pub fn is_float64(&self) -> bool {
        self.raw.0.vertices.type_ == sys::RW_FLOAT64
    }

    /// A copy of the vertices.
    #[must_use]
    pub fn vertices(&self) -> Vec<[f64; 3]> {
        let array = &self.raw.0.vertices;
        let count = self.raw.0.vertex_count;
        // SAFETY: the mesh owns `count` vertices of three coordinates of the type the array names.
        unsafe {
            match array.type_ {
                sys::RW_FLOAT64 => copy_rows(array, count, |number: f64| number),
                _ => copy_rows(array, count, |number: f32| f64::from(number)),
            }
        }
    }

    /// A copy of the three corners of each triangle.
    #[must_use]
    pub fn indices(&self) -> Vec<[u32; 3]> {
        let array = &self.raw.0.indices;
        let count = self.raw.0.triangle_count;
        if array.data.is_null() {
            return (0..count as u32).map(|triangle| [3 * triangle, 3 * triangle + 1, 3 * triangle + 2]).collect();
        }
        // SAFETY: the mesh owns `count` triples of the type the array names; vertices are fewer than 2^32.
        unsafe {
            match array.type_ {
                sys::RW_UINT64 => copy_rows(array, count, |index: u64| index as u32),
                _ => copy_rows(array, count, |index: u32| index),
            }
        }
    }

    /// Which face of the file each triangle was cut from. As told by `rw_mesh_faces`.
    #[must_use]
    pub fn face_of_triangle(&self) -> &[u32] {
        if self.faces.is_null() || self.triangle_count() == 0 {
            return &[];
        }
        // SAFETY: the mesh owns one number per triangle there, and the result borrows the mesh.
        unsafe { std::slice::from_raw_parts(self.faces, self.triangle_count()) }
    }

    /// How many faces the file has. As told by `rw_mesh_faces`.
    #[must_use]
    pub fn face_count(&self) -> u64 {
        self.face_count
    }
}

/// Copies rows of three, wherever they lie.
///
/// # Safety
/// `array` names `count` rows of three elements of type `T`.
unsafe fn copy_rows<T: Copy, R>(array: &sys::rw_array, count: u64, convert: impl Fn(T) -> R) -> Vec<[R; 3]> {
    let size = std::mem::size_of::<T>() as i64;
    let across = if array.component_stride == 0 { size } else { array.component_stride };
    let down = if array.stride == 0 { 3 * size } else { array.stride };
    let element = |row: u64, component: i64| {
        let offset = row as i64 * down + component * across;
        let place = array.data.cast::<u8>().wrapping_offset(offset as isize).cast::<T>();
        // SAFETY: row and component are of the array; no alignment is promised, hence the unaligned read.
        convert(unsafe { place.read_unaligned() })
    };
    (0..count).map(|row| [0, 1, 2].map(|component| element(row, component))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_copied_wherever_they_lie() {
        let planar = [1.0_f32, 2.0, 10.0, 20.0, 100.0, 200.0];
        let array = sys::rw_array {
            data: planar.as_ptr().cast(),
            stride: 4,
            component_stride: 8,
            type_: sys::RW_FLOAT32,
            reserved: 0,
        };
        // SAFETY: two rows of three, columns apart.
        let rows = unsafe { copy_rows(&array, 2, |number: f32| f64::from(number)) };
        assert_eq!(rows, [[1.0, 10.0, 100.0], [2.0, 20.0, 200.0]]);

        let packed = sys::rw_array { stride: 0, component_stride: 0, ..array };
        // SAFETY: two rows of three, packed.
        let rows = unsafe { copy_rows(&packed, 2, |number: f32| number) };
        assert_eq!(rows, [[1.0, 2.0, 10.0], [20.0, 100.0, 200.0]]);
    }
}
