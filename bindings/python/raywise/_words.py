"""Words for the constants of the C library, and checks of plain numbers."""

from __future__ import annotations

import ctypes
import operator
from typing import Dict, Mapping, Optional, SupportsFloat, SupportsIndex, Type, TypeVar, Union, cast

from . import _declarations as c
from ._errors import InvalidArgument, RayCount

RAY_KINDS: Dict[str, int] = {
    "any": c.RW_RAYS_ANY_KIND,
    "random": c.RW_RAYS_RANDOM,
    "camera": c.RW_RAYS_CAMERA,
    "shadow": c.RW_RAYS_SHADOW,
    "diffuse": c.RW_RAYS_DIFFUSE,
}
EFFORTS: Dict[str, int] = {
    "estimate": c.RW_EFFORT_ESTIMATE,
    "probe": c.RW_EFFORT_PROBE,
    "measure": c.RW_EFFORT_MEASURE,
}
RULES: Dict[str, int] = {
    "smallest_total": c.RW_RULE_SMALLEST_TOTAL,
    "hapala": c.RW_RULE_HAPALA,
}
REFITS: Dict[str, int] = {
    "where_it_pays": c.RW_REFIT_WHERE_IT_PAYS,
    "where_possible": c.RW_REFIT_WHERE_POSSIBLE,
    "never": c.RW_REFIT_NEVER,
}
PROFILE_SOURCES: Dict[int, str] = {
    c.RW_PROFILE_SOURCE_GENERIC: "generic",
    c.RW_PROFILE_SOURCE_PATH: "path",
    c.RW_PROFILE_SOURCE_ENV: "environment",
    c.RW_PROFILE_SOURCE_USER: "user",
    c.RW_PROFILE_SOURCE_SYSTEM: "system",
}

Struct = TypeVar("Struct", bound=ctypes.Structure)
Count = Union[SupportsIndex, float]


def constant(words: Mapping[str, int], word: str, argument: str) -> int:
    """The constant for a word; an unknown one is an error that lists the others."""
    try:
        return words[word]
    except (KeyError, TypeError):
        known = ", ".join(repr(name) for name in words)
        raise InvalidArgument(c.RW_ERROR_INVALID_ARGUMENT, f"{argument} is {word!r}, not one of {known}") from None


def whole(value: Count, argument: str) -> int:
    """A whole number; a float such as 2e6 is one as well."""
    if isinstance(value, float) and value.is_integer():
        return int(value)
    try:
        return operator.index(cast(SupportsIndex, value))
    except TypeError:
        raise TypeError(f"{argument} has to be a whole number, not {value!r}") from None


def unsigned(value: Count, argument: str, bits: int) -> int:
    """A whole number that fits a uint of so many bits."""
    number = whole(value, argument)
    if not 0 <= number < 1 << bits:
        raise InvalidArgument(c.RW_ERROR_INVALID_ARGUMENT, f"{argument} is {number}, not in [0, 2^{bits})")
    return number


def ray_count(value: Optional[Count], argument: str) -> int:
    """A count of expected rays; None: nobody knows. The C library judges what is absurd."""
    if value is None:
        return c.RW_RAYS_UNKNOWN
    number = whole(value, argument)
    if not 0 <= number < c.RW_RAYS_UNKNOWN:
        raise RayCount(c.RW_ERROR_RAY_COUNT, f"{argument} is {number}, not in [1, {c.RW_RAYS_LIMIT}]")
    return number


def seconds(value: SupportsFloat, argument: str) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{argument} has to be a number, not {value!r}") from None


def sized(struct_type: Type[Struct]) -> Struct:
    """A new struct, all zero but for its size."""
    return struct_type(struct_size=ctypes.sizeof(struct_type))
