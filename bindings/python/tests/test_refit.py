"""Scene.refit: the same triangles at new places."""

from __future__ import annotations

import gc
import threading
import weakref
from typing import Any, List, Tuple

import numpy as np
import pytest
from samples import rays, same_bits, soup, sphere

import raywise

VERTICES, TRIANGLES = sphere()
MOVES = {
    "far away": lambda p: p + [1e9, -1e9, 3e8],
    "tiny": lambda p: p * 1e-20,
    "twisted": lambda p: np.stack(
        [
            np.cos(p[:, 2]) * p[:, 0] - np.sin(p[:, 2]) * p[:, 1],
            np.sin(p[:, 2]) * p[:, 0] + np.cos(p[:, 2]) * p[:, 1],
            p[:, 2],
        ],
        axis=1,
    ),
    "partly collapsed": lambda p: np.where(p[:, :1] > 0.3, 0.5, p),
    "to a point": lambda p: p * 0,
}


def aimed(vertices: Any, seed: int = 5, count: int = 300) -> Tuple[Any, Any]:
    """Rays between places of a mesh."""
    random = np.random.default_rng(seed)
    first, second = (vertices[random.integers(0, len(vertices), count)] for _ in range(2))
    middle = 0.5 * first + 0.5 * vertices[random.integers(0, len(vertices), count)]
    return second + 2 * (second - middle), middle - second


@pytest.mark.parametrize("move", MOVES)
def test_answers_are_those_of_a_new_scene(structure: str, move: str) -> None:
    moved = MOVES[move](VERTICES)
    fresh = raywise.Scene(moved, TRIANGLES, structure="linear_scan")
    scene = raywise.Scene(VERTICES, TRIANGLES, structure=structure, expected_rays=1000)
    questions = aimed(moved)
    for refitted in (scene.refit(moved), scene.refit((moved, TRIANGLES)), scene.refit(VERTICES).refit(moved)):
        assert refitted.committed
        assert refitted.structure == structure
        same_bits(refitted.intersect(*questions), fresh.intersect(*questions))
        assert np.array_equal(refitted.occluded(*questions), fresh.occluded(*questions))
    if move not in ("to a point",):
        assert fresh.intersect(*questions).hit.any()
    assert scene.statistics.refits == 0


def test_the_old_scene_stays_and_may_go() -> None:
    scene = raywise.Scene(VERTICES, TRIANGLES, structure="bvh")
    before = scene.intersect(*rays(1, 200))
    refitted = scene.refit(VERTICES * 0.5)
    same_bits(scene.intersect(*rays(1, 200)), before)
    after = refitted.intersect(*rays(1, 200))
    scene.close()
    same_bits(refitted.intersect(*rays(1, 200)), after)
    assert refitted.statistics.refits == 1
    assert refitted.refit(VERTICES).statistics.refits == 2
    assert refitted.view(origin=[0, 0, 4]).intersect([0, 0, 4], [0, 0, -1]).t == pytest.approx(3.5)


def test_what_became_of_the_structure_is_explained() -> None:
    scene = raywise.Scene(VERTICES, TRIANGLES, structure="bvh", expected_rays=10)
    assert scene.explain().json["refit"] is None
    refitted = scene.refit(VERTICES * 2)
    refit = refitted.explain().json["refit"]
    assert refit["refits"] == 1
    assert refit["cost"] == pytest.approx(1.0)
    assert refit["obstacle"] == ""
    assert "refitted: 1 times" in str(refitted.explain())
    grid = raywise.Scene(VERTICES, TRIANGLES, structure="uniform_grid").refit(VERTICES)
    assert grid.explain().json["refit"]["obstacle"] == "the structure cannot be refitted"
    assert grid.statistics.refits == 0


def test_several_meshes_each_in_its_own_form() -> None:
    other = soup(3, 40)
    alone = np.random.default_rng(7).uniform(-1, 1, (30, 3)).astype(np.float32)
    scene = raywise.Scene(structure="bvh")
    scene.add_triangles(VERTICES, TRIANGLES)
    scene.add_triangles(*other, copy=False)
    scene.add_triangles(alone)
    scene.commit()
    refitted = scene.refit(VERTICES.astype(np.float32)[:, ::-1], (other[0] + 1, other[1].astype(np.uint64)), alone * 2)
    fresh = raywise.Scene(structure="linear_scan")
    fresh.add_triangles(VERTICES.astype(np.float32)[:, ::-1], TRIANGLES)
    fresh.add_triangles(other[0] + 1, other[1])
    fresh.add_triangles(alone * 2)
    fresh.commit()
    same_bits(refitted.intersect(*rays(8, 300)), fresh.intersect(*rays(8, 300)))
    same_bits(refitted.refit(VERTICES, other[0], alone).intersect(*rays(8, 300)), scene.intersect(*rays(8, 300)))


