"""Skip lists: a ray passes through the triangles it names, and through no others."""

from __future__ import annotations

from typing import Any, Dict, List, Tuple

import numpy as np
import pytest
from conftest import Recorder
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from samples import bits, layouts, same_bits, soup, sphere

import raywise
from raywise import _declarations as c

NOTHING = raywise.INVALID_ID
MESH = soup(5, 300)
# Rays that meet no edge exactly: numbers like these do not. (Those of samples.rays run along the axes now and then.)
GENERIC = np.random.default_rng(21).uniform(-1, 1, (2, 200, 3)) * [[[2.0]], [[1.0]]]


@pytest.fixture(scope="module")
def scene() -> raywise.Scene:
    return raywise.Scene(*MESH)


@pytest.fixture(scope="module")
def stack() -> raywise.Scene:
    """Five squares on top of each other, each a mesh of its own: number i is at z = -i."""
    scene = raywise.Scene()
    square = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    for layer in range(5):
        assert scene.add_triangles(square - [0, 0, layer], [[0, 1, 2], [0, 2, 3]]) == layer
    scene.commit()
    return scene


DOWN = [0.75, 0.25, 1.0], [0.0, 0.0, -1.0]
THREE = np.tile(DOWN[0], (3, 1)), np.array(DOWN[1])


def met(stack: Any, skip: Any, rays: Any = THREE, **options: Any) -> List[int]:
    """Which square each ray hits first."""
    geometry: List[int] = stack.intersect(*rays, skip=skip, **options).geometry.tolist()
    return geometry


# --- the answers ---------------------------------------------------------------------------------------------------


@given(seed=st.integers(0, 2**32 - 1), count=st.integers(1, 60), dtype=st.sampled_from([np.float32, np.float64]))
def test_skipping_the_closest_hit_gives_the_second_of_all(seed: int, count: int, dtype: Any) -> None:
    random = np.random.default_rng(seed)
    vertices = random.uniform(-1, 1, (3 * count, 3)).astype(dtype)
    origins, directions = random.uniform(-1, 1, (2, 20, 3))
    for structure in raywise.structures():
        scene = raywise.Scene(vertices, structure=structure)
        closest, every = scene.intersect(origins, directions), scene.intersect_all(origins, directions)
        second, rest = (ask(origins, directions, skip=closest) for ask in (scene.intersect, scene.intersect_all))
        np.testing.assert_array_equal(rest.counts, np.maximum(every.counts - 1, 0))
        np.testing.assert_array_equal(scene.occluded(origins, directions, skip=closest), every.counts > 1)
        for i in range(len(origins)):
            left = every[i].arrays
            for name, values in left.items():
                assert bits(rest[i].arrays[name]) == bits(values[1:]), (i, name)
                if len(values) > 1:
                    assert bits(second.arrays[name][i]) == bits(values[1]), (i, name)
            single = scene.intersect(origins[i], directions[i], skip=every[i].primitive[:1])
            assert bits(single.t) == bits(second.t[i]) and single.primitive == second.primitive[i]
        assert (second.primitive[every.counts < 2] == NOTHING).all()


coordinates = st.integers(-2, 2).map(float)


