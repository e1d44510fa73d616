"""Names the wheel's platform when libraywise.so.1 was put into the package; one wheel serves every Python 3."""

from __future__ import annotations

import pathlib
import sysconfig
from typing import Any, Dict

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class PlatformTag(BuildHookInterface):  # type: ignore[type-arg]
    def initialize(self, version: str, build_data: Dict[str, Any]) -> None:
        if (pathlib.Path(self.root) / "raywise" / "libraywise.so.1").is_file():
            platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
            build_data["pure_python"] = False
            build_data["tag"] = f"py3-none-{platform}"
