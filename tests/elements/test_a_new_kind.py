"""Test that one module adds a kind of ball bearing."""

from __future__ import annotations

import dataclasses
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.errors import CaseError
from lambda_core.elements.ball import BALL, kinds
from lambda_core.elements.ball.geometry import Geometry
from lambda_core.elements.ball.kinds import kind_of
from lambda_core.elements.ball.raceways import raceways
from lambda_core.elements.kind import CONTACTS
from lambda_core.elements.roller.roller_kinds import ROLLER
from lambda_core.model.checks.describe import headline
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.equilibrium import solve

# Two rows in tandem: both take a thrust of the shaft to +x.
TANDEM = """
from lambda_core.elements.ball.ball_kind import BallKind


def belongs(geometry):
    return geometry.get("arrangement") == "tandem"


def words(geometry, free):
    return f"rows in tandem, {free}"


KIND = BallKind(
    name="tandem", title="Tandem ball bearing", belongs=belongs, thrusts=lambda geometry, row: (1,), words=words,
    rows=2, filling=(100.0, 360.0), tilt=1e-4, tilt_words="rows in tandem take 0.1 mrad", one_sided=True,
    least_thrust=3.0, thrust_words="rows in tandem come apart there",
)
"""
CASE: dict[str, Any] = {
    "name": "two-rows",
    "bearing": {"designation": "SKF 3208 A"},
    "lubricant": {"name": "FVA3", "temperature": "70 degC"},
    "loads": {"radial": "1 kN", "axial": "2 kN"},
    "operation": {"speed": "3000 rpm"},
    "bodies": {"inner_ring": {"tilt_y": "locked", "tilt_z": "locked"}},
}


@pytest.fixture
def tandem(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Geometry]:
    """Return a geometry of a new kind.

    Its module is in a folder of its own.
    """
    geometry = api.check(CASE).geometry
    (tmp_path / "tandem.py").write_text(TANDEM, encoding="utf-8")
    found = [*kinds.__path__, str(tmp_path)]
    monkeypatch.setattr(kinds, "__path__", found)
    kinds.kinds.cache_clear()
    yield dataclasses.replace(geometry, arrangement="tandem")
    kinds.kinds.cache_clear()


def test_every_kind_is_found_and_no_two_claim_a_bearing() -> None:
    found = kinds.kinds()
    assert set(found) == {"deep groove", "angular contact", "four-point", "double row", "self-aligning"}
    assert BALL.kinds() == found
    assert {kind.name: kind.states for kind in (BALL, ROLLER)} == {"ball": L.NB, "roller": L.NR}
    assert {"NU", "tapered", "needle"} < set(ROLLER.kinds())
    assert [kind.number for kind in CONTACTS] == [R.POINT, R.LINE, R.RIB]
    for rows, arrangement, resting, contact in (
        (1, "", 0.0, 0.0), (1, "", 0.0, 0.5), (1, "", 0.4, 0.6), (2, "O", 0.4, 0.5), (2, "X", 0.4, 0.5),
        (2, "spherical", 0.2, 0.2),
    ):  # fmt: skip
        fields = {"rows": rows, "arrangement": arrangement, "resting_angle": resting, "contact_angle": contact}
        assert [kind.belongs(fields) for kind in found.values()].count(True) == 1


def test_a_new_kind_is_one_module(tandem: Geometry) -> None:
    assert kind_of(vars(tandem)).name == tandem.kind.name == "tandem"
    assert [way.thrust for way in raceways(tandem)] == [1, 1, 1, 1]
    model = dataclasses.replace(api.check(CASE), geometry=tandem)
    assert any("rows in tandem" in line for line in headline(model))
    assert any("rows in tandem come apart there" in text for text in api.model_warnings(model))