@given(vertices=hnp.arrays(np.float64, (8, 3), elements=coordinates), data=st.data())
def test_a_skipped_triangle_is_as_one_without_area(vertices: Any, data: Any) -> None:
    """Whole coordinates, so that edges and corners are met all the time."""
    corners = data.draw(hnp.arrays(np.uint32, (12, 3), elements=st.integers(0, 7)))
    origins = data.draw(hnp.arrays(np.float64, (4, 3), elements=coordinates))
    directions = data.draw(hnp.arrays(np.float64, (4, 3), elements=coordinates))
    skipped = data.draw(st.sets(st.integers(0, 11)))
    flattened = corners.copy()
    flattened[list(skipped)] = 0
    # One triangle more keeps the bounds of both scenes the same.
    vertices = np.concatenate([vertices, [[-9, -9, -9], [-9, 9, 9], [9, 9, 8]]])
    frame = np.array([[8, 9, 10]], np.uint32)
    whole, holed = np.concatenate([corners, frame]), np.concatenate([flattened, frame])
    judge = raywise.Scene(vertices, holed, structure="linear_scan")
    closest, every = judge.intersect(origins, directions), judge.intersect_all(origins, directions)
    lists = [sorted(skipped)] * len(origins)
    for structure in raywise.structures():
        scene = raywise.Scene(vertices, whole, structure=structure)
        same_bits(scene.intersect(origins, directions, skip=lists), closest)
        same_bits(scene.intersect_all(origins, directions, skip=lists), every)
        np.testing.assert_array_equal(scene.occluded(origins, directions, skip=lists), closest.hit)
        for i in range(len(origins)):
            ray = origins[i], directions[i]
            assert scene.intersect(*ray, skip=lists[i]).primitive == closest.primitive[i]
            assert bool(scene.occluded(*ray, skip=lists[i])) == bool(closest.hit[i])
            same_bits(scene.intersect_all(*ray, skip=lists[i])[0], every[i])


def test_from_hit_to_hit_rays_find_all_of_them(structure: str) -> None:
    """On from where a ray has hit: only the triangle it starts on is skipped."""
    for mesh in (MESH, sphere()):
        scene = raywise.Scene(*mesh, structure=structure)
        origins, directions = GENERIC
        every = scene.intersect_all(origins, directions)
        hits, found = scene.intersect(origins, directions), []
        while hits.hit.any():
            found.append(hits.primitive)
            origins = np.where(hits.hit[:, None], origins + np.where(hits.hit, hits.t, 0)[:, None] * directions, np.nan)
            hits = scene.intersect(origins, directions, skip=hits)
        assert len(found) == every.counts.max() >= 2
        for i, expected in enumerate(every.primitive[a:b] for a, b in zip(every.offsets, every.offsets[1:])):
            assert [ids[i] for ids in found if ids[i] != NOTHING] == expected.tolist(), i


def test_views_and_one_shots_skip_as_scenes_do(structure: str) -> None:
    origins, directions = GENERIC
    scene = raywise.Scene(*MESH, structure=structure)
    every = scene.intersect_all(origins, directions)
    previous = scene.intersect(origins, directions)
    view = scene.view(origin=[0.3, -0.2, 4.0], structure=structure)
    for skip in (previous, every, every.primitive[every.offsets[3] : every.offsets[4]][None, :]):
        expected = scene.intersect(origins, directions, skip=skip)
        flags = scene.occluded(origins, directions, skip=skip)
        same_bits(view.intersect(origins, directions, skip=skip), expected)
        same_bits(
            view.intersect_all(origins, directions, skip=skip), scene.intersect_all(origins, directions, skip=skip)
        )
        same_bits(raywise.intersect_once(MESH, origins, directions, skip=skip, structure=structure), expected)
        for found in (
            view.occluded(origins, directions, skip=skip),
            raywise.occluded_once(MESH, origins, directions, skip=skip),
        ):
            np.testing.assert_array_equal(found, flags)
    assert not scene.occluded(origins, directions, skip=every).any()
    ray, skip = (origins[0], directions[0]), every[0]
    for ask in (view.intersect, view.occluded, view.intersect_all):
        assert not np.any(getattr(ask(*ray, skip=skip), "hit", False))
    assert not raywise.intersect_once(MESH, *ray, skip=skip).hit
    assert not raywise.occluded_once(MESH, *ray, skip=skip)


# --- the forms -----------------------------------------------------------------------------------------------------

