"""Install laws that misbehave for the tests' processes."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

LAWS = """
import math
from lambda_core.plugins import law


@law("damping", "endless", role_api=3, reference="none: made to misbehave")
def endless(delta, delta_dot, load, par, out):
    out[0] = 0.0
    while math.exp(1e4 + out[0]) > 1.0:  # endless in machine code alone: Python's own raises
        out[0] = 0.5 * out[0]
    return 1


@law("fluid_drag", "lurking", role_api=3, reference="none: made to misbehave")
def lurking(v_orbit, omega_spin, azimuth, nu, rho, par, out):
    out[0] = 0.0
    out[1] = 0.0
    if -3.375 < azimuth * azimuth * azimuth < -3.308:  # no ball stands there at the start, and no check looks there
        while out[0] < 1.0:
            out[0] = 0.5 * out[0]
    return 1
"""
METADATA = "Metadata-Version: 2.1\nName: looping\nVersion: 1.0\n"


@pytest.fixture(scope="session")
def misbehaving(tmp_path_factory: pytest.TempPathFactory) -> Mapping[str, str]:
    """Return an environment with ``looping``.

    A process sees the package.
    """
    site = tmp_path_factory.mktemp("site")
    (site / "looping.py").write_text(LAWS, encoding="utf-8")
    record = site / "looping-1.0.dist-info"
    record.mkdir()
    (record / "METADATA").write_text(METADATA, encoding="utf-8")
    (record / "entry_points.txt").write_text("[lambda_bearing.plugins]\nmain = looping\n", encoding="utf-8")
    return {"PYTHONPATH": os.pathsep.join([str(site), *filter(None, [os.environ.get("PYTHONPATH")])])}


@pytest.fixture
def program(tmp_path: Path) -> Callable[..., subprocess.Popen[str]]:
    """Start ``lambda-bearing`` here.

    In a process of its own, in the folder of this test.
    """

    def start(*arguments: str, env: Mapping[str, str] | None = None) -> subprocess.Popen[str]:
        return subprocess.Popen(
            [sys.executable, "-m", "lambda_cli", *arguments],
            cwd=tmp_path, env=os.environ | dict(env or {}), text=True,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        )  # fmt: skip

    return start
