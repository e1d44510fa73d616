"""The package as a whole: everything public is documented, and everything in the C library is used."""

from __future__ import annotations

import inspect
import pathlib
import re
from typing import Dict, Iterator, Tuple

import numpy as np
import pytest

import raywise
from raywise import _declarations as c
from raywise import _errors, _words
from raywise._library import lib


def public() -> Iterator[Tuple[str, object]]:
    """Every public class, function, method and property."""
    for name in raywise.__all__:
        value = getattr(raywise, name)
        if not inspect.isclass(value) and not inspect.isfunction(value):
            continue
        yield name, value
        if inspect.isclass(value) and not issubclass(value, (BaseException, tuple)):
            for member in dir(value):
                attribute = inspect.getattr_static(value, member)
                if not member.startswith("_") and (inspect.isfunction(attribute) or isinstance(attribute, property)):
                    yield f"{name}.{member}", attribute


def documentation() -> str:
    constructors = [value.__init__ for _, value in public() if inspect.isclass(value)]
    texts = [inspect.getdoc(value) or "" for _, value in public()]
    return "\n".join(texts + [inspect.getdoc(constructor) or "" for constructor in constructors])


@pytest.mark.parametrize(("name", "value"), list(public()), ids=[name for name, _ in public()])
def test_everything_public_is_documented(name: str, value: object) -> None:
    assert (inspect.getdoc(value) or "").strip(), name


def test_every_function_of_the_library_is_named_by_what_wraps_it() -> None:
    internal = {"rw_abi_version", "rw_last_error_message"}  # the loader's and the exceptions' own
    named = set(re.findall(r"\brw_[a-z0-9_]+\b", documentation()))
    missing = {name for name in c.FUNCTIONS if not name.endswith("_retain")} - named - internal
    assert not missing


def test_the_documentation_names_no_function_that_is_not_there() -> None:
    named = set(re.findall(r"\brw_[a-z0-9_]+\b", documentation()))
    assert named <= set(c.FUNCTIONS) | set(c.LAYOUTS)


def constants(prefix: str) -> Dict[str, int]:
    return {name: value for name, value in vars(c).items() if name.startswith(prefix) and isinstance(value, int)}


@pytest.mark.parametrize(
    ("prefix", "words", "others"),
    [
        ("RW_RAYS_", _words.RAY_KINDS.values(), {"RW_RAYS_UNKNOWN", "RW_RAYS_LIMIT"}),
        ("RW_EFFORT_", _words.EFFORTS.values(), set()),
        ("RW_RULE_", _words.RULES.values(), set()),
        ("RW_PROFILE_SOURCE_", _words.PROFILE_SOURCES.keys(), set()),
    ],
)
def test_every_constant_has_a_word(prefix: str, words: "list[int]", others: "set[str]") -> None:
    assert sorted(words) == sorted(value for name, value in constants(prefix).items() if name not in others)


def test_every_status_has_an_exception_and_a_text() -> None:
    statuses = range(1, c.RW_STATUS_COUNT)
    assert set(_errors.CLASSES) == set(statuses)
    texts = [_errors.status_text(status) for status in statuses]
    assert all(texts) and len(set(texts)) == len(texts)


def test_every_exception_is_public() -> None:
    assert {kind.__name__ for kind in _errors.CLASSES.values()} <= set(raywise.__all__)


def test_the_types_are_published() -> None:
    assert (pathlib.Path(raywise.__file__).parent / "py.typed").is_file()


def test_the_readme_tells_the_truth() -> None:
    readme = (pathlib.Path(__file__).resolve().parents[1] / "README.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"```python\n(.*?)```", readme, flags=re.DOTALL)
    origins, directions = np.random.default_rng(1).uniform(-1, 1, (2, 50, 3))
    exec(block, {"origins": origins, "directions": directions})


def test_version_and_structures_come_from_the_library() -> None:
    assert re.fullmatch(r"\d+\.\d+\.\d+", raywise.version())
    assert "linear_scan" in raywise.structures()
    assert len(set(raywise.structures())) == len(raywise.structures())


def test_the_missing_id_is_the_librarys() -> None:
    assert np.uint32(raywise.INVALID_ID) == np.iinfo(np.uint32).max


def test_statuses_that_do_not_exist_have_a_text_as_well() -> None:
    assert lib.rw_status_text(-1) and lib.rw_status_text(c.RW_STATUS_COUNT)
