"""Views: faster for the rays they are made for, and the same bits for all."""

from __future__ import annotations

import math
from typing import Any, Dict

import numpy as np
import pytest
from samples import bits, rays, same_bits, soup, sphere

import raywise

EYE = np.array([0.3, -0.2, 4.0])
VIEWS: Dict[str, Dict[str, Any]] = {
    "all around": {"origin": EYE},
    "camera": {"origin": EYE, "direction": -EYE, "half_angle": 0.5},
    "camera, default angle": {"origin": EYE.astype(np.float32), "direction": (-EYE).tolist()},
    "from inside": {"origin": [0.1, 0, 0]},
    "point light": {"origin": EYE, "kind": "shadow", "expected_rays": 1e5},
    "sun": {"direction": [1, 2, -3], "kind": "shadow", "expected_rays": 10},
}


@pytest.mark.parametrize("name", list(VIEWS))
def test_a_view_answers_as_its_scene(structure: str, name: str) -> None:
    scene = raywise.Scene(*soup(5, 300))
    view = scene.view(structure=structure, **VIEWS[name])
    origins, directions = rays(6, 400)
    towards = directions + origins
    sun = np.array([1.0, 2, -3])
    for batch in (
        (origins, directions),
        (EYE, towards - EYE),
        (towards, EYE - towards),
        (origins, sun),
        (origins, -2 * sun),
        (EYE.astype(np.float32), (towards - EYE).astype(np.float32)),
    ):
        expected = scene.intersect(*batch)
        same_bits(view.intersect(*batch), expected)
        same_bits(view.intersect_all(*batch), scene.intersect_all(*batch))
        np.testing.assert_array_equal(view.occluded(*batch), expected.hit)
    hit = view.intersect(EYE, towards[0] - EYE)
    assert bits(hit.t) == bits(scene.intersect(EYE, towards[0] - EYE).t)
    assert bool(view.occluded(EYE, towards[0] - EYE)) == bool(hit.hit)
    same_bits(view.intersect_all(EYE, towards[0] - EYE), scene.intersect_all(EYE, towards[0] - EYE))


def test_a_view_explains_itself() -> None:
    view = raywise.Scene(*sphere()).view(origin=EYE, structure="projected_bvh")
    assert {candidate.structure for candidate in view.candidates} == set(raywise.structures())
    (chosen,) = [candidate for candidate in view.candidates if candidate.chosen]
    assert chosen.structure == "projected_bvh" and chosen.forced
    assert "projected_bvh" in str(view.explain())
    assert isinstance(view.explain().json, dict)


def test_a_view_is_a_scene_with_facts_of_its_own() -> None:
    scene = raywise.Scene(*sphere(), structure="bvh")
    view = scene.view(origin=EYE, structure="projected_bvh")
    assert view.structure == "projected_bvh" and scene.structure == "bvh"
    assert view.statistics.triangle_count == scene.statistics.triangle_count
    np.testing.assert_array_equal(view.bounds.lower, scene.bounds.lower)
    view.intersect(*rays(6, 400))
    assert (view.statistics.rays, scene.statistics.rays) == (400, 0)
    with pytest.raises(raywise.WrongStructure, match="projected_bvh"):
        view.grid_statistics  # noqa: B018


def test_a_view_of_a_view_is_one_of_its_scene() -> None:
    scene = raywise.Scene(*soup(5, 300))
    view = raywise.View(scene.view(origin=EYE, structure="projected_bvh"), direction=[1, 2, -3], kind="shadow")
    scene.close()
    origins, _ = rays(6, 400)
    expected = raywise.Scene(*soup(5, 300)).intersect(origins, np.array([1.0, 2, -3]))
    same_bits(view.intersect(origins, np.array([1.0, 2, -3])), expected)


def test_a_view_outlives_its_scene() -> None:
    scene = raywise.Scene(*sphere())
    expected = scene.intersect(EYE, -EYE)
    view = scene.view(origin=EYE)
    scene.close()
    assert bits(view.intersect(EYE, -EYE).t) == bits(expected.t)


@pytest.mark.parametrize(
    ("options", "error", "words"),
    [
        ({}, TypeError, "origin or direction"),
        ({"origin": [0, 0]}, ValueError, r"origin.*\(2,\)"),
        ({"origin": [0, 0, math.nan]}, raywise.NotFinite, "origin"),
        ({"direction": [0, math.inf, 0]}, raywise.NotFinite, "direction"),
        ({"direction": [0, 0, 0]}, ValueError, "direction"),
        ({"direction": "up"}, TypeError, "direction"),
        ({"origin": [0, 0, 5], "direction": [0, 0, -1], "half_angle": 2.0}, ValueError, "half_angle"),
        ({"origin": [0, 0, 5], "direction": [0, 0, -1], "half_angle": -1.0}, ValueError, "half_angle"),
        ({"origin": [0, 0, 5], "expected_rays": 0}, raywise.RayCount, "count"),
        ({"origin": [0, 0, 5], "kind": "diffuse"}, ValueError, "kind"),
        ({"origin": [0, 0, 5], "structure": "no_such_thing"}, raywise.UnknownStructure, "no_such_thing"),
    ],
)
def test_an_option_that_makes_no_sense_is_named(options: Any, error: "type[Exception]", words: str) -> None:
    with pytest.raises(error, match=words):
        raywise.Scene(*sphere()).view(**options)


def test_a_view_can_be_cancelled_and_what_its_callback_raises_comes_out() -> None:
    scene = raywise.Scene(*sphere(64, 128))
    told = []
    scene.view(origin=EYE, structure="projected_bvh", progress=lambda fraction, stage: told.append(stage))
    assert told
    with pytest.raises(raywise.Cancelled):
        scene.view(origin=EYE, structure="projected_bvh", progress=lambda fraction, stage: True)

    def progress(fraction: float, stage: str) -> None:
        raise LookupError("in the callback")

    with pytest.raises(LookupError, match="in the callback"):
        scene.view(origin=EYE, structure="projected_bvh", progress=progress)
