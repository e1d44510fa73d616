"""Errors: the exception a Python user expects, with a message that names the argument and the element."""

from __future__ import annotations

import pathlib
import pickle
from typing import Any, Dict

import numpy as np
import pytest
from samples import sphere

import raywise

VERTICES, TRIANGLES = sphere()
RAYS = np.zeros((5, 3)), np.ones((5, 3))


@pytest.fixture(scope="module")
def scene() -> raywise.Scene:
    return raywise.Scene(VERTICES, TRIANGLES)


# --- arguments of the rays -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("question", ["intersect", "occluded", "intersect_all"])
@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"origins": np.zeros((5, 2))}, ["origins", "(5, 2)"]),
        ({"directions": np.zeros((3, 5))}, ["directions", "(3, 5)"]),
        ({"origins": 1.0}, ["origins", "()"]),
        ({"origins": np.zeros((4, 3))}, ["origins", "(4, 3)", "directions", "(5, 3)"]),
        ({"tmin": np.zeros(4)}, ["tmin", "(4,)", "(5, 3)"]),
        ({"tmax": np.zeros((5, 1))[:, :, None]}, ["tmax", "(5, 1, 1)"]),
        ({"origins": [[0, 0, 0], [1, 2]]}, ["origins"]),
    ],
)
def test_a_wrong_shape_names_the_argument_and_its_shape(
    scene: raywise.Scene, question: str, arguments: Dict[str, Any], words: "list[str]"
) -> None:
    given = {"origins": RAYS[0], "directions": RAYS[1], **arguments}
    if "tmax" in arguments:
        given["origins"], given["directions"] = np.zeros((2, 2, 2, 3)), np.ones(3)
    with pytest.raises(ValueError) as caught:
        getattr(scene, question)(**given)
    for word in words:
        assert word in str(caught.value)


@pytest.mark.parametrize("values", [np.zeros((5, 3), complex), np.zeros((5, 3), bool), [["a", "b", "c"]], object()])
def test_what_is_no_real_number_is_a_type_error(scene: raywise.Scene, values: Any) -> None:
    with pytest.raises(TypeError, match="directions"):
        scene.intersect(RAYS[0], values)


@pytest.mark.parametrize("threads", [-1, 1 << 32])
def test_an_absurd_thread_count_is_a_value_error(scene: raywise.Scene, threads: int) -> None:
    for origins in (RAYS[0], RAYS[0][0]):
        with pytest.raises(ValueError, match="threads"):
            scene.intersect(origins, RAYS[1][0], threads=threads)


def test_threads_have_to_be_a_whole_number(scene: raywise.Scene) -> None:
    with pytest.raises(TypeError, match="threads"):
        scene.intersect(*RAYS, threads=1.5)


def test_an_unknown_answer_is_named(scene: raywise.Scene) -> None:
    with pytest.raises(ValueError, match="'distance'.*primitive"):
        scene.intersect(*RAYS, want=("t", "distance"))


def test_an_impossible_output_type_is_named(scene: raywise.Scene) -> None:
    with pytest.raises(TypeError, match="dtype.*int32"):
        scene.intersect(*RAYS, dtype=np.int32)


def test_an_answer_that_was_not_asked_for_says_so(scene: raywise.Scene) -> None:
    hits = scene.intersect(*RAYS, want=["t"])
    with pytest.raises(AttributeError, match="normal was not asked for"):
        hits.normal  # noqa: B018
    with pytest.raises(AttributeError, match="nonsense"):
        hits.nonsense  # type: ignore[attr-defined]  # noqa: B018


# --- the caller's outputs ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("out", "error", "words"),
    [
        ({"distance": np.zeros(5)}, ValueError, "distance"),
        ({"t": np.zeros(4)}, ValueError, r"out\['t'\].*\(5,\).*\(4,\)"),
        ({"uv": np.zeros((5, 3))}, ValueError, r"out\['uv'\].*\(5, 2\).*\(5, 3\)"),
        ({"t": np.zeros(5, np.int64)}, TypeError, r"out\['t'\].*float32 or float64.*int64"),
        ({"t": np.zeros(5, ">f8")}, TypeError, r"out\['t'\]"),
        ({"primitive": np.zeros(5, np.int32)}, TypeError, r"out\['primitive'\].*uint32 or uint64"),
        ({"t": [0.0] * 5}, TypeError, r"out\['t'\].*list"),
        ({"t": np.broadcast_to(np.zeros(1), (5,))}, ValueError, "read-only"),
    ],
)
def test_an_output_that_does_not_fit_is_named(
    scene: raywise.Scene, out: Dict[str, Any], error: "type[Exception]", words: str
) -> None:
    with pytest.raises(error, match=words):
        scene.intersect(*RAYS, out=out)


