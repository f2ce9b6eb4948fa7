"""Test every role filled by a third party at once.

The dynamics return a torque that is known in closed form.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import pytest

from lambda_core.domain import elements
from lambda_core.domain.roles import CAGE, DEFAULT_LINE_MODELS, MOTION_ROLES, RACEWAYS

from .conftest import Installation

PACKAGE = Path(__file__).parent / "packages" / "all-roles"
CHOICE = [f"models.{role}=own" for role in MOTION_ROLES if role != "cage_contact"]
CHOICE += [f"forces.{element}.models.cage_contact=own" for element in CAGE]
ROLLERS = ["operation.speed=2750 rpm", "bearing.clearance=-10 um", "loads.radial=1 kN", "lubricant.temperature=60 degC"]
ROLLERS += [f"models.{role}={'own-line' if role in DEFAULT_LINE_MODELS else 'own'}" for role in MOTION_ROLES]
# An NJ passes thrust on through its ribs: each of their laws is foreign, too.
RIBS = [f"forces.{rib}.models.{role.name}={'own-rib' if role.name == 'traction' else 'own'}"
        for rib in elements.RIBS for role in MOTION_ROLES.values() if RACEWAYS[0] in role.elements]  # fmt: skip
RUN = """
import json, sys
from lambda_core import api
from lambda_core.solver.drivers.dynamics import BearingEngine

source, first, last = "6208-axial-1300", 0.02, 0.1
if "rollers" in sys.argv:  # 1e15 Pa s/m of 448 slices hold them so fast that steps are short
    bearing = "SKF NJ 208 ECP" if "ribs" in sys.argv else "SKF NU 208 ECP"
    source = {"name": "rollers", "bearing": {"designation": bearing}, "lubricant": {"name": "FVA3"}}
    first, last = 0.001, 0.004
model = api.check(source, [text for text in sys.argv[1:] if "=" in text])
engine = BearingEngine(model)
engine.advance(first)
start = engine.integrals()
outcome = engine.advance(last)
end = engine.integrals()
spent = {name: end[name] - start[name] for name in end}
geometry = model.geometry
print(json.dumps({
    "ok": outcome.ok,
    "loss": sum(value for name, value in spent.items() if name.startswith("loss.")),
    "hysteresis": spent["loss.hysteresis_inner"] + spent["loss.hysteresis_outer"],
    "angle": spent["relative_angle"],
    "ball_count": geometry.ball_count, "pitch": geometry.pitch_diameter, "ball": geometry.ball_diameter,
    "laws": sorted({law.model.label for roles in model.laws.values() for law in roles.values()}),
    "ribs": engine.samples()["rib_load"][-1].sum(axis=0).tolist() if "ribs" in sys.argv else [],
    "rib_laws": sorted(
        law.model.label for element, roles in model.laws.items() if "rib" in element for law in roles.values()
    ),
    "imported": sorted(name for name in sys.modules if name.startswith("lambda_plugins.")),
}))
"""


@pytest.fixture(scope="module")
def site(install: Callable[..., Installation]) -> Installation:
    return install([PACKAGE])


@pytest.mark.full
@pytest.mark.timeout(900)  # the first test of a session that needs the solver compiles it
def test_the_torque_is_the_closed_form_and_no_built_in_law_was_imported(site: Installation) -> None:
    answer = site.python(RUN, *CHOICE, "gravity.z=0 m/s2")
    assert answer.code == 0, answer.err
    found = answer.data
    assert found["ok"]
    # Z M d_m/D_w with M = 2e-4 N m (the package says why). Balls run at a contact angle and on a circle that differs
    # from the pitch circle by clearance and deflection: 5e-4 of the torque.
    expected = found["ball_count"] * 2e-4 * found["pitch"] / found["ball"]
    assert found["loss"] / found["angle"] == pytest.approx(expected, rel=1e-3)
    assert found["hysteresis"] == pytest.approx(found["loss"], rel=1e-3)
    assert found["angle"] == pytest.approx(2750.0 * math.pi / 30.0 * 0.08, rel=1e-2)
    neighbour = ("lambda_plugins.methods", "lambda_plugins.views")
    laws = [name for name in found["imported"] if not name.startswith(neighbour)]
    assert laws == []


@pytest.mark.full
@pytest.mark.timeout(300)
def test_rollers_have_the_same_closed_form(site: Installation) -> None:
    """Run all foreign laws of rollers at once.

    They are laws of lines, of slices, of pockets and of the oil.

    Every roller is pressed on both rings by a negative clearance. Ribs, which a NU without thrust leaves alone, have
    the foreign laws of the roles that lines and points share, and built-in ones of points.
    """
    answer = site.forked(RUN, "rollers", *ROLLERS, "gravity.z=0 m/s2")
    assert answer.code == 0, answer.err
    found = answer.data
    assert found["ok"]
    expected = found["ball_count"] * 2e-4 * found["pitch"] / found["ball"]
    assert found["hysteresis"] / found["angle"] == pytest.approx(expected, rel=1e-3)
    assert found["loss"] == pytest.approx(found["hysteresis"], rel=2e-3)
    own = {label.split()[0] for label in found["laws"] if "all-roles" in label}
    lines = {f"{role}/own-line" for role in DEFAULT_LINE_MODELS}
    assert own == lines | {f"{role}/own" for role in MOTION_ROLES if role not in DEFAULT_LINE_MODELS}


@pytest.mark.full
@pytest.mark.timeout(300)
def test_ribs_under_thrust_have_foreign_laws_in_every_role(site: Installation) -> None:
    """Run foreign laws of lines, pockets and ribs at once.

    The thrust of 300 N goes through one rib of each ring. Their oil hardly holds them: they add little to the torque.
    """
    answer = site.forked(RUN, "rollers", "ribs", *ROLLERS, *RIBS, "loads.axial=300 N", "gravity.z=0 m/s2")
    assert answer.code == 0, answer.err
    found = answer.data
    assert found["ok"]
    assert len(found["rib_laws"]) == len(RIBS)
    assert all("all-roles" in label for label in found["rib_laws"])
    assert sorted(found["ribs"])[-2:] == pytest.approx([300.0, 300.0], rel=0.01)
    expected = found["ball_count"] * 2e-4 * found["pitch"] / found["ball"]
    assert found["hysteresis"] / found["angle"] == pytest.approx(expected, rel=0.02)


CURRENTS = """
import json, sys
from lambda_core import api

events = api.electric("6208-axial-1300", sys.argv[1:]).events
first = int((events.time > 0.0).argmax())  # at time 0 the source stands at a voltage already
print(json.dumps({"voltage": abs(events.contact_voltage[first]), "peak": events.peak[first]}))
"""


@pytest.mark.full
def test_films_break_down_and_burn_by_foreign_laws(site: Installation) -> None:
    """Break a film down at 4 V by foreign laws.

    The current is 4 V over 28 Ohm; the voltage rises.

    The ball's other film breaks down in the same discharge, and its current comes on top.
    """
    answer = site.forked(CURRENTS, "electric.breakdown.law=own", "electric.discharge.law=own", "electric.duration=2 ms")
    assert answer.code == 0, answer.err
    assert answer.data["voltage"] == pytest.approx(4.0, rel=1e-7)  # crossed inside a step, along a straight line
    assert 4.0 / 28.0 <= answer.data["peak"] <= 2.0 * 4.0 / 28.0
