"""Has raywise_bench write the scenes. Apart from what reads them: NumPy must not be loaded yet."""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import Sequence


def export(command: Sequence[str], folder: Path, scenes: Sequence[str], rays: int) -> None:
    """Files of other runs go first: one that is not written must not be found."""
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.scene"):
        old.unlink()
    asked = ["--scene", ",".join(scenes), "--export", str(folder), "--export-rays", str(rays)]
    subprocess.run([*command, *asked], check=True)
