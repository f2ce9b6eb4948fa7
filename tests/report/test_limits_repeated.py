"""Test that run and report repeat the warnings of `check`."""

from __future__ import annotations

from pathlib import Path

import pytest
from lambda_cli.main import main

from lambda_core import api

MOTOR = """\
name = "motor"
bearing = { designation = "6308 C3", maker = "SKF" }
lubricant = { name = "mineral-vg68", temperature = "70 degC" }
loads = { radial = "2.5 kN", axial = "0.5 kN" }
operation = { speed = "6000 rpm" }
solver = { duration = "1 ms" }
bodies.inner_ring = { tilt_y = "locked", tilt_z = "locked" }
"""
LIMITS = {
    "30 000 rpm": ("operation.speed=30000 rpm", "30000 rpm is above the limiting speed of the bearing"),
    "0 N": ("loads.radial=0 N|loads.axial=0 N", "is below the minimum load of ball bearings, 0.01 C = 423 N"),
    "above C0": ("loads.radial=30 kN", "P0 = 30 kN is above the static load rating C0 = 24 kN"),
    "4 mrad": (
        'bodies.inner_ring.tilt_y={ mode = "prescribed", motion = "4 mrad" }',
        "tilts the rings against each other by 4 mrad",
    ),
    "300 degC": ("lubricant.temperature=300 degC", "the oil at 300 degC is outside -40 to 200 degC"),
    "-40 degC": ("lubricant.temperature=-40 degC", "the oil is so thick at this speed that heating in the inlet"),
}


@pytest.fixture
def motor(tmp_path: Path) -> Path:
    path = tmp_path / "motor.toml"
    path.write_text(MOTOR, encoding="utf-8")
    return path


# The others go the same way with more limits.
FIRST = ("30 000 rpm", "300 degC")
LAST = ("0 N", "4 mrad")  # `check` tells these in tests/case/test_operating_limits.py


@pytest.mark.parametrize(
    "limit",
    [
        *FIRST,
        *(pytest.param(limit, marks=pytest.mark.full) for limit in LIMITS if limit not in FIRST + LAST),
        *(pytest.param(limit, marks=pytest.mark.slow) for limit in LAST),
    ],
)
def test_check_run_and_report_say_the_same(
    limit: str, motor: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    change, words = LIMITS[limit]
    changes = [word for part in change.split("|") for word in ("--set", part)]
    assert main(["check", str(motor), *changes]) == 0
    assert words in " ".join(capsys.readouterr().out.split())
    out = tmp_path / "beyond.h5"
    short = ["--out", str(out), "--band", "none", "--quiet"]
    assert main(["run", str(motor), *changes, *short]) == 5  # 1 ms does not converge
    assert words in " ".join(capsys.readouterr().out.split())
    page = api.report(out, tmp_path / "beyond.html", appendices=[]).read_text(encoding="utf-8")
    assert page.index("Beyond a limit") < page.index(words) < page.index('id="results"')


def test_an_oil_at_800_degrees_is_refused_by_all(motor: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for command in ("check", "quasistatic", "run"):
        assert main([command, str(motor), "--set", "lubricant.temperature=800 degC"]) == 3
        assert "lubricant.temperature  800 degC: no oil is liquid there" in capsys.readouterr().err
