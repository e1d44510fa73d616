"""The same bits from every structure, call, type, layout, order and number of threads; and the right ones."""

from __future__ import annotations

import math
from typing import Any, Tuple

import numpy as np
import pytest
from conftest import Recorder
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from samples import bits, layouts, rays, same_bits, soup, sphere

import raywise

DTYPES = [np.float32, np.float64]


def make(mesh: Tuple[Any, Any], structure: str) -> raywise.Scene:
    return raywise.Scene(*mesh, structure=structure)


@pytest.mark.parametrize("ray_type", DTYPES)
@pytest.mark.parametrize("mesh_type", DTYPES)
def test_every_structure_answers_as_the_plain_scan(structure: str, mesh_type: Any, ray_type: Any) -> None:
    for mesh in (soup(5, 300, mesh_type), (sphere()[0].astype(mesh_type), sphere()[1])):
        judge, scene = make(mesh, "linear_scan"), make(mesh, structure)
        assert scene.structure == structure
        origins, directions = rays(7, 500, ray_type)
        same_bits(scene.intersect(origins, directions), judge.intersect(origins, directions))
        same_bits(scene.intersect_all(origins, directions), judge.intersect_all(origins, directions))
        flags = scene.occluded(origins, directions)
        np.testing.assert_array_equal(flags, judge.occluded(origins, directions))
        np.testing.assert_array_equal(flags, judge.intersect(origins, directions).hit)


@pytest.mark.parametrize("ray_type", DTYPES)
def test_one_ray_is_answered_as_in_a_batch(structure: str, ray_type: Any) -> None:
    scene = make(soup(5, 300), structure)
    origins, directions = rays(8, 100, ray_type)
    batch, all_hits = scene.intersect(origins, directions), scene.intersect_all(origins, directions)
    flags = scene.occluded(origins, directions)
    for i in range(len(origins)):
        hit = scene.intersect(origins[i], directions[i])
        for name, values in batch.arrays.items():
            assert hit.arrays[name].dtype == values.dtype
            assert bits(hit.arrays[name]) == bits(values[i]), (i, name)
        assert bool(hit.hit) == bool(batch.hit[i])
        assert bool(scene.occluded(origins[i], directions[i])) == bool(flags[i])
        every = scene.intersect_all(origins[i], directions[i])
        assert every.offsets.tolist() == [0, all_hits.counts[i]]
        same_bits(every[0], all_hits[i])


@pytest.mark.parametrize("dtype", DTYPES)
def test_the_layout_of_the_arrays_does_not_matter(structure: str, dtype: Any) -> None:
    vertices, triangles = soup(6, 200, dtype)
    origins, directions = rays(9, 200, dtype)
    expected = make((vertices, triangles), structure).intersect(origins, directions)
    for layout, placed in layouts(vertices).items():
        scene = make((placed, layouts(triangles)[layout]), structure)
        hits = scene.intersect(layouts(origins)[layout], layouts(directions)[layout])
        same_bits(hits, expected)
        shared = raywise.Scene(placed, layouts(triangles)[layout], structure=structure, copy=False)
        same_bits(shared.intersect(origins, directions), expected)


def test_the_type_of_the_rays_does_not_matter_when_it_holds_them(structure: str) -> None:
    scene = make(soup(5, 300), structure)
    origins, directions = rays(10, 300, np.float32)
    narrow = scene.intersect(origins, directions, dtype=np.float64)
    wide = scene.intersect(origins.astype(np.float64), directions.astype(np.float64))
    same_bits(narrow, wide)


def test_float32_answers_are_the_rounded_float64_answers(structure: str) -> None:
    scene = make(soup(5, 300), structure)
    origins, directions = rays(10, 300, np.float32)
    exact = scene.intersect(origins, directions, dtype=np.float64)
    rounded = scene.intersect(origins, directions)
    for name in ("t", "uv", "normal"):
        assert rounded.arrays[name].dtype == np.float32
        assert bits(rounded.arrays[name]) == bits(exact.arrays[name].astype(np.float32))


