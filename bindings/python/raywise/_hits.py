"""Answers: Hits for the closest hit of each ray, AllHits for every hit of each ray."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _declarations as c
from ._arrays import Array, FloatArray, Shape, output_array, overlap
from ._errors import SharedMemory
from ._words import sized

IdArray = Union[npt.NDArray[np.uint32], npt.NDArray[np.uint64]]

INVALID_ID = c.RW_INVALID_ID

# What can be asked for: name -> (type of its numbers, shape of one answer).
FIELDS: Dict[str, Tuple[str, Shape]] = {
    "t": ("float", ()),
    "uv": ("float", (2,)),
    "normal": ("float", (3,)),
    "geometry": ("id", ()),
    "primitive": ("id", ()),
    "instance": ("id", ()),
}
EVERYTHING = tuple(FIELDS)
OUTPUT_TYPES: Dict[str, Tuple[str, ...]] = {
    "float": ("float32", "float64"),
    "id": ("uint32", "uint64"),
    "flag": ("bool", "uint8", "uint32", "uint64"),
}


class Answers:
    """What Hits and AllHits have in common. An array that was not asked for is an AttributeError which says so.

    t: distance in units of the direction's length; inf for a miss.
    uv: barycentric coordinates (u, v); the point is (1 - u - v) * v0 + u * v1 + v * v2; 0 for a miss.
    normal: geometric normal of unit length, (v1 - v0) x (v2 - v0); 0 for a miss.
    geometry, primitive, instance: ids; INVALID_ID for a miss (2**64 - 1 in a uint64 array), and `instance` always while
    the scene has no instances.
    invalid_rays: how many rays held a NaN.
    """

    t: FloatArray
    uv: FloatArray
    normal: FloatArray
    geometry: IdArray
    primitive: IdArray
    instance: IdArray
    invalid_rays: int

    def __init__(self, arrays: Mapping[str, Array], invalid_rays: int) -> None:
        self.__dict__.update(arrays)
        self.invalid_rays = invalid_rays

    @property
    def arrays(self) -> Dict[str, Array]:
        """The arrays there are, by name."""
        return {name: self.__dict__[name] for name in FIELDS if name in self.__dict__}

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            if name in FIELDS:
                raise AttributeError(f"{name} was not asked for; `want` was {tuple(self.arrays)}")
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    def __repr__(self) -> str:
        arrays = ", ".join(f"{name}{np.shape(array)}" for name, array in self.arrays.items())
        return f"<{type(self).__name__} {arrays}>"


class Hits(Answers):
    """The closest hit of each ray.

    With rays of shape (n, 3) the arrays have the shapes t (n,), uv (n, 2), normal (n, 3), geometry, primitive and
    instance (n,); rays of shape (h, w, 3) give (h, w), (h, w, 2) and so on. For a single ray, given as shape (3,),
    the numbers are NumPy scalars, and uv and normal have the shapes (2,) and (3,).
    """

    @property
    def hit(self) -> npt.NDArray[np.bool_]:
        """Whether each ray hit something: bool in the shape of the rays."""
        for name in ("primitive", "geometry"):
            ids = self.__dict__.get(name)
            if ids is not None:
                return np.not_equal(ids, np.iinfo(ids.dtype).max)  # type: ignore[no-any-return]
        return np.less(self.t, np.inf)


class AllHits(Answers):
    """Every hit of each ray, ray by ray, each ray's hits sorted by t, then by (instance, geometry, primitive).

    offsets: int64, one more than there are rays; ray i has the elements offsets[i] up to offsets[i + 1] of the arrays.
    `all_hits[i]` are the Hits of ray i. Rays of more than one leading axis are counted in C order.
    """

    offsets: npt.NDArray[np.int64]

    def __init__(self, arrays: Mapping[str, Array], invalid_rays: int, offsets: npt.NDArray[np.int64]) -> None:
        super().__init__(arrays, invalid_rays)
        self.offsets = offsets

    def __len__(self) -> int:
        """The number of rays."""
        return len(self.offsets) - 1

    @property
    def counts(self) -> npt.NDArray[np.int64]:
        """The number of hits of each ray."""
        return np.diff(self.offsets)

    @property
    def ray(self) -> npt.NDArray[np.int64]:
        """The ray of each hit."""
        return np.repeat(np.arange(len(self), dtype=np.int64), self.counts)

    def __getitem__(self, ray: int) -> Hits:
        index = range(len(self))[ray]
        part = slice(int(self.offsets[index]), int(self.offsets[index + 1]))
        return Hits({name: array[part] for name, array in self.arrays.items()}, 0)


Out = Union[Answers, Mapping[str, Array]]


@dataclass(frozen=True)
class Outputs:
    """Arrays to be filled: as the caller sees them, and as rows in the same memory for the C library."""

    arrays: Dict[str, Array]
    rows: Dict[str, Array]

    def describe(self) -> c.rw_hits:
        """rw_hits over the rows."""
        hits = sized(c.rw_hits)
        for name, row in self.rows.items():
            setattr(hits, name, output_array(row))
        return hits


def wanted(want: Iterable[str]) -> List[str]:
    """Checks the names in `want`."""
    names = [want] if isinstance(want, str) else list(want)
    for name in names:
        if name not in FIELDS:
            raise ValueError(f"want holds {name!r}, not one of {', '.join(FIELDS)}")
    return names


def float_type(dtype: Optional[npt.DTypeLike], default: "np.dtype[np.floating]") -> "np.dtype[np.floating]":
    """The type of t, uv and normal."""
    if dtype is None:
        return default
    chosen = np.dtype(dtype)
    for known in (np.dtype(np.float32), np.dtype(np.float64)):
        if chosen == known:
            return known
    raise TypeError(f"dtype has to be float32 or float64, not {chosen}")


def new_outputs(names: Iterable[str], shape: Shape, dtype: "np.dtype[np.floating]") -> Outputs:
    """New arrays for these names."""
    arrays: Dict[str, Array] = {}
    for name in names:
        kind, tail = FIELDS[name]
        arrays[name] = np.empty(shape + tail, dtype if kind == "float" else np.uint32)
    return Outputs(arrays, {name: rows_of(array, shape, name) for name, array in arrays.items()})


def caller_outputs(out: Out, shape: Shape, inputs: Mapping[str, Array]) -> Outputs:
    """The caller's arrays, checked: type, shape, writable, apart from each other and from the rays."""
    given = out.arrays if isinstance(out, Answers) else dict(out)
    for name, array in given.items():
        if name not in FIELDS:
            raise ValueError(f"out holds {name!r}, not one of {', '.join(FIELDS)}")
        kind, tail = FIELDS[name]
        require_output(array, f"out[{name!r}]", kind, shape + tail)
    require_apart({f"out[{name!r}]": array for name, array in given.items()}, inputs)
    return Outputs(given, {name: rows_of(array, shape, f"out[{name!r}]") for name, array in given.items()})


