"""The questions that scenes and views answer alike."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any, Callable, Dict, Iterable, List, Mapping, NamedTuple, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _declarations as c
from ._arrays import Array, output_array
from ._errors import Capacity, check
from ._explanation import Candidate, Explanation, GridStatistics, SceneStatistics, facts
from ._handle import Handle, Reference
from ._hits import (
    EVERYTHING,
    FIELDS,
    AllHits,
    Hits,
    Out,
    Outputs,
    caller_outputs,
    float_type,
    new_outputs,
    require_apart,
    require_output,
    rows_of,
    wanted,
)
from ._interrupt import Interrupt
from ._library import lib
from ._memory import Workspace
from ._rays import Rays, as_rays, describe
from ._skip import SkipLike
from ._text import library_json, library_text
from ._words import Count, sized, unsigned

# The first guess of intersect_all's capacity, in hits per ray; a second pass is needed when it is too low.
GUESSED_HITS_PER_RAY = 4

# What rw_hit has, for NumPy, with u and v, which are neighbours, as one.
HIT_FIELDS = tuple(name for name in FIELDS if name != "normal")


def record_of(struct: Any, number: str) -> "np.dtype[np.void]":
    return np.dtype(
        {
            "names": list(HIT_FIELDS),
            "formats": [(number if FIELDS[name][0] == "float" else "u4", FIELDS[name][1]) for name in HIT_FIELDS],
            "offsets": [getattr(struct, "u" if name == "uv" else name).offset for name in HIT_FIELDS],
            "itemsize": ctypes.sizeof(struct),
        }
    )


@dataclass(frozen=True)
class Precision:
    """The structs and functions for one ray: in float32 where the ray and the answer are, which is the same rounded."""

    suffix: str
    ray: Any
    hit: Any
    record: "np.dtype[np.void]"
    number: "np.dtype[np.floating]"

    def function(self, name: str) -> Callable[..., int]:
        function: Callable[..., int] = getattr(lib, f"rw_scene_{name}{self.suffix}")
        return function


FLOAT64 = Precision("", c.rw_ray, c.rw_hit, record_of(c.rw_hit, "f8"), np.dtype(np.float64))
FLOAT32 = Precision("_f32", c.rw_ray_f32, c.rw_hit_f32, record_of(c.rw_hit_f32, "f4"), np.dtype(np.float32))


def precision_of(rays: Rays, dtype: "np.dtype[np.floating]") -> Precision:
    return FLOAT32 if rays.is_float32 and dtype == np.float32 else FLOAT64


@dataclass(frozen=True)
class Batch:
    """Rays and options of one call, described for C."""

    rays: Rays
    rows: Dict[str, Array]
    options: c.rw_query_options
    interrupt: Interrupt
    invalid_rays: "ctypes.c_uint64"
    workspace: Optional[Reference]

    def structs(self) -> c.rw_rays:
        return describe(self.rays, self.rows)


def batch_of(rays: Rays, threads: Count, workspace: Optional[Workspace]) -> Batch:
    invalid_rays = ctypes.c_uint64()
    options = sized(c.rw_query_options)
    options.threads = unsigned(threads, "threads", 32)
    options.invalid_rays = ctypes.addressof(invalid_rays)
    used = workspace._use() if workspace is not None else None
    options.workspace = used.address if used is not None else None
    return Batch(rays, rays.rows(), options, Interrupt(options), invalid_rays, used)


def answer_closest(
    rays: Rays,
    call: Callable[[c.rw_rays, c.rw_hits, c.rw_query_options], int],
    want: Iterable[str],
    out: Optional[Out],
    dtype: Optional[npt.DTypeLike],
    threads: Count,
    workspace: Optional[Workspace] = None,
) -> Hits:
    """Sizes the outputs, has `call` fill them, and hands them out in the rays' shape."""
    batch = batch_of(rays, threads, workspace)
    if out is None:
        outputs = new_outputs(wanted(want), rays.shape, float_type(dtype, rays.dtype))
    else:
        outputs = caller_outputs(out, rays.shape, rays.inputs)
    with rays.in_callers_terms():
        batch.interrupt.finish(call(batch.structs(), outputs.describe(), batch.options))
    return Hits(outputs.arrays, batch.invalid_rays.value)


def answer_occluded(
    rays: Rays,
    call: Callable[[c.rw_rays, c.rw_output, c.rw_query_options], int],
    out: Optional[Array],
    threads: Count,
    workspace: Optional[Workspace] = None,
) -> npt.NDArray[Any]:
    """The same for the question whether anything is hit."""
    batch = batch_of(rays, threads, workspace)
    if out is None:
        flags = np.empty(rays.shape, np.bool_)
    else:
        require_output(out, "out", "flag", rays.shape)
        require_apart({"out": out}, rays.inputs)
        flags = out
    with rays.in_callers_terms():
        batch.interrupt.finish(
            call(batch.structs(), output_array(rows_of(flags, rays.shape, "out")), batch.options)
        )
    return flags


