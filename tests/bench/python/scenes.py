"""Scenes and rays in files, as raywise_bench --export writes them (tests/bench/export_scene.h)."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict

import numpy as np
import numpy.typing as npt
from kinds import RAY_KINDS

Array = npt.NDArray[Any]


@dataclass(frozen=True)
class RayArrays:
    """Rays as all libraries can take them: float32, from their origins to one common end."""

    origins: Array  # (n, 3)
    directions: Array  # (n, 3)
    tmax: float

    def __len__(self) -> int:
        return len(self.origins)

    def fewer(self, count: int) -> "RayArrays":
        """`count` of them, evenly spread: the first rays of an image only see its sky."""
        if count >= len(self):
            return self
        which = evenly(count, len(self))
        return RayArrays(self.origins[which], self.directions[which], self.tmax)


def evenly(count: int, out_of: int) -> Array:
    """Which rays RayArrays.fewer takes."""
    return np.arange(count, dtype=np.int64) * out_of // count


@dataclass(frozen=True)
class Mesh:
    vertices: Array  # (n, 3)
    triangles: Array  # uint32 (m, 3)


@dataclass(frozen=True)
class Scene:
    name: str
    mesh: Mesh
    rays: Dict[str, RayArrays]  # by kind


class Reader:
    """Arrays one after the other: a count of 64 bits, then the values (tests/bench/binary.h)."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.bytes = np.memmap(path, np.uint8, mode="r")
        self.place = 0

    def array(self, dtype: npt.DTypeLike) -> Array:
        """The next array, in memory of its own, which is aligned and is not paged in while the clock runs."""
        count = int(self.take(np.uint64, 1)[0])
        return self.take(dtype, count)

    def take(self, dtype: npt.DTypeLike, count: int) -> Array:
        end = self.place + count * np.dtype(dtype).itemsize
        if end > len(self.bytes):
            raise ValueError(f"{self.path}: the file breaks off")
        values = np.frombuffer(self.bytes[self.place : end].tobytes(), dtype).copy()
        self.place = end
        return values


def read_scene(path: Path, vertex_type: npt.DTypeLike = np.float32) -> Scene:
    reader = Reader(path)
    vertices = reader.array(np.float32).reshape(-1, 3).astype(vertex_type, copy=False)
    triangles = reader.array(np.uint32).reshape(-1, 3)
    rays = {}
    for kind in RAY_KINDS:
        origins = reader.array(np.float32).reshape(-1, 3)
        directions = reader.array(np.float32).reshape(-1, 3)
        tmin = reader.array(np.float32)
        tmax = reader.array(np.float32)
        if len(origins):
            rays[kind] = from_start(origins, directions, tmin, tmax)
    return Scene(path.stem, Mesh(vertices, triangles), rays)


def from_start(origins: Array, directions: Array, tmin: Array, tmax: Array) -> RayArrays:
    """No peer has an interval for each ray: rays begin where theirs did, and all end at the same t."""
    ends = np.unique(tmax - tmin)
    if len(ends) != 1:
        raise ValueError("rays of one kind end at different t")
    starts = origins + tmin[:, None] * directions
    return RayArrays(np.ascontiguousarray(starts, np.float32), directions, float(ends[0]))