def test_the_order_of_the_rays_does_not_matter(structure: str) -> None:
    scene = make(soup(5, 300), structure)
    origins, directions = rays(11, 1000)
    hits = scene.intersect(origins, directions)
    order = np.random.default_rng(3).permutation(len(origins))
    shuffled = scene.intersect(origins[order], directions[order])
    for name, values in hits.arrays.items():
        assert bits(values[order]) == bits(shuffled.arrays[name]), name


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_the_number_of_threads_does_not_matter(structure: str, threads: int) -> None:
    scene = make(soup(5, 300), structure)
    origins, directions = rays(12, 5000)
    same_bits(scene.intersect(origins, directions, threads=threads), scene.intersect(origins, directions))
    same_bits(scene.intersect_all(origins, directions, threads=threads), scene.intersect_all(origins, directions))


def test_an_answer_does_not_depend_on_which_others_are_wanted(structure: str) -> None:
    scene = make(soup(5, 300), structure)
    origins, directions = rays(13, 200)
    everything = scene.intersect(origins, directions)
    for name in everything.arrays:
        alone = scene.intersect(origins, directions, want=name)
        assert list(alone.arrays) == [name]
        assert bits(alone.arrays[name]) == bits(everything.arrays[name])


@pytest.mark.parametrize(
    "hint",
    [
        {"expected_rays": 1},
        {"expected_rays": 10**15},
        {"expected_rays": 1e4, "kind": "shadow"},
        {"effort": "probe"},
        {"effort": "measure", "time_limit": 1.0},
        {"rule": "hapala", "expected_rays": 5000},
        {"effort": "measure", "sample": rays(1, 20)},
    ],
)
def test_a_hint_never_changes_an_answer(hint: Any) -> None:
    mesh, (origins, directions) = soup(5, 300), rays(14, 300)
    judge = make(mesh, "linear_scan")
    same_bits(raywise.Scene(*mesh, **hint).intersect(origins, directions), judge.intersect(origins, directions))


def test_rays_of_an_image_are_answered_in_its_shape() -> None:
    scene = raywise.Scene(*sphere())
    origins, directions = rays(15, 60)
    image_rays = origins.reshape(6, 10, 3), directions.reshape(6, 10, 3)
    flat, image = scene.intersect(origins, directions), scene.intersect(*image_rays)
    for name, values in flat.arrays.items():
        assert bits(values) == bits(image.arrays[name]), name
    assert image.hit.shape == (6, 10)
    assert scene.occluded(*image_rays).shape == (6, 10)
    every = scene.intersect_all(*image_rays)
    assert len(every) == 60


def test_arguments_broadcast_against_each_other() -> None:
    scene = raywise.Scene(*sphere())
    origins, directions = rays(16, 20)
    for i, spread in enumerate((scene.intersect(origins[0], directions), scene.intersect(origins, directions[0]))):
        whole = (np.tile(origins[0], (20, 1)), directions) if i == 0 else (origins, np.tile(directions[0], (20, 1)))
        same_bits(spread, scene.intersect(*whole))
    table = scene.intersect(origins[:4, None, :], directions[None, :5, :])
    assert table.t.shape == (4, 5)
    assert bits(table.t[2, 3]) == bits(scene.intersect(origins[2], directions[3]).t)
    limits = scene.intersect([0, 0, 3.0], [0, 0, -1.0], tmax=np.array([1.0, 2.0, 3.0]))
    assert limits.hit.tolist() == [False, True, True]


def test_no_rays_are_no_answers(structure: str) -> None:
    scene = make(sphere(), structure)
    empty = np.zeros((0, 3))
    assert scene.intersect(empty, empty).t.shape == (0,)
    assert scene.occluded(empty, [0, 0, 1]).shape == (0,)
    every = scene.intersect_all(empty, empty)
    assert every.offsets.tolist() == [0] and len(every) == 0 and len(every.ray) == 0
    assert scene.intersect(np.zeros((0, 4, 3)), [0, 0, 1]).uv.shape == (0, 4, 2)


def test_an_empty_scene_is_legal(structure: str) -> None:
    for scene in (
        raywise.Scene(np.zeros((0, 3)), np.zeros((0, 3), np.uint32), structure=structure),
        raywise.Scene([], [], structure=structure),
        raywise.Scene(structure=structure),
    ):
        if not scene.committed:
            scene.commit()
        hits = scene.intersect(*rays(1, 10))
        assert not hits.hit.any()
        assert np.isposinf(hits.t).all()
        assert scene.bounds.lower.tolist() == [math.inf] * 3 and scene.bounds.upper.tolist() == [-math.inf] * 3


