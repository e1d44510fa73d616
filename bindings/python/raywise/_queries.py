"""The questions that scenes and views answer alike."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any, Callable, Dict, Iterable, List, Mapping, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _declarations as c
from ._arrays import Array, output_array
from ._errors import Capacity, check
from ._explanation import Candidate, Explanation, facts
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
from ._library import lib
from ._rays import Rays, as_rays, describe
from ._skip import SkipLike
from ._text import library_json, library_text
from ._words import Count, sized, unsigned

# The first guess of intersect_all's capacity, in hits per ray; a second pass is needed when it is too low.
GUESSED_HITS_PER_RAY = 4

# rw_hit for NumPy, with u and v, which are neighbours, as one.
HIT = np.dtype(
    {
        "names": list(FIELDS),
        "formats": [("f8" if kind == "float" else "u4", tail) for kind, tail in FIELDS.values()],
        "offsets": [getattr(c.rw_hit, "u" if name == "uv" else name).offset for name in FIELDS],
        "itemsize": ctypes.sizeof(c.rw_hit),
    }
)


@dataclass(frozen=True)
class Batch:
    """Rays and options of one call, described for C."""

    rays: Rays
    rows: Dict[str, Array]
    options: c.rw_query_options
    invalid_rays: "ctypes.c_uint64"

    def structs(self) -> c.rw_rays:
        return describe(self.rays, self.rows)


def batch_of(rays: Rays, threads: Count) -> Batch:
    invalid_rays = ctypes.c_uint64()
    options = sized(c.rw_query_options)
    options.threads = unsigned(threads, "threads", 32)
    options.invalid_rays = ctypes.addressof(invalid_rays)
    return Batch(rays, rays.rows(), options, invalid_rays)


def answer_closest(
    rays: Rays,
    call: Callable[[c.rw_rays, c.rw_hits, c.rw_query_options], int],
    want: Iterable[str],
    out: Optional[Out],
    dtype: Optional[npt.DTypeLike],
    threads: Count,
) -> Hits:
    """Sizes the outputs, has `call` fill them, and hands them out in the rays' shape."""
    batch = batch_of(rays, threads)
    if out is None:
        outputs = new_outputs(wanted(want), rays.shape, float_type(dtype, rays.dtype))
    else:
        outputs = caller_outputs(out, rays.shape, rays.inputs)
    with rays.in_callers_terms():
        check(call(batch.structs(), outputs.describe(), batch.options))
    return Hits(outputs.arrays, batch.invalid_rays.value)


def answer_occluded(
    rays: Rays,
    call: Callable[[c.rw_rays, c.rw_output, c.rw_query_options], int],
    out: Optional[Array],
    threads: Count,
) -> npt.NDArray[Any]:
    """The same for the question whether anything is hit."""
    batch = batch_of(rays, threads)
    if out is None:
        flags = np.empty(rays.shape, np.bool_)
    else:
        require_output(out, "out", "flag", rays.shape)
        require_apart({"out": out}, rays.inputs)
        flags = out
    with rays.in_callers_terms():
        check(call(batch.structs(), output_array(rows_of(flags, rays.shape, "out")), batch.options))
    return flags


