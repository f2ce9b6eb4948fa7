"""Test equilibrium, kinematics and friction of a roller row."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lambda_core.elements.roller import line_film, rib
from lambda_core.elements.roller.roller_bearing import RIBS, RollerBearing
from lambda_core.elements.roller.roller_equilibrium import RollerEquilibrium, balance, single_contact_constant
from lambda_core.elements.roller.roller_friction import FrictionParameters, OilState, RollerFriction, friction
from lambda_core.elements.roller.roller_motion import rolling_motion
from lambda_core.elements.roller.roller_thrust import least_thrust
from lambda_core.model.roller_case import friction_parameters

RPM = math.pi / 30.0
OIL = OilState(0.06, 870.0, 20e-9, 0.045, 0.13)
NU = RollerBearing(
    "NU", 14, 11e-3, 11e-3, 9.5e-3, 60.5e-3, 40e-3, 80e-3, 18e-3, 62e3, 53e3, 6.7e3, clearance=35e-6, rib_height=2e-3
)
TAPERED = RollerBearing(
    *("tapered", 16, 17e-3, 22.7e-3, 20.7e-3, 108.5e-3, 80e-3, 140e-3, 35.25e-3, 187e3, 245e3, 28.5e3),
    contact_angle=math.radians(15.64),
)


def of_kind(kind: str) -> RollerBearing:
    return replace(NU, kind=kind)


def total(bearing: RollerBearing, state: RollerEquilibrium) -> np.ndarray:
    """Return the outer ring's forces x, y, z.

    By the geometry of the contacts, not by the solver's matrices.
    """
    angle = bearing.contact_angle
    load = state.outer.sum(axis=1)
    axial, radial = math.sin(angle) * load.sum(), math.cos(angle) * load
    for index, one in enumerate(bearing.ribs):
        if one.ring == "outer":
            axial -= one.normal[0] * state.ribs[:, index].sum()
            radial = radial - one.normal[1] * state.ribs[:, index]
    return np.array([axial, radial @ np.cos(state.azimuths), radial @ np.sin(state.azimuths)])


@given(axial=st.floats(500.0, 3e4), share=st.floats(0.0, 2.0), direction=st.floats(0.0, 6.3))
@settings(max_examples=10, deadline=None)
def test_what_goes_in_at_the_inner_ring_comes_out_at_the_outer(axial: float, share: float, direction: float) -> None:
    radial = share * axial
    loads = np.array([axial, radial * math.cos(direction), radial * math.sin(direction), 0.0, 0.0])
    state = balance(TAPERED, loads)
    assert total(TAPERED, state) == pytest.approx(loads[:3], abs=1e-6 * axial)
    assert state.loads[:3] == pytest.approx(loads[:3], abs=1e-6 * axial)


@pytest.mark.parametrize("kind", ["NJ", "NUP", "NCF"])
def test_ribs_pass_the_thrust_on(kind: str) -> None:
    state = balance(of_kind(kind), np.array([1e3, 5e3, 0.0, 0.0, 0.0]))
    assert total(of_kind(kind), state) == pytest.approx([1e3, 5e3, 0.0], abs=1e-3)
    assert np.all(state.rollers[state.ribs[:, 0] > 1.0, 2] > 0.0)  # the couple of both ribs tilts the rollers


@pytest.mark.parametrize(("kind", "thrust"), [("NU", 1e3), ("N", 1e3), ("NJ", -1e3), ("NCF", -1e3), ("tapered", 0.0)])
def test_thrust_that_no_rib_takes_is_refused(kind: str, thrust: float) -> None:
    bearing = TAPERED if kind == "tapered" else of_kind(kind)
    with pytest.raises(ValueError, match="thrust"):
        balance(bearing, np.array([thrust, 5e3, 0.0, 0.0, 0.0]))


def test_too_little_thrust_on_a_tapered_bearing_is_named() -> None:
    """Name too little thrust instead of 200 steps."""
    least = 5e3 * math.tan(TAPERED.angles.outer)
    with pytest.raises(ArithmeticError, match=r"must be above F_r tan\(a_o\), with "):
        balance(TAPERED, np.array([0.999 * least, 5e3, 0.0, 0.0, 0.0]))
    with pytest.raises(ArithmeticError, match=r"above F_r tan\(a_o\)/cos\(pi/Z\), with .*; raise it"):
        balance(TAPERED, np.array([1.005 * least, 5e3, 0.0, 0.0, 0.0]), first_angle=math.pi / TAPERED.count)
    state = balance(TAPERED, np.array([1.3 * least, 5e3, 0.0, 0.0, 0.0]))
    assert total(TAPERED, state)[1] == pytest.approx(5e3, rel=1e-6)


@pytest.mark.parametrize("rpm", [1000.0, 4000.0, 12_000.0])
def test_centrifugal_force_raises_the_least_thrust(rpm: float) -> None:
    """Meet the bound from both sides."""
    inertial = rolling_motion(TAPERED, rpm * RPM).inertial(TAPERED)
    least = least_thrust(TAPERED, 2e3, float(inertial[1]))
    assert least > 2e3 * math.tan(TAPERED.angles.outer)
    state = balance(TAPERED, np.array([1.01 * least, 2e3, 0.0, 0.0, 0.0]), inertial=inertial)
    assert 1 <= np.count_nonzero(state.inner.sum(axis=1) > 1.0) <= 5
    scarce = np.array([0.99 * least, 2e3, 0.0, 0.0, 0.0])
    with pytest.raises(ArithmeticError, match="does not hold cone and cup together"):
        balance(TAPERED, scarce, inertial=inertial)


def test_the_rib_has_the_load_of_the_wedge() -> None:
    state = balance(TAPERED, np.array([6e3, 0.0, 0.0, 0.0, 0.0]))
    outer = 6e3 / (16 * math.sin(TAPERED.contact_angle))
    face, inner = rib.rib_load(outer, TAPERED.angles, TAPERED.ribs[0].contact.normal)
    assert state.ribs[:, 0] == pytest.approx(face, rel=1e-6)
    assert state.inner.sum(axis=1) == pytest.approx(inner, rel=1e-6)


def test_a_tilted_ring_tilts_the_rollers_by_half() -> None:
    state = balance(NU, np.array([0.0, 5e3, 0.0, 0.0, 0.0]), displacement=np.array([0.0, 0.0, 0.0, 0.0, 1e-3]))
    back = balance(NU, np.array([0.0, 5e3, 0.0, 0.0, 0.0]), displacement=np.array([0.0, 0.0, 0.0, 0.0, -1e-3]))
    assert state.rollers[0, 2] == pytest.approx(0.5e-3, rel=1e-3)  # both contacts are alike
    assert state.loads[4] > 0.0
    assert state.loads[4] == pytest.approx(-back.loads[4], rel=1e-9)


def test_a_free_tilt_balances_the_moment() -> None:
    loads = np.array([0.0, 5e3, 0.0, 0.0, 2.0])
    state = balance(NU, loads, held=(False, False, False, False, False))
    assert state.loads == pytest.approx(loads, abs=1e-5)
    assert state.ring[4] > 0.0


def test_centrifugal_force_presses_the_outer_raceway() -> None:
    motion = rolling_motion(NU, 10000.0 * RPM)
    state = balance(NU, np.array([0.0, 5e3, 0.0, 0.0, 0.0]), inertial=motion.inertial(NU))
    assert (state.outer.sum(axis=1) - state.inner.sum(axis=1)) == pytest.approx(
        NU.mass * motion.cage**2 * NU.centre, rel=1e-4
    )


def test_gyroscopic_moments_vanish_for_cylinders_and_tilt_cones() -> None:
    assert rolling_motion(NU, 1000.0).inertial(NU)[2] == 0.0
    moment = rolling_motion(TAPERED, 400.0).inertial(TAPERED)[2]
    polar, transverse = TAPERED.inertias
    motion, axis = rolling_motion(TAPERED, 400.0), TAPERED.angles.roller
    by_hand = motion.cage * math.sin(axis) * (polar * motion.spin + (transverse - polar) * motion.cage * math.cos(axis))
    assert abs(moment) == pytest.approx(abs(by_hand))
    assert moment != 0.0


@pytest.mark.parametrize("bearing", [NU, TAPERED], ids=["NU", "tapered"])
def test_both_raceways_roll(bearing: RollerBearing) -> None:
    motion = rolling_motion(bearing, 300.0, -50.0)
    lever = 0.5 * bearing.diameter * math.cos(bearing.angles.roller)
    at_inner = (motion.inner - motion.cage) * (bearing.centre - lever)
    at_outer = (motion.cage - motion.outer) * (bearing.centre + lever)
    assert at_inner == pytest.approx(at_outer)
    assert motion.entrainment == pytest.approx(at_inner)
    if bearing is TAPERED:
        assert motion.turning[0] == pytest.approx(rib.relative_speed(bearing.angles, 350.0), rel=1e-9)


def test_clearance_narrows_the_loaded_zone() -> None:
    many = replace(NU, count=16)
    loads = np.array([0.0, 5e3, 0.0, 0.0, 0.0])
    carrying = [
        int((balance(replace(many, clearance=gap), loads).inner.sum(axis=1) > 1.0).sum()) for gap in (-2e-5, 0.0, 5e-5)
    ]
    assert carrying == sorted(carrying, reverse=True)
    assert carrying[0] > carrying[2]


@pytest.mark.parametrize("kind", ["needle", "NCF"])
def test_needles_and_full_complements_resist_more_with_load_and_speed(kind: str) -> None:
    sizes = {
        "needle": (34, 2.5e-3, 12e-3, 10e-3, 32.5e-3, 25e-3, 42e-3, 17e-3, 24.2e3, 34.5e3, 4.2e3),
        "NCF": (24, 7e-3, 13e-3, 10.8e-3, 54.74e-3, 40e-3, 68e-3, 21e-3, 57.2e3, 69.5e3, 8.2e3),
    }[kind]
    bearing = RollerBearing(kind, *sizes, clearance=30e-6, rib_height=0.8e-3)
    slow, loaded, fast = (
        torque(bearing, [0.0, load, 0.0, 0.0, 0.0], rpm, FrictionParameters()).total
        for load, rpm in ((2e3, 500.0), (8e3, 500.0), (2e3, 3000.0))
    )
    assert slow < loaded
    assert slow < fast
    state = balance(bearing, np.array([0.0, 2e3, 0.0, 0.0, 0.0]))
    assert state.inner.sum(axis=1).argmax() == 0
    assert (state.inner.sum(axis=1) > 0.0).sum() < bearing.count / 2


def test_slices_do_not_matter() -> None:
    loads = np.array([6e3, 9e3, 0.0, 0.0, 0.0])
    few, many = (balance(TAPERED, loads, slices=n) for n in (40, 160))
    assert few.inner.sum(axis=1) == pytest.approx(many.inner.sum(axis=1), rel=5e-3, abs=5.0)


def test_one_contact_is_twice_as_stiff_as_two_in_series() -> None:
    constant = single_contact_constant(12e-3)
    both = 35948.0 * 12.0 ** (8.0 / 9.0) * 10e-3 ** (10.0 / 9.0)  # N at 10 um
    assert constant * 5e-6 ** (10.0 / 9.0) == pytest.approx(both)


def torque(bearing: RollerBearing, loads: list[float], rpm: float, given: FrictionParameters) -> RollerFriction:
    motion = rolling_motion(bearing, rpm * RPM)
    state = balance(bearing, np.array(loads), inertial=motion.inertial(bearing))
    return friction(bearing, state, motion, OIL, given)


def test_friction_is_the_sum_of_its_parts_and_positive() -> None:
    given = FrictionParameters(oil_height=8e-3)
    found = torque(TAPERED, [6e3, 3e3, 0.0, 0.0, 0.0], 1500.0, given)
    parts = [*found.rolling.values(), *found.hysteresis.values(), *found.sliding.values(), found.rib, found.drag]
    assert found.total == pytest.approx(sum(parts))
    assert min(parts) > 0.0


def test_boundary_friction_rules_a_slow_rib() -> None:
    slow = torque(TAPERED, [6e3, 0.0, 0.0, 0.0, 0.0], 1.0, FrictionParameters())
    fast = torque(TAPERED, [6e3, 0.0, 0.0, 0.0, 0.0], 1500.0, FrictionParameters())
    assert 0.08 < slow.rib_friction < 0.12
    assert fast.rib_friction < 0.01
    # sliding with a lever: mu F h omega_rel/omega of every roller
    motion = rolling_motion(TAPERED, RPM)
    state = balance(TAPERED, np.array([6e3, 0.0, 0.0, 0.0, 0.0]))
    lever = TAPERED.ribs[0].contact.height * motion.turning[0] / motion.relative
    assert slow.rib == pytest.approx(slow.rib_friction * state.ribs.sum() * lever, rel=0.04)  # spin adds


def test_starved_and_hot_inlets_resist_less() -> None:
    flooded, starved = (
        torque(NU, [0.0, 5e3, 0.0, 0.0, 0.0], 3000.0, FrictionParameters(replenishment=k)) for k in (0.0, 6e-8)
    )
    assert flooded.supply_factor == 1.0
    assert starved.rolling["inner"] == pytest.approx(starved.supply_factor * flooded.rolling["inner"])
    assert flooded.heat_factor < 1.0


def test_nothing_turns_nothing_resists() -> None:
    state = balance(NU, np.array([0.0, 5e3, 0.0, 0.0, 0.0]))
    with pytest.raises(ValueError, match="turn against each other"):
        friction(NU, state, rolling_motion(NU, 0.0), OIL)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"kind": "NX"}, "NX"),
        ({"contact_angle": 0.2}, "contact_angle"),
        ({"effective_length": 20e-3}, "effective_length"),
        ({"count": 40}, "do not fit"),
    ],
)
def test_impossible_bearings_are_refused(change: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        replace(NU, **change)  # type: ignore[arg-type]


def test_every_kind_has_ribs_in_its_plane() -> None:
    for kind in RIBS:
        bearing = TAPERED if kind == "tapered" else of_kind(kind)
        assert len(bearing.ribs) == len(RIBS[kind])
        for one in bearing.ribs:
            assert math.hypot(*one.normal) == pytest.approx(1.0)


@given(load=st.floats(5e4, 3e5), speed=st.floats(0.5, 5.0))
def test_films_of_moes_and_dowson_agree_where_both_hold(load: float, speed: float) -> None:
    moes = float(line_film.moes_line_film(load, 7e-3, speed, 0.05, 20e-9, 226e9))
    dowson = line_film.dowson_toyoda_film(load, 7e-3, speed, 0.05, 20e-9, 226e9)
    assert moes == pytest.approx(dowson, rel=0.25)


def test_light_rigid_contacts_have_martins_film() -> None:
    # 4.9 eta u R/w is the smallest film of a rigid cylinder (Martin 1916), 1.226 times that where the pressure peaks
    load, speed, viscosity, radius = 20.0, 2.0, 0.05, 7e-3
    found = float(line_film.moes_line_film(load, radius, speed, viscosity, 1e-12, 226e12))
    assert found == pytest.approx(1.226 * 4.896 * viscosity * speed * radius / load, rel=0.01)


def test_asperities_carry_all_without_a_film() -> None:
    assert float(line_film.asperity_share(0.0, 1.9, 0.99)) == 1.0
    assert float(line_film.asperity_share(3.0, 1.9, 0.99)) < 0.005


def test_an_oil_jet_drags_twice_as_much_as_a_bath_to_the_middle_of_the_lowest_roller() -> None:
    """Drag rollers with a jet; they had no drag.

    SKF, Rolling bearings, catalogue 17000 EN (2018), chapter Friction.
    """
    bath, jet = (friction_parameters(TAPERED, 0.16e-6, way, 0.0) for way in ("oil bath", "oil jet"))
    loads = [6e3, 3e3, 0.0, 0.0, 0.0]
    dragged = torque(TAPERED, loads, 1500.0, bath).drag
    assert dragged > 0.0
    assert torque(TAPERED, loads, 1500.0, jet).drag == pytest.approx(2.0 * dragged)
