"""Tests of bench_python.py with raywise alone, on a scene of a few triangles. Needs raywise and NumPy.

Run as a program: python3 bench_python_test.py
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from agreement import compare_hits
from cells import Row, cells_of, summary_of
from kinds import RAY_KINDS
from libraries.library import hits_of
from tables import notes, rays_text, totals_text

PROGRAM = Path(__file__).with_name("bench_python.py")
RAYS_NAMES = ["raywise", "t,uv,id", "embreex", "Open3D", "tri+emb", "trimesh"]
NAMES = ["raywise", "t,uv,id", "once", "embreex", "Open3D", "tri+emb", "trimesh"]


def write_scene(path: Path, rays: int) -> None:
    """A square of two triangles, and rays from above, half of which hit it; as tests/bench/export_scene.cpp writes."""
    corners = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], np.float32)
    origins = np.full((rays, 3), 0.25, np.float32)
    origins[::2, 0] = 2.0
    down = np.tile(np.array([0, 0, -1], np.float32), (rays, 1))
    arrays = [corners, np.array([[0, 1, 2], [0, 2, 3]], np.uint32)]
    for _ in RAY_KINDS:
        arrays += [origins, down, np.zeros(rays, np.float32), np.full(rays, np.inf, np.float32)]
    with open(path, "wb") as file:
        for array in arrays:
            file.write(np.uint64(array.size).tobytes() + array.tobytes())


def row(section: str, library: str, value: float, asked: int = 1_000_000) -> Row:
    return Row(
        section=section,
        scene="dragonfly",
        triangles=871_414,
        rays="random",
        query="closest",
        count=1_000_000,
        asked=asked,
        unit="ms" if section == "total" else "Mray/s",
        library=library,
        value=value,
        fastest=value,
        spread=0.0,
        repetitions=5,
        busy_threads=1.0,
        structure="two_level_grid",
        hit_rate=0.5,
        differing_hits=0,
        differing_t=0,
        differing_primitives=0,
    )


class Program(unittest.TestCase):
    def run_program(self, *arguments: str) -> "subprocess.CompletedProcess[str]":
        return subprocess.run([sys.executable, str(PROGRAM), *arguments], capture_output=True, text=True)

    def test_measures_raywise_and_names_who_is_absent(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            report_file = Path(folder) / "reports" / "report.json"
            write_scene(Path(folder) / "square.scene", 200)
            done = self.run_program(
                folder, "--scene", "square,cube", "--quick", "--repetitions", "1", "--json", str(report_file)
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("square", done.stdout)
            self.assertIn("left out: scene cube", done.stdout)
            report = json.loads(report_file.read_text())
        ours = [row for row in report["rows"] if row["library"] == "raywise"]
        self.assertEqual({row["section"] for row in ours}, {"rays", "total"})
        self.assertEqual({row["hit_rate"] for row in ours if row["section"] == "rays"}, {0.5})
        self.assertIn("once", {row["library"] for row in report["rows"]})

    def test_refuses_what_it_does_not_know(self) -> None:
        for arguments in (["--rays", "cosmic"], ["--count", "0"], ["--threads", "3"]):
            done = self.run_program("nowhere", *arguments)
            self.assertEqual(done.returncode, 2)
            self.assertIn("usage:", done.stderr)

    def test_has_the_scenes_written_and_says_where_that_fails(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_program(folder, "--scene", "square", "--", sys.executable, "-c", "import sys; sys.exit(3)")
        self.assertEqual(done.returncode, 2)
        self.assertIn("could not be written", done.stderr)
        self.assertIn("--export-rays", done.stderr)

    def test_says_that_there_are_no_scenes(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_program(folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("no such scenes", done.stderr)


class Agreement(unittest.TestCase):
    def test_one_ray_in_a_thousand_may_differ(self) -> None:
        t = np.linspace(1.0, 2.0, 5000)
        everything = hits_of(t, np.arange(5000), np.ones(5000, bool), None)
        for missing, too_much in ((5, False), (6, True)):
            hit = np.arange(5000) >= missing
            difference = compare_hits(everything, hits_of(t, np.arange(5000), hit, None))
            self.assertEqual((difference.hit, difference.too_much), (missing, too_much))

    def test_distances_count_and_triangles_do_not(self) -> None:
        t = np.ones(1000)
        one = hits_of(t, np.zeros(1000), np.ones(1000, bool), None)
        self.assertFalse(compare_hits(one, hits_of(t, np.ones(1000), np.ones(1000, bool), None)).too_much)
        self.assertTrue(compare_hits(one, hits_of(t + 0.1, np.zeros(1000), np.ones(1000, bool), None)).too_much)


class Tables(unittest.TestCase):
    def test_fit_into_100_columns(self) -> None:
        rows = [row("rays", name, 123.456) for name in RAYS_NAMES[:-1]]
        rows += [row("total", name, 123.456) for name in NAMES[:-1]]
        rows += [row("rays", "trimesh", 0.00002, 20), row("total", "trimesh", 5.9e7, 20)]
        cells = cells_of(rows)
        text = rays_text(cells, RAYS_NAMES) + totals_text(cells, NAMES) + "\n".join(notes(cells, "all"))
        self.assertLessEqual(max(len(line) for line in text.splitlines()), 100, text)
        self.assertIn("20/s*", text)
        self.assertIn("16.4 h*", text)

    def test_ratios_are_above_one_where_raywise_is_faster(self) -> None:
        rows = [row("rays", "raywise", 2.0), row("rays", "embreex", 1.0), row("rays", "t,uv,id", 9.0)]
        rows += [row("total", "raywise", 2.0), row("total", "embreex", 1.0), row("total", "Open3D", 8.0)]
        summary = summary_of(cells_of(rows))
        self.assertEqual(summary["rays"]["geomean"], 2.0)
        self.assertEqual(summary["total"]["worst"], 0.5)
        self.assertEqual([r.library for r in rows if r.best_peer], ["embreex", "embreex"])


if __name__ == "__main__":
    unittest.main()
