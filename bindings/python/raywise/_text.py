"""Texts to and from the C library."""

from __future__ import annotations

import ctypes
import json
import os
from typing import Any, Callable, Dict, Optional, Union, cast

from . import _declarations as c
from ._errors import check

PathLike = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]


def c_text(text: Optional[str], argument: str) -> Optional[bytes]:
    """UTF-8 for a `const char *`; None stays NULL."""
    if text is None:
        return None
    if not isinstance(text, str):
        raise TypeError(f"{argument} has to be a str or None, not {type(text).__name__}")
    return without_zero(text.encode("utf-8"), argument)


def c_path(path: PathLike, argument: str) -> bytes:
    """A path as the C library wants it."""
    name = os.fspath(path)
    data = name.encode("utf-8", "surrogateescape") if isinstance(name, str) else name
    return without_zero(data, argument)


def without_zero(data: bytes, argument: str) -> bytes:
    if b"\0" in data:
        raise ValueError(f"{argument} holds a zero byte, which would end it: {data!r}")
    return data


def library_text(function: Callable[..., int], address: int, format_: int) -> str:
    """The whole text of rw_profile_text or rw_scene_explain, which may grow between two calls."""
    needed = ctypes.c_uint64()
    check(function(address, format_, None, 0, ctypes.byref(needed)))
    while True:
        buffer = ctypes.create_string_buffer(needed.value)
        status = function(address, format_, buffer, needed.value, ctypes.byref(needed))
        if status != c.RW_ERROR_CAPACITY:
            check(status)
            return buffer.value.decode("utf-8", "replace")


def library_json(function: Callable[..., int], address: int) -> Dict[str, Any]:
    """The same as JSON."""
    return cast(Dict[str, Any], json.loads(library_text(function, address, c.RW_FORMAT_JSON)))