FORMS: Dict[str, Tuple[Any, List[int]]] = {
    "none": (None, [0, 0, 0]),
    "one for all": (0, [1, 1, 1]),
    "one each": ([0, -1, 1], [1, 0, 0]),
    "one each, all bits set": (np.array([0, 2**32 - 1, 1], np.uint32), [1, 0, 0]),
    "one each, all 64 bits set": (np.array([0, 2**64 - 1, 1], np.uint64), [1, 0, 0]),
    "one list for all": ([[0, 1]], [1, 1, 1]),
    "as many each": ([[1, 0], [1, 1], [-1, -1]], [1, 0, 0]),
    "none each": ([[], [], []], [0, 0, 0]),
    "lists": ([[1, 0], [], [1]], [1, 0, 0]),
    "arrays": ([np.array([1, 0], np.uint8), np.array([], np.int16), np.array([1], np.uint64)], [1, 0, 0]),
    "a pair": (([0, 1, 0], [0, 0, 1]), [1, 0, 0]),
    "a pair of one": (((0, 0)), [1, 1, 1]),
    "a pair that broadcasts": (([[0], [1], [0]], [0, 1]), [1, 0, 1]),
    "a pair of lists": (([[0, 1], [], [1]], [[0, 0], [], [0]]), [2, 0, 0]),
    "lists of one mesh": ((0, [[0, 1], [], [1]]), [1, 0, 0]),
    "offsets": (([0, 2, 2, 3], [0, 1, 0], [0, 0, 1]), [2, 0, 0]),
    "offsets into longer arrays": (([1, 2, 2, 4], [9, 0, 1, 0, 9], [9, 0, 0, 0, 9]), [1, 0, 2]),
    "offsets, one mesh": ((np.array([0, 2, 2, 3], np.uint8), 0, [0, 1, 1]), [1, 0, 0]),
    "offsets without entries": (([0, 0, 0, 0], [], []), [0, 0, 0]),
}


@pytest.mark.parametrize("form", list(FORMS))
def test_lists_come_in_many_forms(stack: raywise.Scene, form: str) -> None:
    skip, expected = FORMS[form]
    assert met(stack, skip) == expected
    assert met(stack, skip, threads=1, out={"geometry": np.zeros(3, np.uint64)}) == expected
    every = stack.intersect_all(*THREE, skip=skip)
    assert [hits.geometry[0] for hits in (every[i] for i in range(3))] == expected
    above = np.array(expected) + 1.5  # ends between that square and the next one
    np.testing.assert_array_equal(stack.occluded(*THREE, tmax=above, skip=skip), True)
    np.testing.assert_array_equal(stack.occluded(*THREE, tmax=above - 1, skip=skip), False)


@pytest.mark.parametrize(
    ("skip", "left"),
    [
        (None, [0, 1, 2, 3, 4]),
        (0, [1, 2, 3, 4]),
        (-1, [0, 1, 2, 3, 4]),
        ([0, 1, -1], [1, 2, 3, 4]),
        ([], [0, 1, 2, 3, 4]),
        (np.array([0], np.uint64), [1, 2, 3, 4]),
        ((1, 0), [0, 2, 3, 4]),
        (([0, 1, 2], [0, 0, 0]), [3, 4]),
        (([2, 1, 0], 0), [3, 4]),
        (([4, 3, 2, 1, 0], 0), []),
        (([0, 2], [0, 1], [0, 0]), [2, 3, 4]),
    ],
)
def test_one_ray_takes_one_list(stack: raywise.Scene, skip: Any, left: List[int]) -> None:
    first = left[0] if left else NOTHING
    assert stack.intersect(*DOWN, skip=skip).geometry == first
    assert stack.intersect(*DOWN, skip=skip, out={"geometry": np.zeros((), np.uint32)}).geometry == first
    assert stack.intersect_all(*DOWN, skip=skip).geometry.tolist() == left
    for layer in range(5):
        above = layer + 1.5  # ends between this square and the next one
        assert stack.occluded(*DOWN, tmin=above - 1, tmax=above, skip=skip) == (layer in left)