class Bounds(NamedTuple):
    """A box: shape (3,) float64 each. An empty one has lower = inf and upper = -inf."""

    lower: npt.NDArray[np.float64]
    upper: npt.NDArray[np.float64]


class Queries(Handle):
    """Closest hit, any hit and all hits, for one ray, a list or an image of rays; and why this structure.

    All methods may be called from any number of threads at once; other Python threads run meanwhile.

    Rays: float32 and float64 arrays are read where they are, in any layout with fixed strides (rows, columns, reversed,
    transposed, fields of a record, repeated by broadcasting); other numbers are converted to float64 first (float16
    to float32), as are arrays of foreign byte order. t is measured in units of the direction's length; a hit counts
    when tmin <= t <= tmax. A ray with a NaN, a zero direction, an infinite origin or direction or tmin > tmax is a
    miss.
    """

    def _committed(self) -> Reference:
        """The reference of something that can be asked."""
        return self._use()

    def _ask_one(
        self, name: str, precision: Precision, reference: Reference, rays: Rays, *results: Any
    ) -> None:
        """Asks about the one ray of shape ()."""
        options = rays.skip.options() if rays.skip is not None else None
        with rays.in_callers_terms():
            check(precision.function(name)(reference.address, rays.single(precision.ray), options, *results))

    # --- questions -------------------------------------------------------------------------------------------------

    def intersect(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        tmin: Optional[npt.ArrayLike] = None,
        tmax: Optional[npt.ArrayLike] = None,
        *,
        skip: Optional[SkipLike] = None,
        want: Iterable[str] = EVERYTHING,
        out: Optional[Out] = None,
        dtype: Optional[npt.DTypeLike] = None,
        threads: Count = 0,
        workspace: Optional[Workspace] = None,
    ) -> Hits:
        """The closest hit of each ray.

        origins, directions: shape (3,) or (..., 3). tmin, tmax: shape () or the rays' leading shape; None: 0 and
        infinity. The leading shapes broadcast against each other, so one origin of shape (3,) serves a whole batch.
        skip: triangles that single rays pass through without a hit: the one a ray starts on, or those it has met
        before. One of
          - the Hits of an earlier query: each ray skips what that one hit;
          - ids of triangles, whole numbers in an array or list that broadcasts to the rays' leading shape: one for
            each ray; with one axis more than the rays, all along the last axis: (n, k) for n rays, (k,) for one;
          - a list of n lists, not equally long, for rays of shape (n,); or AllHits of as many rays;
          - a tuple (geometry, primitive) of such ids; alone they are of geometry 0;
          - a tuple (offsets, geometry, primitive): ray i, in C order, skips the entries offsets[i] up to
            offsets[i + 1] of the other two, of shape (m,); offsets has one element more than there are rays.
        -1, or all bits set as in the ids of a miss, stands for nothing. uint32, int32, uint64 and int64 are read in
        place wherever strides can say their order.
        want: which answers; some of "t", "uv", "normal", "geometry", "primitive", "instance".
        out: a dict of the caller's arrays to fill, or the Hits of an earlier call, instead of `want`: float32 or
        float64 for t, uv and normal, uint32 or uint64 for the ids, in the shapes of Hits, any strides; they may not
        overlap the rays.
        dtype: float32 or float64 for t, uv and normal; None: float32 when origins and directions are, else float64.
        threads: at most so many; 0: as many as the process may use.
        workspace: a Workspace keeps the memory that the batch takes for the next one; None: it is given back.

        Returns Hits in the rays' leading shape, on arrays of its own (or on `out`); NumPy scalars for a single ray.
        Raises ValueError or TypeError naming the argument, IndexOutOfRange naming the entry of `skip`, NotCommitted,
        ClosedError, MemoryError. Threads: any. In the main thread signal handlers run meanwhile, at most some ten
        milliseconds late: Ctrl-C raises KeyboardInterrupt, and what was written to `out` by then is right.

        C: rw_scene_intersect_batch; for a single ray rw_scene_intersect and rw_scene_normal, in float32
        rw_scene_intersect_f32 and rw_scene_normal_f32.
        """
        reference = self._committed()
        rays = as_rays(origins, directions, tmin, tmax, skip)
        unsigned(threads, "threads", 32)
        if rays.shape == () and out is None:
            return self._intersect_one(reference, rays, wanted(want), float_type(dtype, rays.dtype))
        return answer_closest(
            rays,
            lambda c_rays, c_hits, options: lib.rw_scene_intersect_batch(reference.address, c_rays, c_hits, options),
            want,
            out,
            dtype,
            threads,
            workspace,
        )

    def _intersect_one(
        self, reference: Reference, rays: Rays, names: List[str], dtype: "np.dtype[np.floating]"
    ) -> Hits:
        precision = precision_of(rays, dtype)
        hits = (precision.hit * 1)()
        self._ask_one("intersect", precision, reference, rays, hits)
        found = self._columns(reference, precision, hits, 1, names, dtype)
        return Hits({name: values[0] for name, values in found.items()}, count_nan(rays))

    def _columns(
        self,
        reference: Reference,
        precision: Precision,
        hits: Any,
        count: int,
        names: Iterable[str],
        dtype: "np.dtype[np.floating]",
    ) -> Dict[str, Array]:
        """The first `count` hits of a ctypes array as arrays of their own, one for each name."""
        records = np.frombuffer(hits, precision.record, count) if count else np.empty(0, precision.record)
        found = {}
        with np.errstate(over="ignore", under="ignore"):
            for name in names:
                values = self._normals(reference, precision, hits, count) if name == "normal" else records[name]
                found[name] = values.astype(dtype if FIELDS[name][0] == "float" else np.uint32)
        return found

    def _normals(self, reference: Reference, precision: Precision, hits: Any, count: int) -> Array:
        normals = np.zeros((count, 3), precision.number)
        for i in range(count):
            if hits[i].primitive != c.RW_INVALID_ID:
                check(precision.function("normal")(reference.address, hits[i], normals[i].ctypes.data))
        return normals

    def occluded(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        tmin: Optional[npt.ArrayLike] = None,
        tmax: Optional[npt.ArrayLike] = None,
        *,
        skip: Optional[SkipLike] = None,
        out: Optional[Array] = None,
        threads: Count = 0,
        workspace: Optional[Workspace] = None,
    ) -> npt.NDArray[np.bool_]:
        """Whether each ray hits anything.

        origins, directions, tmin, tmax, skip, threads, workspace: as for intersect.
        out: the caller's array to fill: bool, uint8, uint32 or uint64, in the rays' leading shape, any strides.

        Returns a bool array in the rays' leading shape (or `out`); a NumPy bool for a single ray.
        Raises as intersect does. Threads: any.

        C: rw_scene_occluded_batch; for a single ray rw_scene_occluded, in float32 rw_scene_occluded_f32.
        """
        reference = self._committed()
        rays = as_rays(origins, directions, tmin, tmax, skip)
        unsigned(threads, "threads", 32)
        if rays.shape == () and out is None:
            answer = ctypes.c_int32()
            precision = FLOAT32 if rays.is_float32 else FLOAT64
            self._ask_one("occluded", precision, reference, rays, ctypes.byref(answer))
            return np.bool_(answer.value)  # type: ignore[return-value]
        return answer_occluded(
            rays,
            lambda c_rays, c_output, options: lib.rw_scene_occluded_batch(reference.address, c_rays, c_output, options),
            out,
            threads,
            workspace,
        )

    def intersect_all(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        tmin: Optional[npt.ArrayLike] = None,
        tmax: Optional[npt.ArrayLike] = None,
        *,
        skip: Optional[SkipLike] = None,
        want: Iterable[str] = EVERYTHING,
        dtype: Optional[npt.DTypeLike] = None,
        threads: Count = 0,
        workspace: Optional[Workspace] = None,
    ) -> AllHits:
        """Every hit of each ray, each ray's sorted by t, then by (instance, geometry, primitive).

        A surface that is crossed at an edge or a corner counts once: the first hit is the one that intersect finds, and
        their number is even for a ray that starts outside a closed mesh.

        origins, directions, tmin, tmax, skip, want, dtype, threads, workspace: as for intersect.

        Returns AllHits on arrays of its own; for a single ray offsets is [0, number of hits].
        Raises as intersect does. Threads: any.

        C: rw_scene_intersect_all_batch; for a single ray rw_scene_intersect_all, in float32 rw_scene_intersect_all_f32.
        """
        reference = self._committed()
        rays = as_rays(origins, directions, tmin, tmax, skip)
        names, float_dtype = wanted(want), float_type(dtype, rays.dtype)
        unsigned(threads, "threads", 32)
        if rays.shape == ():
            return self._intersect_all_of_one(reference, rays, names, float_dtype)

        batch = batch_of(rays, threads, workspace)
        offsets = np.zeros(rays.count + 1, np.uint64)
        needed = ctypes.c_uint64()
        capacity = GUESSED_HITS_PER_RAY * rays.count
        while True:
            outputs = new_outputs(names, (capacity,), float_dtype)
            status = lib.rw_scene_intersect_all_batch(
                reference.address,
                batch.structs(),
                offsets.ctypes.data,
                outputs.describe(),
                capacity,
                ctypes.byref(needed),
                batch.options,
            )
            if status != c.RW_ERROR_CAPACITY:
                break
            capacity = needed.value
        with rays.in_callers_terms():
            batch.interrupt.finish(status)
        return AllHits(trimmed(outputs, needed.value), batch.invalid_rays.value, offsets.view(np.int64))

    def _intersect_all_of_one(
        self, reference: Reference, rays: Rays, names: List[str], dtype: "np.dtype[np.floating]"
    ) -> AllHits:
        precision = precision_of(rays, dtype)
        needed = ctypes.c_uint64()
        capacity = 16
        while True:
            hits = (precision.hit * capacity)()
            try:
                self._ask_one("intersect_all", precision, reference, rays, hits, capacity, ctypes.byref(needed))
                break
            except Capacity:
                capacity = needed.value
        found = self._columns(reference, precision, hits, needed.value, names, dtype)
        return AllHits(found, count_nan(rays), np.array([0, needed.value], np.int64))

    # --- facts -----------------------------------------------------------------------------------------------------

    @property
    def bounds(self) -> Bounds:
        """The box around all triangles that can be hit. Raises NotCommitted, ClosedError. C: rw_scene_bounds."""
        reference = self._committed()
        box = Bounds(np.empty(3), np.empty(3))
        check(lib.rw_scene_bounds(reference.address, box.lower.ctypes.data, box.upper.ctypes.data))
        return box

    @property
    def statistics(self) -> SceneStatistics:
        """What is in the scene and what it has cost so far. Raises NotCommitted, ClosedError.

        C: rw_scene_get_statistics.
        """
        reference = self._committed()
        struct = sized(c.rw_scene_statistics)
        check(lib.rw_scene_get_statistics(reference.address, struct))
        return facts(SceneStatistics, struct)

    @property
    def grid_statistics(self) -> GridStatistics:
        """The statistics of the grid in use.

        Raises WrongStructure when the structure is not uniform_grid, NotCommitted, ClosedError.

        C: rw_scene_get_grid_statistics.
        """
        reference = self._committed()
        struct = sized(c.rw_grid_statistics)
        check(lib.rw_scene_get_grid_statistics(reference.address, struct))
        return facts(GridStatistics, struct)

    @property
    def structure(self) -> str:
        """The name of the structure in use. Raises NotCommitted, ClosedError. C: rw_scene_get_statistics."""
        return self.statistics.structure

    # --- why this structure ----------------------------------------------------------------------------------------

    def explain(self) -> Explanation:
        """Why this structure: scene, profile, and each candidate, predicted and actual build time, ns per ray, bytes.

        str() of the result is the table, `.json` the same as a dict. It is a snapshot: rays asked later do not change
        it.
        Raises NotCommitted, ClosedError. Threads: any.

        C: rw_scene_explain.
        """
        reference = self._committed()
        function = lib.rw_scene_explain
        text = library_text(function, reference.address, c.RW_FORMAT_TEXT)
        return Explanation(text, library_json(function, reference.address))

    @property
    def candidates(self) -> Tuple[Candidate, ...]:
        """All structures as the decision saw them, in the order of raywise.structures().

        Raises NotCommitted, ClosedError. Threads: any.

        C: rw_scene_candidate_count and rw_scene_get_candidate.
        """
        reference = self._committed()
        count = ctypes.c_uint32()
        check(lib.rw_scene_candidate_count(reference.address, ctypes.byref(count)))
        found = []
        for index in range(count.value):
            candidate = sized(c.rw_candidate)
            check(lib.rw_scene_get_candidate(reference.address, index, candidate))
            found.append(facts(Candidate, candidate))
        return tuple(found)


def count_nan(rays: Rays) -> int:
    """1 when the single ray holds a NaN; the calls for one ray do not say it."""
    return int(any(bool(np.isnan(part).any()) for part in rays.parts.values()))


def trimmed(outputs: Outputs, length: int) -> Mapping[str, Array]:
    """The first `length` elements; copied when the guess was far too high, so that the rest of the memory goes."""
    arrays = {name: array[:length] for name, array in outputs.arrays.items()}
    capacity = max((len(array) for array in outputs.arrays.values()), default=0)
    return {name: array.copy() for name, array in arrays.items()} if 2 * length < capacity else arrays
