"""The tables, within 100 columns."""

from __future__ import annotations

from typing import Dict, List, Sequence

from cells import Cells, Row, best_peer, best_ratios, summary_of
from libraries import OURS

WIDTH = 8  # of a library's column, with the space before it


def rays_text(cells: Cells, libraries: Sequence[str]) -> str:
    """A line for each cell: each library's rate, and the peer beside which raywise does worst."""
    lines = [
        "Rays against a scene that is built: Mray/s; ratio above 1: raywise is faster",
        f"{'scene':<8}{'rays':<7}{'count':>10}{head(libraries)}  best peer",
    ]
    for cell in those_of(cells, "rays"):
        ours, best = cell[OURS], best_peer(cell)
        first = f"{ours.scene:<8.7}{ours.rays:<7}{ours.count:>10,}"
        lines.append(f"{first}{figures(cell, libraries)}  {best.library if best else ''}")
    return ended(lines, cells, "rays")


def totals_text(cells: Cells, libraries: Sequence[str]) -> str:
    """A line for each cell: each library's time, and what raywise chose."""
    lines = [
        "From arrays to answers of random rays, building included: ms; ratio above 1: raywise is faster",
        f"{'scene':<8}{'count':>10}{head(libraries)}  chosen",
    ]
    for cell in those_of(cells, "total"):
        ours = cell[OURS]
        lines.append(f"{ours.scene:<8.7}{ours.count:>10,}{figures(cell, libraries)}  {ours.structure}")
    return ended(lines, cells, "total")


def those_of(cells: Cells, section: str) -> List[Dict[str, Row]]:
    return [cell for key, cell in cells.items() if key[0] == section]


def head(libraries: Sequence[str]) -> str:
    return "".join(f"{name:>{WIDTH}}" for name in libraries) + f"{'ratio':>7}"


def figures(cell: Dict[str, Row], libraries: Sequence[str]) -> str:
    text = ""
    for name in libraries:
        row = cell.get(name)
        text += f"{shown(row) if row else '-':>{WIDTH}}"
    best = best_peer(cell)
    return text + (f"{best.ratio:>7.3g}" if best and best.ratio is not None else f"{'':>7}")


def shown(row: Row) -> str:
    """Three digits; /s for less than 1,000 rays a second; a star where not all rays were asked."""
    mark = "*" if row.asked < row.count else ""
    value = row.value
    if row.unit == "ms" and value >= 1e5:
        return f"{long_time(value)}{mark}"
    if value >= 100:
        return f"{value:,.0f}{mark}"
    if row.unit == "Mray/s" and value < 1e-3:
        return f"{value * 1e6:.0f}/s{mark}"
    return f"{value:.3g}{mark}"


def long_time(ms: float) -> str:
    if ms < 1e6:
        return f"{ms / 1e3:.0f} s"
    return f"{ms / 6e4:.0f} min" if ms < 6e6 else f"{ms / 3.6e6:.1f} h"


def ended(lines: List[str], cells: Cells, section: str) -> str:
    """Nothing where nothing was measured."""
    if not those_of(cells, section):
        return ""
    if best_ratios(cells, section):
        summary = summary_of(cells)[section]
        lines.append(
            f"ratio: {summary['geomean']:.2f} in the geometric mean, at least {summary['worst']:.2f}"
            f" ({summary['worst_scene']})"
        )
    return "\n" + "\n".join(lines) + "\n"


def notes(cells: Cells, threads: str) -> List[str]:
    rows = [row for cell in cells.values() for row in cell.values()]
    lines = [
        "raywise gives all outputs, t,uv,id only those; once: intersect_once, which keeps nothing.",
        "tri+emb: trimesh with embreex. trimesh gives no u and v, and knows no end of a ray, as shadows have.",
    ]
    slow: Dict[str, List[int]] = {}
    for row in rows:
        if row.asked < row.count:
            slow.setdefault(row.library, []).append(row.asked)
    for name, asked in slow.items():
        lines.append(f"* {name}: asked {min(asked):,} to {max(asked):,} of the rays; its ms are reckoned from those.")
    if threads == "all":
        lines.append("threads at work: " + ", ".join(threads_at_work(rows)))
    return lines


def threads_at_work(rows: Sequence[Row]) -> List[str]:
    most: Dict[str, float] = {}
    for row in rows:
        if row.section == "rays":
            most[row.library] = max(most.get(row.library, 0.0), row.busy_threads)
    return [f"{name} {threads:.1f}" for name, threads in most.items()]
