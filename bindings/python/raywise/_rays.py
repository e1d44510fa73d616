"""Rays as callers have them, as rw_rays and as rw_ray."""

from __future__ import annotations

import math
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Dict, Iterator, List, Optional, Tuple, Type, TypeVar

import numpy as np
import numpy.typing as npt

from . import _declarations as c
from ._arrays import Array, Shape, as_floats, expressible, input_array
from ._errors import IndexOutOfRange
from ._skip import Skip, SkipLike, as_skip
from ._words import sized


Ray = TypeVar("Ray", c.rw_ray, c.rw_ray_f32)


@dataclass(frozen=True)
class Rays:
    """Rays of any leading shape: () for a single one, (n,) for a list, (h, w) for an image."""

    shape: Shape
    parts: Dict[str, Array]  # origins, directions and, where given, tmin and tmax; not yet broadcast
    dtype: "np.dtype[np.floating]"  # of the answers: float32 when origins and directions are
    skip: Optional[Skip]

    @property
    def count(self) -> int:
        return math.prod(self.shape)

    @property
    def inputs(self) -> Dict[str, Array]:
        """All that C reads, by the names for messages."""
        return {**self.parts, **self.skip.arrays()} if self.skip else self.parts

    @contextmanager
    def in_callers_terms(self) -> Iterator[None]:
        """Names an entry of a skip list that is out of range as the caller would."""
        try:
            yield
        except IndexOutOfRange as error:
            raise (self.skip.in_callers_terms(error) if self.skip else error) from None

    def rows(self) -> Dict[str, Array]:
        """The parts broadcast to (count, 3) and (count,). A copy is made only where strides cannot say it."""
        rows = {}
        for name, part in self.parts.items():
            tail = tail_of(name)
            whole = np.broadcast_to(part, self.shape + tail)
            rows[name] = expressible(whole if len(self.shape) == 1 else whole.reshape((self.count,) + tail))
        return rows

    @property
    def is_float32(self) -> bool:
        """Whether all numbers are float32."""
        return all(part.dtype == np.float32 for part in self.parts.values())

    def single(self, struct: "Type[Ray]") -> "Ray":
        """The one ray of shape ()."""
        ray = struct()
        ray.origin[:] = self.parts["origins"].tolist()
        ray.direction[:] = self.parts["directions"].tolist()
        ray.tmin = float(self.parts["tmin"]) if "tmin" in self.parts else 0.0
        ray.tmax = float(self.parts["tmax"]) if "tmax" in self.parts else math.inf
        return ray


def as_rays(
    origins: npt.ArrayLike,
    directions: npt.ArrayLike,
    tmin: Optional[npt.ArrayLike] = None,
    tmax: Optional[npt.ArrayLike] = None,
    skip: Optional[SkipLike] = None,
) -> Rays:
    """Checks types and shapes. ValueError names the arguments and shapes that do not fit."""
    parts = {"origins": as_floats(origins, "origins"), "directions": as_floats(directions, "directions")}
    for name, values in (("tmin", tmin), ("tmax", tmax)):
        if values is not None:
            parts[name] = as_floats(values, name)
    for name in ("origins", "directions"):
        if parts[name].ndim == 0 or parts[name].shape[-1] != 3:
            raise ValueError(f"{name} has to have the shape (3,) or (..., 3), not {parts[name].shape}")
    try:
        shape = np.broadcast_shapes(*(lead_of(name, part) for name, part in parts.items()))
    except ValueError:
        shapes = " and ".join(f"{name} of shape {part.shape}" for name, part in parts.items())
        raise ValueError(f"these do not fit together: {shapes}") from None
    return Rays(shape, parts, np.result_type(parts["origins"], parts["directions"]), as_skip(skip, shape))


def tail_of(name: str) -> Shape:
    return (3,) if name in ("origins", "directions") else ()


def lead_of(name: str, part: Array) -> Shape:
    return part.shape[:-1] if tail_of(name) else part.shape


def describe(rays: Rays, rows: Dict[str, Array]) -> c.rw_rays:
    """rw_rays over rows and skip lists, which the caller keeps for as long as C reads them."""
    struct = sized(c.rw_rays)
    struct.count = rays.count
    struct.origin = input_array(rows["origins"])
    struct.direction = input_array(rows["directions"])
    if "tmin" in rows:
        struct.tmin = input_array(rows["tmin"])
    if "tmax" in rows:
        struct.tmax = input_array(rows["tmax"])
    if rays.skip:
        rays.skip.describe(struct)
    return struct


def sample_of(sample: "Tuple[npt.ArrayLike, ...]") -> Tuple[c.rw_rays, List[Array]]:
    """rw_rays over (origins, directions[, tmin[, tmax]]) and the arrays to keep meanwhile."""
    if not isinstance(sample, tuple) or not 2 <= len(sample) <= 4:
        raise TypeError("sample has to be a tuple (origins, directions), (..., tmin) or (..., tmin, tmax)")
    rays = as_rays(*sample)
    rows = rays.rows()
    return describe(rays, rows), list(rows.values())
