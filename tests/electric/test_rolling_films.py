"""Test films of rollers where no steady motion is found.

The search is cut short: no usual point is known that it does not find, and loads and films are known without it.
"""

from __future__ import annotations

import numpy as np
import pytest

from lambda_core import api
from lambda_core.analysis.electric.contacts import contacts_of_equilibria, equilibria
from lambda_core.analysis.static_point import static_point
from lambda_core.domain.errors import EquilibriumError
from lambda_core.solver.drivers import equilibrium
from lambda_core.solver.drivers.equilibrium import solve
from lambda_core.studies.measures import static_film

CASE = {
    "name": "nj",
    "bearing": {"designation": "SKF NJ 208"},
    "lubricant": {"name": "FVA3", "temperature": "60 degC"},
    "loads": {"radial": "6.2 kN", "axial": "500 N"},
    "operation": {"speed": "1500 rpm"},
}


@pytest.fixture
def short_search(monkeypatch: pytest.MonkeyPatch) -> None:
    """Give the search too few iterations."""
    monkeypatch.setattr(equilibrium, "_ROLLER_ITERATIONS", 5)


@pytest.mark.usefixtures("short_search")
def test_circuit_has_the_films_of_rolling() -> None:
    """Compare films and loads with the operating point."""
    model = api.check(CASE)
    with pytest.raises(EquilibriumError, match="no quasi-static equilibrium with friction"):
        solve(model, by_warmer_oil=False)
    contacts = contacts_of_equilibria(equilibria(model, 1), 1e-3)
    assert contacts.origin.endswith("which roll: no steady motion with friction was found")
    point = api.quasistatic(CASE)
    assert contacts.load.max() == pytest.approx(point.max_load_N, rel=3e-3)
    raceways = contacts.load > 0.05 * contacts.load.max()
    assert 1e6 * contacts.film[raceways].min() == pytest.approx(point.film_um[0], rel=0.01)


@pytest.mark.usefixtures("short_search")
def test_stribeck_curve_names_speeds_of_rolling() -> None:
    found = api.stribeck(CASE, speeds_rpm=[1000.0, 1500.0])
    assert "at 1000 to 1500 1/min rollers roll: no steady motion with friction was found" in found.note
    assert "continues" not in found.note
    torque = api.quasistatic(CASE).friction_torque_Nmm
    assert torque is not None
    assert found.torque_Nmm[1] == pytest.approx(torque, rel=0.03)
    assert np.isfinite(found.film_parameter).all()


def test_balls_without_a_steady_motion_stay_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """Refuse balls, whose slip no film can do without."""
    monkeypatch.setattr(equilibrium, "MAX_ITERATIONS", {False: 5000, True: 1})
    monkeypatch.setattr(equilibrium, "_FRESH_STARTS", 0)
    monkeypatch.setattr("lambda_core.solver.drivers.viscosity_continuation._WARMER", ())
    with pytest.raises(EquilibriumError, match="no quasi-static equilibrium with friction"):
        equilibria(api.check("6208-axial-1300"), 1)


@pytest.mark.usefixtures("short_search")
def test_point_of_a_study_has_the_films_of_rolling() -> None:
    """Read currents and films as maps and studies do."""
    point = static_point(api.check(CASE, ["electric.duration=2 ms"]))
    (numbers,) = point.circuit.values()
    assert numbers.discharges_per_s is not None
    own = point.bearing("")
    found = point.answer
    assert found.rollers is not None
    assert static_film(own) == pytest.approx(found.rollers.min_film_um, rel=0.01)
