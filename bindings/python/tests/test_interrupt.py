"""Ctrl-C and other signals during a batch."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from typing import Any, Iterator

import numpy as np
import pytest
from samples import rays, soup

import raywise

# A batch that takes minutes where nothing ends it: the linear scan looks at every triangle for every ray.
PROGRAM = """
import sys
import numpy as np
import raywise
from samples import rays, soup

scene = raywise.Scene(*soup(5, 3000), structure="linear_scan")
ray = rays(6, 400)
expected = scene.intersect(*ray)
origins, directions = (np.tile(part, (10000, 1)) for part in ray)
out = {"t": np.full(len(origins), -7.0), "normal": np.full((len(origins), 3), -7.0)}
print("ready", flush=True)
try:
    scene.intersect(origins, directions, out=out, threads=int(sys.argv[1]))
except KeyboardInterrupt:
    written = out["t"] != -7.0
    right = np.tile(expected.t, 10000)[written] == out["t"][written]
    assert 0 < written.sum() < len(written) and right.all()
    normals = np.tile(expected.normal, (10000, 1))[out["normal"][:, 0] != -7.0]
    assert (out["normal"][out["normal"][:, 0] != -7.0] == normals).all()
    again = scene.intersect(*ray)
    assert (again.t == expected.t).all()
    print("interrupted", flush=True)
"""


@pytest.mark.parametrize("threads", [0, 1])
def test_ctrl_c_ends_a_batch_with_everything_intact(threads: int) -> None:
    environment = dict(os.environ, PYTHONPATH=os.pathsep.join([os.path.dirname(__file__), *sys.path]))
    with subprocess.Popen(
        [sys.executable, "-c", PROGRAM, str(threads)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=environment,
    ) as child:
        assert child.stdout is not None
        assert child.stdout.readline() == "ready\n"
        time.sleep(0.5)  # until the batch has begun; a signal before it would end it with nothing written
        child.send_signal(signal.SIGINT)
        output, errors = child.communicate(timeout=60)
    assert (output, errors, child.returncode) == ("interrupted\n", "", 0)


class Alarm(Exception):
    """What the handler raises."""


@pytest.fixture
def alarm() -> Iterator[None]:
    """SIGALRM every millisecond; its handler raises the first time."""
    raised = []

    def handler(number: int, frame: Any) -> None:
        if not raised:
            raised.append(number)
            raise Alarm

    before = signal.signal(signal.SIGALRM, handler)
    yield
    signal.setitimer(signal.ITIMER_REAL, 0)
    signal.signal(signal.SIGALRM, before)


def slow_batch() -> "tuple[raywise.Scene, Any, Any]":
    scene = raywise.Scene(*soup(5, 3000), structure="linear_scan")
    origins, directions = (np.tile(part, (20000, 1)) for part in rays(6, 400))
    return scene, origins, directions


@pytest.mark.parametrize("name", ["intersect", "occluded", "intersect_all"])
def test_what_a_signal_handler_raises_comes_out_of_the_batch(name: str, alarm: None) -> None:
    scene, origins, directions = slow_batch()
    signal.setitimer(signal.ITIMER_REAL, 0.05)
    with pytest.raises(Alarm):
        getattr(scene, name)(origins, directions)
    assert scene.intersect(origins[:10], directions[:10]).t.shape == (10,)


def test_one_shot_calls_are_interrupted_as_well(alarm: None) -> None:
    _, origins, directions = slow_batch()
    signal.setitimer(signal.ITIMER_REAL, 0.05)
    with pytest.raises(Alarm):
        raywise.intersect_once(soup(5, 3000), origins, directions, structure="linear_scan")


def test_handlers_that_do_not_raise_run_while_a_batch_goes_on() -> None:
    scene = raywise.Scene(*soup(5, 3000), structure="linear_scan")
    origins, directions = (np.tile(part, (200, 1)) for part in rays(6, 400))
    expected = scene.intersect(origins, directions)
    calls = []
    before = signal.signal(signal.SIGALRM, lambda number, frame: calls.append(threading.current_thread()))
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.001, 0.001)
        found = scene.intersect(origins, directions)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    np.testing.assert_array_equal(found.t, expected.t)
    assert set(calls) == {threading.main_thread()}


def test_other_threads_are_not_disturbed() -> None:
    scene = raywise.Scene(*soup(5, 300))
    origins, directions = rays(6, 4000)
    expected = scene.intersect(origins, directions)
    found = []
    thread = threading.Thread(target=lambda: found.append(scene.intersect(origins, directions)))
    thread.start()
    thread.join()
    np.testing.assert_array_equal(found[0].t, expected.t)