def test_outputs_may_not_overlap_the_rays(scene: raywise.Scene) -> None:
    origins = np.zeros((5, 3))
    with pytest.raises(raywise.SharedMemory, match=r"out\['normal'\] overlaps origins"):
        scene.intersect(origins, RAYS[1], out={"normal": origins})


def test_outputs_may_not_overlap_each_other(scene: raywise.Scene) -> None:
    numbers = np.zeros(20)
    with pytest.raises(raywise.SharedMemory, match="overlaps"):
        scene.intersect(*RAYS, out={"t": numbers[:5], "uv": numbers[4:14].reshape(5, 2)})


def test_outputs_whose_elements_overlap_are_refused(scene: raywise.Scene) -> None:
    piled = np.lib.stride_tricks.as_strided(np.zeros(1), (5,), (0,), writeable=True)
    with pytest.raises(ValueError):
        scene.intersect(*RAYS, out={"t": piled})


def test_an_image_that_one_stride_cannot_walk_is_refused_as_an_output(scene: raywise.Scene) -> None:
    with pytest.raises(ValueError, match="leading axes"):
        scene.intersect(np.zeros((4, 5, 3)), np.ones(3), out={"t": np.zeros((5, 4)).T})


# --- meshes --------------------------------------------------------------------------------------------------------


def test_an_index_out_of_range_names_triangle_index_and_vertex_count() -> None:
    triangles = TRIANGLES.copy()
    triangles[17, 1] = 9000
    with pytest.raises(raywise.IndexOutOfRange) as caught:
        raywise.Scene(VERTICES, triangles)
    for word in ("triangle 17", "9000", str(len(VERTICES))):
        assert word in str(caught.value)
    assert isinstance(caught.value, (IndexError, ValueError))


@pytest.mark.parametrize("dtype", [np.int8, np.int16, np.int32, np.int64])
def test_a_negative_index_is_called_negative(dtype: Any) -> None:
    triangles = np.zeros((4, 3), dtype)
    triangles[2, 1] = -5
    with pytest.raises(raywise.IndexOutOfRange, match="triangle 2: index -5 is negative"):
        raywise.Scene(VERTICES, triangles)
    with pytest.raises(raywise.IndexOutOfRange, match="triangle 2: index -5 is negative"):
        raywise.intersect_once((VERTICES, triangles), *RAYS)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_a_coordinate_that_is_not_finite_names_the_vertex(value: float) -> None:
    vertices = VERTICES.copy()
    vertices[123, 2] = value
    with pytest.raises(raywise.NotFinite, match="123"):
        raywise.Scene(vertices, TRIANGLES)


def test_a_coordinate_beyond_float32_names_the_vertex() -> None:
    vertices = VERTICES.copy()
    vertices[45, 0] = 1e39
    with pytest.raises(raywise.CoordinateRange, match="45"):
        raywise.Scene(vertices, TRIANGLES)


def test_invalid_triangles_can_be_skipped_without_shifting_ids() -> None:
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [np.nan, 0, 0]])
    triangles = [[0, 1, 3], [0, 1, 77], [0, 1, -1], [0, 1, 2]]
    scene = raywise.Scene(vertices, triangles, skip_invalid=True)
    assert scene.intersect([0.2, 0.2, 1], [0, 0, -1]).primitive == 3
    assert scene.statistics.invalid_triangles == 3


@pytest.mark.parametrize(
    ("vertices", "triangles", "error", "words"),
    [
        (np.zeros((4, 2)), [[0, 1, 2]], ValueError, r"vertices.*\(4, 2\)"),
        (np.zeros(9), [[0, 1, 2]], ValueError, r"vertices.*\(9,\)"),
        (np.zeros((4, 3)), [0, 1, 2], ValueError, r"triangles.*\(3,\)"),
        (np.zeros((4, 3)), [[0, 1, 2, 3]], ValueError, r"triangles.*\(1, 4\)"),
        (np.zeros((4, 3)), [[0.0, 1.0, 2.0]], TypeError, "triangles.*float64"),
        (np.zeros((4, 3)), [[True, False, True]], TypeError, "triangles.*bool"),
        (np.zeros((4, 3), complex), [[0, 1, 2]], TypeError, "vertices.*complex"),
        (np.zeros((4, 3)), None, ValueError, "vertices.*4"),
    ],
)
def test_arrays_that_are_no_mesh_are_named(vertices: Any, triangles: Any, error: "type[Exception]", words: str) -> None:
    with pytest.raises(error, match=words):
        raywise.Scene(vertices, triangles)


