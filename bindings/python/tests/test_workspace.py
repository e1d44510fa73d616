"""Workspaces: the same answers, from memory that stays."""

import threading

import numpy as np
import pytest

import raywise


def scene_and_rays():
    random = np.random.default_rng(7)
    corners = random.uniform(-1, 1, (3000, 1, 3)) + random.uniform(-0.05, 0.05, (3000, 3, 3))
    scene = raywise.Scene(corners.reshape(-1, 3).astype(np.float32), np.arange(9000).reshape(-1, 3))
    origins = random.uniform(-2, 2, (20000, 3))
    return scene, origins, random.uniform(-1, 1, (20000, 3))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_answers_are_those_without(dtype: type) -> None:
    scene, origins, directions = scene_and_rays()
    origins, directions = origins.astype(dtype), directions.astype(dtype)
    with raywise.Workspace() as workspace:
        for _ in range(3):
            kept = scene.intersect(origins, directions, workspace=workspace)
            own = scene.intersect(origins, directions)
            for name in ("t", "uv", "normal", "primitive"):
                assert np.array_equal(getattr(kept, name), getattr(own, name))
            assert np.array_equal(
                scene.occluded(origins, directions, workspace=workspace), scene.occluded(origins, directions)
            )
            every = scene.intersect_all(origins[:500], directions[:500], workspace=workspace)
            assert np.array_equal(every.offsets, scene.intersect_all(origins[:500], directions[:500]).offsets)
    with pytest.raises(raywise.ClosedError):
        scene.intersect(origins, directions, workspace=workspace)


def test_two_batches_at_once_are_refused_or_right() -> None:
    scene, origins, directions = scene_and_rays()
    wanted = scene.occluded(origins, directions)
    workspace = raywise.Workspace()
    refused, right = [], []

    def ask() -> None:
        for _ in range(50):
            try:
                right.append(np.array_equal(scene.occluded(origins, directions, workspace=workspace), wanted))
            except raywise.InUse as error:
                assert "workspace" in str(error)
                refused.append(error)

    threads = [threading.Thread(target=ask) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(refused) + len(right) == 150
    assert all(right) and right