def test_a_hit_is_what_geometry_says(structure: str) -> None:
    scene = make(([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]]), structure)
    hit = scene.intersect([1, 2, 6], [0, 0, -2])
    assert hit.hit and hit.t == 3.0
    assert hit.uv.tolist() == [0.25, 0.5]
    assert hit.normal.tolist() == [0, 0, 1]
    assert (hit.geometry, hit.primitive, hit.instance) == (0, 0, raywise.INVALID_ID)


def test_a_miss_is_marked_everywhere(structure: str) -> None:
    scene = make(sphere(), structure)
    hit = scene.intersect([0, 0, 3], [0, 0, 1])
    assert not hit.hit and np.isposinf(hit.t)
    assert hit.uv.tolist() == [0, 0] and hit.normal.tolist() == [0, 0, 0]
    assert hit.geometry == hit.primitive == hit.instance == raywise.INVALID_ID


def test_the_interval_is_closed(structure: str) -> None:
    scene = make(([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]), structure)
    for tmin, tmax, expected in ((2, 2, True), (0, 2, True), (2, 9, True), (0, 1.999, False), (2.001, 9, False)):
        assert bool(scene.intersect([0.2, 0.2, 2], [0, 0, -1], tmin, tmax).hit) is expected
        assert bool(scene.occluded([0.2, 0.2, 2], [0, 0, -1], tmin, tmax)) is expected


@pytest.mark.parametrize(
    "ray",
    [
        ([math.nan, 0, 3], [0, 0, -1], 0, 9),
        ([0, 0, 3], [0, math.nan, -1], 0, 9),
        ([0, 0, 3], [0, 0, -1], math.nan, 9),
        ([0, 0, 3], [0, 0, -1], 0, math.nan),
        ([0, 0, 3], [0, 0, 0], 0, 9),
        ([0, 0, math.inf], [0, 0, -1], 0, 9),
        ([0, 0, 3], [0, 0, -math.inf], 0, 9),
        ([0, 0, 3], [0, 0, -1], 9, 0),
    ],
)
def test_a_ray_without_a_meaning_is_a_miss(structure: str, ray: Tuple[Any, ...]) -> None:
    scene = make(sphere(), structure)
    has_nan = any(np.isnan(np.asarray(part, float)).any() for part in ray)
    single = scene.intersect(*ray)
    batch = scene.intersect(*(np.asarray([part, part], float) for part in ray))
    assert not single.hit and not batch.hit.any()
    assert single.invalid_rays == has_nan and batch.invalid_rays == 2 * has_nan
    assert not scene.occluded(*ray)
    assert len(scene.intersect_all(*ray).t) == 0


def test_several_meshes_are_told_apart() -> None:
    scene = raywise.Scene()
    vertices, triangles = sphere()
    assert scene.add_triangles(vertices + [0, 0, 5], triangles) == 0
    assert scene.add_triangles(vertices, triangles) == 1
    scene.commit()
    assert scene.intersect([0.1, 0.2, 9], [0, 0, -1]).geometry == 0
    assert scene.intersect([0.1, 0.2, -9], [0, 0, 1]).geometry == 1
    every = scene.intersect_all([0.1, 0.2, 9], [0, 0, -1])
    assert every.geometry.tolist() == [0, 0, 1, 1]
    assert (np.diff(every.t) > 0).all()
    assert scene.statistics.geometry_count == 2
    assert scene.bounds.upper[2] == 6


