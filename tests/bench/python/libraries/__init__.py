"""The ray libraries that take part, each in the form that it likes best."""

from __future__ import annotations

from typing import List, Tuple

from libraries.embreex_library import Embreex
from libraries.library import Library
from libraries.open3d_library import Open3D
from libraries.raywise_library import Raywise, RaywiseOnce
from libraries.trimesh_library import Trimesh, TrimeshEmbreex

OURS = "raywise"


def all_libraries() -> List[Library]:
    """raywise is the first: it and Open3D want a TBB of the same name, the one that is loaded first serves both, and
    the system's is the newer one."""
    return [
        Raywise(OURS),
        Raywise("t,uv,id", want=("t", "uv", "primitive")),
        RaywiseOnce("once"),
        Embreex(),
        Open3D(),
        TrimeshEmbreex(),
        Trimesh(),
    ]


def those_there(libraries: List[Library]) -> Tuple[List[Library], List[str], List[str]]:
    """Libraries that can be loaded, their versions, and why the others cannot."""
    there, versions, absent = [], [], []
    for library in libraries:
        try:
            version = library.version()
        except (ImportError, OSError) as error:
            absent.append(f"{library.name}: {error}")
            continue
        there.append(library)
        if version not in versions:
            versions.append(version)
    return there, versions, absent
