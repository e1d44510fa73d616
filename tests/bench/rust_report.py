"""Collects what criterion left behind: rust_report.py CRITERION_FOLDER BENCH_JSON OUT_JSON COMMIT COMMAND

Writes the report of make bench-rust, in the form of the other reports, and prints a table. The machine is taken from BENCH_JSON,
the report of make bench, where there is one.
"""

import json
import math
import sys
from datetime import datetime, timezone
from pathlib import Path

OURS = "raywise bvh"


def read(folder):
    """(scene, what) -> subject -> (rate, unit)."""
    cells = {}
    for told in sorted(folder.glob("*/*/new/benchmark.json")):
        benchmark = json.loads(told.read_text())
        estimates = json.loads(told.with_name("estimates.json").read_text())
        ns = estimates["median"]["point_estimate"]
        elements = benchmark["throughput"]["Elements"]
        scene, what = benchmark["group_id"].split("/")
        cells.setdefault((scene, what), {})[benchmark["function_id"]] = (ns, elements)
    return cells


def rows_of(cells):
    rows = []
    for (scene, what), subjects in cells.items():
        building = what == "build"

        def value(subject):
            ns, elements = subjects[subject]
            return ns * 1e-6 if building else 1e3 * elements / ns

        def ratio(other):
            return value(other) / value(OURS) if building else value(OURS) / value(other)

        peers = [subject for subject in subjects if subject != OURS]
        if OURS not in subjects or not peers:
            continue
        best = min(peers, key=ratio)
        for peer in peers:
            rows.append(
                {
                    "section": "build" if building else "single",
                    "scene": scene,
                    "rays": "" if building else what,
                    "query": "build" if building else ("any" if what == "shadow" else "closest"),
                    "count": subjects[OURS][1],
                    "threads": 1,
                    "unit": "ms" if building else "Mray/s",
                    "subject": OURS,
                    "value": value(OURS),
                    "peer": peer,
                    "peer_value": value(peer),
                    "ratio": ratio(peer),
                    "best_peer": peer == best,
                }
            )
    return rows


def summary_of(rows):
    summary = {}
    for key in ("single", "build"):
        best = [row for row in rows if row["section"] == key and row["best_peer"]]
        if not best:
            continue
        worst = min(best, key=lambda row: row["ratio"])
        summary[key] = {
            "geomean": math.exp(sum(math.log(row["ratio"]) for row in best) / len(best)),
            "worst": worst["ratio"],
            "worst_scene": f"{worst['scene']}, {worst['rays'] or 'build'}",
        }
    return summary


def show(rows):
    print("\nBeside Rust crates, single calls, 1 thread: Mray/s, or ms to build; above 1 is better")
    print(f"{'scene':<12}  {'':<8}  {OURS:>12}  {'best peer':>12}  {'':<14}  {'ratio':>6}")
    for row in rows:
        if row["best_peer"]:
            what = row["rays"] or "build"
            print(
                f"{row['scene']:<12}  {what:<8}  {row['value']:>12.3g}  {row['peer_value']:>12.3g}  {row['peer']:<14}  "
                f"{row['ratio']:>6.2f}"
            )


def main():
    if len(sys.argv) != 6:
        print(__doc__)
        return 0 if "--help" in sys.argv else 2
    rows = rows_of(read(Path(sys.argv[1])))
    if not rows:
        print(f"{sys.argv[1]}: nothing was measured", file=sys.stderr)
        return 1
    other = Path(sys.argv[2])
    report = {
        "target": "bench-rust",
        "machine": json.loads(other.read_text())["machine"] if other.is_file() else None,
        "commit": sys.argv[4],
        "date": datetime.now(timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
        "command": sys.argv[5],
        "rows": rows,
        "summary": summary_of(rows),
    }
    Path(sys.argv[3]).write_text(json.dumps(report, indent=2) + "\n")
    show(rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
