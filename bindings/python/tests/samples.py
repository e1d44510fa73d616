"""Meshes, rays and comparisons for the tests."""

from __future__ import annotations

from typing import Any, Dict, List, Tuple

import numpy as np
import numpy.typing as npt

import raywise

Points = npt.NDArray[np.float64]
Indices = npt.NDArray[np.uint32]


def sphere(rings: int = 12, sectors: int = 24, radius: float = 1.0) -> Tuple[Points, Indices]:
    """A closed triangle mesh with its vertices on a sphere around 0, normals outwards."""
    polar = np.linspace(0, np.pi, rings + 1)[1:-1]
    around = np.arange(sectors) * (2 * np.pi / sectors)
    x = np.outer(np.sin(polar), np.cos(around))
    y = np.outer(np.sin(polar), np.sin(around))
    z = np.repeat(np.cos(polar)[:, None], sectors, axis=1)
    inner = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    vertices = np.concatenate([[[0.0, 0.0, 1.0]], inner, [[0.0, 0.0, -1.0]]]) * radius
    last = len(vertices) - 1

    triangles: List[Tuple[int, int, int]] = []
    for j in range(sectors):
        k = (j + 1) % sectors
        triangles.append((0, 1 + j, 1 + k))
        for i in range(rings - 2):
            upper, lower = 1 + i * sectors, 1 + (i + 1) * sectors
            triangles.append((upper + j, lower + j, lower + k))
            triangles.append((upper + j, lower + k, upper + k))
        triangles.append((last, 1 + (rings - 2) * sectors + k, 1 + (rings - 2) * sectors + j))
    return vertices, np.array(triangles, np.uint32)


def soup(seed: int, count: int, dtype: Any = np.float64) -> Tuple[npt.NDArray[Any], Indices]:
    """Triangles without order, of which some share vertices and some have no area."""
    random = np.random.default_rng(seed)
    vertices = random.uniform(-1, 1, (2 * count, 3)).astype(dtype)
    triangles = random.integers(0, len(vertices), (count, 3)).astype(np.uint32)
    triangles[::10, 2] = triangles[::10, 1]
    return vertices, triangles


def rays(seed: int, count: int, dtype: Any = np.float64) -> Tuple[npt.NDArray[Any], npt.NDArray[Any]]:
    """Chords through [-1, 1]^3, some along the axes."""
    random = np.random.default_rng(seed)
    origins = random.uniform(-2, 2, (count, 3))
    directions = random.uniform(-1, 1, (count, 3)) - origins
    directions[::7] = np.eye(3)[random.integers(0, 3, len(directions[::7]))]
    origins[::7] = np.round(origins[::7])
    return origins.astype(dtype), directions.astype(dtype)


def bits(array: Any) -> bytes:
    """The bytes of an array, in its order of elements: 0.0 and -0.0 differ, equal NaNs do not."""
    return np.ascontiguousarray(array).tobytes()


def same_bits(one: Any, other: Any) -> None:
    """Fails unless two Hits or AllHits are the same bits, array by array."""
    assert one.arrays.keys() == other.arrays.keys()
    for name, array in one.arrays.items():
        other_array = other.arrays[name]
        assert array.dtype == other_array.dtype, name
        assert array.shape == other_array.shape, name
        if bits(array) != bits(other_array):
            differs = np.flatnonzero(np.any((array != other_array).reshape(len(array), -1), axis=1))
            raise AssertionError(f"{name} differs for the rays {differs[:10]}")
    if isinstance(one, raywise.AllHits):
        assert one.offsets.tolist() == other.offsets.tolist()


def layouts(array: npt.NDArray[Any]) -> Dict[str, npt.NDArray[Any]]:
    """The same numbers of an (n, 3) array in different places and orders."""
    count = len(array)
    soa = np.array(array.T, order="C").T
    reversed_ = np.array(array[::-1])[::-1]
    reversed_components = np.array(array[:, ::-1])[:, ::-1]
    wide = np.full((count, 7), 77, array.dtype)
    wide[:, 2:5] = array
    spread = np.full((2 * count, 6), 77, array.dtype)
    spread[::2, ::2] = array
    record = np.zeros(count, np.dtype([("tag", np.uint8), ("ray", array.dtype, (3,))]))
    record["ray"] = array
    odd = np.zeros(array.nbytes + 1, np.uint8)[1:].view(np.dtype((np.void, array.nbytes)))
    unaligned = np.ndarray(array.shape, array.dtype, odd.data)
    unaligned[...] = array
    read_only = array.copy()
    read_only.flags.writeable = False
    return {
        "packed": np.array(array),
        "components apart": soa,
        "reversed": reversed_,
        "components reversed": reversed_components,
        "columns of a wider one": wide[:, 2:5],
        "every other row and column": spread[::2, ::2],
        "field of a packed record": record["ray"],
        "unaligned": unaligned,
        "read-only": read_only,
    }
