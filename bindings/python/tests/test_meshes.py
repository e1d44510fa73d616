"""Meshes from files."""

from __future__ import annotations

import os
import pathlib

import numpy as np
import pytest
from samples import rays, same_bits

import raywise

PYRAMID = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 1\nf 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n"


@pytest.fixture
def pyramid(tmp_path: pathlib.Path) -> pathlib.Path:
    path = tmp_path / "Pyramide \u00fc.obj"
    path.write_text(PYRAMID, encoding="utf-8")
    return path


def test_a_file_becomes_arrays(pyramid: pathlib.Path) -> None:
    with raywise.Mesh(pyramid) as mesh:
        assert mesh.vertices.shape == (5, 3) and mesh.vertices.dtype in (np.float32, np.float64)
        np.testing.assert_array_equal(mesh.vertices[4], [0.5, 0.5, 1])
        assert mesh.triangles.shape == (6, 3) and mesh.triangles.dtype in (np.uint32, np.uint64)
        assert mesh.face_count == 5
        assert mesh.face_of_triangle.tolist() == [0, 0, 1, 2, 3, 4]
        assert repr(mesh) == "<Mesh of 5 vertices and 6 triangles, float32>"


def test_coordinates_are_as_written(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "utm.obj"
    path.write_text("v 500000.1 5183526.3 100.25\nv 500000.2 5183526.3 100.25\nv 500000.2 5183526.4 100.25\nf 1 2 3\n")
    mesh = raywise.Mesh(path)
    assert mesh.vertices.dtype == np.float64 and repr(mesh).endswith("float64>")
    assert mesh.vertices[1].tolist() == [500000.2, 5183526.3, 100.25]
    scene = raywise.Scene(mesh)
    assert "vertices: float64\n" in str(scene.explain()) and scene.explain().json["vertices"] == "float64"
    assert scene.intersect([500000.19, 5183526.32, 200], [0, 0, -1]).t == 99.75
    scene = raywise.Scene(mesh.vertices.astype(np.float32), mesh.triangles)
    assert scene.explain().json["vertices"] == "float32"


def test_convex_polygons_are_fans_in_the_order_of_their_corners(pyramid: pathlib.Path) -> None:
    assert raywise.Mesh(pyramid).triangles[:2].tolist() == [[3, 2, 1], [3, 1, 0]]


def test_concave_polygons_have_no_surface_outside(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "notch.off"
    path.write_text("OFF\n8 1 0\n0 0 0\n3 0 0\n3 3 0\n2 3 0\n2 1 0\n1 1 0\n1 3 0\n0 3 0\n8 0 1 2 3 4 5 6 7\n")
    scene = raywise.Scene(raywise.Mesh(path))
    origins = [[1.5, 2, 1], [0.5, 2, 1], [2.5, 2, 1], [1.5, 0.5, 1]]
    assert scene.intersect(origins, np.tile([0.0, 0, -1], (4, 1))).hit.tolist() == [False, True, True, True]


def test_the_arrays_are_the_meshs_own_and_read_only(pyramid: pathlib.Path) -> None:
    mesh = raywise.Mesh(pyramid)
    assert mesh.vertices.ctypes.data == mesh.vertices.ctypes.data
    for array in (mesh.vertices, mesh.face_of_triangle):
        assert not array.flags.writeable
        with pytest.raises(ValueError):
            array[0] = 1


@pytest.mark.parametrize("kind", [str, os.fsencode, pathlib.Path])
def test_every_kind_of_path_is_understood(pyramid: pathlib.Path, kind: type) -> None:
    assert raywise.Mesh(kind(pyramid)).face_count == 5


def test_a_mesh_takes_the_place_of_arrays(pyramid: pathlib.Path) -> None:
    mesh = raywise.Mesh(pyramid)
    expected = raywise.Scene(mesh.vertices, mesh.triangles).intersect(*rays(1, 200))
    assert expected.hit.any()
    same_bits(raywise.Scene(mesh).intersect(*rays(1, 200)), expected)
    same_bits(raywise.Scene(mesh, copy=False).intersect(*rays(1, 200)), expected)
    same_bits(raywise.intersect_once(mesh, *rays(1, 200)), expected)
    with pytest.raises(TypeError, match="triangles"):
        raywise.Scene(mesh, [[0, 1, 2]])


def test_a_missing_file_is_named(tmp_path: pathlib.Path) -> None:
    with pytest.raises(FileNotFoundError, match="nowhere.ply"):
        raywise.Mesh(tmp_path / "nowhere.ply")


@pytest.mark.parametrize(
    ("name", "text", "error"),
    [
        ("mesh.xyz", "0 0 0\n", raywise.MeshFormat),
        ("mesh.off", "this is no mesh\n", raywise.MeshFormat),
        ("mesh.ply", "ply\nformat nonsense\n", raywise.MeshFormat),
        ("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", raywise.NoFaces),
        ("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", raywise.BadPolygon),
    ],
)
def test_a_bad_file_is_a_value_error(
    tmp_path: pathlib.Path, name: str, text: str, error: "type[raywise.RaywiseError]"
) -> None:
    path = tmp_path / name
    path.write_text(text)
    with pytest.raises(error) as caught:
        raywise.Mesh(path)
    assert isinstance(caught.value, ValueError) and str(caught.value)


def test_a_path_with_a_zero_byte_is_refused() -> None:
    with pytest.raises(ValueError, match="zero byte"):
        raywise.Mesh("mesh\0.obj")
