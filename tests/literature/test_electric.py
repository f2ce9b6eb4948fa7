"""Test capacitance and first breakdown against published numbers."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

import numpy as np
import pytest
from electric.rough_film import breakdown_voltage

from lambda_core import api
from lambda_core.analysis.electric.circuit_bearing import circuit_bearings
from lambda_core.analysis.electric.contacts import contacts_of_equilibria, equilibria, films
from lambda_core.analysis.electric.simulation import simulate
from lambda_core.analysis.thermal.temperatures import ready
from lambda_core.case.case_io import apply_overrides
from lambda_core.case.electric import Electric

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import BearingModel

RADIAL = ["loads.axial=0 N"]


@pytest.mark.parametrize(
    ("changes", "capacitance", "share"),
    [
        ([], 240.7, 0.0),
        ([*RADIAL, "loads.radial=2 kN"], 134.0, 0.320),
        ([*RADIAL, "loads.radial=0.5 kN"], 93.7, 0.466),
        ([*RADIAL, "loads.radial=2 kN", "operation.speed=500 rpm"], 187.3, 0.246),
        ([*RADIAL, "loads.radial=2 kN", "operation.speed=10000 rpm"], 138.1, 0.298),
    ],
)
def test_regression_6208(changes: list[str], capacitance: float, share: float) -> None:
    """Compare a 6208 with values of version 0.1.

    2750 1/min, one ball lowest; the test shows a change.

    Axial 1300 N: nine balls of 26.7 pF. Radial: the share is that of the six balls that the inner ring does not press
    on. Surfaces of 0.1 um, so that every film is thick enough to insulate. Not compared with a measurement: Puchtler et
    al. 2022, Tribol. Int. 176, 107882, was not read.
    """
    model = api.check("6208-axial-1300", ["surface.roughness=0.1 um", *changes])
    contacts = contacts_of_equilibria(equilibria(model, 1), 1e-3)
    each = films(contacts, Electric()).capacitance[0]
    series = each[:, 0] * each[:, 1] / each.sum(axis=1)
    unloaded = ~contacts.loaded[0].all(axis=1)
    assert 1e12 * series.sum() == pytest.approx(capacitance, rel=1e-3)
    assert series[unloaded].sum() / series.sum() == pytest.approx(share, abs=2e-3)


# Peak voltages of the first breakdown: speed [1/min] -> F_r/F_a 1800/900, 1800/300, 600/900 N, two bearings each [V].
PUBLISHED = {7000: (5.0, 6.0, 2.5, 3.0, 2.0, 2.5), 2000: (3.0, 4.5, 3.0, 3.5, 1.5, 2.0)}
LOADS = ((1800, 900), (1800, 300), (600, 900))  # F_r, F_a [N]


def rig(speed: int, radial: int = 1800, axial: int = 900, temperatures: str = "given") -> BearingModel:
    """Return a 6205 under rising voltage.

    With the oil of the built-in case and smooth surfaces.
    """
    case = api.case("6208-axial-1300").with_(
        bearing={"designation": "6205", "maker": "SKF", "geometry": None, "clearance": None},
        loads={"radial": f"{radial} N", "axial": f"{axial} N"},
        operation={"speed": f"{speed} rpm", "temperatures": temperatures},
        surface={"roughness": "0.1 um"},
        electric={
            "step": {"amplitude": "60 V", "rise_time": "20 ms"},
            "machine": {"winding_rotor": "1000 nF", "other_bearings": "0 pF"},
        },
    )
    return ready(api.check(case))


def first_breakdown(model: BearingModel, seeds: int = 15) -> float:
    """Return the median first breakdown on the ramp [V]."""
    contacts, bearing = contacts_of_equilibria(equilibria(model, 1), 0.02), circuit_bearings(model)[0]
    found = []
    for seed in range(seeds):
        options = bearing.options.model_copy(update={"seed": seed})
        events = simulate(contacts, dataclasses.replace(bearing, options=options)).events
        found.append(abs(float(events.bearing_voltage[0])))
    return float(np.median(found))


def test_first_breakdown() -> None:
    """Compare first breakdown voltages at one temperature.

    Run-in deep groove ball bearings: the published voltages are not met, and the test shows by how much.

    Lubricants 2024, 12(1), 1, table A1; its text could not be read: type, oil and temperature are unknown. The Hertzian
    areas printed there (5.0 to 5.7 mm2) are near those of a 6205 (4.6 to 6.5 mm2 here, both raceways), so this is a
    6205 with the oil of the built-in case at 40 degC, 0.1 um and the law's defaults; nothing is fitted. It gives 1.3 V
    at 2000 1/min (published median 3.0 V) and 21 V at 7000 1/min (2.75 V): the published voltages hardly depend on
    speed, the computed film of 0.43 and 0.79 um at one temperature does.
    """
    slow, fast = first_breakdown(rig(2000)), first_breakdown(rig(7000))
    assert slow == pytest.approx(1.3, rel=0.25)
    assert fast == pytest.approx(21.2, rel=0.1)
    assert slow < min(PUBLISHED[2000])
    assert fast > max(PUBLISHED[7000])
    assert np.median(PUBLISHED[2000]) / slow == pytest.approx(2.3, rel=0.25)
    assert fast / np.median(PUBLISHED[7000]) == pytest.approx(7.7, rel=0.15)


@pytest.mark.slow
def test_first_breakdown_at_own_temperatures() -> None:
    """Compare voltages at temperatures of the bearing's losses.

    The voltage does not rise with speed; its level follows the roughness.

    Thermal network of the program with its defaults (pillow block in still air of 20 degC): oil at 48 to 55 degC at
    2000, 83 to 95 degC at 7000 1/min. The median films are then 0.30 to 0.40 and 0.23 to 0.31 um. With the defaults of
    the law and a composite roughness of 0.1 um all points are at the floor of 0.5 V per film: 1.0 V, a third of the
    published medians of 3.0 and 2.75 V. With 0.05 um, of which no measurement is known here, and the lower of the two
    published strengths, 15 V/um for slow changes, the medians are 3.7 V at 2000 and 1.5 V at 7000 1/min, factors of 1.2
    and 1.9. This shows that the law can be right, not that it is: a roughness of 0.03 or 0.1 um or 30 V/um are as good
    a guess, and give 1 to 10 V.
    """
    plain: dict[int, list[float]] = {2000: [], 7000: []}
    smooth: dict[int, list[float]] = {2000: [], 7000: []}
    changes = ["surface.roughness=0.05 um", "electric.breakdown.parameters.strength=15 V/um"]
    for speed in PUBLISHED:
        for radial, axial in LOADS:
            model = rig(speed, radial, axial, "computed")
            plain[speed].append(first_breakdown(model, 3))
            smooth[speed].append(first_breakdown(api.check(apply_overrides(model.case, changes)), 15))
    for speed, published in PUBLISHED.items():
        assert max(plain[speed]) < 1.2
        assert np.median(published) / np.median(plain[speed]) == pytest.approx(3.0, rel=0.15)
        assert 0.5 < np.median(smooth[speed]) / np.median(published) < 1.5
    assert np.median(smooth[2000]) == pytest.approx(3.65, rel=0.1)
    assert np.median(smooth[7000]) == pytest.approx(1.46, rel=0.1)


def test_film_that_the_published_voltages_stand_for() -> None:
    """Find the film whose lowest spot holds 3 V.

    The mean film is 0.5 um, between those computed at the two speeds.
    """
    one = float(breakdown_voltage(0.5, 0.5e-6, 0.1e-6, 30e6, 5.5e-6 / 2 / 1e-10))
    assert one == pytest.approx(2.9, rel=0.05)
