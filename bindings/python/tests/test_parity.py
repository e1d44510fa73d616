"""The cases that every language has to answer with the same bits: tests/parity/cases.json."""

from __future__ import annotations

import json
import math
import struct
from typing import Any, Dict, List, Tuple

import numpy as np
import pytest
from conftest import ROOT

import raywise

CASES = ROOT / "tests" / "parity" / "cases.json"
Answer = Tuple[str, ...]  # one hit


@pytest.fixture(scope="module")
def cases() -> Dict[str, Any]:
    """A missing file is a failure: the parity of the languages would go untested."""
    loaded: Dict[str, Any] = json.loads(CASES.read_text(encoding="utf-8"))
    assert loaded["meshes"] and loaded["cases"]
    return loaded


def hexadecimal(value: Any) -> str:
    return "0x" + struct.pack(">d", value).hex()


def number(value: Any) -> float:
    return math.inf if value == "inf" else float(value)


def expected_answers(hits: List[Dict[str, Any]]) -> List[Answer]:
    answers = []
    for hit in hits:
        values = [hit["t"], hit["u"], hit["v"], *hit["normal"]]
        answers.append((*(f"0x{int(value, 16):016x}" for value in values), str(hit["geometry"]), str(hit["primitive"])))
    return answers


def given_answers(hits: raywise.Hits) -> List[Answer]:
    """One element for each hit of some Hits of shape (n,); misses are left out."""
    answers = []
    for i in np.flatnonzero(hits.hit):
        values = [hits.t[i], *hits.uv[i], *hits.normal[i]]
        answers.append((*(hexadecimal(value) for value in values), str(hits.geometry[i]), str(hits.primitive[i])))
    return answers


def only(hits: raywise.Hits, index: Any) -> raywise.Hits:
    """The answer at an index as Hits of shape (1,)."""
    return raywise.Hits({name: array[index][None] for name, array in hits.arrays.items()}, 0)


def rays_of(group: List[Dict[str, Any]]) -> Tuple[Any, ...]:
    origins = np.array([case["origin"] for case in group], np.float64).reshape(-1, 3)
    directions = np.array([case["direction"] for case in group], np.float64).reshape(-1, 3)
    tmin = np.array([number(case["tmin"]) for case in group])
    tmax = np.array([number(case["tmax"]) for case in group])
    return origins, directions, tmin, tmax


def skips_of(group: List[Dict[str, Any]]) -> Tuple[Any, ...]:
    """The skip lists of all cases as (offsets, geometry, primitive)."""
    ids = np.array([pair for case in group for pair in case["skip"]], np.uint32).reshape(-1, 2)
    return np.cumsum([0] + [len(case["skip"]) for case in group]), ids[:, 0], ids[:, 1]


def test_every_structure_gives_the_agreed_bits(structure: str, cases: Dict[str, Any]) -> None:
    asked = 0
    for mesh in cases["meshes"]:
        vertices = np.array(mesh["vertices"], np.float64).reshape(-1, 3)
        triangles = np.array(mesh["triangles"], np.uint32).reshape(-1, 3)
        group = [case for case in cases["cases"] if case["mesh"] == mesh["name"]]
        expected = [expected_answers(case["hits"]) for case in group]
        batch, skip = rays_of(group), skips_of(group)
        with raywise.Scene(vertices, triangles, structure=structure) as scene:
            hits, every = scene.intersect(*batch, skip=skip), scene.intersect_all(*batch, skip=skip)
            once = raywise.intersect_once((vertices, triangles), *batch, skip=skip, structure=structure)
            np.testing.assert_array_equal(
                scene.occluded(*batch, skip=skip), [len(all_hits) > 0 for all_hits in expected]
            )
            for i, case in enumerate(group):
                where = (mesh["name"], i)
                ray = tuple(part[i] for part in batch)
                # Without a list the plain calls for one ray are used.
                own = tuple(np.array(case["skip"], np.int64).T) if case["skip"] else None
                assert given_answers(only(hits, i)) == expected[i][:1], where
                assert given_answers(only(once, i)) == expected[i][:1], where
                assert given_answers(every[i]) == expected[i], where
                assert given_answers(only(scene.intersect(*ray, skip=own), ())) == expected[i][:1], where
                assert given_answers(scene.intersect_all(*ray, skip=own)[0]) == expected[i], where
                assert bool(scene.occluded(*ray, skip=own)) == bool(expected[i]), where
        asked += len(group)
    assert asked == len(cases["cases"])


def test_the_cases_have_skip_lists_and_several_hits(cases: Dict[str, Any]) -> None:
    assert sum(len(case["skip"]) > 1 for case in cases["cases"]) > 50
    assert sum(len(case["hits"]) > 1 for case in cases["cases"]) > 50