def test_both_rows_in_tandem_carry_the_thrust(tandem: Geometry) -> None:
    """Share the thrust in tandem, not back to back.

    Back to back one row takes it alone; in tandem each takes half.
    """
    thrust = api.check({**CASE, "loads": {"axial": "2 kN"}})
    shares = []
    for geometry in (thrust.geometry, tandem):
        inner, _ = solve(dataclasses.replace(thrust, geometry=geometry)).loads_by_row()
        rows = np.array(inner).reshape(2, -1).sum(axis=1)
        shares.append(float(rows.max() / rows.sum()))
    assert shares[0] > 0.9
    assert shares[1] == pytest.approx(0.5, abs=0.01)


# The folder of a kind: how a case writes it, and angles and clearance from a row of the catalogue.
FOLDER = TANDEM.replace(
    "KIND = BallKind(",
    '''
import math

from lambda_core.elements.ball.ball_kind import Angles
from lambda_core.formulas.tolerances import Limits


def written(inline):
    return inline.arrangement == "tandem"


def resolve(given):
    """Open by 20 um along the shaft."""
    free, apart = (given.ledger.row(f"bearing.{name}", getattr(given.row, name), quantity)
                   for name, quantity in (("contact_angle", "angle"), ("row_distance", "length")))
    resting = math.asin(math.sin(free) - 10e-6 / given.centres)
    clearance = 2.0 * given.centres * (math.cos(resting) - math.cos(free))
    return Angles(free, resting, Limits(clearance, clearance), "tandem", apart)


KIND = BallKind(
    written=written, resolve=resolve, arrangement="tandem", arrangements=("tandem",),''',
).replace("3.0", "1.0")
ROW = """designation=T3208|maker=Own|kind=tandem|contact_angle=30 deg|row_distance=13 mm|bore_diameter=40 mm
outside_diameter=80 mm|width=30.2 mm|dynamic_rating=47.5 kN|static_rating=34 kN|ball_count=14|ball_diameter=9.525 mm
pitch_diameter=60 mm|groove_radius_inner=4.95 mm|groove_radius_outer=4.95 mm|source=own drawing|grade=C"""
COMMANDS = """
import sys
from lambda_core.elements.ball import kinds
kinds.__path__.append(sys.argv[1])  # as if the folder stood in the program
from lambda_cli.main import main

for words in (
    ["db", "add", "bearing", *sys.argv[2].replace(chr(10), "|").split("|")],
    ["db", "show", "T3208"],
    ["init", "rows", "--bearing", "T3208", "--radial", "1 kN"],
    ["check", "rows.toml"],
    ["quasistatic", "rows.toml", "--set", "loads.axial=3 kN", "--band", "none"],
    ["run", "rows.toml", "--set", "loads.axial=3 kN", "--duration", "1 ms", "--band", "none", "--out", "rows.h5"],
    ["view", "rows.h5", "load-distribution"],
    ["show", "rows.h5"],
):
    code = main([*words])
    if code not in (0, 5):  # 5: a run of a millisecond does not converge
        sys.exit(f"{words}: {code}")
"""


def test_a_folder_is_enough_for_every_command(tmp_path: Path) -> None:
    """Add a bearing of a new kind and run it."""
    (tmp_path / "kinds" / "tandem").mkdir(parents=True)
    (tmp_path / "kinds" / "tandem" / "__init__.py").write_text(FOLDER, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-c", COMMANDS, str(tmp_path / "kinds"), ROW],
        cwd=tmp_path, env=os.environ | {"LAMBDA_BEARING_DATA": str(tmp_path / "data")}, capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "rows.toml").read_text().startswith("# Tandem ball bearing T3208 of Own")
    assert done.stdout.count("rows in tandem, contact angle 30 deg") >= 3
    assert done.stdout.count("27 balls loaded") + done.stdout.count("28 balls loaded") == 1  # both rows
    assert list(tmp_path.glob("rows*load-distribution*"))


def test_an_arrangement_of_no_kind_is_refused() -> None:
    case = {**CASE, "bearing": {"designation": "SKF 3208 A", "geometry": {"arrangement": "tandm"}}}
    with pytest.raises(CaseError, match='"tandm" is not a known arrangement; '):
        api.check(case)
