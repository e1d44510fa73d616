"""Many threads on one scene."""

from __future__ import annotations

import concurrent.futures
import multiprocessing
import sys
import threading
from typing import Any

import pytest
from samples import bits, rays, same_bits, soup, sphere

import raywise


def test_threads_share_a_scene(structure: str) -> None:
    scene = raywise.Scene(*soup(5, 300), structure=structure)
    batches = [rays(seed, 300) for seed in range(12)]
    expected = [scene.intersect(*batch) for batch in batches]
    expected_all = [scene.intersect_all(*batch) for batch in batches]

    def work(index: int) -> None:
        origins, directions = batches[index % len(batches)]
        same_bits(scene.intersect(origins, directions, threads=1 + index % 3), expected[index % len(batches)])
        same_bits(scene.intersect_all(origins, directions), expected_all[index % len(batches)])
        single = scene.intersect(origins[index], directions[index])
        assert bits(single.t) == bits(expected[index % len(batches)].t[index])

    with concurrent.futures.ThreadPoolExecutor(8) as pool:
        for future in [pool.submit(work, index) for index in range(48)]:
            future.result()


def test_threads_share_a_view() -> None:
    scene = raywise.Scene(*sphere(32, 64))
    view = scene.view(origin=[0, 0, 4], expected_rays=1e6)
    directions = rays(3, 400)[1]
    expected = scene.intersect([0, 0, 4], directions)
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for hits in pool.map(lambda _: view.intersect([0, 0, 4], directions), range(12)):
            same_bits(hits, expected)


def test_each_thread_has_its_own_error_message() -> None:
    barrier = threading.Barrier(4)

    def fail(index: int) -> str:
        barrier.wait(60)
        for _ in range(50):
            with pytest.raises(raywise.UnknownStructure) as caught:
                raywise.Scene(structure=f"thread_{index}_")
            assert f"thread_{index}_" in str(caught.value)
        return "done"

    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        assert list(pool.map(fail, range(4))) == ["done"] * 4


def test_closing_while_others_ask_is_safe() -> None:
    origins, directions = rays(3, 2000)
    for _ in range(10):
        scene = raywise.Scene(*soup(5, 300), structure="bvh")
        expected = scene.intersect(origins, directions)
        started = threading.Barrier(4)

        def ask(scene: raywise.Scene = scene, expected: Any = expected, started: Any = started) -> None:
            started.wait(60)
            try:
                while True:
                    same_bits(scene.intersect(origins, directions), expected)
            except raywise.ClosedError:
                pass

        with concurrent.futures.ThreadPoolExecutor(3) as pool:
            futures = [pool.submit(ask) for _ in range(3)]
            started.wait(60)
            scene.close()
            for future in futures:
                future.result()


def test_scenes_are_built_in_threads() -> None:
    def build(seed: int) -> raywise.Hits:
        with raywise.Scene(*soup(seed, 200)) as scene:
            return scene.intersect(*rays(seed, 100))

    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for seed, hits in enumerate(pool.map(build, range(12))):
            same_bits(hits, build(seed))


def ask_in_child(queue: Any, scene: raywise.Scene, origins: Any, directions: Any) -> None:
    queue.put(bits(scene.intersect(origins, directions).t))


@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
@pytest.mark.skipif(sys.platform == "win32", reason="there is no fork")
def test_a_scene_answers_after_a_fork() -> None:
    scene = raywise.Scene(*soup(5, 300), structure="bvh")
    origins, directions = rays(3, 20_000)
    expected = bits(scene.intersect(origins, directions).t)
    context = multiprocessing.get_context("fork")
    queue = context.Queue()
    child = context.Process(target=ask_in_child, args=(queue, scene, origins, directions))
    child.start()
    try:
        assert queue.get(timeout=60) == expected
        child.join(60)
        assert child.exitcode == 0
    finally:
        if child.is_alive():
            child.kill()
