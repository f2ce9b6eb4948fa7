"""Test the surface of a raceway in the host.

Where it is looked up, what enters the contact, and when it refuses.
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from lambda_core import api
from lambda_core.laws.law import Law
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.arrays import fault_roles as faults
from lambda_core.solver.drivers.contact_field import contact_field
from lambda_core.solver.drivers.equilibrium import solve
from lambda_core.solver.drivers.surface_steps import longest_step

from .support import ALL_FREE, Machine, machine

TIGHT = "bearing.clearance=10 um"
STILL = (TIGHT, *ALL_FREE, "bodies.inner_ring.spin=free")  # nothing turns unless the state says so
WAVES = ("models.surface=waviness", "parameters.surface.amplitude=2 um", "parameters.surface.waves=5")


def load(m: Machine, azimuth: float, angle: float, pressed: float = 10e-6) -> float:
    """Return the load on the inner ring [N].

    Turned by `angle`, of a ball at rest that is pressed towards it.
    """
    state = m.at_rest()
    state.balls[0, L.BPSI] = azimuth
    state.balls[0, L.BR] -= pressed
    state.shared[0, L.STHETA] = angle
    return float(m.observe(m.vector(state))["load"][0, 0])


def test_the_raceway_turns_with_its_ring() -> None:
    """Turn balls and ring together.

    Equal angles between them give equal loads; a crest presses more than a trough.
    """
    m = machine(*STILL, *WAVES)
    crest, trough = load(m, 0.7, 0.7), load(m, 0.7, 0.7 + math.pi / 5.0)
    assert crest > 1.5 * trough > 0.0
    assert load(m, 2.9, 2.9) == pytest.approx(crest, rel=1e-9)
    assert load(m, -3.0, -3.0 + 4.0 * math.pi) == pytest.approx(crest, rel=1e-9)


def test_the_penetration_grows_by_the_height() -> None:
    """Compare loads at a node and a crest.

    The node has the load of the nominal raceway; a crest of 2 um that of a ball 2 um nearer to it.
    """
    wavy, nominal = machine(*STILL, *WAVES), machine(*STILL)
    assert load(wavy, 0.0, math.pi / 10.0) == pytest.approx(load(nominal, 0.0, 0.0), rel=1e-9)
    assert load(wavy, 0.0, 0.0) == pytest.approx(load(nominal, 0.0, 0.0, pressed=12e-6), rel=1e-6)
    assert load(nominal, 0.0, 0.0) > 100.0


def test_the_quasi_static_solution_has_nominal_raceways() -> None:
    nominal, wavy = (solve(api.check("6208-axial-700", changes)) for changes in ((), WAVES))
    assert np.array_equal(nominal.contacts, wavy.contacts)
    assert nominal.displacement == wavy.displacement


@pytest.mark.parametrize(("waves", "expected"), [(8, 1.0 / 8.0), (300, 1.0 / 300.0)])
def test_steps_of_time_resolve_the_waves(waves: int, expected: float) -> None:
    """Compare steps with a quarter of 1/k rad.

    At the speed of the balls past the outer ring, (1 - D_w/d_m)/2 of the shaft's.
    """
    changes = ("forces.ball_outer.models.surface=waviness", f"forces.ball_outer.parameters.surface.waves={waves}")
    m = machine(*changes)
    speed = 1500.0 * math.pi / 30.0 * 0.5 * (1.0 - 30.0 / 147.5)
    assert longest_step(m.context) == pytest.approx(expected / (4.0 * speed), rel=0.01)
    assert longest_step(machine().context) == math.inf


def test_steps_of_time_see_a_short_wave_on_a_long_one() -> None:
    def step(*choice: str) -> float:
        options = (f"parameters.surface.{option}" for option in choice)
        return longest_step(machine("models.surface=waviness", *options).context)

    short = 'harmonics=[{ waves = 100, amplitude = "20 nm" }]'
    alone = step("waves=100", "amplitude=20 nm")
    assert step("waves=2", "amplitude=5 um", short) == pytest.approx(alone, rel=0.01)
    assert step("waves=2", "amplitude=5 um") > 40.0 * alone


def test_a_narrow_defect_is_not_stepped_over() -> None:
    """Cross a narrow defect in ten steps.

    0.2 mm long on a raceway of 177.5 mm, from edge to edge.
    """
    m = machine("forces.ball_outer.models.surface=defect", "forces.ball_outer.parameters.surface.width=0.2 mm")
    speed = 1500.0 * math.pi / 30.0 * 0.5 * (1.0 - 30.0 / 147.5)
    assert longest_step(m.context) < 0.1 * (0.2 / 88.75) / speed


def unmapped(azimuth, contact_angle, par, out):  # type: ignore[no-untyped-def]
    out[0] = 0.0
    out[1] = 0.0
    out[2] = 0.0
    return 1 if azimuth < 1.0 else 2


def test_a_surface_that_refuses_is_named() -> None:
    law = Law("surface", "unmapped", unmapped, role_api=3, reference="-", errors={2: "the scan ends here"})
    case = api.check("6319-cp10-1500", (TIGHT,))
    inner = case.laws["ball_inner"]
    own = dataclasses.replace(inner["surface"], model=dataclasses.replace(law, distribution="scans 1.2"))
    m = Machine(dataclasses.replace(case, laws={**case.laws, "ball_inner": {**inner, "surface": own}}))
    with pytest.raises(AssertionError) as found:
        m.evaluate(m.vector(m.at_rest()))
    for words in ("surface/unmapped (scans 1.2)", "the scan ends here", "inner"):
        assert words in str(found.value)


def test_faults_name_the_role_that_refused() -> None:
    """Compare role numbers with the table of roles.

    Compiled code tells a role by its number.
    """
    numbers = {name: number for name, number in vars(faults).items() if name.isupper() and isinstance(number, int)}
    assert numbers.pop("OUTSIDE") < 0  # a status, not a role
    assert [name.lower() for name in numbers] == list(faults.ROLES)
    assert list(numbers.values()) == list(range(len(faults.ROLES)))


def test_a_view_inside_the_contact_sees_the_same_surface() -> None:
    """Compare a contact's load in plain Python.

    The view of the field has the load of the run.
    """
    m = machine(*STILL, *WAVES)
    state = m.at_rest()
    state.balls[0, L.BR] -= 10e-6
    state.shared[0, L.STHETA] = 0.3
    state.balls[:, L.BVT], state.balls[:, L.BWX] = 2.0, 150.0
    y = m.vector(state)
    field = contact_field(m.context, state.balls[0], m.shared_state(y, 0.0)[0], 0)
    pressure, nominal = (float(each.observe(y)["max_pressure"][0, 0]) for each in (m, machine(*STILL)))
    assert float(field.pressure.max()) == pytest.approx(pressure, rel=0.01)
    assert pressure != pytest.approx(nominal, rel=1e-3)
