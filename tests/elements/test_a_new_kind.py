"""Test that one module adds a kind of ball bearing."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api
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
