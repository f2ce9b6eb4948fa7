"""Build wheels with machine code of solver and laws.

This file is both the build backend, hatchling's with more requirements for a wheel, and its hook. A wheel takes a pack
where the compiler is there: Numba and the other dependencies of the program, and a C compiler. Otherwise it has none,
and the program compiles where it is installed. An sdist and an editable install never have one.
LAMBDA_BEARING_PACK=0 leaves it out, and then nothing but hatchling is needed.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path
from typing import Any

from hatchling.build import (
    build_editable,
    build_sdist,
    build_wheel,
    get_requires_for_build_editable,
    get_requires_for_build_sdist,
)
from hatchling.builders.hooks.plugin.interface import BuildHookInterface

__all__ = [
    "PackHook",
    "build_editable",
    "build_sdist",
    "build_wheel",
    "get_requires_for_build_editable",
    "get_requires_for_build_sdist",
    "get_requires_for_build_wheel",
]
VARIABLE = "LAMBDA_BEARING_PACK"
ROOT = Path(__file__).parent
HOMES = (".", "plugins", "db", "gui", "cli")


def is_wanted() -> bool:
    """Tell whether wheels take a pack."""
    return os.environ.get(VARIABLE, "1") != "0"


def get_requires_for_build_wheel(config_settings: dict[str, Any] | None = None) -> list[str]:
    """Return the requirements of a wheel's build.

    In addition to hatchling.
    """
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    return list(project["dependencies"]) if is_wanted() else []


class PackHook(BuildHookInterface):
    """Add the pack to a wheel."""

    PLUGIN_NAME = "custom"

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the pack for a wheel.

        Only where the wheel is not editable.
        """
        if self.target_name != "wheel" or version != "standard" or not is_wanted():
            return
        self._made = tempfile.TemporaryDirectory(prefix="lambda-bearing-pack-")
        paths = [str(ROOT / home) for home in HOMES]
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join([*paths, os.environ.get("PYTHONPATH", "")])}
        command = [sys.executable, "-P", "-W", "ignore", "-m", "lambda_core.export.fmu.pack_builder", self._made.name]
        done = subprocess.run(command, env=environment, stdout=subprocess.DEVNULL, check=False)
        files = sorted(Path(self._made.name).iterdir())
        if done.returncode != 0:
            print(
                "the wheel has no machine code, and the program compiles where it is installed: for machine code, "
                "build where a C compiler and the program's dependencies are",
                file=sys.stderr,
            )
            return
        build_data["force_include"].update({str(file): f"lambda_core/pack/{file.name}" for file in files})

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Drop the files that are in the wheel now."""
        if hasattr(self, "_made"):
            self._made.cleanup()
