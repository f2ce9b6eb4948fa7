"""Test capacitance of contacts that carry little or nothing.

Continuous from no load to full load.
"""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.arrays import FloatArray
from lambda_core.formulas.gap_capacitance import gap_capacitance
from lambda_core.formulas.hertz import hertz_contact
from lambda_core.laws.probe import trial_context
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import core
from lambda_core.solver.drivers.equilibrium import contact_channels, solve
from lambda_core.solver.records import CONTACT_CHANNELS
from lambda_core.testing import evaluate

from .gap import surroundings
from .statics import STEEL
from .test_models_capacitance import EPS_0, groove_6208

EPS_R = 2.2
CONTEXT = dataclasses.replace(trial_context("ball_outer"), ball_diameter=2.0 * groove_6208(inner=False)[2])
LOAD = CONTACT_CHANNELS.index("load")
CAPACITANCE = CONTACT_CHANNELS.index("capacitance")


def light(load: float, film: float) -> dict[str, Any]:
    """Return a light contact's law inputs.

    The outer contact of a 6208 at 3000 1/min.
    """
    R_x, R_y, _, _, _ = groove_6208(inner=False)
    ellipse = hertz_contact(load, R_x, R_y, STEEL)
    return {
        "C_hertz": EPS_0 * EPS_R * ellipse.area / film,
        "h": film,
        "semi_a": ellipse.semi_a,
        "semi_b": ellipse.semi_b,
        "R_x": R_x,
        "R_y": R_y,
        "U": 4.8e-11,
        "G": 4700.0,
        "W": load / (STEEL * R_x**2),
        "eps_r0": EPS_R,
    }


@pytest.mark.parametrize("name", ["schneider", "constant-factor", "gap-integral"])
def test_a_contact_under_centrifugal_force_alone_has_the_capacitance_of_its_gap(name: str) -> None:
    """Compare with area and gap by quadrature.

    Outer contact of an unloaded ball, 3.6 N, film 1.41 um.

    The gap without load is 12 % less: the surfaces are flattened. The power of the load alone gave 6.5 pF.
    """
    given = light(3.6, 1.41e-6)
    R_x, R_y, radius, _, _ = groove_6208(inner=False)
    ellipse = hertz_contact(3.6, R_x, R_y, STEEL)
    total = given["C_hertz"] + EPS_0 * EPS_R * surroundings(ellipse, STEEL, 1.41e-6, radius)
    unloaded = EPS_R * gap_capacitance(1.41e-6, R_x, R_y, radius)
    found = evaluate(f"capacitance/{name}", context=CONTEXT, **given)[0]
    assert unloaded <= found * (1.0 + 1e-12)
    assert found == pytest.approx(total, rel=0.15)
    assert 0.85 * total < unloaded < total


@pytest.mark.parametrize("name", ["schneider", "constant-factor", "gap-integral"])
def test_capacitance_is_continuous_from_no_load_to_full_load(name: str) -> None:
    """Keep capacitance continuous down to no load.

    The film of Hamrock and Dowson falls with load^-0.067; a thousandth of a decade changes C by less than 1 %.
    """
    loads = np.logspace(-6.0, 4.0, 10001)
    found = np.array(
        [
            evaluate(f"capacitance/{name}", context=CONTEXT, **light(load, 1.41e-6 * (load / 3.6) ** -0.067))[0]
            for load in loads[:: 1 if name == "schneider" else 20]
        ]
    )
    assert np.abs(np.diff(np.log(found))).max() < 0.01 * (1 if name == "schneider" else 20)
    R_x, R_y, radius, _, _ = groove_6208(inner=False)
    film = 1.41e-6 * (1e-6 / 3.6) ** -0.067
    assert found[0] == pytest.approx(EPS_R * gap_capacitance(film, R_x, R_y, radius), rel=0.01)


def touching_outer_ring(distances: FloatArray, *changes: str) -> tuple[FloatArray, FloatArray]:
    """Return outer load and capacitance [N, F].

    Of an unloaded ball as it moves outwards.
    """
    case: dict[str, Any] = {
        "name": "6208", "bearing": {"designation": "SKF 6208"}, "loads": {"radial": "1 kN"},
        "lubricant": {"name": "FVA3", "temperature": "60 degC"}, "operation": {"speed": "3000 rpm"},
        "bodies": {"cage": {"type": "steel-ribbon"}},
    }  # fmt: skip
    found = solve(api.check(case, changes))
    ball = int(np.argmin(found.contacts[:, 0, LOAD]))
    rows = []
    for distance in distances:
        state = found.state.copy()
        state[L.NB * ball + L.BR] += distance
        rows.append(contact_channels(core(), found.context, state)[0][ball, 1])
    table = np.stack(rows)
    return table[:, LOAD], table[:, CAPACITANCE]


def test_capacitance_does_not_jump_where_ball_and_raceway_touch() -> None:
    """Step through the touching point by 5 nm.

    No step in capacitance is above 2 % of it.
    """
    load, capacitance = touching_outer_ring(np.arange(-0.5e-6, 0.5e-6, 5e-9))
    assert load.min() == 0.0 < load.max()
    assert np.abs(np.diff(np.log(capacitance))).max() < 0.02


def test_a_wide_gap_has_the_capacitance_of_its_distance() -> None:
    """Count the distance where it exceeds the film."""
    _, (near, far) = touching_outer_ring(np.array([-10e-6, -20e-6]))
    assert far < near
    radii = groove_6208(inner=False)[:3]
    gaps = [gap_capacitance(gap, *radii) for gap in (10e-6, 20e-6)]
    assert near / far == pytest.approx(gaps[0] / gaps[1], rel=0.02)
