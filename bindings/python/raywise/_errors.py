"""Exceptions: one class for each status of the C library, each also the built-in exception a Python user expects."""

from __future__ import annotations

from typing import Dict, Type

from . import _declarations as c
from ._library import lib


class RaywiseError(Exception):
    """An error of the library.

    status: the RW_ERROR_ or RW_PROFILE_ value (rw_status_text puts it into words).
    message: what went wrong, naming the argument and the element (rw_last_error_message).
    """

    def __init__(self, status: int, message: str) -> None:
        super().__init__(message)
        self.status = status
        self.message = message

    def __str__(self) -> str:
        return self.message

    def __reduce__(self) -> "tuple[type[RaywiseError], tuple[int, str]]":
        return type(self), (self.status, self.message)


class InvalidArgument(RaywiseError, ValueError):
    """An argument that makes no sense."""


class ClosedError(InvalidArgument):
    """A scene, view, mesh or profile was used after close()."""


class ReservedMember(InvalidArgument):
    """A reserved member of a struct is not zero. The package fills structs itself, so users do not meet this."""


class OverlappingOutput(InvalidArgument):
    """The strides of an output array let its elements overlap."""


class SharedMemory(InvalidArgument):
    """Two outputs, or an output and the rays, share memory."""


class InUse(RaywiseError, RuntimeError):
    """A workspace serves one batch at a time, and another one is at it; nothing was written."""


class OutOfMemory(RaywiseError, MemoryError):
    """An allocation failed; nothing was changed but a batch's outputs."""


class NotFinite(RaywiseError, ValueError):
    """A vertex, or a view's origin or direction, has a NaN or infinite coordinate."""


class CoordinateRange(RaywiseError, ValueError):
    """A float64 vertex lies beyond what a float32 box can hold."""


class IndexOutOfRange(RaywiseError, IndexError, ValueError):
    """An index or id names a vertex, geometry or triangle that is not there."""


class TooMany(RaywiseError, ValueError):
    """More vertices or triangles than the ids can count, or more rays than there may be."""


class AlreadyCommitted(RaywiseError):
    """A committed scene cannot be changed."""


class NotCommitted(RaywiseError):
    """The scene has to be committed first."""


class UnknownStructure(RaywiseError, ValueError):
    """No structure has that name; raywise.structures() lists them."""


class WrongStructure(RaywiseError):
    """The question has no meaning for the structure in use."""


class RayCount(RaywiseError, ValueError):
    """An expected ray count of zero, or above 10^15."""


class Capacity(RaywiseError):
    """An output was too small. The package sizes its outputs itself, so users do not meet this."""


class Cancelled(RaywiseError):
    """The progress callback asked to stop; the scene is as it was and can be committed again."""


class MemoryLimit(RaywiseError, MemoryError):
    """No structure fits the memory limit."""


class MeshNotFound(RaywiseError, FileNotFoundError):
    """There is no such mesh file."""


class MeshUnreadable(RaywiseError, OSError):
    """The mesh file is there but cannot be opened or read."""


class MeshFormat(RaywiseError, ValueError):
    """The mesh file's kind is unknown or its content is not of that kind."""


class NoFaces(MeshFormat):
    """A mesh file without a single face."""


class BadPolygon(MeshFormat):
    """A face with fewer than three corners."""


class HostParallel(RaywiseError, RuntimeError):
    """A parallel-for of the host left a task out or ran one twice."""


class InternalError(RaywiseError, RuntimeError):
    """An unexpected failure; please report it."""


class ProfileError(RaywiseError):
    """A calibration profile could not be used; `status` says why (RW_PROFILE_)."""


class ProfileNotFound(ProfileError, FileNotFoundError):
    """There is no profile at that path."""


CLASSES: Dict[int, Type[RaywiseError]] = {
    c.RW_ERROR_INVALID_ARGUMENT: InvalidArgument,
    c.RW_ERROR_OUT_OF_MEMORY: OutOfMemory,
    c.RW_ERROR_NOT_FINITE: NotFinite,
    c.RW_ERROR_COORDINATE_RANGE: CoordinateRange,
    c.RW_ERROR_INDEX_OUT_OF_RANGE: IndexOutOfRange,
    c.RW_ERROR_TOO_MANY: TooMany,
    c.RW_ERROR_ALREADY_COMMITTED: AlreadyCommitted,
    c.RW_ERROR_NOT_COMMITTED: NotCommitted,
    c.RW_ERROR_UNKNOWN_STRUCTURE: UnknownStructure,
    c.RW_ERROR_WRONG_STRUCTURE: WrongStructure,
    c.RW_ERROR_RAY_COUNT: RayCount,
    c.RW_ERROR_CAPACITY: Capacity,
    c.RW_ERROR_CANCELLED: Cancelled,
    c.RW_ERROR_MEMORY_LIMIT: MemoryLimit,
    c.RW_ERROR_FILE_NOT_FOUND: MeshNotFound,
    c.RW_ERROR_FILE_UNREADABLE: MeshUnreadable,
    c.RW_ERROR_FILE_FORMAT: MeshFormat,
    c.RW_ERROR_NO_FACES: NoFaces,
    c.RW_ERROR_BAD_POLYGON: BadPolygon,
    c.RW_ERROR_HOST_PARALLEL: HostParallel,
    c.RW_ERROR_INTERNAL: InternalError,
    c.RW_PROFILE_NOT_FOUND: ProfileNotFound,
    c.RW_PROFILE_UNREADABLE: ProfileError,
    c.RW_PROFILE_MALFORMED: ProfileError,
    c.RW_PROFILE_SCHEMA: ProfileError,
    c.RW_PROFILE_EPOCH: ProfileError,
    c.RW_PROFILE_MACHINE: ProfileError,
    c.RW_PROFILE_RANGE: ProfileError,
    c.RW_ERROR_RESERVED: ReservedMember,
    c.RW_ERROR_OVERLAP: OverlappingOutput,
    c.RW_ERROR_SHARED_MEMORY: SharedMemory,
    c.RW_ERROR_IN_USE: InUse,
}


def status_text(status: int) -> str:
    """A status in words: rw_status_text."""
    text: bytes = lib.rw_status_text(status)
    return text.decode("utf-8", "replace")


def error_of(status: int) -> RaywiseError:
    """The exception for a status that the calling thread has just been given: rw_last_error_message."""
    text: bytes = lib.rw_last_error_message()
    message = text.decode("utf-8", "replace") or status_text(status)
    return CLASSES.get(status, RaywiseError)(status, message)


def check(status: int) -> None:
    """Raises the exception for any status but RW_OK."""
    if status != c.RW_OK:
        raise error_of(status)
