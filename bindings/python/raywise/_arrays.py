"""NumPy arrays to rw_array and rw_output: by address and strides, converted only where C has no such type."""

from __future__ import annotations

from typing import Any, Dict, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _declarations as c

FloatArray = Union[npt.NDArray[np.float32], npt.NDArray[np.float64]]
Array = npt.NDArray[Any]
Shape = Tuple[int, ...]

TYPES: Dict[str, int] = {
    "f4": c.RW_FLOAT32,
    "f8": c.RW_FLOAT64,
    "u1": c.RW_UINT8,
    "b1": c.RW_UINT8,
    "u4": c.RW_UINT32,
    "u8": c.RW_UINT64,
}


def as_floats(values: npt.ArrayLike, name: str) -> Array:
    """values as a float32 or float64 array of this machine's byte order.

    The array itself when it is one already, in whatever layout; float16 becomes float32, all other numbers float64.
    """
    array = as_array(values, name)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name} has to hold real numbers, not {array.dtype}")
    if array.dtype.kind == "f" and array.dtype.itemsize <= 4:
        return array.astype(np.float32, copy=False)
    return array.astype(np.float64, copy=False)


def as_indices(values: npt.ArrayLike, name: str) -> Array:
    """values as a uint32 or uint64 array.

    int32 and int64 arrays are read in place as unsigned ones: a negative index is then out of range, as it should be.
    """
    array = as_array(values, name)
    if array.size == 0 and array.dtype.kind == "f":
        return array.astype(np.uint32)  # an empty list
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name} has to hold whole numbers, not {array.dtype}")
    if array.dtype.itemsize < 4:
        array = array.astype(np.int32)
    array = array.astype(array.dtype.newbyteorder("="), copy=False)
    return array.view(f"u{array.dtype.itemsize}")


def as_array(values: npt.ArrayLike, name: str) -> Array:
    try:
        return np.asarray(values)
    except ValueError as error:
        raise ValueError(f"{name} is not an array: {error}") from error


def require_rows(array: Array, name: str, columns: int) -> Array:
    """array of shape (n, columns); ValueError names the argument and its shape otherwise."""
    if array.ndim == 1 and array.size == 0:
        return array.reshape(0, columns)
    if array.ndim != 2 or array.shape[1] != columns:
        raise ValueError(f"{name} has to have the shape (n, {columns}), not {array.shape}")
    return array


def strides(array: Array) -> Tuple[int, int]:
    """Stride and component stride, in the C library's words, of an array of shape (n,) or (n, k)."""
    stride = array.strides[0] if array.shape[0] > 1 else 0
    if array.shape[0] > 1 and stride == 0:
        stride = c.RW_REPEAT
    component = array.strides[1] if array.ndim == 2 else 0
    return stride, component


def expressible(array: Array) -> Array:
    """array, or a copy of the few layouts that an rw_array cannot name: all components of an element in one place."""
    if array.ndim == 2 and array.shape[1] > 1 and array.strides[1] == 0:
        return np.ascontiguousarray(array)
    return array


def input_array(array: Array) -> c.rw_array:
    """Describes an expressible array of shape (n,) or (n, k). The caller keeps the array for as long as C reads it."""
    stride, component = strides(array)
    return c.rw_array(array.ctypes.data, stride, component, type_of(array), 0)


def output_array(array: Array) -> c.rw_output:
    """Describes an array of shape (n,) or (n, k) that C writes to."""
    stride, component = strides(array)
    return c.rw_output(array.ctypes.data, stride, component, type_of(array), 0)


def type_of(array: Array) -> int:
    return TYPES[array.dtype.str[1:]]


def overlap(one: Array, other: Array) -> bool:
    """Whether two arrays have an element's byte in common; when that is too hard to say, whether their extents meet."""
    if not np.may_share_memory(one, other):
        return False
    try:
        return bool(np.shares_memory(one, other, max_work=100_000))  # type: ignore[arg-type]  # stubs know 0 and -1
    except RuntimeError:  # numpy's TooHardError, which moved between versions
        return True
