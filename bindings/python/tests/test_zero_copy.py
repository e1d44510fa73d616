"""Arrays go to the C library by address and strides; what has to be converted is converted and nothing else."""

from __future__ import annotations

import tracemalloc
from typing import Any

import numpy as np
import pytest
from conftest import Recorder
from samples import layouts, rays, sphere

import raywise
from raywise import _declarations as c

VERTICES, TRIANGLES = sphere()
C_TYPES = {"float32": c.RW_FLOAT32, "float64": c.RW_FLOAT64, "uint32": c.RW_UINT32, "uint64": c.RW_UINT64}


def assert_in_place(described: Any, array: Any) -> None:
    """The struct points at the array itself, with its strides."""
    assert described.data == array.ctypes.data
    assert described.stride == array.strides[0]
    assert described.component_stride == (array.strides[1] if array.ndim == 2 else 0)
    assert described.type == C_TYPES[array.dtype.name]


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("layout", list(layouts(np.zeros((2, 3)))))
def test_rays_are_read_where_they_are(recorder: Recorder, layout: str, dtype: Any) -> None:
    scene = raywise.Scene(VERTICES, TRIANGLES)
    origins, directions = (layouts(array)[layout] for array in rays(1, 50, dtype))
    tmin, tmax = np.zeros(100, dtype)[::2], np.full(50, 9, dtype)[::-1]
    scene.intersect(origins, directions, tmin, tmax)
    given = recorder.arguments("rw_scene_intersect_batch")[1]
    assert given.count == 50
    assert_in_place(given.origin, origins)
    assert_in_place(given.direction, directions)
    assert_in_place(given.tmin, tmin)
    assert_in_place(given.tmax, tmax)


@pytest.mark.parametrize("name", ["occluded", "intersect_all"])
def test_the_other_questions_read_rays_in_place_too(recorder: Recorder, name: str) -> None:
    scene = raywise.Scene(VERTICES, TRIANGLES)
    origins, directions = rays(1, 50)
    getattr(scene, name)(origins, directions)
    given = recorder.arguments(f"rw_scene_{name}_batch")[1]
    assert_in_place(given.origin, origins)
    assert_in_place(given.direction, directions)


def test_mixed_types_are_each_read_in_place(recorder: Recorder) -> None:
    scene = raywise.Scene(VERTICES, TRIANGLES)
    origins, directions = rays(1, 50, np.float32)[0], rays(1, 50, np.float64)[1]
    hits = scene.intersect(origins, directions)
    given = recorder.arguments("rw_scene_intersect_batch")[1]
    assert_in_place(given.origin, origins)
    assert_in_place(given.direction, directions)
    assert hits.t.dtype == np.float64


def test_one_origin_for_all_is_one_origin(recorder: Recorder) -> None:
    scene = raywise.Scene(VERTICES, TRIANGLES)
    origin, directions = np.array([0.0, 0, 3]), rays(1, 50)[1]
    for given_origin in (origin, origin[None, :], np.broadcast_to(origin, (50, 3))):
        scene.intersect(given_origin, directions, tmax=np.float32(5))
        given = recorder.arguments("rw_scene_intersect_batch")[1]
        assert given.origin.data == origin.ctypes.data
        assert given.origin.stride == c.RW_REPEAT
        assert given.origin.component_stride == 8
        assert given.tmax.stride == c.RW_REPEAT
        assert given.tmin.data is None


def test_an_image_of_rays_is_read_in_place(recorder: Recorder) -> None:
    scene = raywise.Scene(VERTICES, TRIANGLES)
    directions = rays(1, 60)[1].reshape(6, 10, 3)
    hits = scene.intersect(np.zeros(3), directions)
    given = recorder.arguments("rw_scene_intersect_batch")[1]
    assert given.count == 60
    assert given.direction.data == directions.ctypes.data
    assert given.origin.stride == c.RW_REPEAT
    assert hits.t.shape == (6, 10) and hits.normal.shape == (6, 10, 3)


@pytest.mark.parametrize("shared", [False, True])
@pytest.mark.parametrize("layout", list(layouts(np.zeros((2, 3)))))
def test_meshes_are_read_where_they_are(recorder: Recorder, layout: str, shared: bool) -> None:
    vertices, triangles = layouts(VERTICES)[layout], layouts(TRIANGLES.astype(np.int64))[layout]
    raywise.Scene(vertices, triangles, copy=not shared)
    given = recorder.arguments("rw_scene_add_triangles")[1]
    assert_in_place(given.vertices, vertices)
    assert_in_place(given.indices, triangles.view(np.uint64))
    assert given.flags == (c.RW_TRIANGLES_SHARED if shared else 0)


def test_meshes_of_one_shot_calls_are_read_where_they_are(recorder: Recorder) -> None:
    raywise.intersect_once([(VERTICES, TRIANGLES), (VERTICES, None)][:1], *rays(1, 5))
    given = recorder.arguments("rw_once_intersect")[0][0]
    assert_in_place(given.vertices, VERTICES)
    assert_in_place(given.indices, TRIANGLES)


def test_a_mesh_file_is_handed_on_where_it_is(recorder: Recorder, tmp_path: Any) -> None:
    path = tmp_path / "triangle.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    mesh = raywise.Mesh(path)
    raywise.Scene(mesh, copy=False)
    given = recorder.arguments("rw_scene_add_triangles")[1]
    assert given.vertices.data == mesh.vertices.ctypes.data == mesh.vertices.ctypes.data
    assert given.flags & c.RW_TRIANGLES_SHARED