def test_answers_are_lists(stack: raywise.Scene) -> None:
    closest, every = stack.intersect(*THREE), stack.intersect_all(*THREE, tmax=[1.5, 3.5, 0.5])
    assert met(stack, closest) == [1, 1, 1]
    assert met(stack, every) == [1, 3, 0]
    assert met(stack, every[1], rays=DOWN) == 3  # type: ignore[comparison-overlap]
    assert met(stack, stack.intersect(*DOWN)) == [1, 1, 1]
    assert met(stack, stack.intersect(*THREE, dtype=np.float32, want=["geometry", "primitive"])) == [1, 1, 1]
    wide = {name: np.zeros(3, np.uint64) for name in ("geometry", "primitive")}
    assert met(stack, stack.intersect(*THREE, tmax=[0.5, 5, 5], out=wide)) == [0, 1, 1]


def test_images_of_rays_take_images_of_ids(stack: raywise.Scene) -> None:
    image = np.tile(DOWN[0], (2, 3, 1)), np.array(DOWN[1])
    ids = np.array([[0, 1, -1], [0, 0, 1]])
    expected = [[1, 0, 0], [1, 1, 0]]
    for skip in (ids, ids[:, :, None], np.stack([ids, ids], -1), (np.arange(7), 0, ids.ravel())):
        assert met(stack, skip, rays=image) == expected
    assert met(stack, [0, 1, -1], rays=image) == [[1, 0, 0]] * 2
    assert met(stack, np.array([[[0]], [[1]]]), rays=image) == [[1] * 3, [0] * 3]
    assert met(stack, stack.intersect(*image), rays=image) == [[1] * 3] * 2


def test_no_rays_skip_nothing(stack: raywise.Scene) -> None:
    empty = np.zeros((0, 3))
    for skip in (None, [], np.zeros((0, 4), int), 0, ([0], [], []), stack.intersect(empty, empty)):
        assert stack.intersect(empty, empty, skip=skip).t.shape == (0,)


# --- without copying -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("dtype", [np.uint32, np.int32, np.uint64, np.int64])
@pytest.mark.parametrize("layout", ["packed", "reversed", "every other row and column", "field of a packed record"])
def test_ids_are_read_where_they_are(recorder: Recorder, layout: str, dtype: Any) -> None:
    scene = raywise.Scene(*MESH)
    geometry, primitive = (layouts(np.zeros((200, 3), dtype))[layout][:, i] for i in (0, 2))
    scene.intersect(*GENERIC, skip=(geometry, primitive))
    given = recorder.arguments("rw_scene_intersect_batch")[1]
    for described, array in ((given.skip_geometry, geometry), (given.skip_primitive, primitive)):
        assert described.data == array.ctypes.data and described.stride == array.strides[0]
        assert described.type == (c.RW_UINT32 if array.itemsize == 4 else c.RW_UINT64)
    assert given.skip_offsets is None


def test_offsets_and_lists_are_read_where_they_are(recorder: Recorder, scene: raywise.Scene) -> None:
    every = scene.intersect_all(*GENERIC)
    table = np.zeros((200, 4), np.int64)
    for ask, name in (
        (scene.intersect, "intersect"),
        (scene.occluded, "occluded"),
        (scene.intersect_all, "intersect_all"),
    ):
        ask(*GENERIC, skip=every)
        given = recorder.arguments(f"rw_scene_{name}_batch")[1]
        assert given.skip_offsets == every.offsets.ctypes.data
        assert given.skip_primitive.data == every.primitive.ctypes.data
        assert given.skip_geometry.data == every.geometry.ctypes.data
        ask(*GENERIC, skip=table)
        given = recorder.arguments(f"rw_scene_{name}_batch")[1]
        assert given.skip_primitive.data == table.ctypes.data and given.skip_geometry.data is None
    raywise.intersect_once(MESH, *GENERIC, skip=every)
    assert recorder.arguments("rw_once_intersect")[2].skip_primitive.data == every.primitive.ctypes.data