# --- options -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("options", "error", "words"),
    [
        ({"structure": "no_such_thing"}, raywise.UnknownStructure, "no_such_thing"),
        ({"structure": "bvh\0"}, ValueError, "structure"),
        ({"structure": 7}, TypeError, "structure"),
        ({"expected_rays": 0}, raywise.RayCount, "count"),
        ({"expected_rays": -1}, raywise.RayCount, "expected_rays.*-1"),
        ({"expected_rays": 10**16}, raywise.RayCount, "count"),
        ({"expected_rays": 2**70}, raywise.RayCount, "expected_rays"),
        ({"expected_rays": 1.5}, TypeError, "expected_rays"),
        ({"kind": "purple"}, ValueError, "kind.*'purple'.*'camera'"),
        ({"memory_limit": -1}, ValueError, "memory_limit"),
        ({"effort": "heroic"}, ValueError, "effort.*'heroic'.*'probe'"),
        ({"rule": "golden"}, ValueError, "rule.*'golden'.*'hapala'"),
        ({"time_limit": -1.0}, ValueError, "time_limit"),
        ({"time_limit": "long"}, TypeError, "time_limit"),
        ({"sample": [1, 2]}, TypeError, "sample"),
        ({"sample": (np.zeros((2, 3)), np.zeros((3, 3)))}, ValueError, "origins"),
    ],
)
def test_an_option_that_makes_no_sense_is_named(options: Dict[str, Any], error: "type[Exception]", words: str) -> None:
    with pytest.raises(error, match=words):
        raywise.Scene(VERTICES, TRIANGLES, **options)


def test_options_of_the_commit_need_something_to_commit() -> None:
    with pytest.raises(TypeError, match="progress"):
        raywise.Scene(progress=print)


def test_too_little_memory_is_a_memory_error() -> None:
    with pytest.raises(raywise.MemoryLimit) as caught:
        raywise.Scene(VERTICES, TRIANGLES, structure="bvh", memory_limit=1)
    assert isinstance(caught.value, MemoryError)


# --- the order of things -------------------------------------------------------------------------------------------


def test_a_scene_has_to_be_committed_before_it_is_asked() -> None:
    scene = raywise.Scene()
    scene.add_triangles(VERTICES, TRIANGLES)
    for question in (
        lambda: scene.intersect(*RAYS),
        lambda: scene.occluded(*RAYS),
        lambda: scene.intersect_all(*RAYS),
        lambda: scene.explain(),
        lambda: scene.candidates,
        lambda: scene.bounds,
        lambda: scene.statistics,
        lambda: scene.grid_statistics,
        lambda: scene.structure,
        lambda: scene.view(origin=[0, 0, 5]),
    ):
        with pytest.raises(raywise.NotCommitted):
            question()
    assert not scene.committed


def test_a_committed_scene_cannot_be_changed(scene: raywise.Scene) -> None:
    for change in (
        lambda: scene.add_triangles(VERTICES, TRIANGLES),
        lambda: scene.commit(),
        lambda: scene.set_structure("bvh"),
        lambda: scene.set_expected_rays(5),
        lambda: scene.set_memory_limit(5),
        lambda: scene.set_effort("probe"),
    ):
        with pytest.raises(raywise.AlreadyCommitted):
            change()
    assert scene.committed


def test_a_failed_mesh_leaves_the_scene_as_it_was() -> None:
    scene = raywise.Scene()
    with pytest.raises(raywise.IndexOutOfRange):
        scene.add_triangles(VERTICES, [[0, 1, 10**6]])
    assert scene.add_triangles(VERTICES, TRIANGLES) == 0
    scene.commit()
    assert scene.statistics.geometry_count == 1


# --- the exceptions themselves -------------------------------------------------------------------------------------


def test_the_exceptions_are_those_python_users_expect(tmp_path: pathlib.Path) -> None:
    with pytest.raises(FileNotFoundError, match="missing.obj"):
        raywise.Mesh(tmp_path / "missing.obj")
    with pytest.raises(raywise.RaywiseError) as caught:
        raywise.Scene(structure="x")
    assert isinstance(caught.value, ValueError)
    assert str(caught.value) == caught.value.message
    assert caught.value.status == 9


def test_exceptions_can_be_sent_to_other_processes() -> None:
    with pytest.raises(raywise.UnknownStructure) as caught:
        raywise.Scene(structure="x")
    again = pickle.loads(pickle.dumps(caught.value))
    assert type(again) is raywise.UnknownStructure
    assert (again.status, again.message) == (caught.value.status, caught.value.message)
