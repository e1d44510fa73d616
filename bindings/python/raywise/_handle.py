"""Counted C handles as Python objects that can be closed."""

from __future__ import annotations

import weakref
from types import TracebackType
from typing import Any, Callable, NoReturn, Optional, Type, TypeVar

from ._declarations import RW_ERROR_INVALID_ARGUMENT
from ._errors import ClosedError

Self = TypeVar("Self", bound="Handle")


class Reference:
    """One counted reference of the C library and whatever has to outlive it.

    It is given back when nothing in Python holds this object any longer. A call in flight holds it, so closing a
    scene in one thread while another one asks it is safe: the memory goes when the last question is answered.
    """

    __slots__ = ("address", "kept", "__weakref__")

    def __init__(self, address: int, release: Callable[[int], int]) -> None:
        self.address = address
        self.kept: "list[object]" = []
        # Not at exit: threads that still run then would lose the handle under their feet.
        weakref.finalize(self, release, address).atexit = False


class Handle:
    """A scene, view, mesh or profile: use it with `with`, or close() it, or let it go."""

    _reference: Optional[Reference]

    def __init__(self, reference: Reference) -> None:
        self._reference = reference

    def _use(self) -> Reference:
        """The reference; hold it for as long as the address is in use. Raises ClosedError."""
        reference: Optional[Reference] = getattr(self, "_reference", None)
        if reference is None:
            name = type(self).__name__
            raise ClosedError(RW_ERROR_INVALID_ARGUMENT, f"this {name} is closed: it cannot be used any longer")
        return reference

    @property
    def closed(self) -> bool:
        """Whether close() was called."""
        return getattr(self, "_reference", None) is None

    def close(self) -> None:
        """Gives the C library's memory back, once calls in other threads are over. Harmless when closed already."""
        self._reference = None

    def __enter__(self: Self) -> Self:
        self._use()
        return self

    def __exit__(
        self, kind: Optional[Type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None:
        self.close()

    def __reduce_ex__(self, protocol: Any) -> NoReturn:
        name = type(self).__name__
        raise TypeError(f"a {name} cannot be pickled or copied: it is memory of this process. Send its input instead")
