"""Bearing capacitance and first breakdown beside numbers from elsewhere."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from electric.rough_film import breakdown_voltage

from lambda_core import api
from lambda_core.case.electric import Electric
from lambda_core.electric.circuit_run import simulate
from lambda_core.electric.contacts import contacts_of_equilibria, equilibria, films
from lambda_core.electric.electrified import of_model

RADIAL = ["loads.axial=0 N"]


@pytest.mark.parametrize(
    ("changes", "capacitance", "share"),
    [
        ([], 240.7, 0.0),
        ([*RADIAL, "loads.radial=2 kN"], 113.9, 0.200),
        ([*RADIAL, "loads.radial=0.5 kN"], 73.2, 0.317),
        ([*RADIAL, "loads.radial=2 kN", "operation.speed=500 rpm"], 155.1, 0.090),
        ([*RADIAL, "loads.radial=2 kN", "operation.speed=10000 rpm"], 137.0, 0.293),
    ],
)
def test_regression_6208(changes: list[str], capacitance: float, share: float) -> None:
    """6208, 2750 1/min where nothing else stands, one ball lowest: own values of version 0.1, so that a change is seen.

    Axial 1300 N: nine balls of 26.7 pF. Radial: the share is that of the six balls that the inner ring does not press
    on. Not compared with a measurement: Puchtler et al. 2022, Tribol. Int. 176, 107882, was not read.
    """
    contacts = contacts_of_equilibria(equilibria(api.check("6208-axial-1300", changes), 1), 1e-3)
    each = films(contacts, Electric()).capacitance[0]
    series = each[:, 0] * each[:, 1] / each.sum(axis=1)
    unloaded = ~contacts.loaded[0].all(axis=1)
    assert 1e12 * series.sum() == pytest.approx(capacitance, rel=1e-3)
    assert series[unloaded].sum() / series.sum() == pytest.approx(share, abs=2e-3)


# Peak voltages of the first breakdown, F_r/F_a 1800/900, 1800/300, 600/900 N, two bearings each [V].
PUBLISHED = {7000: (5.0, 6.0, 2.5, 3.0, 2.0, 2.5), 2000: (3.0, 4.5, 3.0, 3.5, 1.5, 2.0)}


def first_breakdown(speed: int) -> float:
    """Return the median over seeds of the first breakdown of a 6205 under 1800/900 N on a slow ramp [V]."""
    case = api.case("6208-axial-1300").with_(
        bearing={"designation": "6205", "maker": "SKF", "geometry": None, "clearance": None},
        loads={"radial": "1800 N", "axial": "900 N"},
        operation={"speed": f"{speed} rpm"},
        electric={
            "step": {"amplitude": "60 V", "rise_time": "20 ms"},
            "machine": {"winding_rotor": "1000 nF", "other_bearings": "0 pF"},
        },
    )
    model = api.check(case)
    contacts, bearing = contacts_of_equilibria(equilibria(model, 1), 0.02), of_model(model)
    found = []
    for seed in range(15):
        options = bearing.options.model_copy(update={"seed": seed})
        events = simulate(contacts, dataclasses.replace(bearing, options=options)).events
        found.append(abs(float(events.bearing_voltage[0])))
    return float(np.median(found))


def test_first_breakdown() -> None:
    """First breakdown voltages of run-in deep groove ball bearings: not met, and by how much.

    Lubricants 2024, 12(1), 1, table A1, second-hand: type, oil and temperature could not be read. The Hertzian areas
    printed there (5.0 to 5.7 mm2) are near those of a 6205 (4.6 to 6.5 mm2 here, both raceways), so this is a 6205
    with the oil of the built-in case at 40 degC and every default of the law; nothing is fitted. The law gives 1.3 V at
    2000 1/min (published median 3.0 V) and 21 V at 7000 1/min (2.75 V): the published voltages hardly depend on speed,
    the computed film of 0.43 and 0.79 um at one temperature does. A median within a factor 1.5 is not reached.
    """
    slow, fast = first_breakdown(2000), first_breakdown(7000)
    assert slow == pytest.approx(1.3, rel=0.25)
    assert fast == pytest.approx(21.2, rel=0.1)
    assert slow < min(PUBLISHED[2000])
    assert fast > max(PUBLISHED[7000])
    assert np.median(PUBLISHED[2000]) / slow == pytest.approx(2.3, rel=0.25)
    assert fast / np.median(PUBLISHED[7000]) == pytest.approx(7.7, rel=0.15)


def test_film_that_the_published_voltages_stand_for() -> None:
    """Turned round: the mean film whose lowest spot stands 3 V is 0.5 um, between those computed at the two speeds."""
    one = float(breakdown_voltage(0.5, 0.5e-6, 0.1e-6, 30e6, 5.5e-6 / 2 / 1e-10))
    assert one == pytest.approx(2.9, rel=0.05)
