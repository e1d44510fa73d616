"""The generated declarations: raywise/_declarations.py and bindings/emit_python.py."""

from __future__ import annotations

import ctypes
import pathlib
import sys

import pytest
from conftest import ROOT

import raywise
from raywise import _declarations, _library

sys.path.insert(0, str(ROOT / "bindings"))
import emit_python  # noqa: E402

HEADER = ROOT / "capi" / "include" / "raywise" / "raywise.h"
PREAMBLE = "#include <stdint.h>\n"


def test_the_committed_file_is_what_the_header_gives() -> None:
    committed = pathlib.Path(_declarations.__file__).read_text(encoding="utf-8")
    assert emit_python.emit(HEADER) == committed, "run bindings/generate.py"


def test_the_text_does_not_depend_on_where_the_header_is(tmp_path: pathlib.Path) -> None:
    copy = tmp_path / "raywise.h"
    copy.write_bytes(HEADER.read_bytes())
    assert emit_python.emit(copy) == emit_python.emit(HEADER)


@pytest.mark.parametrize("name", sorted(_declarations.LAYOUTS))
def test_sizes_and_offsets_are_those_of_c(name: str) -> None:
    struct = getattr(_declarations, name)
    size, alignment, offsets = _declarations.LAYOUTS[name]
    assert ctypes.sizeof(struct) == size
    assert ctypes.alignment(struct) == alignment
    assert {field: getattr(struct, field).offset for field, _ in struct._fields_} == offsets


def test_u_and_v_of_a_hit_are_neighbours() -> None:
    assert _declarations.rw_hit.v.offset == _declarations.rw_hit.u.offset + 8


def test_every_struct_has_a_layout() -> None:
    structs = {
        name
        for name, value in vars(_declarations).items()
        if isinstance(value, type) and issubclass(value, ctypes.Structure)
    }
    assert structs == set(_declarations.LAYOUTS)


@pytest.mark.parametrize("name", sorted(_declarations.FUNCTIONS))
def test_every_function_is_in_the_library_and_declared(name: str) -> None:
    function = getattr(_library.lib, name)
    restype, argtypes = _declarations.FUNCTIONS[name]
    assert function.restype is restype
    assert list(function.argtypes) == argtypes


def test_the_packages_version_is_the_projects() -> None:
    assert raywise.__version__ == (ROOT / "VERSION").read_text(encoding="utf-8").strip()


def emit_text(tmp_path: pathlib.Path, text: str) -> str:
    header = tmp_path / "some.h"
    header.write_text(PREAMBLE + text, encoding="utf-8")
    return emit_python.emit(header)


@pytest.mark.parametrize(
    ("definition", "expected"),
    [
        ("#define RW_A 7u", "RW_A = 7\n"),
        ("#define RW_A 0xFFFFFFFFFFFFFFFFull", "RW_A = 0xFFFFFFFFFFFFFFFF\n"),
        ("#define RW_A (-9223372036854775807LL - 1)", "RW_A = -9223372036854775808\n"),
        ("#define RW_A (1u << 4 | 1u)", "RW_A = 17\n"),
        ('#define RW_A "a" "b"', "RW_A = 'ab'\n"),
    ],
)
def test_constants_keep_their_value(tmp_path: pathlib.Path, definition: str, expected: str) -> None:
    assert expected in emit_text(tmp_path, definition + "\n")


@pytest.mark.parametrize(
    "text",
    [
        "enum rw_kind { RW_ONE };",
        "typedef struct rw_a { uint32_t x : 3; } rw_a;",
        "long rw_f(void);",
        "typedef struct rw_a { int32_t x; } rw_a; rw_a rw_f(void);",
        "int32_t rw_f();",
        "int32_t rw_f(int32_t x, ...);",
        "int32_t other(void);",
        "typedef int32_t rw_status;",
        "int32_t rw_f(missing x);",
        "#define RW_A sizeof(int)",
    ],
)
def test_what_ctypes_cannot_express_is_refused(tmp_path: pathlib.Path, text: str) -> None:
    with pytest.raises(emit_python.EmitError):
        emit_text(tmp_path, text + "\n")