def test_one_id_for_all_rays_is_one_id(recorder: Recorder, scene: raywise.Scene) -> None:
    one = np.array(7, np.uint32)
    scene.intersect(*GENERIC, skip=(0, one))
    given = recorder.arguments("rw_scene_intersect_batch")[1]
    assert given.skip_primitive.data == one.ctypes.data
    assert given.skip_primitive.stride == given.skip_geometry.stride == c.RW_REPEAT


def test_one_ray_is_asked_by_the_call_for_one_ray(recorder: Recorder, scene: raywise.Scene) -> None:
    ray = GENERIC[0][0], GENERIC[1][0]
    for name in ("intersect", "occluded", "intersect_all"):
        getattr(scene, name)(*ray, skip=[3, -1])
        options = recorder.arguments(f"rw_scene_{name}")[2]
        assert [options.skip[i].primitive for i in range(options.skip_count)] == [3, NOTHING]
        assert {options.skip[i].instance for i in range(2)} == {NOTHING}
        for nothing in (None, [], np.zeros((0,), np.uint32)):
            getattr(scene, name)(*ray, skip=nothing)
            assert recorder.arguments(f"rw_scene_{name}")[2] is None


def test_ids_of_other_types_are_converted(stack: raywise.Scene) -> None:
    for dtype in ("i1", "u1", "i2", "u2", ">i4", ">u4", ">i8", ">u8"):
        assert met(stack, np.array([0, 1, 0], dtype)) == [1, 0, 1]
    for dtype in ("i1", "i2", ">i4", ">i8"):
        assert met(stack, np.array([-1, -1, 0], dtype)) == [0, 0, 1]


def test_the_callers_ids_are_not_written_to(stack: raywise.Scene) -> None:
    ids = np.array([[0, -1], [1, 0], [-1, -1]])
    kept = ids.copy()
    ids.flags.writeable = False
    assert met(stack, ids) == [1, 1, 0]
    np.testing.assert_array_equal(ids, kept)


def test_outputs_may_not_overlap_what_is_skipped(stack: raywise.Scene) -> None:
    hits = stack.intersect(*THREE)
    with pytest.raises(ValueError, match=r"out\['primitive'\] overlaps skip primitive"):
        stack.intersect(*THREE, skip=hits, out={"primitive": hits.primitive})
    flags = np.zeros(3, np.uint32)
    with pytest.raises(ValueError, match="out overlaps skip primitive"):
        stack.occluded(*THREE, skip=flags, out=flags)
    offsets = np.zeros(4, np.uint64)
    with pytest.raises(ValueError, match="overlaps skip offsets"):
        stack.occluded(*THREE, skip=(offsets, 0, [1]), out=offsets[1:])


# --- errors --------------------------------------------------------------------------------------------------------

QUESTIONS = ["intersect", "occluded", "intersect_all", "intersect_once", "occluded_once"]


