"""Skip lists: the triangles that single rays pass through without a hit."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _declarations as c
from ._arrays import Array, Shape, as_array, as_indices, input_array
from ._errors import IndexOutOfRange, RaywiseError
from ._hits import AllHits, Answers, Hits
from ._words import sized

Ids = Union[npt.ArrayLike, Sequence[npt.ArrayLike]]
SkipLike = Union[Ids, Hits, AllHits, Tuple[Ids, Ids], Tuple[npt.ArrayLike, npt.ArrayLike, npt.ArrayLike]]

# How the C library names an entry in its messages.
ENTRY = re.compile(r"(?:rays\.skip_primitive|options\.skip)\[(\d+)\]: (.*)", re.DOTALL)


@dataclass(frozen=True)
class Skip:
    """Entries one behind the other, and which of them belong to which ray."""

    ids: Dict[str, Array]  # "primitive" and, unless it is 0 for all, "geometry": uint32 or uint64, shape (entries,)
    offsets: Optional[Array]  # uint64, one more than rays; None: entry i is for ray i
    place: Callable[[int], str]  # an entry in the caller's terms, e.g. "skip[3]"
    signed: Dict[str, Array]  # the ids as the caller gave them, where they could be negative

    def arrays(self) -> Dict[str, Array]:
        """What C reads, by the names for messages."""
        named = {f"skip {name}": array for name, array in self.ids.items()}
        return named if self.offsets is None else {**named, "skip offsets": self.offsets}

    def describe(self, rays: c.rw_rays) -> None:
        """Adds the entries to rw_rays."""
        rays.skip_primitive = input_array(self.ids["primitive"])
        if "geometry" in self.ids:
            rays.skip_geometry = input_array(self.ids["geometry"])
        if self.offsets is not None:
            rays.skip_offsets = self.offsets.ctypes.data

    def options(self) -> c.rw_ray_options:
        """All entries as those of one ray."""
        primitive = self.ids["primitive"]
        nothing = (primitive == c.RW_INVALID_ID) | (primitive == np.iinfo(primitive.dtype).max)
        for name, ids in self.ids.items():
            beyond = np.flatnonzero((ids >= c.RW_INVALID_ID) & ~nothing)
            if len(beyond):  # rw_primitive_id has 32 bits for each
                entry = int(beyond[0])
                message = f"options.skip[{entry}]: {name} {ids[entry]} is out of range"
                raise self.in_callers_terms(IndexOutOfRange(c.RW_ERROR_INDEX_OUT_OF_RANGE, message))
        table = np.full((len(primitive), 3), c.RW_INVALID_ID, np.uint32)
        table[:, 1] = self.ids.get("geometry", 0)
        table[~nothing, 2] = primitive[~nothing]
        options = sized(c.rw_ray_options)
        options.skip_count = len(table)
        options.skip = (c.rw_primitive_id * len(table)).from_buffer(table.data)
        return options

    def in_callers_terms(self, error: IndexOutOfRange) -> IndexOutOfRange:
        """An error about an entry, in the caller's terms; any other as it is."""
        found = ENTRY.fullmatch(error.message)
        if not found:
            return error
        entry, what = int(found[1]), found[2]
        for name, ids in self.signed.items():
            if what.startswith(name) and ids[entry] < 0:
                what = f"{name} {ids[entry]} is negative" + ("; -1 stands for nothing" if name == "primitive" else "")
        return IndexOutOfRange(error.status, f"{self.place(entry)}: {what}")


def is_about_skip(error: RaywiseError) -> bool:
    """Whether the C library complains about an entry of a skip list."""
    return ENTRY.fullmatch(error.message) is not None


def as_skip(skip: Optional[SkipLike], shape: Shape) -> Optional[Skip]:
    """Checks types, shapes and offsets for rays of this shape; None when there are no entries.

    ValueError and TypeError name what does not fit. Which ids there are only the scene knows.
    """
    if skip is None:
        return None
    if isinstance(skip, Answers):
        geometry, primitive = (wanted_ids(skip, name) for name in ("geometry", "primitive"))
        if isinstance(skip, AllHits):
            return of_offsets(skip.offsets, geometry, primitive, shape)
        return of_arrays(geometry, primitive, shape)
    if not isinstance(skip, tuple):
        return of_ids(None, skip, shape)
    if len(skip) == 2:
        return of_ids(skip[0], skip[1], shape)
    if len(skip) == 3:
        return of_offsets(skip[0], as_ids(skip[1], "skip geometry"), as_ids(skip[2], "skip primitive"), shape)
    raise TypeError(
        f"skip is a tuple of {len(skip)}, not (geometry, primitive) or (offsets, geometry, primitive); "
        "ids alone have to be an array or a list"
    )


def wanted_ids(answers: Answers, name: str) -> Array:
    if name not in answers.arrays:
        raise ValueError(f"skip: these {type(answers).__name__} lack {name}, which `want` or `out` left out")
    return answers.arrays[name]


def as_ids(values: npt.ArrayLike, name: str) -> Array:
    """values as an array of whole numbers, of the caller's type."""
    array = as_array(values, name)
    if array.size == 0 and array.dtype.kind == "f":
        return array.astype(np.uint32)  # an empty list
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name} has to hold whole numbers, not {array.dtype}")
    return array


