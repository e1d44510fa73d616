"""Opening, closing and keeping: raywise/_handle.py."""

from __future__ import annotations

import copy
import gc
import pickle
import weakref
from typing import Any, Callable

import numpy as np
import pytest
from samples import bits, sphere

import raywise
from raywise._library import lib

VERTICES, TRIANGLES = sphere()
CUBE = "\n".join(
    ["v 0 0 0", "v 1 0 0", "v 1 1 0", "v 0 1 0", "v 0 0 1", "v 1 0 1", "v 1 1 1", "v 0 1 1"]
    + ["f 4 3 2 1", "f 5 6 7 8", "f 1 2 6 5", "f 2 3 7 6", "f 3 4 8 7", "f 4 1 5 8", ""]
)


def make_scene(folder: Any) -> raywise.Scene:
    return raywise.Scene(VERTICES, TRIANGLES)


def make_view(folder: Any) -> raywise.View:
    return make_scene(folder).view(origin=[0, 0, 5])


def make_mesh(folder: Any) -> raywise.Mesh:
    path = folder / "cube.obj"
    path.write_text(CUBE)
    return raywise.Mesh(path)


def make_profile(folder: Any) -> raywise.Profile:
    return raywise.profile()


every_kind = pytest.mark.parametrize("make", [make_scene, make_view, make_mesh, make_profile])


@every_kind
def test_closing_twice_is_harmless(make: Callable[[Any], Any], tmp_path: Any) -> None:
    handle = make(tmp_path)
    assert not handle.closed
    handle.close()
    handle.close()
    assert handle.closed
    assert "closed" in repr(handle)


@every_kind
def test_leaving_with_closes(make: Callable[[Any], Any], tmp_path: Any) -> None:
    with make(tmp_path) as handle:
        assert not handle.closed
    assert handle.closed
    with pytest.raises(raywise.ClosedError), handle:
        pass


@every_kind
def test_a_closed_handle_says_so(make: Callable[[Any], Any], tmp_path: Any) -> None:
    handle = make(tmp_path)
    handle.close()
    name = type(handle).__name__
    uses = {
        raywise.Scene: ["bounds", "statistics", "structure", "candidates", "grid_statistics"],
        raywise.View: ["candidates"],
        raywise.Mesh: ["vertices", "triangles", "face_of_triangle", "face_count"],
        raywise.Profile: ["source", "status", "path", "spread", "json"],
    }[type(handle)]
    for use in uses:
        with pytest.raises(raywise.ClosedError, match=f"this {name} is closed"):
            getattr(handle, use)


def test_every_method_of_a_closed_scene_says_so() -> None:
    scene = make_scene(None)
    scene.close()
    for use in (
        lambda: scene.intersect([0, 0, 0], [0, 0, 1]),
        lambda: scene.occluded([[0, 0, 0]], [0, 0, 1]),
        lambda: scene.intersect_all([0, 0, 0], [0, 0, 1]),
        lambda: scene.explain(),
        lambda: scene.add_triangles(VERTICES, TRIANGLES),
        lambda: scene.commit(),
        lambda: scene.set_structure(None),
        lambda: scene.set_expected_rays(1),
        lambda: scene.set_memory_limit(0),
        lambda: scene.set_effort(),
        lambda: scene.view(origin=[0, 0, 1]),
        lambda: scene.refit(VERTICES),
    ):
        with pytest.raises(raywise.ClosedError):
            use()


def test_closed_things_cannot_be_handed_on(tmp_path: Any) -> None:
    mesh, profile = make_mesh(tmp_path), make_profile(tmp_path)
    mesh.close()
    profile.close()
    with pytest.raises(raywise.ClosedError, match="Mesh"):
        raywise.Scene(mesh)
    with pytest.raises(raywise.ClosedError, match="Mesh"):
        raywise.intersect_once(mesh, [0, 0, 0], [0, 0, 1])
    with pytest.raises(raywise.ClosedError, match="Profile"):
        raywise.Scene(VERTICES, TRIANGLES, profile=profile)


@every_kind
def test_a_handle_cannot_be_pickled_or_copied(make: Callable[[Any], Any], tmp_path: Any) -> None:
    handle = make(tmp_path)
    for attempt in (pickle.dumps, copy.copy, copy.deepcopy):
        with pytest.raises(TypeError, match="cannot be pickled or copied"):
            attempt(handle)


@every_kind
def test_each_reference_is_given_back_once(
    make: Callable[[Any], Any], tmp_path: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    released = []
    for kind in ("scene", "mesh", "profile"):
        function = getattr(lib, f"rw_{kind}_release")
        monkeypatch.setattr(
            lib, f"rw_{kind}_release", lambda a, f=function, k=kind: (released.append(k), f(a))[1], raising=False
        )
    handle = make(tmp_path)
    kind = type(handle).__name__.lower()
    kinds = ["scene", "scene"] if kind == "view" else [kind]  # a view is a scene, and holds the one that it is of
    handle.close()
    handle.close()
    del handle
    gc.collect()
    assert [each for each in released if each in kinds] == kinds


def test_a_forgotten_scene_is_released() -> None:
    scene = make_scene(None)
    reference = weakref.ref(scene._use())
    del scene
    gc.collect()
    assert reference() is None


def test_shared_arrays_live_as_long_as_scene_and_view() -> None:
    vertices = VERTICES.copy()
    triangles = TRIANGLES.copy()
    alive = weakref.ref(vertices)
    expected = raywise.Scene(VERTICES, TRIANGLES).intersect([0.1, 0.2, 3], [0, 0, -1])
    scene = raywise.Scene(vertices, triangles, copy=False)
    view = scene.view(origin=[0.1, 0.2, 3])
    del vertices, triangles
    gc.collect()
    assert alive() is not None
    scene.close()
    del scene
    gc.collect()
    assert alive() is not None
    assert bits(view.intersect([0.1, 0.2, 3], [0, 0, -1]).t) == bits(expected.t)
    view.close()
    gc.collect()
    assert alive() is None


def test_copied_arrays_are_not_kept() -> None:
    vertices = VERTICES.copy()
    alive = weakref.ref(vertices)
    scene = raywise.Scene(vertices, TRIANGLES)
    before = scene.intersect([0.1, 0.2, 3], [0, 0, -1]).t
    vertices[:] = 0
    assert bits(scene.intersect([0.1, 0.2, 3], [0, 0, -1]).t) == bits(before)
    del vertices
    gc.collect()
    assert alive() is None


def test_a_shared_mesh_lives_as_long_as_the_scene(tmp_path: Any) -> None:
    mesh = make_mesh(tmp_path)
    scene = raywise.Scene(mesh, copy=False)
    mesh.close()
    del mesh
    gc.collect()
    assert scene.intersect([0.3, 0.4, 5], [0, 0, -1]).t == 4.0


def test_arrays_of_a_mesh_outlive_it(tmp_path: Any) -> None:
    mesh = make_mesh(tmp_path)
    vertices, triangles = mesh.vertices, mesh.triangles
    mesh.close()
    del mesh
    gc.collect()
    assert vertices.shape == (8, 3) and np.asarray(vertices).max() == 1
    assert triangles.shape == (12, 3) and triangles.max() == 7
