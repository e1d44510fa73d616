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
Answer = Tuple[str, ...]


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


def expected_answer(hit: Any) -> Answer:
    if hit is None:
        return ("miss",)
    values = [hit["t"], hit["u"], hit["v"], *hit["normal"]]
    return (*(f"0x{int(value, 16):016x}" for value in values), str(hit["geometry"]), str(hit["primitive"]))


def given_answer(hits: raywise.Hits, index: Any) -> Answer:
    if not hits.hit[index]:
        return ("miss",)
    values = [hits.t[index], *hits.uv[index], *hits.normal[index]]
    return (*(hexadecimal(value) for value in values), str(hits.geometry[index]), str(hits.primitive[index]))


def rays_of(group: List[Dict[str, Any]]) -> Tuple[Any, ...]:
    origins = np.array([case["origin"] for case in group], np.float64).reshape(-1, 3)
    directions = np.array([case["direction"] for case in group], np.float64).reshape(-1, 3)
    tmin = np.array([number(case["tmin"]) for case in group])
    tmax = np.array([number(case["tmax"]) for case in group])
    return origins, directions, tmin, tmax


def test_every_structure_gives_the_agreed_bits(structure: str, cases: Dict[str, Any]) -> None:
    asked = 0
    for mesh in cases["meshes"]:
        vertices = np.array(mesh["vertices"], np.float64).reshape(-1, 3)
        triangles = np.array(mesh["triangles"], np.uint32).reshape(-1, 3)
        group = [case for case in cases["cases"] if case["mesh"] == mesh["name"]]
        expected = [expected_answer(case["hit"]) for case in group]
        batch = rays_of(group)
        with raywise.Scene(vertices, triangles, structure=structure) as scene:
            hits = scene.intersect(*batch)
            assert [given_answer(hits, i) for i in range(len(group))] == expected, mesh["name"]
            np.testing.assert_array_equal(scene.occluded(*batch), hits.hit)
            for i in range(len(group)):
                single = scene.intersect(*(part[i] for part in batch))
                assert given_answer(single, ()) == expected[i], (mesh["name"], i)
        once = raywise.intersect_once((vertices, triangles), *batch, structure=structure)
        assert [given_answer(once, i) for i in range(len(group))] == expected, mesh["name"]
        asked += len(group)
    assert asked == len(cases["cases"])
