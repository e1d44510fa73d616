"""Tables for a terminal, and the report as JSON."""

import json
from dataclasses import asdict, dataclass
from typing import Optional

OURS = "raywise"


@dataclass
class Row:
    """One library in one cell; ratio: raywise's value over this one's, both as rates, so that above 1 raywise wins."""

    section: str  # rays or total
    scene: str
    rays: str
    query: str
    count: int  # rays that were asked
    library: str
    value: float  # Mray/s, or ms
    unit: str
    structure: str
    ratio: Optional[float] = None


def add_ratios(rows):
    cells = {}
    for row in rows:
        cells.setdefault((row.section, row.scene, row.rays, row.query, cell_count(row)), []).append(row)
    for cell in cells.values():
        ours = next(row for row in cell if row.library == OURS)
        for row in cell:
            faster = ours.value / row.value if row.section == "rays" else row.value / ours.value
            row.ratio = faster
    return cells


def cell_count(row):
    """Totals of different numbers of rays are different cells; rays are rates, whoever was asked fewer."""
    return row.count if row.section == "total" else 0


def best_peer(cell):
    """The peer against which raywise does worst."""
    peers = [row for row in cell if not row.library.startswith(OURS)]
    return min(peers, key=lambda row: row.ratio, default=None)


def geometric_mean(values):
    product = 1.0
    for value in values:
        product *= value ** (1.0 / len(values))
    return product


def table_of(cells, section, title, columns):
    """A line for each cell, a column for each library."""
    width = 12
    lines = ["", title]
    head = f"{'scene':10}{'rays':>9}{'number':>10}"
    lines.append(head + "".join(f"{short(name):>{width}}" for name in columns) + f"{'ratio':>7}")
    ratios = []
    for (of, scene, rays, query, _), cell in cells.items():
        if of != section:
            continue
        by_library = {row.library: row for row in cell}
        text = f"{scene:10}{rays:>9}{by_library[OURS].count:>10,}"
        for name in columns:
            row = by_library.get(name)
            mark = "*" if row and row.count < by_library[OURS].count else ""
            text += f"{number(row.value) + mark if row else '-':>{width}}"
        best = best_peer(cell)
        if best:
            ratios.append(best.ratio)
            text += f"{best.ratio:>7.2f}"
        lines.append(text)
    if ratios:
        lines.append(f"best peer over raywise or its inverse, above 1 raywise wins: {geometric_mean(ratios):.2f}, worst {min(ratios):.2f}")
    return "\n".join(lines)


def short(name):
    return {"raywise t, uv, id": "t, uv, id", "trimesh + embreex": "tri.+embr."}.get(name, name)


def number(value):
    return f"{value:.3g}" if value < 1000 else f"{value:,.0f}"


def write_json(path, facts, rows, warnings, left_out):
    report = dict(facts, rows=[asdict(row) for row in rows], warnings=warnings, left_out=left_out)
    with open(path, "w", encoding="utf-8") as file:
        json.dump(report, file, indent=1)
        file.write("\n")
