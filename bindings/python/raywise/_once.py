"""One shot: the number of rays is known and nothing is kept."""

from __future__ import annotations

import ctypes
from typing import Any, Iterable, List, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _declarations as c
from ._arrays import Array
from ._errors import RaywiseError, error_of
from ._hits import EVERYTHING, Hits, Out
from ._library import lib
from ._mesh import Mesh, Triangles, triangles_of
from ._profile import Profile
from ._queries import answer_closest, answer_occluded
from ._rays import as_rays
from ._skip import SkipLike, is_about_skip
from ._text import c_text
from ._words import RAY_KINDS, Count, constant, sized, unsigned

OneMesh = Union[Mesh, Tuple[npt.ArrayLike, Optional[npt.ArrayLike]]]
Meshes = Union[OneMesh, Sequence[OneMesh]]


def intersect_once(
    meshes: Meshes,
    origins: npt.ArrayLike,
    directions: npt.ArrayLike,
    tmin: Optional[npt.ArrayLike] = None,
    tmax: Optional[npt.ArrayLike] = None,
    *,
    kind: str = "any",
    structure: Optional[str] = None,
    memory_limit: Count = 0,
    profile: Optional[Profile] = None,
    skip_invalid: bool = False,
    skip: Optional[SkipLike] = None,
    want: Iterable[str] = EVERYTHING,
    out: Optional[Out] = None,
    dtype: Optional[npt.DTypeLike] = None,
    threads: Count = 0,
) -> Hits:
    """The closest hit of each ray, against meshes that are used in place and forgotten afterwards.

    The structure is chosen for exactly these rays.

    meshes: a Mesh, a pair (vertices, triangles), or a list of those; hits name mesh i as geometry i. Arrays,
    skip_invalid (of triangles): as for Scene.add_triangles. kind, structure, memory_limit, profile: as for Scene.
    The rest, `skip` among it, the result and its ownership: as for Scene.intersect.

    Raises what Scene, Scene.add_triangles, Scene.commit and Scene.intersect raise. Threads: any; other Python threads
    run meanwhile.

    C: rw_once_intersect.
    """
    call = Once(meshes, skip_invalid, kind, structure, memory_limit, profile)
    rays = as_rays(origins, directions, tmin, tmax, skip)
    hits = answer_closest(
        rays,
        lambda c_rays, c_hits, query: call.run(lib.rw_once_intersect, c_rays, c_hits, query),
        want,
        out,
        dtype,
        threads,
    )
    if out is not None or rays.shape != ():
        return hits
    return Hits({name: array[()] for name, array in hits.arrays.items()}, hits.invalid_rays)


def occluded_once(
    meshes: Meshes,
    origins: npt.ArrayLike,
    directions: npt.ArrayLike,
    tmin: Optional[npt.ArrayLike] = None,
    tmax: Optional[npt.ArrayLike] = None,
    *,
    kind: str = "any",
    structure: Optional[str] = None,
    memory_limit: Count = 0,
    profile: Optional[Profile] = None,
    skip_invalid: bool = False,
    skip: Optional[SkipLike] = None,
    out: Optional[Array] = None,
    threads: Count = 0,
) -> npt.NDArray[np.bool_]:
    """Whether each ray hits anything, against meshes that are used in place and forgotten afterwards.

    Arguments and errors: as for intersect_once; out, the result and its ownership: as for Scene.occluded.

    C: rw_once_occluded.
    """
    call = Once(meshes, skip_invalid, kind, structure, memory_limit, profile)
    rays = as_rays(origins, directions, tmin, tmax, skip)
    flags = answer_occluded(
        rays,
        lambda c_rays, c_output, query: call.run(lib.rw_once_occluded, c_rays, c_output, query),
        out,
        threads,
    )
    return flags[()] if out is None else flags


class Once:
    """Meshes and options of one call, described for C."""

    def __init__(
        self,
        meshes: Meshes,
        skip_invalid: bool,
        kind: str,
        structure: Optional[str],
        memory_limit: Count,
        profile: Optional[Profile],
    ) -> None:
        self.meshes = [described(mesh, i, skip_invalid) for i, mesh in enumerate(list_of(meshes))]
        self.array = (c.rw_triangles * len(self.meshes))(*(mesh.struct for mesh in self.meshes))
        self.profile = profile._use() if profile is not None else None
        self.options = sized(c.rw_once_options)
        self.options.kind = constant(RAY_KINDS, kind, "kind")
        self.options.structure = c_text(structure, "structure")
        self.options.memory_limit = unsigned(memory_limit, "memory_limit", 64)
        self.options.profile = self.profile.address if self.profile else None

    def run(self, function: Any, rays: c.rw_rays, output: Any, query: c.rw_query_options) -> int:
        self.options.query = ctypes.pointer(query)
        status: int = function(self.array, len(self.meshes), rays, output, self.options)
        if status == c.RW_ERROR_INDEX_OUT_OF_RANGE:
            raise self.in_callers_terms(error_of(status))
        return status

    def in_callers_terms(self, error: RaywiseError) -> RaywiseError:
        """Calls an index of a mesh that is out of range negative when the caller's is."""
        if not is_about_skip(error):
            for mesh in self.meshes:
                error = mesh.in_callers_terms(error)
        return error


def list_of(meshes: Meshes) -> List[OneMesh]:
    if isinstance(meshes, (Mesh, tuple)):
        return [meshes]
    if isinstance(meshes, list):
        return list(meshes)
    raise TypeError(
        f"meshes has to be a Mesh, a pair (vertices, triangles) or a list of those, not {type(meshes).__name__}"
    )


def described(mesh: OneMesh, index: int, skip_invalid: bool) -> Triangles:
    if isinstance(mesh, Mesh):
        return triangles_of(mesh, None, skip_invalid=skip_invalid, shared=False)
    if not isinstance(mesh, tuple) or len(mesh) != 2:
        raise TypeError(f"meshes: element {index} is neither a Mesh nor a pair (vertices, triangles)")
    return triangles_of(mesh[0], mesh[1], skip_invalid=skip_invalid, shared=False)
