"""Scenes: geometry with the structure chosen for it."""

from __future__ import annotations

import ctypes
import threading
from contextlib import contextmanager
from typing import Iterator, List, NamedTuple, Optional, SupportsFloat, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _declarations as c
from ._arrays import Array
from ._errors import IndexOutOfRange, NotCommitted, check
from ._handle import Reference
from ._library import lib
from ._mesh import Mesh, Triangles, moved_triangles_of, triangles_of
from ._profile import Profile
from ._progress import Progress, ProgressCallback
from ._queries import Bounds, Queries
from ._rays import sample_of
from ._text import c_text
from ._view import View
from ._words import EFFORTS, RAY_KINDS, RULES, Count, constant, ray_count, seconds, sized, unsigned


class _Added(NamedTuple):
    """A mesh of a scene."""

    triangle_count: int
    shared_indices: Optional[object]  # what has to be kept when the scene reads them in place
    indexed: bool


def _added(triangles: Triangles, shared_indices: Optional[object]) -> _Added:
    return _Added(triangles.struct.triangle_count, shared_indices, bool(triangles.struct.indices.data))


class SceneBusy(RuntimeError):
    """Filling and committing need the scene alone, and another thread (or the progress callback) got in the way."""


class Scene(Queries):
    """Geometry with the structure chosen for it.

    In one step:    scene = Scene(vertices, triangles, expected_rays=1e6)
    Step by step:   scene = Scene(); scene.add_triangles(...); scene.set_expected_rays(1e6); scene.commit()

    Once committed a scene never changes, and any number of threads may ask it. Filling and committing are for one
    thread at a time; a second one gets SceneBusy.
    """

    def __init__(
        self,
        vertices: Union[npt.ArrayLike, Mesh, None] = None,
        triangles: Optional[npt.ArrayLike] = None,
        *,
        expected_rays: Optional[Count] = None,
        kind: str = "any",
        sample: "Optional[Tuple[npt.ArrayLike, ...]]" = None,
        structure: Optional[str] = None,
        memory_limit: Count = 0,
        effort: str = "estimate",
        rule: str = "smallest_total",
        time_limit: SupportsFloat = 0.0,
        skip_invalid: bool = False,
        copy: bool = True,
        profile: Optional[Profile] = None,
        threads: Count = 0,
        progress: Optional[ProgressCallback] = None,
    ) -> None:
        """Makes a scene; with vertices it is filled and committed, without it is empty and can be filled.

        vertices, triangles, skip_invalid, copy: as for add_triangles.
        expected_rays, kind, sample: as for set_expected_rays.
        structure, memory_limit: as for set_structure and set_memory_limit.
        effort, rule, time_limit: as for set_effort.
        threads, progress: as for commit.
        profile: the constants to decide with; None: those that raywise.profile() finds.

        Raises what those methods raise; nothing is left behind then.

        C: rw_scene_create; close() is rw_scene_release.
        """
        filled = vertices is not None
        if not filled and (triangles is not None or progress is not None or threads != 0 or skip_invalid or not copy):
            raise TypeError("without vertices, triangles, skip_invalid, copy, threads and progress have no use here")
        constants = profile._use() if profile is not None else None
        address = ctypes.c_void_p()
        check(lib.rw_scene_create(constants.address if constants else None, ctypes.byref(address)))
        assert address.value is not None
        super().__init__(Reference(address.value, lib.rw_scene_release))
        self._alone = threading.Lock()
        self._is_committed = False
        self._meshes: "List[_Added]" = []

        if expected_rays is not None or kind != "any" or sample is not None:
            self.set_expected_rays(expected_rays, kind, sample)
        if structure is not None:
            self.set_structure(structure)
        if memory_limit != 0:
            self.set_memory_limit(memory_limit)
        self.set_effort(effort, rule=rule, time_limit=time_limit)
        if vertices is not None:
            self.add_triangles(vertices, triangles, skip_invalid=skip_invalid, copy=copy)
            self.commit(threads=threads, progress=progress)

    # --- filling and committing ------------------------------------------------------------------------------------

    @contextmanager
    def _changing(self) -> Iterator[Reference]:
        """The reference, for one thread at a time."""
        reference = self._use()
        if not self._alone.acquire(blocking=False):
            raise SceneBusy("the scene is being filled or committed by another call, which needs it alone")
        try:
            yield reference
        finally:
            self._alone.release()

    def _committed(self) -> Reference:
        reference = self._use()
        if not self._is_committed:
            raise NotCommitted(c.RW_ERROR_NOT_COMMITTED, "scene: it has to be committed first: call commit()")
        return reference

    def add_triangles(
        self,
        vertices: Union[npt.ArrayLike, Mesh],
        triangles: Optional[npt.ArrayLike] = None,
        *,
        skip_invalid: bool = False,
        copy: bool = True,
    ) -> int:
        """Adds a mesh and returns its geometry id: 0, 1, 2 ... in the order of adding.

        vertices: shape (n, 3), float32 or float64 in any layout (other numbers are converted first); or a Mesh.
        triangles: indices into vertices, shape (m, 3), whole numbers of 32 or 64 bits in any layout (shorter ones are
        converted first); None: vertices 3i, 3i + 1 and 3i + 2 are triangle i. Triangles without area are legal and
        are never hit.
        skip_invalid: triangles with a NaN, infinite or out-of-range vertex, or an index out of range, are never hit,
        instead of an error; ids do not shift.
        copy: False: the scene reads the arrays (or what they had to be converted to) in place for as long as it
        lives, and keeps them alive: they must stay as they are.

        Raises NotFinite, CoordinateRange, IndexOutOfRange, TooMany, ValueError, TypeError, AlreadyCommitted,
        MemoryError, ClosedError; the scene is then as it was. Threads: alone with the scene.

        C: rw_scene_add_triangles.
        """
        described = triangles_of(vertices, triangles, skip_invalid=skip_invalid, shared=not copy)
        geometry = ctypes.c_uint32()
        with self._changing() as reference:
            status = lib.rw_scene_add_triangles(reference.address, described.struct, ctypes.byref(geometry))
            try:
                check(status)
            except IndexOutOfRange as error:
                raise described.in_callers_terms(error) from None
            if not copy:
                reference.kept.extend(described.kept)
            self._meshes.append(_added(described, None if copy else described.indices))
        return geometry.value

    def set_expected_rays(
        self,
        count: Optional[Count] = None,
        kind: str = "any",
        sample: "Optional[Tuple[npt.ArrayLike, ...]]" = None,
    ) -> None:
        """Says how many rays of which kind are coming. A wrong word costs time, never an answer.

        count: 1 ... 10^15 (2e6 is fine); None: nobody knows.
        kind: "any" (not known), "random", "camera", "shadow" or "diffuse".
        sample: some of those rays, as (origins, directions[, tmin[, tmax]]), for the efforts "probe" and "measure"
        and the rule "hapala"; copied, at most the first 1,000. None: rays of that kind are made up.

        Raises RayCount, ValueError, TypeError, AlreadyCommitted, MemoryError, ClosedError.
        Threads: alone with the scene.

        C: rw_scene_set_expected_rays.
        """
        expected = sized(c.rw_expected_rays)
        expected.kind = constant(RAY_KINDS, kind, "kind")
        expected.count = ray_count(count, "expected_rays")
        kept: "List[Array]" = []
        if sample is not None:
            rays, kept = sample_of(sample)
            expected.sample = ctypes.pointer(rays)
        with self._changing() as reference:
            check(lib.rw_scene_set_expected_rays(reference.address, expected))
        kept.clear()

    def set_memory_limit(self, limit: Count) -> None:
        """Bounds the bytes that the structure may take, meshes not counted; 0: no limit.

        Raises ValueError, AlreadyCommitted, ClosedError. Threads: alone with the scene.

        C: rw_scene_set_memory_limit.
        """
        with self._changing() as reference:
            check(lib.rw_scene_set_memory_limit(reference.address, unsigned(limit, "memory_limit", 64)))

    def set_structure(self, name: Optional[str]) -> None:
        """Forces a structure by one of raywise.structures(); None: the library chooses again.

        Raises UnknownStructure, TypeError, AlreadyCommitted, ClosedError. Threads: alone with the scene.

        C: rw_scene_set_structure.
        """
        with self._changing() as reference:
            check(lib.rw_scene_set_structure(reference.address, c_text(name, "structure")))

    def set_effort(
        self, effort: str = "estimate", *, rule: str = "smallest_total", time_limit: SupportsFloat = 0.0
    ) -> None:
        """Sets how hard to think before choosing, and by which rule.

        effort: "estimate" (formulas only), "probe" (build the grid and time a sample of rays on it) or "measure"
        (build every candidate that fits and time the sample on each).
        rule: "smallest_total" (build + rays) or "hapala" (grid or kd-tree by the critical ray count, 2011).
        time_limit: seconds after which "measure" starts no further build; 0: no limit.

        Raises ValueError, TypeError, AlreadyCommitted, ClosedError. Threads: alone with the scene.

        C: rw_scene_set_effort.
        """
        effort_number, rule_number = constant(EFFORTS, effort, "effort"), constant(RULES, rule, "rule")
        limit = seconds(time_limit, "time_limit")
        with self._changing() as reference:
            check(lib.rw_scene_set_effort(reference.address, effort_number, rule_number, limit))

    def commit(self, *, threads: Count = 0, progress: Optional[ProgressCallback] = None) -> None:
        """Chooses a structure and builds it. An empty scene is legal: every ray misses.

        threads: at most so many; 0: as many as the process may use.
        progress: called as progress(fraction, stage) with 0 <= fraction <= 1, from any of the threads at work but
        never from two at once. A true result asks to stop: Cancelled. What it raises asks to stop too and comes out
        of commit().

        Raises Cancelled, MemoryLimit, MemoryError, AlreadyCommitted, ValueError, ClosedError; the scene is then as it
        was and can be committed again. Threads: alone with the scene.

        C: rw_scene_commit.
        """
        build = Progress(threads, progress)
        with self._changing() as reference:
            status = lib.rw_scene_commit(reference.address, build.options)
            if status == c.RW_OK:
                self._is_committed = True
        build.finish(status)

    def refit(
        self,
        *meshes: "Union[npt.ArrayLike, Mesh, Tuple[npt.ArrayLike, Optional[npt.ArrayLike]]]",
        skip_invalid: bool = False,
        copy: bool = True,
        refit: str = "where_it_pays",
        threads: Count = 0,
        progress: Optional[ProgressCallback] = None,
    ) -> "Scene":
        """A committed scene of the same triangles at new places, as for the next frame of meshes that deform.

        The structure is this scene's with new boxes where it has such a form ("bvh") and that pays, which takes a
        fraction of building; else it is built anew. Expectations, effort, memory limit, profile and a forced structure
        are those of this scene. Answers are those of any scene with these meshes. This scene stays as it is.
        From the second frame on the memory of scenes that are closed is kept for the next ones:

            next_scene = scene.refit(vertices, refit="never")
            scene.close()
            scene = next_scene

        meshes: one for each mesh of the scene, in the order of adding, each with as many triangles as before: its
        vertices alone, which keep their indices and have to be as many as before; or a tuple (vertices, triangles); or
        a Mesh.
        skip_invalid, copy: as for add_triangles, for all of them. With copy=False, indices that this scene reads in
        place are read in place by the new one as well.
        refit: "where_it_pays" by the rays expected; "where_possible": however the boxes overlap; "never": built anew,
        and then there may be other numbers of triangles (with their indices, if they have any) and of meshes.
        threads, progress: as for commit.

        Raises NotCommitted, NotFinite, CoordinateRange, IndexOutOfRange, ValueError (numbers that differ), TypeError,
        Cancelled, MemoryLimit, MemoryError, ClosedError. Threads: any.

        C: rw_scene_refit.
        """
        reference = self._committed()
        described: "List[Triangles]" = []
        added: "List[_Added]" = []
        for i, mesh in enumerate(meshes):
            before = self._meshes[i] if i < len(self._meshes) else _Added(0, None, False)
            if isinstance(mesh, tuple) and len(mesh) != 2:
                raise TypeError(f"meshes[{i}]: a tuple is (vertices, triangles), this one has {len(mesh)} elements")
            vertices, triangles = mesh if isinstance(mesh, tuple) else (mesh, None)
            if isinstance(vertices, Mesh) or triangles is not None:
                triangles_ = triangles_of(vertices, triangles, skip_invalid=skip_invalid, shared=not copy)
                added.append(_added(triangles_, None if copy else triangles_.indices))
            else:
                may_differ = refit == "never" and not before.indexed
                count = None if may_differ else before.triangle_count
                triangles_ = moved_triangles_of(vertices, count, skip_invalid=skip_invalid, shared=not copy)
                kept_indices = None if copy else before.shared_indices
                added.append(_Added(triangles_.struct.triangle_count, kept_indices, before.indexed))
            described.append(triangles_)
        build = Progress(threads, progress, refit)
        address = ctypes.c_void_p()
        structs = (c.rw_triangles * len(described))(*(each.struct for each in described))
        status = lib.rw_scene_refit(reference.address, structs, len(described), build.options, ctypes.byref(address))
        try:
            build.finish(status)
        except IndexOutOfRange as error:
            for i, each in enumerate(described):
                if f"meshes[{i}]." in str(error):
                    raise each.in_callers_terms(error) from None
            raise
        assert address.value is not None
        scene = Scene.__new__(Scene)
        Queries.__init__(scene, Reference(address.value, lib.rw_scene_release))
        scene._alone = threading.Lock()
        scene._is_committed = True
        scene._meshes = added
        if not copy:
            kept = scene._use().kept
            for each in described:
                kept.extend(each.kept)
            kept.extend(mesh.shared_indices for mesh in added)
        return scene

    # --- facts -----------------------------------------------------------------------------------------------------

    @property
    def committed(self) -> bool:
        """Whether the scene can be asked (and no longer be changed)."""
        return self._is_committed

    # --- views -----------------------------------------------------------------------------------------------------

    def view(
        self,
        *,
        origin: Optional[npt.ArrayLike] = None,
        direction: Optional[npt.ArrayLike] = None,
        half_angle: Optional[float] = None,
        expected_rays: Optional[Count] = None,
        kind: str = "camera",
        structure: Optional[str] = None,
        threads: Count = 0,
        progress: Optional[ProgressCallback] = None,
    ) -> View:
        """A view of this scene, for rays that share an origin or a direction: View(self, ...), which says the rest.

        C: rw_scene_view.
        """
        return View(
            self,
            origin=origin,
            direction=direction,
            half_angle=half_angle,
            expected_rays=expected_rays,
            kind=kind,
            structure=structure,
            threads=threads,
            progress=progress,
        )

    def __repr__(self) -> str:
        if self.closed:
            return "<Scene, closed>"
        if not self._is_committed:
            return "<Scene, not committed>"
        facts_ = self.statistics
        return f"<Scene of {facts_.triangle_count} triangles in {facts_.geometry_count} meshes, {facts_.structure}>"