class Queries(Handle):
    """Closest hit, any hit and all hits, for one ray, a list or an image of rays; and why this structure.

    All methods may be called from any number of threads at once; other Python threads run meanwhile.

    Rays: float32 and float64 arrays are read where they are, in any layout with fixed strides (rows, columns, reversed,
    transposed, fields of a record, repeated by broadcasting); other numbers are converted to float64 first (float16
    to float32), as are arrays of foreign byte order. t is measured in units of the direction's length; a hit counts
    when tmin <= t <= tmax. A ray with a NaN, a zero direction, an infinite origin or direction or tmin > tmax is a
    miss.
    """

    _prefix: str

    def _function(self, name: str) -> Callable[..., int]:
        function: Callable[..., int] = getattr(lib, self._prefix + name)
        return function

    def _committed(self) -> Reference:
        """The reference of something that can be asked."""
        return self._use()

    def _ask_one(self, name: str, reference: Reference, rays: Rays, *results: Any) -> None:
        """Asks about the one ray of shape (), by the function with options when it skips something."""
        with rays.in_callers_terms():
            if rays.skip is None:
                check(self._function(name)(reference.address, rays.single(), *results))
            else:
                options = rays.skip.options()
                check(self._function(f"{name}_with")(reference.address, rays.single(), options, *results))

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

        Returns Hits in the rays' leading shape, on arrays of its own (or on `out`); NumPy scalars for a single ray.
        Raises ValueError or TypeError naming the argument, IndexOutOfRange naming the entry of `skip`, NotCommitted,
        ClosedError, MemoryError. Threads: any.

        C: rw_scene_intersect, rw_scene_intersect_with (for a ray with skip) and rw_scene_intersect_batch; for a view
        rw_view_intersect, rw_view_intersect_with and rw_view_intersect_batch.
        """
        reference = self._committed()
        rays = as_rays(origins, directions, tmin, tmax, skip)
        unsigned(threads, "threads", 32)
        if rays.shape == () and out is None:
            return self._intersect_one(reference, rays, wanted(want), float_type(dtype, rays.dtype))
        function = self._function("intersect_batch")
        return answer_closest(
            rays,
            lambda c_rays, c_hits, options: function(reference.address, c_rays, c_hits, options),
            want,
            out,
            dtype,
            threads,
        )

    def _intersect_one(
        self, reference: Reference, rays: Rays, names: List[str], dtype: "np.dtype[np.floating]"
    ) -> Hits:
        hit = c.rw_hit()
        self._ask_one("intersect", reference, rays, hit)
        return Hits({name: values[0] for name, values in columns(hit, 1, names, dtype).items()}, count_nan(rays))

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
    ) -> npt.NDArray[np.bool_]:
        """Whether each ray hits anything.

        origins, directions, tmin, tmax, skip, threads: as for intersect.
        out: the caller's array to fill: bool, uint8, uint32 or uint64, in the rays' leading shape, any strides.

        Returns a bool array in the rays' leading shape (or `out`); a NumPy bool for a single ray.
        Raises as intersect does. Threads: any.

        C: rw_scene_occluded, rw_scene_occluded_with (for a ray with skip) and rw_scene_occluded_batch; for a view
        rw_view_occluded, rw_view_occluded_with and rw_view_occluded_batch.
        """
        reference = self._committed()
        rays = as_rays(origins, directions, tmin, tmax, skip)
        unsigned(threads, "threads", 32)
        if rays.shape == () and out is None:
            answer = ctypes.c_int32()
            self._ask_one("occluded", reference, rays, ctypes.byref(answer))
            return np.bool_(answer.value)  # type: ignore[return-value]
        function = self._function("occluded_batch")
        return answer_occluded(
            rays,
            lambda c_rays, c_output, options: function(reference.address, c_rays, c_output, options),
            out,
            threads,
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
    ) -> AllHits:
        """Every hit of each ray, each ray's sorted by t, then by (instance, geometry, primitive).

        A surface that is crossed at an edge or a corner counts once: the first hit is the one that intersect finds, and
        their number is even for a ray that starts outside a closed mesh.

        origins, directions, tmin, tmax, skip, want, dtype, threads: as for intersect.

        Returns AllHits on arrays of its own; for a single ray offsets is [0, number of hits].
        Raises as intersect does. Threads: any.

        C: rw_scene_intersect_all, rw_scene_intersect_all_with (for a ray with skip) and rw_scene_intersect_all_batch;
        for a view rw_view_intersect_all, rw_view_intersect_all_with and rw_view_intersect_all_batch.
        """
        reference = self._committed()
        rays = as_rays(origins, directions, tmin, tmax, skip)
        names, float_dtype = wanted(want), float_type(dtype, rays.dtype)
        unsigned(threads, "threads", 32)
        if rays.shape == ():
            return self._intersect_all_of_one(reference, rays, names, float_dtype)

        batch = batch_of(rays, threads)
        offsets = np.zeros(rays.count + 1, np.uint64)
        needed = ctypes.c_uint64()
        capacity = GUESSED_HITS_PER_RAY * rays.count
        while True:
            outputs = new_outputs(names, (capacity,), float_dtype)
            status = self._function("intersect_all_batch")(
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
            check(status)
        return AllHits(trimmed(outputs, needed.value), batch.invalid_rays.value, offsets.view(np.int64))

    def _intersect_all_of_one(
        self, reference: Reference, rays: Rays, names: List[str], dtype: "np.dtype[np.floating]"
    ) -> AllHits:
        needed = ctypes.c_uint64()
        capacity = 16
        while True:
            hits = (c.rw_hit * capacity)()
            try:
                self._ask_one("intersect_all", reference, rays, hits, capacity, ctypes.byref(needed))
                break
            except Capacity:
                capacity = needed.value
        found = columns(hits, needed.value, names, dtype)
        return AllHits(found, count_nan(rays), np.array([0, needed.value], np.int64))

    # --- why this structure ----------------------------------------------------------------------------------------

    def explain(self) -> Explanation:
        """Why this structure: scene, profile, and each candidate, predicted and actual build time, ns per ray, bytes.

        str() of the result is the table, `.json` the same as a dict. It is a snapshot: rays asked later do not change
        it.
        Raises NotCommitted, ClosedError. Threads: any.

        C: rw_scene_explain; for a view rw_view_explain.
        """
        reference = self._committed()
        function = self._function("explain")
        text = library_text(function, reference.address, c.RW_FORMAT_TEXT)
        return Explanation(text, library_json(function, reference.address))

    @property
    def candidates(self) -> Tuple[Candidate, ...]:
        """All structures as the decision saw them, in the order of raywise.structures().

        Raises NotCommitted, ClosedError. Threads: any.

        C: rw_scene_candidate_count and rw_scene_get_candidate; for a view rw_view_candidate_count and
        rw_view_get_candidate.
        """
        reference = self._committed()
        count = ctypes.c_uint32()
        check(self._function("candidate_count")(reference.address, ctypes.byref(count)))
        found = []
        for index in range(count.value):
            candidate = sized(c.rw_candidate)
            check(self._function("get_candidate")(reference.address, index, candidate))
            found.append(facts(Candidate, candidate))
        return tuple(found)


def columns(hits: Any, count: int, names: Iterable[str], dtype: "np.dtype[np.floating]") -> Dict[str, Array]:
    """The first `count` rw_hit of a ctypes object as arrays of their own, one for each name."""
    records = np.frombuffer(hits, HIT, count) if count else np.empty(0, HIT)
    with np.errstate(over="ignore", under="ignore"):
        return {name: records[name].astype(dtype if FIELDS[name][0] == "float" else np.uint32) for name in names}


def count_nan(rays: Rays) -> int:
    """1 when the single ray holds a NaN; the calls for one ray do not say it."""
    return int(any(bool(np.isnan(part).any()) for part in rays.parts.values()))


def trimmed(outputs: Outputs, length: int) -> Mapping[str, Array]:
    """The first `length` elements; copied when the guess was far too high, so that the rest of the memory goes."""
    arrays = {name: array[:length] for name, array in outputs.arrays.items()}
    capacity = max((len(array) for array in outputs.arrays.values()), default=0)
    return {name: array.copy() for name, array in arrays.items()} if 2 * length < capacity else arrays
