"""Scenes and rays in files, as raywise_bench --export writes them (tests/bench/export_scene.h)."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

# The kinds of rays in the order of the file, and which question is asked with them.
RAY_KINDS = {"random": "closest", "camera": "closest", "shadow": "any", "diffuse": "closest"}


@dataclass(frozen=True)
class RayArrays:
    """Rays as all libraries can take them: float32, from their origin to one common end."""

    origins: np.ndarray  # (n, 3)
    directions: np.ndarray  # (n, 3)
    tmax: float

    def __len__(self):
        return len(self.origins)

    def thinned(self, count):
        """One in so many, that about `count` remain, and no more: the same spread."""
        step = max(1, -(-len(self) // count))
        return RayArrays(
            np.ascontiguousarray(self.origins[::step]), np.ascontiguousarray(self.directions[::step]), self.tmax
        )


@dataclass(frozen=True)
class BenchScene:
    name: str
    vertices: np.ndarray  # float32 (n, 3)
    triangles: np.ndarray  # uint32 (n, 3)
    rays: dict  # kind -> RayArrays


class File:
    """Arrays one after the other: a count of 64 bits, then the values."""

    def __init__(self, path):
        self.bytes = np.fromfile(path, np.uint8)
        self.place = 0

    def take(self, dtype, count):
        end = self.place + count * np.dtype(dtype).itemsize
        if end > len(self.bytes):
            raise ValueError("the file breaks off")
        values = self.bytes[self.place : end].view(dtype)
        self.place = end
        return values

    def array(self, dtype):
        return self.take(dtype, int(self.take(np.uint64, 1)[0])).copy()


def read_scene(path):
    file = File(path)
    vertices = file.array(np.float32).reshape(-1, 3)
    triangles = file.array(np.uint32).reshape(-1, 3)
    rays = {}
    for kind in RAY_KINDS:
        origins = file.array(np.float32).reshape(-1, 3)
        directions = file.array(np.float32).reshape(-1, 3)
        tmin = file.array(np.float32)
        tmax = file.array(np.float32)
        if len(origins):
            rays[kind] = from_start(origins, directions, tmin, tmax)
    return BenchScene(Path(path).stem, vertices, triangles, rays)


def from_start(origins, directions, tmin, tmax):
    """Not all libraries have an interval for each ray: rays begin where theirs did, and all end at the same t."""
    starts = origins + tmin[:, None] * directions
    ends = np.unique(tmax - tmin)
    if len(ends) != 1:
        raise ValueError("rays of one kind end at different t")
    return RayArrays(starts.astype(np.float32), directions, float(ends[0]))
