"""Finding and loading the library: raywise/_library.py."""

from __future__ import annotations

import ctypes
import importlib
import os
import pathlib
import subprocess
import sys
from types import SimpleNamespace
from typing import Any

import pytest

import raywise
from raywise import _declarations, _library


def test_the_variable_is_asked_first(tmp_path: pathlib.Path) -> None:
    (tmp_path / _library.SONAME).touch()
    named = tmp_path / "elsewhere.so"
    named.touch()
    assert _library.find({_library.VARIABLE: str(named)}, tmp_path) == str(named)


def test_the_file_in_the_package_is_second(tmp_path: pathlib.Path) -> None:
    (tmp_path / _library.SONAME).touch()
    assert _library.find({}, tmp_path) == str(tmp_path / _library.SONAME)


def test_the_systems_loader_is_asked_last(tmp_path: pathlib.Path) -> None:
    assert _library.find({}, tmp_path) == "libraywise.so.1"


def test_a_relative_path_in_the_variable_is_refused(tmp_path: pathlib.Path) -> None:
    with pytest.raises(raywise.LibraryError, match="absolute"):
        _library.find({_library.VARIABLE: "libraywise.so.1"}, tmp_path)


def test_a_missing_file_in_the_variable_is_an_error_and_nothing_else_is_taken(tmp_path: pathlib.Path) -> None:
    (tmp_path / _library.SONAME).touch()
    with pytest.raises(raywise.LibraryError, match="no such file"):
        _library.find({_library.VARIABLE: str(tmp_path / "missing.so")}, tmp_path)


def test_a_file_that_is_no_library_is_an_error_that_lists_what_was_tried(tmp_path: pathlib.Path) -> None:
    broken = tmp_path / _library.SONAME
    broken.write_text("not a library")
    with pytest.raises(raywise.LibraryError) as caught:
        _library.load({}, tmp_path)
    message = str(caught.value)
    assert "Tried:" in message and _library.VARIABLE in message and str(broken) in message


def test_another_library_is_refused() -> None:
    stranger: Any = getattr(importlib.import_module("_ctypes"), "__file__", None)
    if stranger is None:  # built into the interpreter
        files = [str(getattr(module, "__file__", "")) for module in list(sys.modules.values())]
        stranger = next(file for file in files if file.endswith(".so"))
    with pytest.raises(raywise.LibraryError, match="is not libraywise"):
        _library.load({_library.VARIABLE: os.path.abspath(stranger)}, pathlib.Path("/"))


class ForeignInterface:
    """rw_abi_version of a library with another binary interface."""

    restype: Any = None
    argtypes: Any = None

    def __call__(self, abi: Any) -> int:
        abi._obj.value = _declarations.RW_ABI_VERSION + 1
        return _declarations.RW_OK


def test_another_binary_interface_is_refused() -> None:
    foreign: Any = SimpleNamespace(rw_abi_version=ForeignInterface())
    with pytest.raises(raywise.LibraryError, match=f"interface {_declarations.RW_ABI_VERSION + 1}"):
        _library.check_interface(foreign, "somewhere")


def test_a_library_without_a_function_is_refused_by_name() -> None:
    with pytest.raises(AttributeError, match="rw_version"):
        _declarations.declare(ctypes.CDLL(None))


def test_importing_with_a_wrong_variable_is_an_import_error() -> None:
    environment = {**os.environ, _library.VARIABLE: "/there/is/no/libraywise.so.1"}
    done = subprocess.run(
        [sys.executable, "-c", "import raywise"], env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode != 0
    assert "/there/is/no/libraywise.so.1" in done.stderr and "LibraryError" in done.stderr


def test_other_python_threads_run_during_calls() -> None:
    assert isinstance(_library.lib, ctypes.CDLL) and not isinstance(_library.lib, ctypes.PyDLL)


def test_the_library_under_test_is_the_one_that_was_named() -> None:
    if _library.VARIABLE in os.environ:
        assert raywise.library_path() == os.environ[_library.VARIABLE]