def watched(array: Any) -> Tuple[Any, "weakref.ref[Any]"]:
    copy = np.array(array)
    return copy, weakref.ref(copy)


def test_shared_arrays_live_as_long_as_they_are_read_and_no_longer() -> None:
    vertices, vertices_alive = watched(VERTICES)
    triangles, triangles_alive = watched(TRIANGLES)
    scene = raywise.Scene(vertices, triangles, structure="bvh", copy=False)
    del vertices, triangles
    moved, moved_alive = watched(VERTICES * 2)
    refitted = scene.refit(moved, copy=False)
    del moved
    scene.close()
    del scene
    gc.collect()
    # The new scene needs its own vertices and the old one's indices.
    assert vertices_alive() is None
    assert moved_alive() is not None
    assert triangles_alive() is not None
    assert refitted.intersect([0.1, 0.2, 5], [0, 0, -1]).t == pytest.approx(3.0, abs=0.1)
    last = refitted.refit(VERTICES)
    refitted.close()
    del refitted
    gc.collect()
    assert moved_alive() is None
    assert triangles_alive() is None  # copied
    assert last.intersect([0.1, 0.2, 5], [0, 0, -1]).t == pytest.approx(4.0, abs=0.1)


def test_vertices_can_be_moved_in_place() -> None:
    vertices = VERTICES.copy()
    scene = raywise.Scene(vertices, TRIANGLES, structure="bvh", copy=False)
    for _ in range(3):
        vertices *= 1.5
        scene = scene.refit(vertices, copy=False)
        assert scene.intersect([0, 0, 9], [0, 0, -1]).t == pytest.approx(9 - vertices[0, 2])


def test_a_mesh_from_a_file_can_be_where_triangles_go(tmp_path: Any) -> None:
    path = tmp_path / "square.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n")
    scene = raywise.Scene([[0, 0, 5], [1, 0, 5], [1, 1, 5], [0, 1, 5]], [[0, 1, 2], [0, 2, 3]], structure="bvh")
    with raywise.Mesh(path) as mesh:
        refitted = scene.refit(mesh, copy=False)
    assert refitted.intersect([0.3, 0.2, 9], [0, 0, -1]).t == 9


def test_numbers_that_differ_are_named() -> None:
    scene = raywise.Scene(VERTICES, TRIANGLES, structure="bvh")
    with pytest.raises(ValueError, match=r"mesh_count: it is 0, the scene has 1"):
        scene.refit()
    with pytest.raises(ValueError, match=r"mesh_count: it is 2, the scene has 1"):
        scene.refit(VERTICES, VERTICES)
    with pytest.raises(ValueError, match=r"meshes\[0\].vertex_count: it is \d+, .* \d+ vertices"):
        scene.refit(VERTICES[:-1])
    with pytest.raises(ValueError, match=r"meshes\[0\].triangle_count: it is \d+, .* \d+ triangles"):
        scene.refit((VERTICES, TRIANGLES[1:]))
    with pytest.raises(TypeError, match=r"meshes\[0\]: a tuple is \(vertices, triangles\)"):
        scene.refit((VERTICES,))  # type: ignore[arg-type]


def test_what_cannot_be_is_named() -> None:
    scene = raywise.Scene(VERTICES, TRIANGLES, structure="bvh")
    bad = VERTICES.copy()
    bad[5, 1] = np.nan
    with pytest.raises(raywise.NotFinite, match=r"meshes\[0\].vertices: vertex 5: coordinate y is NaN"):
        scene.refit(bad)
    assert scene.refit(bad, skip_invalid=True).statistics.invalid_triangles > 0
    indices = TRIANGLES.astype(np.int64)
    indices[3, 2] = -7
    with pytest.raises(raywise.IndexOutOfRange, match="triangle 3: index -7 is negative"):
        scene.refit((VERTICES, indices))
    with pytest.raises(TypeError, match="vertices"):
        scene.refit("ball")
    with pytest.raises(raywise.NotCommitted):
        raywise.Scene().refit()


