"""Calibration profiles: what building and asking each structure costs on a machine."""

from __future__ import annotations

import ctypes
from typing import Any, Dict, Optional

from . import _declarations as c
from ._errors import check, error_of, status_text
from ._handle import Handle, Reference
from ._library import lib
from ._text import PathLike, c_path, library_json, library_text
from ._words import PROFILE_SOURCES, sized


class Profile(Handle):
    """The measured constants that structures are chosen with. They may change how long things take, never an answer.

    It is immutable; any number of threads may use it. str() is the whole profile for people, `json` the same as a dict.
    """

    def __init__(self, path: Optional[PathLike] = None, *, fallback: bool = False) -> None:
        """Reads a profile.

        path: the file, read anew each time; None: the first valid one of the file named by RAYWISE_CALIBRATION, the
        user's cache folder and the system's folder, or else the constants compiled into the library: looked up once in
        a process and kept; scenes without a profile of their own have the same one.
        fallback: what to do when the file at `path` cannot be used. False: raise ProfileError (ProfileNotFound, which
        is a FileNotFoundError as well). True: use the constants compiled into the library and say why in `status`.
        Without a path files that cannot be used are always passed over, and `status` says why the first one was.

        Raises ProfileError, MemoryError.

        C: rw_profile_load; close() is rw_profile_release.
        """
        address = ctypes.c_void_p()
        status = lib.rw_profile_load(None if path is None else c_path(path, "path"), ctypes.byref(address))
        if address.value is None:
            raise error_of(status)
        error = error_of(status) if status != c.RW_OK else None
        super().__init__(Reference(address.value, lib.rw_profile_release))
        if error is not None and path is not None and not fallback:
            raise error

    def _info(self) -> c.rw_profile_info:
        return inspect(self._use())

    @property
    def source(self) -> str:
        """Where it came from: "generic" (compiled in), "path", "environment", "user" or "system".

        C: rw_profile_inspect.
        """
        number: int = self._info().source
        return PROFILE_SOURCES.get(number, str(number))

    @property
    def status(self) -> int:
        """RW_OK, or why a file that comes before `source` was passed over (RW_PROFILE_). C: rw_profile_inspect."""
        return int(self._info().status)

    @property
    def status_text(self) -> str:
        """`status` in words; str() of the profile names the file as well. C: rw_status_text."""
        return status_text(self.status)

    @property
    def path(self) -> str:
        """The file in use; empty for the generic constants. C: rw_profile_inspect."""
        return self._text("path")

    @property
    def machine(self) -> str:
        """Key of the machine it was measured on; "generic". C: rw_profile_inspect."""
        return self._text("machine")

    @property
    def date(self) -> str:
        """When it was measured, ISO 8601. C: rw_profile_inspect."""
        return self._text("date")

    @property
    def tool(self) -> str:
        """The program and version that measured it. C: rw_profile_inspect."""
        return self._text("tool")

    @property
    def epoch(self) -> int:
        """Calibration epoch of the constants. C: rw_profile_inspect."""
        return int(self._info().epoch)

    @property
    def spread(self) -> float:
        """Relative spread of repeated timings, 0.05 = 5 %. C: rw_profile_inspect."""
        return float(self._info().spread)

    @property
    def threads(self) -> int:
        """Threads the machine offered when it was measured. C: rw_profile_inspect."""
        return int(self._info().threads)

    @property
    def json(self) -> Dict[str, Any]:
        """The whole profile, every constant with its unit. C: rw_profile_text."""
        return library_json(lib.rw_profile_text, self._use().address)

    def _text(self, name: str) -> str:
        reference = self._use()  # holds the text while it is copied
        value: Optional[bytes] = getattr(inspect(reference), name)
        return (value or b"").decode("utf-8", "replace")

    def __str__(self) -> str:
        """The whole profile as text for people. C: rw_profile_text."""
        return library_text(lib.rw_profile_text, self._use().address, c.RW_FORMAT_TEXT)

    def __repr__(self) -> str:
        return "<Profile, closed>" if self.closed else f"<Profile {self.machine!r} from {self.source}>"


def inspect(reference: Reference) -> c.rw_profile_info:
    """The facts; the texts in them belong to the profile. C: rw_profile_inspect."""
    info = sized(c.rw_profile_info)
    check(lib.rw_profile_inspect(reference.address, info))
    return info


def profile(path: Optional[PathLike] = None, *, fallback: bool = False) -> Profile:
    """Reads a calibration profile, to inspect it or to hand it to Scene: Profile(path, fallback=fallback).

    C: rw_profile_load.
    """
    return Profile(path, fallback=fallback)
