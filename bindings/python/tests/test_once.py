"""One-shot calls."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from samples import bits, rays, same_bits, soup, sphere

import raywise

MESH = soup(5, 300)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("count", [1, 10, 1000])
def test_one_shot_answers_as_a_scene(dtype: Any, count: int) -> None:
    scene = raywise.Scene(*MESH)
    batch = rays(3, count, dtype)
    same_bits(raywise.intersect_once(MESH, *batch), scene.intersect(*batch))
    np.testing.assert_array_equal(raywise.occluded_once(MESH, *batch), scene.occluded(*batch))


def test_every_structure_can_be_forced(structure: str) -> None:
    batch = rays(3, 200)
    expected = raywise.Scene(*MESH).intersect(*batch)
    same_bits(raywise.intersect_once(MESH, *batch, structure=structure, kind="random", threads=2), expected)
    np.testing.assert_array_equal(raywise.occluded_once(MESH, *batch, structure=structure), expected.hit)


def test_several_meshes_are_told_apart() -> None:
    vertices, triangles = sphere()
    hits = raywise.intersect_once(
        [(vertices + [0, 0, 5], triangles), (vertices[triangles].reshape(-1, 3), None)],
        [[0.1, 0.2, 9], [0.1, 0.2, -9]],
        [[0, 0, -1], [0, 0, 1]],
    )
    assert hits.geometry.tolist() == [0, 1]


def test_one_ray_gives_scalars() -> None:
    hit = raywise.intersect_once(sphere(), [0.1, 0.2, 9], [0, 0, -1])
    expected = raywise.Scene(*sphere()).intersect([0.1, 0.2, 9], [0, 0, -1])
    for name, value in expected.arrays.items():
        assert np.shape(hit.arrays[name]) == np.shape(value)
        assert bits(hit.arrays[name]) == bits(value)
    assert raywise.occluded_once(sphere(), [0.1, 0.2, 9], [0, 0, -1])
    assert not raywise.occluded_once(sphere(), [0.1, 0.2, 9], [0, 0, -1], tmax=1.0)


def test_no_meshes_are_no_hits() -> None:
    assert not raywise.intersect_once([], *rays(1, 5)).hit.any()


def test_outputs_can_be_the_callers() -> None:
    t, flags = np.zeros(50, np.float32), np.zeros(50, np.uint8)
    hits = raywise.intersect_once(MESH, *rays(1, 50), out={"t": t})
    assert hits.t is t
    assert raywise.occluded_once(MESH, *rays(1, 50), out=flags) is flags
    np.testing.assert_array_equal(np.isfinite(t), flags)


def test_invalid_triangles_can_be_skipped() -> None:
    vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [np.nan, 0, 0]]
    mesh = (vertices, [[0, 1, 3], [0, 1, 2]])
    with pytest.raises(raywise.NotFinite, match="3"):
        raywise.intersect_once(mesh, [0.2, 0.2, 1], [0, 0, -1])
    assert raywise.intersect_once(mesh, [0.2, 0.2, 1], [0, 0, -1], skip_invalid=True).primitive == 1


@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        ({"meshes": 5}, TypeError, "meshes"),
        ({"meshes": [5]}, TypeError, "meshes: element 0"),
        ({"meshes": ([[0, 0, 0]],)}, TypeError, "meshes"),
        ({"structure": "no_such_thing"}, raywise.UnknownStructure, "no_such_thing"),
        ({"kind": "purple"}, ValueError, "kind"),
        ({"memory_limit": -5}, ValueError, "memory_limit"),
        ({"origins": np.zeros((2, 3)), "directions": np.zeros((3, 3))}, ValueError, "origins"),
    ],
)
def test_an_argument_that_makes_no_sense_is_named(arguments: Any, error: "type[Exception]", words: str) -> None:
    given = {"meshes": MESH, "origins": [0, 0, 0], "directions": [0, 0, 1], **arguments}
    for function in (raywise.intersect_once, raywise.occluded_once):
        with pytest.raises(error, match=words):
            function(**given)