def test_outputs_are_written_where_the_caller_wants(recorder: Recorder) -> None:
    scene = raywise.Scene(VERTICES, TRIANGLES)
    origins, directions = rays(1, 50)
    expected = scene.intersect(origins, directions)
    record = np.zeros(50, np.dtype([("id", np.uint64), ("t", np.float32), ("normal", np.float64, (3,))]))
    uv = np.zeros((2, 50)).T[::-1]
    out = {"t": record["t"], "normal": record["normal"], "primitive": record["id"], "uv": uv}
    hits = scene.intersect(origins, directions, out=out)
    given = recorder.arguments("rw_scene_intersect_batch")[2]
    assert_in_place(given.t, record["t"])
    assert_in_place(given.uv, uv)
    assert given.geometry.data is None and given.instance.data is None
    assert hits.t is out["t"]
    np.testing.assert_array_equal(record["t"], expected.t.astype(np.float32))
    np.testing.assert_array_equal(record["normal"], expected.normal)
    np.testing.assert_array_equal(uv, expected.uv)
    np.testing.assert_array_equal(record["id"][expected.hit], expected.primitive[expected.hit])
    assert (record["id"][~expected.hit] == 2**64 - 1).all()
    np.testing.assert_array_equal(hits.hit, expected.hit)


def test_the_hits_of_an_earlier_call_can_be_filled_again() -> None:
    scene = raywise.Scene(VERTICES, TRIANGLES)
    first = scene.intersect(*rays(1, 50))
    second = scene.intersect(*rays(2, 50), out=first)
    assert second.t is first.t
    np.testing.assert_array_equal(first.t, scene.intersect(*rays(2, 50)).t)


@pytest.mark.parametrize("dtype", [np.bool_, np.uint8, np.uint32, np.uint64])
def test_occlusion_is_written_where_the_caller_wants(dtype: Any) -> None:
    scene = raywise.Scene(VERTICES, TRIANGLES)
    expected = scene.occluded(*rays(1, 50))
    out = np.zeros(100, dtype)[::-2]
    assert scene.occluded(*rays(1, 50), out=out) is out
    np.testing.assert_array_equal(out, expected)
    with pytest.raises(TypeError, match="out"):
        scene.occluded(*rays(1, 50), out=np.zeros(50))


def test_the_callers_arrays_are_not_written_to() -> None:
    origins, directions = rays(1, 50)
    kept = [array.copy() for array in (VERTICES, TRIANGLES, origins, directions)]
    scene = raywise.Scene(VERTICES, TRIANGLES, copy=False)
    scene.intersect(origins, directions)
    scene.intersect_all(origins, directions)
    scene.occluded(origins, directions)
    for array, before in zip((VERTICES, TRIANGLES, origins, directions), kept):
        np.testing.assert_array_equal(array, before)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_a_large_batch_allocates_its_outputs_only(dtype: Any) -> None:
    scene = raywise.Scene(VERTICES, TRIANGLES)
    count = 200_000
    wide = np.zeros((count, 8), dtype)
    wide[:, :3] = [0.1, 0.05, 3]  # away from the pole, where each ray has to tell dozens of triangles apart exactly
    wide[:, 7] = -1
    origins, directions = wide[:, 0:3], wide[:, 5:8]
    scene.intersect(origins[:10], directions[:10])
    tracemalloc.start()
    try:
        hits = scene.intersect(origins, directions, want=["primitive"])
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert hits.hit.all()
    assert hits.primitive.nbytes <= peak < hits.primitive.nbytes + 100_000


@pytest.mark.parametrize(
    ("given", "read_as"),
    [
        (np.float16, np.float32),
        (np.int8, np.float64),
        (np.int64, np.float64),
        (np.uint32, np.float64),
        (np.longdouble, np.float64),
        (np.dtype(np.float32).newbyteorder("S"), np.float32),
        (np.dtype(np.float64).newbyteorder("S"), np.float64),
    ],
)
def test_other_numbers_are_converted(recorder: Recorder, given: Any, read_as: Any) -> None:
    scene = raywise.Scene(VERTICES, TRIANGLES)
    origins, directions = np.array([[0, 0, 0]] * 4, given), np.array([[1, 2, 3]] * 4, given)
    hits = scene.intersect(origins, directions)
    assert recorder.arguments("rw_scene_intersect_batch")[1].origin.type == C_TYPES[np.dtype(read_as).name]
    assert hits.t.dtype == read_as
    expected = scene.intersect(origins.astype(read_as), directions.astype(read_as))
    assert hits.hit.all() and (hits.t == expected.t).all()


@pytest.mark.parametrize("dtype", ["i1", "u1", "i2", "<i4", ">i4", "<i8", ">i8", "<u4", ">u4", "<u8", ">u8"])
def test_indices_of_any_width_and_byte_order_are_understood(dtype: str) -> None:
    vertices = [[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]
    scene = raywise.Scene(vertices, np.array([[2, 2, 2], [0, 1, 2]], dtype))
    assert scene.intersect([0.2, 0.2, 1], [0, 0, -1]).primitive == 1


def test_one_number_for_all_components_is_understood() -> None:
    scene = raywise.Scene(VERTICES, TRIANGLES)
    directions = np.broadcast_to(np.array([[1.0], [2.0]]), (2, 3))
    assert directions.strides[1] == 0
    hits = scene.intersect([0, 0, 0], directions)
    np.testing.assert_array_equal(hits.t, scene.intersect([0, 0, 0], directions.copy()).t)
