"""What has been measured: a row for each library in each cell of a table."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Dict, Iterable, List, Optional, Tuple

from libraries import OURS

# Of raywise too; they are nobody's peers.
OUR_NAMES = ("raywise", "t,uv,id", "once")


@dataclass
class Row:
    section: str  # rays or total
    scene: str
    triangles: int
    rays: str
    query: str
    count: int  # rays of the cell
    asked: int  # rays that were asked; fewer than `count` of a slow library
    unit: str  # Mray/s, or ms
    library: str
    value: float  # the median
    fastest: float
    spread: float
    repetitions: int
    busy_threads: float
    structure: str
    hit_rate: float
    differing_hits: int  # rays about which it and raywise disagree, as are the next two
    differing_t: int
    differing_primitives: int
    ratio: Optional[float] = None  # raywise over this one as rates: above 1 raywise wins
    best_peer: bool = False


Key = Tuple[str, str, str, str, int]
Cells = Dict[Key, Dict[str, Row]]


def cells_of(rows: Iterable[Row]) -> Cells:
    """Rows by cell and library, with their ratios."""
    cells: Cells = {}
    for row in rows:
        key = (row.section, row.scene, row.rays, row.query, row.count)
        cells.setdefault(key, {})[row.library] = row
    for cell in cells.values():
        ours = cell[OURS]
        for row in cell.values():
            row.ratio = ours.value / row.value if row.unit == "Mray/s" else row.value / ours.value
        best = best_peer(cell)
        if best:
            best.best_peer = True
    return cells


def best_peer(cell: Dict[str, Row]) -> Optional[Row]:
    """The one beside which raywise does worst."""
    peers = [row for row in cell.values() if row.library not in OUR_NAMES]
    return min(peers, key=lambda row: row.ratio or math.inf, default=None)


def best_ratios(cells: Cells, section: str) -> List[Tuple[float, Row]]:
    best = (best_peer(cell) for key, cell in cells.items() if key[0] == section)
    return [(row.ratio, row) for row in best if row is not None and row.ratio is not None]


def summary_of(cells: Cells) -> Dict[str, Dict[str, object]]:
    """By section, as in the other reports."""
    summary: Dict[str, Dict[str, object]] = {}
    for section in ("rays", "total"):
        ratios = best_ratios(cells, section)
        if not ratios:
            continue
        worst, row = min(ratios, key=lambda ratio: ratio[0])
        summary[section] = {
            "geomean": math.exp(sum(math.log(ratio) for ratio, _ in ratios) / len(ratios)),
            "worst": worst,
            "worst_scene": f"{row.scene}, {row.count:,} {row.rays} rays, {row.library}",
        }
    return summary
