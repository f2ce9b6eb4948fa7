"""Test what no roller bearing can have."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.errors import CaseError
from lambda_core.elements.roller.roller_ratings import HIGHEST_ROLLER_PRESSURE
from lambda_core.model.checks.describe import headline
from lambda_core.model.checks.operating_limits import operating_warnings
from lambda_core.solver.drivers.equilibrium import solve

CASE: dict[str, Any] = {
    "name": "rollers",
    "bearing": {"designation": "SKF NU 208 ECP"},
    "lubricant": {"name": "FVA3", "temperature": "60 degC"},
    "loads": {"radial": "100 N"},
    "operation": {"speed": "3000 rpm"},
}


def with_clearance(text: str) -> dict[str, Any]:
    return {**CASE, "bearing": {**CASE["bearing"], "clearance": text}}


@pytest.mark.parametrize(
    ("clearance", "words"),
    [
        ("-5 mm", "more interference than a bearing survives: every roller has the 4 GPa"),
        ("2.1 mm", "2.1 mm lets rollers leave their ribs: must be below 2 mm"),
    ],
)
def test_clearances_of_no_real_bearing_are_refused_everywhere(clearance: str, words: str) -> None:
    for ask in (api.check, api.quasistatic):
        with pytest.raises(CaseError, match=words):
            ask(with_clearance(clearance))


def test_the_largest_interference_has_the_pressure_of_the_static_rating() -> None:
    with pytest.raises(CaseError) as refused:
        api.check(with_clearance("-5 mm"))
    limit = float(str(refused.value).split(" at -")[1].split()[0])  # [um]
    found = api.quasistatic(with_clearance(f"{1.0 - limit} um"))
    # A weak load, and the profile of the roller, which takes part of the interference, move the pressure a little
    assert found.max_pressure_GPa == pytest.approx(1e-9 * HIGHEST_ROLLER_PRESSURE, rel=0.1)


@pytest.mark.parametrize(("interference", "is_told"), [("-60 um", True), ("900 um", True), ("40 um", False)])
def test_a_clearance_that_shortens_the_life_is_told(interference: str, is_told: bool) -> None:
    found = api.quasistatic({**with_clearance(interference), "loads": {"radial": "5 kN"}})
    told = [one for one in found.warnings if "ISO 281 assumes half of the raceway loaded" in one]
    assert bool(told) == is_told, found.warnings


@pytest.mark.parametrize(
    ("bodies", "words"),
    [
        ({"inner_ring": {"y": {"motion": "1 um"}}}, r"inner_ring.y +must be free or locked"),
        ({"inner_ring": {"tilt_y": "50 N m/mrad"}}, "inner_ring.tilt_y must be free, locked or prescribed"),
        ({"outer_ring": {"tilt_y": {"motion": "1 mrad"}}}, "outer_ring.tilt_y must begin at zero"),
    ],
)
def test_tilts_that_no_operating_point_has_are_refused_everywhere(bodies: dict[str, Any], words: str) -> None:
    for ask in (api.check, api.quasistatic):
        with pytest.raises(CaseError, match=words):
            ask({**CASE, "bodies": bodies})


@pytest.mark.parametrize(
    ("designation", "loads"), [("NU 208", {"radial": "5 kN"}), ("SKF 32216", {"radial": "6.5 kN", "axial": "6 kN"})]
)
def test_a_prescribed_tilt_is_that_of_its_moment(designation: str, loads: dict[str, str]) -> None:
    """Compare a prescribed with the free tilt under its moment.

    The compiled equilibrium, which a run starts from, has the same pose and largest load.
    """
    tilted = {**CASE, "bearing": {"designation": designation}, "loads": loads}
    prescribed = {**tilted, "bodies": {"inner_ring": {"tilt_y": {"mode": "prescribed", "motion": "1 mrad"}}}}
    found = api.quasistatic(prescribed)
    assert found.inner_ring_tilt_mrad == pytest.approx([1.0, 0.0], abs=1e-9)
    assert found.rollers is not None
    about_y, _ = found.rollers.inner_ring_moment_Nm
    loaded = {**loads, "moment_y": f"{-about_y!r} N m"}
    free = api.quasistatic({**tilted, "loads": loaded, "bodies": {"inner_ring": {"tilt_y": "free"}}})
    assert free.inner_ring_tilt_mrad == pytest.approx([1.0, 0.0], abs=1e-6)
    assert free.max_load_N == pytest.approx(found.max_load_N, rel=1e-6)
    compiled = solve(api.check(prescribed), with_friction=False)
    assert compiled.displacement[3] == pytest.approx(1e-3)
    assert compiled.contacts[..., 0].max() == pytest.approx(found.max_load_N, rel=2e-3)


def test_a_prescribed_tilt_beyond_the_limit_is_told() -> None:
    bodies = {"inner_ring": {"tilt_z": {"mode": "prescribed", "motion": "2 mrad"}}}
    words = "roller bearings take up to 1.2 mrad"
    case = {**CASE, "bodies": bodies}
    assert any(words in one for one in api.quasistatic(case).warnings)
    assert any(words in one for one in operating_warnings(api.check(case)))


def test_a_band_without_ends_is_left_out() -> None:
    rollers = {**CASE, "bearing": {"designation": "SKF NCF 3008"}, "loads": {"radial": "5.72 kN"}}
    band = api.model_band({**rollers, "operation": {"speed": "1500 rpm"}})
    assert "capacitance" not in [one.quantity for one in band.bands]
    assert "capacitance has no band: at an end of a range there is no value" in band.left_out
    assert all(np.isfinite([one.low, one.high]).all() for one in band.bands)


def test_the_circuit_of_rollers_speaks_of_no_balls() -> None:
    told = api.electric({**CASE, "loads": {"radial": "5 kN"}}).outcome.assumptions
    assert "between the rings there is air outside the rolling elements" in told
    assert not [one for one in told if "ball" in one]


def test_tapered_rollers_have_no_clearance_of_their_own() -> None:
    taper = {**CASE, "bearing": {"designation": "SKF 32208"}, "loads": {"radial": "3 kN", "axial": "2 kN"}}
    assert "clearance closed by the load" in headline(api.check(taper))[0]
    assert "clearance 37.5 um" in headline(api.check(CASE))[0]