def of_ids(geometry: Optional[Ids], primitive: Ids, shape: Shape) -> Optional[Skip]:
    """Arrays, or lists that are not equally long."""
    primitives, offsets = ids_or_lists(primitive, "skip" if geometry is None else "skip primitive")
    geometries, others = None, None
    if geometry is not None:
        geometries, others = ids_or_lists(geometry, "skip geometry")
        if others is not None or (offsets is not None and geometries.ndim > 0):
            require_same_lengths(others, offsets)
    if offsets is None:
        return of_arrays(geometries, primitives, shape)
    if len(shape) != 1:
        raise ValueError(f"skip: lists that are not equally long are for rays of shape (n,), not {shape}")
    return of_offsets(offsets, geometries, primitives, shape)


def ids_or_lists(values: Ids, name: str) -> Tuple[Array, Optional[Array]]:
    """An array; or, of lists or arrays that are not equally long, all ids one behind the other, and offsets."""
    try:
        array = np.asarray(values)
    except ValueError as error:  # lists that make no array
        if not isinstance(values, (list, tuple)):
            raise ValueError(f"{name} is not an array: {error}") from error
    else:
        return as_ids(array, name), None
    lists: List[Array] = []
    for i, ids in enumerate(values):
        lists.append(as_ids(ids, f"{name}[{i}]"))
        if lists[-1].ndim != 1:
            raise ValueError(f"{name}[{i}] has to be a list of ids, not an array of shape {lists[-1].shape}")
    if any(ids.dtype.kind == "i" for ids in lists):
        lists = [ids.astype(np.int64) for ids in lists]  # 2^64 - 1 becomes -1, which stands for nothing as well
    return np.concatenate(lists), np.cumsum([0] + [len(ids) for ids in lists], dtype=np.int64)


def require_same_lengths(geometry: Optional[Array], primitive: Optional[Array]) -> None:
    """The lists between the offsets of both have to be equally long; without offsets of both they are not."""
    if geometry is None or primitive is None or len(geometry) != len(primitive):
        raise ValueError("skip geometry and skip primitive have to be lists of the same lengths")
    for ray, (one, other) in enumerate(zip(np.diff(geometry), np.diff(primitive))):
        if one != other:
            raise ValueError(f"skip geometry[{ray}] has {one} ids, skip primitive[{ray}] {other}")


def of_arrays(geometry: Optional[Array], primitive: Array, shape: Shape) -> Optional[Skip]:
    """One id per ray, broadcast to the rays' shape; or, with one axis more, a list per ray along the last axis."""
    given = {"primitive": primitive} if geometry is None else {"primitive": primitive, "geometry": geometry}
    try:
        own = np.broadcast_shapes(*(ids.shape for ids in given.values()))
        target = shape if len(own) <= len(shape) else shape + own[-1:]
        rows = {name: flat(np.broadcast_to(ids, target)) for name, ids in given.items()}
    except ValueError:
        shapes = " and ".join(f"{name} of shape {ids.shape}" for name, ids in given.items())
        raise ValueError(f"skip: {shapes} does not fit rays of shape {shape}") from None
    offsets = None
    if target != shape:
        offsets = np.arange(math.prod(shape) + 1, dtype=np.uint64) * np.uint64(target[-1])

    def place(entry: int) -> str:
        index = ", ".join(str(i) for i in np.unravel_index(entry, target))
        return f"skip[{index}]" if index else "skip"

    return skip_of(rows, offsets, place)


def of_offsets(offsets: npt.ArrayLike, geometry: Optional[Array], primitive: Array, shape: Shape) -> Optional[Skip]:
    """Lists one behind the other, ray after ray in C order."""
    if primitive.ndim != 1:
        raise ValueError(f"skip primitive has to have the shape (n,), not {primitive.shape}")
    rows = {"primitive": primitive}
    if geometry is not None:
        if geometry.shape not in ((), primitive.shape):
            raise ValueError(f"skip geometry has to have the shape {primitive.shape}, not {geometry.shape}")
        rows["geometry"] = np.broadcast_to(geometry, primitive.shape)
    ends = checked_offsets(offsets, math.prod(shape), len(primitive))

    def place(entry: int) -> str:
        ray = int(np.searchsorted(ends, np.uint64(entry), side="right")) - 1
        return f"skip[{ray}][{entry - int(ends[ray])}]"

    return skip_of(rows, ends, place)


def checked_offsets(offsets: npt.ArrayLike, rays: int, ids: int) -> Array:
    """Offsets as C reads them. That they stay inside the ids is checked here: C does not know how many there are."""
    given = as_ids(offsets, "skip offsets")
    if given.shape != (rays + 1,):
        raise ValueError(f"skip offsets has to have the shape {(rays + 1,)}, one more than rays, not {given.shape}")
    falls = np.flatnonzero(given[1:] < given[:-1])
    if given[0] < 0:
        raise ValueError(f"skip offsets[0] is {given[0]}, which is negative")
    if len(falls):
        i = int(falls[0])
        raise ValueError(f"skip offsets[{i + 1}] is {given[i + 1]}, below the {given[i]} before it")
    if given[-1] > ids:
        raise ValueError(f"skip offsets[{rays}] is {given[-1]}, and there are {ids} ids")
    return np.require(as_indices(given, "skip offsets"), np.uint64, ["C_CONTIGUOUS", "ALIGNED"])


def flat(array: Array) -> Array:
    """array as one axis; a copy only where strides cannot say it."""
    return array if array.ndim == 1 else array.reshape(-1)


def skip_of(rows: Dict[str, Array], offsets: Optional[Array], place: Callable[[int], str]) -> Optional[Skip]:
    if rows["primitive"].size == 0:
        return None
    signed = {name: ids for name, ids in rows.items() if ids.dtype.kind == "i"}
    return Skip({name: as_indices(ids, name) for name, ids in rows.items()}, offsets, place, signed)
