"""Finds libraywise.so.1, checks that it is the right one, and loads it once.

The first of these that exists is loaded; a failure there is an error, never a reason to take another one silently:

1. the file named by the environment variable RAYWISE_LIBRARY (an absolute path);
2. libraywise.so.1 beside this package, where wheels put it;
3. libraywise.so.1 as the system's loader finds it (installed, ld.so.conf, LD_LIBRARY_PATH).
"""

from __future__ import annotations

import ctypes
import os
import pathlib
from typing import List, Mapping

from . import _declarations

VARIABLE = "RAYWISE_LIBRARY"
SONAME = f"libraywise.so.{_declarations.RW_ABI_VERSION}"
PACKAGE_DIRECTORY = pathlib.Path(__file__).resolve().parent


class LibraryError(ImportError):
    """libraywise could not be found, or what was found cannot be used. The message lists what was tried."""


def find(environment: Mapping[str, str], package_directory: pathlib.Path) -> str:
    """Returns what to load: an absolute path, or the bare SONAME for the system's loader. Raises LibraryError."""
    named = environment.get(VARIABLE)
    if named:
        if not os.path.isabs(named):
            raise LibraryError(f"{VARIABLE} has to be the absolute path of the library file, not {named!r}")
        if not os.path.isfile(named):
            raise LibraryError(f"{VARIABLE} names {named!r}, and there is no such file")
        return named
    bundled = package_directory / SONAME
    return str(bundled) if bundled.is_file() else SONAME


def load(environment: Mapping[str, str], package_directory: pathlib.Path) -> ctypes.CDLL:
    """Loads the library, checks its binary interface and declares its functions. Raises LibraryError.

    CDLL, not PyDLL: the interpreter's lock is released while a function runs.
    """
    place = find(environment, package_directory)
    try:
        library = ctypes.CDLL(place)
    except OSError as error:
        tried = "; ".join(attempts(environment, package_directory))
        raise LibraryError(f"cannot load {place!r}: {error}. Tried: {tried}") from error
    check_interface(library, place)
    try:
        _declarations.declare(library)
    except AttributeError as error:
        raise LibraryError(f"{place!r} is older than this package and lacks a function: {error}") from error
    return library


def attempts(environment: Mapping[str, str], package_directory: pathlib.Path) -> List[str]:
    """One sentence for each place that `find` looks at."""
    named = environment.get(VARIABLE)
    if named:
        return [f"{VARIABLE}={named}"]
    bundled = package_directory / SONAME
    return [
        f"{VARIABLE} (not set)",
        f"{bundled} ({'there' if bundled.is_file() else 'not there'})",
        f"{SONAME} by the system's loader",
    ]


def check_interface(library: ctypes.CDLL, place: str) -> None:
    """Refuses a library whose binary interface is not the one declared here. Uses rw_abi_version."""
    try:
        function = library.rw_abi_version
    except AttributeError as error:
        raise LibraryError(f"{place!r} is not libraywise: it has no rw_abi_version") from error
    function.restype = ctypes.c_int32
    function.argtypes = [ctypes.c_void_p]
    found = ctypes.c_uint32()
    status = function(ctypes.byref(found))
    if status != _declarations.RW_OK or found.value != _declarations.RW_ABI_VERSION:
        raise LibraryError(
            f"{place!r} has the binary interface {found.value}, this package needs {_declarations.RW_ABI_VERSION}"
        )


lib = load(os.environ, PACKAGE_DIRECTORY)
