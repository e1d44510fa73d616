"""Committing: progress, cancelling, exceptions in callbacks, and who may do what meanwhile."""

from __future__ import annotations

import contextlib
import itertools
import threading
from typing import List, Tuple

import numpy as np
import pytest
from samples import rays, same_bits, sphere

import raywise

MESH = sphere(64, 128)


def filled(structure: str) -> raywise.Scene:
    scene = raywise.Scene(structure=structure)
    scene.add_triangles(*MESH)
    return scene


class Trouble(Exception):
    """Raised by callbacks of these tests."""


def test_progress_is_told_in_fractions_and_stages(structure: str) -> None:
    told: List[Tuple[float, str]] = []
    filled(structure).commit(progress=lambda fraction, stage: told.append((fraction, stage)))
    assert told
    assert all(0 <= fraction <= 1 for fraction, _ in told)
    assert all(isinstance(stage, str) and stage for _, stage in told)


def test_a_true_result_cancels_and_the_scene_can_be_committed_again(structure: str) -> None:
    scene = filled(structure)
    with pytest.raises(raywise.Cancelled):
        scene.commit(progress=lambda fraction, stage: True)
    assert not scene.committed
    with pytest.raises(raywise.NotCommitted):
        scene.intersect([0, 0, 3], [0, 0, -1])
    assert scene.add_triangles([[0, 0, 2], [1, 0, 2], [0, 1, 2]], [[0, 1, 2]]) == 1
    scene.commit(progress=lambda fraction, stage: False)
    assert scene.intersect([0.2, 0.2, 3], [0, 0, -1]).geometry == 1


def test_a_cancelled_commit_leaves_no_trace_in_the_answers(structure: str) -> None:
    cancelled, straight = filled(structure), filled(structure)
    for calls_before_stopping in range(3):
        if not cancelled.committed:  # a build that tells less often than that is through
            answers = itertools.chain(itertools.repeat(False, calls_before_stopping), itertools.repeat(True))
            with contextlib.suppress(raywise.Cancelled):
                cancelled.commit(progress=lambda fraction, stage, answers=answers: next(answers))
    if not cancelled.committed:
        cancelled.commit()
    straight.commit()
    same_bits(cancelled.intersect(*rays(3, 500)), straight.intersect(*rays(3, 500)))


@pytest.mark.parametrize("error", [Trouble("in the callback"), KeyboardInterrupt(), SystemExit(3)])
def test_what_a_callback_raises_comes_out_of_commit(structure: str, error: BaseException) -> None:
    calls = []

    def progress(fraction: float, stage: str) -> None:
        calls.append(fraction)
        raise error

    scene = filled(structure)
    with pytest.raises(type(error)) as caught:
        scene.commit(progress=progress)
    assert caught.value is error
    assert len(calls) == 1
    if not scene.committed:
        scene.commit()
    assert scene.intersect([0.1, 0.2, 3], [0, 0, -1]).hit


def test_an_exception_of_the_callback_leaves_a_new_scene_behind_closed() -> None:
    def progress(fraction: float, stage: str) -> None:
        raise Trouble

    with pytest.raises(Trouble):
        raywise.Scene(*MESH, progress=progress)


def test_progress_has_to_be_callable() -> None:
    with pytest.raises(TypeError, match="progress"):
        raywise.Scene(*MESH, progress=5)  # type: ignore[arg-type]


def test_the_callback_may_use_other_scenes() -> None:
    other = raywise.Scene(*sphere())
    seen = []
    filled("bvh").commit(progress=lambda f, s: seen.append(bool(other.occluded([0, 0, 3], [0, 0, -1]))))
    assert seen and all(seen)


def test_the_callback_may_not_change_its_own_scene() -> None:
    scene = filled("bvh")

    def progress(fraction: float, stage: str) -> None:
        scene.add_triangles(*MESH)

    with pytest.raises(raywise.SceneBusy):
        scene.commit(progress=progress)


def test_closing_the_scene_from_the_callback_takes_effect_afterwards() -> None:
    scene = filled("bvh")
    scene.commit(progress=lambda fraction, stage: scene.close())
    assert scene.closed


def test_a_second_thread_cannot_commit_at_the_same_time() -> None:
    scene = filled("bvh")
    inside, may_go_on = threading.Event(), threading.Event()

    def progress(fraction: float, stage: str) -> None:
        inside.set()
        may_go_on.wait(60)

    thread = threading.Thread(target=lambda: scene.commit(progress=progress))
    thread.start()
    try:
        assert inside.wait(60)
        with pytest.raises(raywise.SceneBusy):
            scene.commit()
        with pytest.raises(raywise.NotCommitted):
            scene.intersect([0, 0, 3], [0, 0, -1])
    finally:
        may_go_on.set()
        thread.join()
    assert scene.committed


@pytest.mark.parametrize("threads", [1, 2, 7])
def test_the_threads_of_a_commit_do_not_change_answers(structure: str, threads: int) -> None:
    scene, straight = filled(structure), filled(structure)
    scene.commit(threads=threads)
    straight.commit()
    same_bits(scene.intersect(*rays(4, 300)), straight.intersect(*rays(4, 300)))


def test_the_structure_can_be_chosen_again() -> None:
    scene = filled("bvh")
    scene.set_structure("linear_scan")
    scene.set_structure(None)
    scene.commit()
    assert scene.structure in raywise.structures()
    assert not any(candidate.forced for candidate in scene.candidates)


def test_numbers_of_numpy_are_numbers() -> None:
    scene = raywise.Scene(
        *MESH, expected_rays=np.int64(9), memory_limit=np.uint64(1 << 40), threads=np.uint8(1), time_limit=np.float32(1)
    )
    assert scene.committed