def test_the_lowest_id_wins_a_tie(structure: str) -> None:
    corners = [[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]
    scene = raywise.Scene(structure=structure)
    for _ in range(2):
        scene.add_triangles(corners, [[0, 0, 1], [0, 1, 2], [1, 2, 0], [2, 0, 1]])
    scene.commit()
    hit = scene.intersect([0.25, 0.25, 1], [0, 0, -1])
    assert (hit.geometry, hit.primitive) == (0, 1)
    every = scene.intersect_all([0.25, 0.25, 1], [0, 0, -1])
    assert list(zip(every.geometry, every.primitive)) == [(g, p) for g in (0, 1) for p in (1, 2, 3)]


def test_all_hits_of_many_rays_need_no_guess_of_their_number(structure: str) -> None:
    layers = 40
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    vertices = np.concatenate([corners + [0, 0, z] for z in range(layers)])
    scene = make((vertices, None), structure)
    origins = np.array([[0.2, 0.2, 100.0], [5, 5, 100], [0.3, 0.3, 19.5]])
    every = scene.intersect_all(origins, [0, 0, -1])
    assert every.offsets.tolist() == [0, layers, layers, layers + 20]
    assert every.counts.tolist() == [layers, 0, 20]
    assert every.ray.tolist() == [0] * layers + [2] * 20
    assert every.primitive[:layers].tolist() == list(range(layers))[::-1]
    assert len(every) == 3 and len(every[1].t) == 0 and every[-1].t[0] == 0.5
    with pytest.raises(IndexError):
        every[3]
    single = scene.intersect_all(origins[0], [0, 0, -1])
    assert single.offsets.tolist() == [0, layers] and single.ray.tolist() == [0] * layers


coordinates = st.one_of(
    st.integers(-3, 3).map(float),
    st.floats(-4, 4, width=32),
    st.sampled_from([float(np.float32(x)) for x in (1e-30, -1e-30, 0.5, 1 / 3, 2.0**-20)]),
)


@given(
    vertices=hnp.arrays(np.float64, st.tuples(st.integers(3, 9), st.just(3)), elements=coordinates),
    corners=st.data(),
    dtype=st.sampled_from(DTYPES),
)
def test_structures_agree_on_hard_little_scenes(vertices: Any, corners: Any, dtype: Any) -> None:
    """Small whole coordinates make shared edges, coplanar triangles, flat boxes and ties common."""
    count = st.integers(1, 12)
    triangles = corners.draw(
        hnp.arrays(np.uint32, st.tuples(count, st.just(3)), elements=st.integers(0, len(vertices) - 1))
    )
    origins = corners.draw(hnp.arrays(dtype, (6, 3), elements=coordinates))
    directions = corners.draw(hnp.arrays(dtype, (6, 3), elements=coordinates))
    mesh = vertices.astype(dtype), triangles
    judge = make(mesh, "linear_scan")
    closest, every = judge.intersect(origins, directions), judge.intersect_all(origins, directions)
    for structure in raywise.structures():
        scene = make(mesh, structure)
        same_bits(scene.intersect(origins, directions), closest)
        same_bits(scene.intersect_all(origins, directions), every)
        np.testing.assert_array_equal(scene.occluded(origins, directions), closest.hit)
        for i in range(len(origins)):
            single = scene.intersect(origins[i], directions[i])
            assert bits(single.t) == bits(closest.t[i]) and single.primitive == closest.primitive[i]
    first = [hits.primitive[0] if len(hits.t) else raywise.INVALID_ID for hits in (every[i] for i in range(6))]
    assert first == closest.primitive.tolist()


def test_one_float32_ray_is_asked_in_float32(recorder: Recorder) -> None:
    scene = raywise.Scene(*sphere())
    origins, directions = (part.astype(np.float32) for part in rays(6, 100))
    batch = scene.intersect(origins, directions)
    for i in range(100):
        hit = scene.intersect(origins[i], directions[i])
        same_bits(hit, raywise.Hits({name: array[i] for name, array in batch.arrays.items()}, 0))
        assert recorder.calls[-1][0] in ("rw_scene_intersect_f32", "rw_scene_normal_f32")
    scene.occluded(origins[0], directions[0])
    assert recorder.calls[-1][0] == "rw_scene_occluded_f32"
    scene.intersect_all(origins[0], directions[0], want=["t"])
    assert recorder.calls[-1][0] == "rw_scene_intersect_all_f32"
    # What has more digits, or is to have, is asked in float64.
    scene.intersect(origins[0], directions[0], tmax=np.float64(0.1), want=["t"])
    assert recorder.calls[-1][0] == "rw_scene_intersect"
    scene.intersect(origins[0], directions[0], want=["t"], dtype=np.float64)
    assert recorder.calls[-1][0] == "rw_scene_intersect"