def ask(stack: raywise.Scene, question: str, rays: Any, skip: Any) -> None:
    if question.endswith("_once"):
        square = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
        meshes: Any = [(square - [0, 0, layer], [[0, 1, 2], [0, 2, 3]]) for layer in range(5)]
        getattr(raywise, question)(meshes, *rays, skip=skip)
    else:
        getattr(stack, question)(*rays, skip=skip)


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize(
    ("skip", "words"),
    [
        ([0, 1, 2], r"skip\[2\]: primitive 2 .*geometry 0 has 2"),
        (([0, 5, 0], 0), r"skip\[1\]: geometry 5 .*has 5"),
        (7, r"skip\[0\]: primitive 7"),
        ([0, 1, -2], r"skip\[2\]: primitive -2 is negative; -1"),
        (np.array([0, 1, -2], np.int32), r"skip\[2\]: primitive -2 is negative"),
        (np.array([0, 1, -2], np.int8), r"skip\[2\]: primitive -2 is negative"),
        (([-1, -1, 0], [-1, 0, 0]), r"skip\[1\]: geometry -1 is negative"),
        (np.array([0, 1, 2**40], np.uint64), r"skip\[2\]: primitive 1099511627776 "),
        ([[0, 1], [1, 0], [1, 2]], r"skip\[2, 1\]: primitive 2 "),
        ([[0, 1], [], [1, 2]], r"skip\[2\]\[1\]: primitive 2 "),
        ([[0, 1], [], [1, -3]], r"skip\[2\]\[1\]: primitive -3 is negative"),
        (([3, 3, 4, 6], 0, [9, 9, 9, 0, 1, 2, 9]), r"skip\[2\]\[1\]: primitive 2 "),
    ],
)
def test_a_triangle_that_is_not_there_is_named(stack: raywise.Scene, question: str, skip: Any, words: str) -> None:
    with pytest.raises(raywise.IndexOutOfRange, match=words) as caught:
        ask(stack, question, THREE, skip)
    assert isinstance(caught.value, IndexError)


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize(
    ("skip", "words"),
    [
        (7, "skip: primitive 7 .*geometry 0 has 2"),
        ([0, 1, 2], r"skip\[2\]: primitive 2"),
        ([0, -1, -2], r"skip\[2\]: primitive -2 is negative"),
        ((9, -1), None),
        ((9, 0), "skip: geometry 9 .*has 5"),
        ((-1, 0), "skip: geometry -1 is negative"),
        (([0, 2**40], [-1, 0]), r"skip\[1\]: geometry 1099511627776 is out of range"),
        ([2**40 + 1], r"skip\[0\]: primitive 1099511627777 is out of range"),
        (([0, 2], 0, [1, 2]), r"skip\[0\]\[1\]: primitive 2"),
    ],
)
def test_a_triangle_that_is_not_there_is_named_for_one_ray(
    stack: raywise.Scene, question: str, skip: Any, words: str
) -> None:
    if words is None:
        ask(stack, question, DOWN, skip)
        return
    with pytest.raises(raywise.IndexOutOfRange, match=words):
        ask(stack, question, DOWN, skip)


def test_an_image_names_row_and_column(stack: raywise.Scene) -> None:
    image = np.tile(DOWN[0], (2, 3, 1)), np.array(DOWN[1])
    with pytest.raises(raywise.IndexOutOfRange, match=r"skip\[1, 0\]: primitive 5"):
        stack.intersect(*image, skip=[[0, 0, 0], [5, 0, 0]])


