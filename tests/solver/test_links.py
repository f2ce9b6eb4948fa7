"""Test force elements between bodies.

Statics against a closed form, Newton's third law, and what a case may say of them.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.errors import CaseError

from .support import NO_FIELD
from .test_power import LINKS, TIGHT, machine, random_state
from .test_third_law import resultant

SPRING = ("elements.spring.second=inner_ring", "elements.spring.parameters.stiffness_x=2 N/um")


def axial(found: Any) -> float:
    """Return the thrust that the inner raceway's contacts carry [N]."""
    inner = [contact for contact in found.contacts if contact.ring == "inner"]
    return sum(contact.load_N * np.sin(np.radians(contact.contact_angle_deg)) for contact in inner)


def test_a_spring_to_the_ground_takes_its_share_of_the_thrust() -> None:
    """Share thrust with a spring to the ground.

    1.3 kN = thrust on the balls + k x; friction at the contacts, which is not counted here, carries 0.1 % of it.
    """
    bare, found = api.quasistatic("6208-axial-1300"), api.quasistatic("6208-axial-1300", SPRING)
    share = 2e6 * 1e-6 * found.inner_ring_displacement_um[0]
    assert 200.0 < share < 350.0
    assert axial(bare) == pytest.approx(1300.0, rel=1.5e-3)
    assert axial(found) + share == pytest.approx(1300.0, rel=1.5e-3)


def test_a_preload_is_a_load() -> None:
    """Compare a preload with a load of 1 kN.

    F_0 = 1 kN from the ground; to the tolerance of the equilibrium.
    """
    loaded = api.quasistatic("6208-axial-1300", ["loads.axial=2.3 kN"])
    pressed = api.quasistatic(
        "6208-axial-1300", ["elements.press.second=inner_ring", "elements.press.parameters.preload_x=1 kN"]
    )
    for one, other in zip(loaded.contacts, pressed.contacts, strict=True):
        assert one.load_N == pytest.approx(other.load_N, rel=1e-6)


def test_stiffness_is_the_bearings_own() -> None:
    from lambda_core.solver.drivers.equilibrium import solve
    from lambda_core.solver.drivers.stiffness import stiffness_matrix

    # Locked in place, the ring stands where it stands, with the spring or without.
    held = ("bodies.inner_ring.x=locked", "bodies.inner_ring.y=locked", "bodies.inner_ring.z=locked")
    held += (
        "bodies.inner_ring.tilt_y=locked",
        "bodies.inner_ring.tilt_z=locked",
        "bearing.clearance=-5 um",
        "loads.axial=0 N",
    )
    one, other = (stiffness_matrix(solve(api.check("6208-axial-1300", [*held, *more]))) for more in ((), SPRING))
    np.testing.assert_array_equal(one, other)


def test_what_an_element_does_to_its_bodies_sums_to_nothing() -> None:
    """Sum internal forces to rounding.

    The element to the ground is left out; rounding of some hundred additions.
    """
    inside = [change for change in LINKS if "elements.spring" not in change]
    m = machine(TIGHT, *(f"bodies.outer_ring.{dof}=free" for dof in ("x", "y", "z")), *NO_FIELD, *inside)
    bare = machine(TIGHT, *(f"bodies.outer_ring.{dof}=free" for dof in ("x", "y", "z")), *NO_FIELD)
    y = random_state(m, 3, "rolling")
    found, without = m.evaluate(y), bare.evaluate(y)
    acting = found.body_forces - without.body_forces
    assert np.abs(acting[:2]).max() > 100.0
    assert np.abs(acting[2]).max() < 1e-9 * np.abs(acting).max()
    assert max(resultant(m.state(y), found)) < 1e-12


def test_energy_closes_in_a_run(tmp_path: Path) -> None:
    result = api.run(
        "6208-axial-1300", [*SPRING, "elements.spring.parameters.damping_x=200 N s/m", "solver.duration=20 ms"],
        out=tmp_path / "spring.h5",
    )  # fmt: skip
    assert abs(result.summary().energy_residual) < 1e-3
    assert [row["element"] for row in result.laws if row["role"] == "force_element"] == ["elements.spring"]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (["elements.a.second=ring"], r'elements\.a\.second +"ring" is not a known body or marker; nearest: '),
        (["elements.a.second=ground"], "the ground cannot move: write it as `first`"),
        (["elements.a.first=inner_ring", "elements.a.second=inner_ring"], "both ends are on one body, inner_ring"),
        (["elements.a.second=cage", "depth.cage=false"], "there is no cage"),
        (
            ["elements.a.second=inner_ring", "elements.a.law=bushin"],
            '"bushin" is not a force_element model; near',
        ),
        (
            ["elements.a.second=inner_ring", "elements.a.parameters.stiffness=1 N/m"],
            r'elements\.a\.parameters\.stiffness +"stiffness" is not a known parameter of force_element bushing',
        ),
        (["elements.a.second=inner_ring", "elements.a.parameters.stiffness_x=-1 N/m"], "must be at least 0"),
        (
            ["markers.cage.body=inner_ring", "elements.a.second=cage"],
            '"cage" is a marker and also a reserved name',
        ),
        (["elements.a.first=inner_ring"], r"elements\.a\.second +is required"),
    ],
)
def test_mistakes_have_their_place(changes: list[str], words: str) -> None:
    with pytest.raises(CaseError, match=words):
        api.check("6208-axial-1300", changes)
