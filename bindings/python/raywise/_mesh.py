"""Meshes: read from files, and described for the C library."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any, Dict, List, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _declarations as c
from ._arrays import Array, FloatArray, as_array, as_floats, as_indices, expressible, input_array, require_rows
from ._errors import IndexOutOfRange, RaywiseError, check
from ._handle import Handle, Reference
from ._library import lib
from ._text import PathLike, c_path
from ._words import sized

NUMPY_TYPES = {c.RW_FLOAT32: "f4", c.RW_FLOAT64: "f8", c.RW_UINT32: "u4", c.RW_UINT64: "u8"}


class Memory:
    """Memory of a mesh for NumPy: read-only, and alive for as long as an array looks at it."""

    def __init__(self, reference: Reference, array: c.rw_array, shape: Tuple[int, ...], default: int) -> None:
        type_ = NUMPY_TYPES[array.type or default]
        size = int(type_[1])
        component = array.component_stride or size
        stride = array.stride or component * (shape[1] if len(shape) > 1 else 1)
        self.reference = reference
        self.__array_interface__: Dict[str, Any] = {
            "version": 3,
            "shape": shape,
            "typestr": f"{'<' if np.little_endian else '>'}{type_}",
            "data": (array.data or 0, True),
            "strides": (stride, component)[: len(shape)],
        }


def library_array(reference: Reference, array: c.rw_array, shape: Tuple[int, ...], default: int) -> Array:
    """An array of the library's as a NumPy array, without copying."""
    if not array.data or 0 in shape:
        return np.empty(shape, NUMPY_TYPES[array.type or default])
    return np.asarray(Memory(reference, array, shape, default))


class Mesh(Handle):
    """A triangle mesh read from an OBJ, PLY, OFF or STL file.

    Hand it to Scene or intersect_once in the place of vertices and triangles. It is immutable; any number of threads
    may use it.
    """

    def __init__(self, path: PathLike) -> None:
        """Reads a file; the ending tells the format. A face of n corners becomes n - 2 triangles that cover its inside, also
        where it is concave; a convex one the fan about its first corner.

        Coordinates are as written: vertices is float64 where float32 would change any of them, else float32.

        Raises FileNotFoundError, OSError (unreadable), ValueError (MeshFormat, NoFaces, BadPolygon, IndexOutOfRange,
        NotFinite, TooMany) or MemoryError.

        C: rw_mesh_load; close() is rw_mesh_release.
        """
        address = ctypes.c_void_p()
        check(lib.rw_mesh_load(c_path(path, "path"), ctypes.byref(address)))
        assert address.value is not None
        super().__init__(Reference(address.value, lib.rw_mesh_release))

    @property
    def vertices(self) -> FloatArray:
        """Shape (n, 3), float32 or float64; read-only, the mesh's own memory, which lives as long as the array does.

        C: rw_mesh_triangles.
        """
        reference, triangles = self._triangles()
        return library_array(reference, triangles.vertices, (triangles.vertex_count, 3), c.RW_FLOAT32)

    @property
    def triangles(self) -> "Union[npt.NDArray[np.uint32], npt.NDArray[np.uint64]]":
        """Indices into vertices, shape (m, 3); read-only, the mesh's own memory. C: rw_mesh_triangles."""
        reference, triangles = self._triangles()
        shape = (triangles.triangle_count, 3)
        if not triangles.indices.data:  # triangle i has the vertices 3i, 3i + 1, 3i + 2
            return np.arange(3 * shape[0], dtype=np.uint32).reshape(shape)
        return library_array(reference, triangles.indices, shape, c.RW_UINT32)

    @property
    def face_of_triangle(self) -> npt.NDArray[np.uint32]:
        """The face of the file that each triangle was cut from, shape (m,); read-only. C: rw_mesh_faces."""
        reference, triangles = self._triangles()
        address = ctypes.c_void_p()
        check(lib.rw_mesh_faces(reference.address, ctypes.byref(address), None))
        array = c.rw_array(address.value, 0, 0, c.RW_UINT32, 0)
        return library_array(reference, array, (triangles.triangle_count,), c.RW_UINT32)

    @property
    def face_count(self) -> int:
        """The number of faces in the file. C: rw_mesh_faces."""
        address, count = ctypes.c_void_p(), ctypes.c_uint64()
        check(lib.rw_mesh_faces(self._use().address, ctypes.byref(address), ctypes.byref(count)))
        return count.value

    def _triangles(self) -> Tuple[Reference, c.rw_triangles]:
        reference = self._use()
        triangles = sized(c.rw_triangles)
        check(lib.rw_mesh_triangles(reference.address, triangles))
        return reference, triangles

    def __repr__(self) -> str:
        if self.closed:
            return "<Mesh, closed>"
        _, triangles = self._triangles()
        dtype = np.dtype(NUMPY_TYPES[triangles.vertices.type or c.RW_FLOAT32])
        return f"<Mesh of {triangles.vertex_count} vertices and {triangles.triangle_count} triangles, {dtype}>"