def test_an_error_of_the_mesh_is_not_taken_for_one_of_the_list() -> None:
    vertices = [[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]
    with pytest.raises(raywise.IndexOutOfRange, match="triangle 1: index -4 is negative"):
        raywise.intersect_once((vertices, [[0, 1, 2], [0, 1, -4]]), *THREE, skip=[0, 0, -9])
    # These triangles are never hit, and there all the same.
    mesh = (vertices, [[0, 1, 2], [0, 1, -4]])
    assert raywise.intersect_once(mesh, *THREE, skip=[0, 1, 0], skip_invalid=True).t.shape == (3,)
    with pytest.raises(raywise.IndexOutOfRange, match=r"skip\[2\]: primitive 2 .*geometry 0 has 2"):
        raywise.intersect_once(mesh, *THREE, skip=[0, 1, 2], skip_invalid=True)


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize(
    ("skip", "error", "words"),
    [
        ([0.0, 1.0, 2.0], TypeError, "skip has to hold whole numbers, not float64"),
        ([True, False, True], TypeError, "skip has to hold whole numbers, not bool"),
        ("bunny", TypeError, "skip has to hold whole numbers"),
        ((0.5, 0), TypeError, "skip geometry has to hold whole numbers"),
        ((0, [0.5]), TypeError, "skip primitive has to hold whole numbers"),
        ((0, 1, 2, 3), TypeError, "skip is a tuple of 4"),
        ((0,), TypeError, "skip is a tuple of 1"),
        ([0, 1], ValueError, r"skip: primitive of shape \(2,\) does not fit rays of shape \(3,\)"),
        (np.zeros((2, 2), int), ValueError, r"shape \(2, 2\) does not fit rays of shape \(3,\)"),
        (np.zeros((3, 1, 1), int), ValueError, r"shape \(3, 1, 1\)"),
        (([0, 0], [0, 0, 0]), ValueError, r"primitive of shape \(3,\) and geometry of shape \(2,\)"),
        ([[0, 1], [0]], ValueError, r"skip offsets.*\(4,\).*\(3,\)"),
        ([[0, 1], 0, [0]], ValueError, r"skip\[1\] has to be a list of ids"),
        ([[0, 1], [0.5], []], TypeError, r"skip\[1\] has to hold whole numbers, not float64"),
        (([[0], [0], [1]], [[0], [], [1]]), ValueError, "skip geometry and skip primitive .* same lengths"),
        (([[0], [], [1]], [[0], [1], [1]]), ValueError, "skip geometry and skip primitive .* same lengths"),
        (([0, 0, 0], [[0, 1], [], [1]]), ValueError, "skip geometry and skip primitive .* same lengths"),
        (([[0, 1], []], [[0, 1], [], [1]]), ValueError, "skip geometry and skip primitive .* same lengths"),
        (([[0], [1, 1], [1]], [[0], [1], [1, 1]]), ValueError, r"skip geometry\[1\] has 2 ids, skip primitive\[1\] 1"),
        (([0, 1, 2], 0, [0, 1]), ValueError, r"skip offsets.*\(4,\).*\(3,\)"),
        (([0, 9, 1, 2], 0, [0, 1]), ValueError, r"skip offsets\[2\] is 1, below the 9 before it"),
        (([-1, 0, 1, 2], 0, [0, 1]), ValueError, r"skip offsets\[0\] is -1"),
        (([0, 0, 1, 3], 0, [0, 1]), ValueError, r"skip offsets\[3\] is 3, and there are 2 ids"),
        (([0, 0, 1, 2**64 - 1], 0, [0, 1]), TypeError, "skip offsets"),
        (
            (np.array([0, 0, 1, 2**64 - 1], np.uint64), 0, [0, 1]),
            ValueError,
            r"skip offsets\[3\] is 18446744073709551615",
        ),
        (([0.0, 0, 1, 2], 0, [0, 1]), TypeError, "skip offsets has to hold whole numbers"),
        (([0, 0, 1, 2], [0, 0, 0], [0, 1]), ValueError, r"skip geometry has to have the shape \(2,\), not \(3,\)"),
        (([0, 0, 1, 2], 0, [[0, 1]]), ValueError, r"skip primitive has to have the shape \(n,\)"),
    ],
)
def test_a_list_that_does_not_fit_is_named(
    stack: raywise.Scene, question: str, skip: Any, error: "type[Exception]", words: str
) -> None:
    with pytest.raises(error, match=words):
        ask(stack, question, THREE, skip)


def test_lists_for_an_image_have_to_be_arrays(stack: raywise.Scene) -> None:
    image = np.tile(DOWN[0], (1, 2, 1)), np.array(DOWN[1])
    with pytest.raises(ValueError, match=r"rays of shape \(n,\), not \(1, 2\)"):
        stack.intersect(*image, skip=[[0, 1], [0]])


def test_answers_without_ids_are_no_list(stack: raywise.Scene) -> None:
    with pytest.raises(ValueError, match="these Hits lack geometry"):
        stack.intersect(*THREE, skip=stack.intersect(*THREE, want=["t", "primitive"]))
    with pytest.raises(ValueError, match="these AllHits lack primitive"):
        stack.intersect(*THREE, skip=stack.intersect_all(*THREE, want=["geometry"]))
    with pytest.raises(ValueError, match=r"primitive of shape \(2,\)"):
        stack.intersect(*THREE, skip=stack.intersect(THREE[0][:2], THREE[1]))
