"""Why this structure, and what it has cost."""

from __future__ import annotations

import dataclasses
import math

import pytest
from samples import rays, soup, sphere

import raywise


def test_the_table_names_every_structure(structure: str) -> None:
    scene = raywise.Scene(*sphere(), structure=structure, expected_rays=1000)
    explanation = scene.explain()
    for name in raywise.structures():
        assert name in str(explanation)
    assert repr(explanation) == str(explanation) == explanation.text
    assert isinstance(explanation.json, dict)


def test_an_explanation_is_a_snapshot_that_outlives_the_scene() -> None:
    with raywise.Scene(*sphere()) as scene:
        explanation = scene.explain()
    assert str(explanation) and explanation.json


def test_there_is_one_candidate_per_structure(structure: str) -> None:
    scene = raywise.Scene(*sphere(), structure=structure, expected_rays=1000)
    assert tuple(candidate.structure for candidate in scene.candidates) == raywise.structures()
    (chosen,) = [candidate for candidate in scene.candidates if candidate.chosen]
    assert chosen.structure == structure == scene.structure
    assert chosen.forced and math.isnan(chosen.break_even_rays)


def test_without_force_something_is_chosen() -> None:
    scene = raywise.Scene(*sphere(), expected_rays=1e6)
    (chosen,) = [candidate for candidate in scene.candidates if candidate.chosen]
    assert not chosen.forced and chosen.applicable and not chosen.over_limit
    assert chosen.structure == scene.structure


def test_statistics_count_what_happened() -> None:
    scene = raywise.Scene(*soup(5, 300))
    origins, directions = rays(1, 100)
    origins[3] = math.nan
    before = scene.statistics
    assert before.rays == 0 and before.triangle_count == 300 and before.geometry_count == 1
    assert scene.intersect(origins, directions).invalid_rays == 1
    scene.occluded(origins[:50], directions[:50])
    after = scene.statistics
    assert after.rays == 150 and after.invalid_rays == 2
    assert after.structure == scene.structure and after.build_ns >= 0 and after.decide_ns >= 0
    assert dataclasses.asdict(after)


def test_a_scene_introduces_itself() -> None:
    scene = raywise.Scene()
    assert "not committed" in repr(scene)
    scene.add_triangles(*sphere())
    scene.commit()
    assert f"{len(sphere()[1])} triangles in 1 mesh" in repr(scene) and scene.structure in repr(scene)


def test_only_a_grid_has_grid_statistics() -> None:
    grid = raywise.Scene(*sphere(), structure="uniform_grid").grid_statistics
    assert len(grid.resolution) == 3 and math.prod(grid.resolution) == grid.cells
    assert 0 <= grid.empty_cells <= grid.cells
    assert grid.sparseness == pytest.approx(grid.empty_cells / grid.cells)
    assert grid.mean == pytest.approx(grid.references / grid.cells)
    assert grid.standard_deviation == pytest.approx(math.sqrt(grid.variance))
    with pytest.raises(raywise.WrongStructure):
        raywise.Scene(*sphere(), structure="bvh").grid_statistics  # noqa: B018


def test_bounds_are_those_of_the_triangles() -> None:
    vertices, triangles = sphere()
    bounds = raywise.Scene(vertices, triangles).bounds
    assert bounds.lower.tolist() == vertices.min(axis=0).tolist()
    assert bounds.upper.tolist() == vertices.max(axis=0).tolist()
