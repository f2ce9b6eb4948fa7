"""Build and install third-party packages for tests."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
import zipfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from warm import PROGRAM, Warm

PYPROJECT = """
[build-system]
requires = ["hatchling"]
build-backend = "hatchling.build"

[project]
name = "{name}"
version = "{version}"

[project.entry-points."lambda_bearing.plugins"]
main = "{module}"

[tool.hatch.build.targets.wheel]
packages = ["{module}"]
"""


def write_package(root: Path, name: str, code: str, version: str = "0.3") -> Path:
    """Write a small plugin package.

    Return the folder of its sources.
    """
    folder, module = root / name, name.replace("-", "_")
    (folder / module).mkdir(parents=True)
    (folder / "pyproject.toml").write_text(PYPROJECT.format(name=name, version=version, module=module))
    (folder / module / "__init__.py").write_text(code)
    return folder


def pip_install(target: Path, sources: Sequence[Path]) -> None:
    """Install local packages into a folder.

    Without network and without their dependencies.
    """
    command = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation", "--no-index"]
    done = subprocess.run(
        [*command, "--target", str(target), *map(str, sources)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


def unpack(target: Path, sources: Sequence[Path]) -> None:
    """Build local packages and unpack them.

    Into a folder, as pip does with wheels of Python alone.
    """
    from hatchling.build import build_wheel

    for source in sources:
        with contextlib.chdir(source):
            wheel = build_wheel(str(target))
        with zipfile.ZipFile(target / wheel) as archive:
            archive.extractall(target)
        (target / wheel).unlink()


@dataclass(frozen=True)
class Answer:
    """Answer of the program."""

    code: int
    out: str
    err: str

    @property
    def data(self) -> Any:
        return json.loads(self.out)


@dataclass(frozen=True)
class Installation:
    """A folder with installed third-party packages, seen by new processes."""

    path: str  # where Python finds them
    warm: Warm

    def python(self, code: str, *arguments: str, **environment: str) -> Answer:
        """Run Python code in a new process.

        It sees the packages.
        """
        env = os.environ | {"PYTHONPATH": self.path} | environment
        done = subprocess.run(
            [sys.executable, "-c", code, *arguments], env=env, capture_output=True, text=True, check=False
        )
        assert "Traceback" not in done.stderr, done.stderr
        return Answer(done.returncode, done.stdout, done.stderr)

    def program(self, *arguments: str, **environment: str) -> Answer:
        """Run ``lambda-bearing`` in its own process.

        It sees the packages.
        """
        return self.forked(PROGRAM, *arguments, **environment)

    def forked(self, code: str, *arguments: str, **environment: str) -> Answer:
        """Run Python code in a forked process.

        It begins with everything imported.
        """
        process = self.warm.start(code, *arguments, env={"PYTHONPATH": self.path} | environment)
        out, said = process.communicate()
        assert "Traceback" not in said, said
        return Answer(process.returncode, out, said)


@pytest.fixture(scope="session")
def install(tmp_path_factory: pytest.TempPathFactory, warm: Warm) -> Callable[..., Installation]:
    """Install packages into a new folder.

    Built and unpacked, or as `how` has it.
    """

    def installed(sources: Sequence[Path], how: Callable[[Path, Sequence[Path]], None] = unpack) -> Installation:
        target = tmp_path_factory.mktemp("site")
        how(target, sources)
        path = os.pathsep.join([str(target), *filter(None, [os.environ.get("PYTHONPATH")])])
        return Installation(path, warm)

    return installed