def require_output(array: Any, name: str, kind: str, shape: Shape) -> None:
    """An array that the C library can write `kind` of this shape to."""
    if not isinstance(array, np.ndarray):
        raise TypeError(f"{name} has to be a NumPy array, not {type(array).__name__}")
    if not array.dtype.isnative or array.dtype.name not in OUTPUT_TYPES[kind]:
        raise TypeError(f"{name} has to be of {' or '.join(OUTPUT_TYPES[kind])}, not {array.dtype}")
    if array.shape != shape:
        raise ValueError(f"{name} has to have the shape {shape}, not {array.shape}")
    if not array.flags.writeable:
        raise ValueError(f"{name} is read-only")


def require_apart(outputs: Mapping[str, Array], inputs: Mapping[str, Array]) -> None:
    """Outputs may not overlap the rays or each other."""
    seen = list(inputs.items())
    for name, array in outputs.items():
        for other_name, other in seen:
            if overlap(array, other):
                raise SharedMemory(c.RW_ERROR_SHARED_MEMORY, f"{name} overlaps {other_name} in memory")
        seen.append((name, array))


def rows_of(array: Array, shape: Sequence[int], name: str) -> Array:
    """array with its leading axes made one, in the same memory."""
    if len(shape) == 1:
        return array
    rows = array.reshape((-1 if array.size else 0,) + array.shape[len(shape) :])
    if array.size and not np.may_share_memory(rows, array):
        raise ValueError(f"{name} has leading axes that one stride cannot walk; pass an array that is contiguous there")
    return rows
