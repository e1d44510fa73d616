"""What the library tells about itself."""

from __future__ import annotations

import ctypes
from typing import Tuple

from ._errors import check
from ._library import lib


def version() -> str:
    """The version of the library that was loaded, e.g. "0.2.0"; it may differ from the package's. C: rw_version."""
    numbers = (ctypes.c_uint32(), ctypes.c_uint32(), ctypes.c_uint32())
    check(lib.rw_version(*(ctypes.byref(number) for number in numbers)))
    return ".".join(str(number.value) for number in numbers)


def library_path() -> str:
    """The file that was loaded, or "libraywise.so.1" when the system's loader found it."""
    return str(lib._name)


def structures() -> Tuple[str, ...]:
    """The names of the structures the library can choose from. C: rw_structure_count and rw_structure_name."""
    count = ctypes.c_uint32()
    check(lib.rw_structure_count(ctypes.byref(count)))
    names = []
    for index in range(count.value):
        name = ctypes.c_char_p()
        check(lib.rw_structure_name(index, ctypes.byref(name)))
        assert name.value is not None
        names.append(name.value.decode("utf-8"))
    return tuple(names)
