"""What several test files use."""

from __future__ import annotations

import os
import pathlib
from typing import Any, Callable, Iterator, List, Tuple

import pytest
from hypothesis import settings

# Before the library looks for a profile, which it does once in a process: the same whatever this machine was measured with.
os.environ["RAYWISE_CALIBRATION"] = "builtin"

import raywise  # noqa: E402
from raywise import _library, _once, _queries, _scene  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[3]

# The same examples in every run, and nothing left on the disk.
settings.register_profile("raywise", derandomize=True, database=None, deadline=None, max_examples=60)
settings.load_profile("raywise")


def pytest_report_header() -> str:
    return f"raywise {raywise.version()} from {raywise.library_path()}"


@pytest.fixture(params=raywise.structures())
def structure(request: pytest.FixtureRequest) -> str:
    """Each structure of the library in turn."""
    name: str = request.param
    return name


class Recorder:
    """The C library, noting each call."""

    def __init__(self) -> None:
        self.calls: List[Tuple[str, Tuple[Any, ...]]] = []

    def __getattr__(self, name: str) -> Callable[..., int]:
        function = getattr(_library.lib, name)

        def call(*arguments: Any) -> int:
            self.calls.append((name, arguments))
            status: int = function(*arguments)
            return status

        return call

    def arguments(self, name: str) -> Tuple[Any, ...]:
        """The arguments of the latest call of a function."""
        return [arguments for called, arguments in self.calls if called == name][-1]


@pytest.fixture
def recorder(monkeypatch: pytest.MonkeyPatch) -> Iterator[Recorder]:
    """Notes what the package hands to the C library."""
    recorder = Recorder()
    for module in (_queries, _scene, _once):
        monkeypatch.setattr(module, "lib", recorder)
    yield recorder