@dataclass(frozen=True)
class Triangles:
    """rw_triangles and what has to be kept for as long as C reads the arrays."""

    struct: c.rw_triangles
    kept: List[object]
    signed: Optional[Array]  # the indices as the caller gave them, when they could be negative

    @property
    def indices(self) -> Optional[object]:
        """What has to be kept of it for its indices; None: it has none."""
        return self.kept[-1] if self.struct.indices.data else None

    def in_callers_terms(self, error: RaywiseError) -> RaywiseError:
        """The same error, in the caller's terms when the index was a negative one."""
        if self.signed is None or self.signed.size == 0 or self.signed.min() >= 0:
            return error
        triangle, corner = (int(i) for i in np.argwhere(self.signed < 0)[0])
        return IndexOutOfRange(
            error.status, f"triangles: triangle {triangle}: index {self.signed[triangle, corner]} is negative"
        )


def triangles_of(
    vertices: Union[npt.ArrayLike, Mesh], triangles: Optional[npt.ArrayLike], *, skip_invalid: bool, shared: bool
) -> Triangles:
    """Describes a mesh for the C library. ValueError and TypeError name the argument."""
    flags = (c.RW_TRIANGLES_SHARED if shared else 0) | (c.RW_TRIANGLES_SKIP_INVALID if skip_invalid else 0)
    if isinstance(vertices, Mesh):
        if triangles is not None:
            raise TypeError("triangles: a Mesh has its own")
        reference, struct = vertices._triangles()
        struct.flags |= flags
        return Triangles(struct, [reference], None)

    points = expressible(require_rows(as_floats(vertices, "vertices"), "vertices", 3))
    struct = sized(c.rw_triangles)
    struct.flags = flags
    struct.vertex_count = len(points)
    struct.vertices = input_array(points)
    if triangles is None:
        if len(points) % 3:
            raise ValueError(f"vertices: without triangles each three are one, and {len(points)} is no multiple of 3")
        struct.triangle_count = len(points) // 3
        return Triangles(struct, [points], None)

    given = as_array(triangles, "triangles")
    corners = expressible(require_rows(as_indices(given, "triangles"), "triangles", 3))
    struct.triangle_count = len(corners)
    struct.indices = input_array(corners)
    return Triangles(struct, [points, corners], given if given.dtype.kind == "i" else None)


def moved_triangles_of(
    vertices: npt.ArrayLike, triangle_count: Optional[int], *, skip_invalid: bool, shared: bool
) -> Triangles:
    """Describes a mesh that keeps its indices for rw_scene_refit. ValueError and TypeError name the argument.

    triangle_count: None: there are none to keep, and each three vertices are a triangle.
    """
    points = expressible(require_rows(as_floats(vertices, "vertices"), "vertices", 3))
    struct = sized(c.rw_triangles)
    struct.flags = (c.RW_TRIANGLES_SHARED if shared else 0) | (c.RW_TRIANGLES_SKIP_INVALID if skip_invalid else 0)
    struct.vertex_count = len(points)
    struct.vertices = input_array(points)
    struct.triangle_count = len(points) // 3 if triangle_count is None else triangle_count
    return Triangles(struct, [points], None)