def test_progress_can_cancel_and_raise() -> None:
    scene = raywise.Scene(VERTICES, TRIANGLES, structure="bvh")
    told: List[Tuple[float, str]] = []
    scene.refit(VERTICES, threads=2, progress=lambda fraction, stage: told.append((fraction, stage)))
    assert told
    with pytest.raises(raywise.Cancelled):
        scene.refit(VERTICES, progress=lambda fraction, stage: True)

    def raising(fraction: float, stage: str) -> None:
        raise KeyError("out of the callback")

    with pytest.raises(KeyError, match="out of the callback"):
        scene.refit(VERTICES, progress=raising)
    assert scene.refit(VERTICES).statistics.refits == 1


def test_from_several_threads_at_once() -> None:
    scene = raywise.Scene(VERTICES, TRIANGLES, structure="bvh")
    made: List[raywise.Scene] = []
    threads = [threading.Thread(target=lambda: made.append(scene.refit(VERTICES * 2))) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(made) == 4
    for refitted in made:
        same_bits(refitted.intersect(*rays(9, 100)), made[0].intersect(*rays(9, 100)))


def test_the_structure_is_refitted_or_built_as_asked(structure: str) -> None:
    scene = raywise.Scene(VERTICES, TRIANGLES, structure=structure)
    fresh = raywise.Scene(VERTICES * 2, TRIANGLES)
    for refit in ("where_it_pays", "where_possible", "never"):
        refitted = scene.refit(VERTICES * 2, refit=refit)
        same_bits(refitted.intersect(*rays(3, 200)), fresh.intersect(*rays(3, 200)))
        assert refitted.structure == structure
        assert (refitted.statistics.refits > 0) == (refit != "never" and structure.startswith("bvh"))
    with pytest.raises(raywise.InvalidArgument, match="refit is 'sometimes', not one of 'where_it_pays'"):
        scene.refit(VERTICES, refit="sometimes")


def single_triangles(seed: int, count: int) -> Any:
    """Vertices of triangles that share none."""
    return np.random.default_rng(seed).uniform(-1, 1, (3 * count, 3))


def test_numbers_may_change_where_all_is_built_anew() -> None:
    first, second = single_triangles(1, 50), single_triangles(2, 70)
    scene = raywise.Scene(VERTICES, TRIANGLES)
    with pytest.raises(ValueError):
        scene.refit((VERTICES, TRIANGLES[:-5]))
    fewer = scene.refit((VERTICES, TRIANGLES[:-5]), refit="never")
    assert fewer.statistics.triangle_count == len(TRIANGLES) - 5
    more = fewer.refit(VERTICES, first, refit="never")
    assert more.statistics.triangle_count == len(TRIANGLES) - 5 + 50
    again = more.refit(VERTICES, second, first, refit="never")
    fresh = raywise.Scene()
    fresh.add_triangles(VERTICES, TRIANGLES[:-5])
    fresh.add_triangles(second)
    fresh.add_triangles(first)
    fresh.commit()
    same_bits(again.intersect(*rays(4, 300)), fresh.intersect(*rays(4, 300)))
    assert again.refit(refit="never").statistics.triangle_count == 0
    with pytest.raises(ValueError, match="vertex_count"):
        again.refit(VERTICES[:-1], second, first, refit="never")


def test_memory_of_frames_is_kept_until_the_last_is_closed() -> None:
    assert raywise.kept_memory() == 0
    big = single_triangles(1, 20000)
    scene = raywise.Scene(big, structure="bvh")
    for i in range(4):
        next_scene = scene.refit(big + 0.01 * i, refit="never")
        scene.close()
        scene = next_scene
    assert raywise.kept_memory() > 0
    scene.close()
    assert raywise.kept_memory() == 0


def test_memory_of_any_scene_is_kept_on_request() -> None:
    big = single_triangles(1, 20000)
    raywise.keep_memory(1e8)
    try:
        raywise.Scene(big, structure="bvh").close()
        assert 0 < raywise.kept_memory() <= 1e8
    finally:
        raywise.keep_memory(0)
    assert raywise.kept_memory() == 0
    with pytest.raises(ValueError):
        raywise.keep_memory(-1)
