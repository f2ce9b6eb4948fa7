"""Test elastic rings.

Rigid limit, a finite-element ring under the same loads, waves of a turning ring, resuming.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import CaseError
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.dynamics import BearingEngine

from .ring_of_beams import waves_of_beams
from .support import integrate, machine

CASE = "6319-cp10-1500"


def soft(stiffness: str, orders: int = 6, ring: str = "outer_ring") -> tuple[str, ...]:
    """Return overrides that make a ring elastic."""
    return (f"elastic.{ring}.housing_stiffness={stiffness}", f"elastic.{ring}.orders={orders}")


@pytest.mark.parametrize("ring", ["outer_ring", "inner_ring"])
def test_in_a_rigid_housing_a_ring_is_rigid(ring: str) -> None:
    """Compare with rigid rings to 1e-6.

    Loads, displacement and torque.
    """
    rigid, stiff = api.quasistatic(CASE), api.quasistatic(CASE, soft("1e15 N/m", ring=ring))
    assert stiff.max_load_N == pytest.approx(rigid.max_load_N, rel=1e-6)
    assert stiff.friction_torque_Nmm == pytest.approx(rigid.friction_torque_Nmm, rel=1e-6)
    assert stiff.inner_ring_displacement_um[2] == pytest.approx(rigid.inner_ring_displacement_um[2], rel=1e-6)


def beam_ring(loads: FloatArray, azimuths: FloatArray, waves: int) -> FloatArray:
    """Return the outer ring's wave amplitudes [m].

    Of `waves` waves of its radial displacement, by straight beam elements.
    """
    model = api.check(CASE)
    g, steel = model.geometry, model.outer_material
    inside, outside = 0.5 * g.race_diameter_outer, 0.5 * g.outside_diameter
    radius, bending = 0.5 * (inside + outside), steel.youngs_modulus * g.width * (outside - inside) ** 3 / 12.0
    return waves_of_beams(
        radius, bending, 1e8 / (math.pi * radius), np.stack([loads, 0.0 * loads], axis=1), azimuths, waves
    )


def test_the_shape_is_that_of_a_ring_of_beams() -> None:
    """Compare amplitudes of 2 to 4 waves.

    Under the equilibrium's own loads: 1 % of the largest.
    """
    found = api.quasistatic(CASE, soft("100 N/um"))
    (bent,) = found.ring_shapes
    outer = [contact for contact in found.contacts if contact.ring == "outer"]
    loads = np.array([contact.load_N * math.cos(math.radians(contact.contact_angle_deg)) for contact in outer])
    azimuths = np.radians([contact.azimuth_deg for contact in outer])
    largest = math.hypot(bent.cosine_um[0], bent.sine_um[0])
    for i, waves in enumerate((2, 3, 4)):
        beams = 1e6 * beam_ring(loads, azimuths, waves)
        assert np.abs(beams - [bent.cosine_um[i], bent.sine_um[i]]).max() < 0.01 * largest


def test_a_soft_housing_spreads_the_load() -> None:
    """Soften the housing and spread the load.

    More balls carry, the most loaded one carries less, and the bearing gives way more.
    """
    rigid, firm, soft_one = (api.quasistatic(CASE, o) for o in ((), soft("1000 N/um"), soft("100 N/um")))
    assert rigid.max_load_N > 1.05 * firm.max_load_N > 1.05**2 * soft_one.max_load_N
    assert rigid.loaded_elements <= firm.loaded_elements <= soft_one.loaded_elements
    displacements = [each.inner_ring_displacement_um[2] for each in (rigid, firm, soft_one)]
    assert displacements[0] > displacements[1] > displacements[2]
    (bent,) = soft_one.ring_shapes
    assert abs(math.sin(math.radians(bent.inwards_deg))) < 0.4  # flat at the sides
    assert abs(math.sin(math.radians(bent.outwards_deg))) > 0.9  # out below and above


@pytest.mark.parametrize(("waves", "lag"), [(2, 0.400), pytest.param(3, 0.200, marks=pytest.mark.slow)])
def test_the_pattern_of_a_turning_ring_lags(waves: int, lag: float) -> None:
    """Compare the lag with 2/(n^2 + 1) to 1 %.

    Bryan 1890, Proc. Camb. Phil. Soc. 7, 101: a pattern turns back, seen from the ring.

    From a run of the compiled core: the outer ring turns, no ball touches it, nothing damps its waves.
    """
    m = machine(
        *soft("0 N/m", 3), "elastic.outer_ring.damping_ratio=0", "bearing.clearance=300 um", "gravity.z=0 m/s2",
        "loads.radial=0 N", "bodies.outer_ring.spin=free", "models.fluid_drag=none", "depth.cage=false",
        "operation.speed=100 rpm",
    )  # fmt: skip
    ring = m.model.elastic["outer_ring"].ring
    spin = 5e-3 * ring.frequency(waves)
    start, body = m.at_rest(), 3 + waves - 2
    start.shared[1, L.SSIGMA], start.shared[body, L.SY] = spin, 20e-6
    period = 2.0 * math.pi / ring.frequency(waves)
    with m.frictionless():
        motion = integrate(m, m.vector(start), 20.0 * period, 1e-7, samples=2000, longest=period / 300.0)
    seen = np.array([m.state(y).shared[body] for y in motion.states])
    size = np.hypot(seen[:, L.SY], seen[:, L.SZ])
    last = motion.times > 16.0 * period
    at = int(np.flatnonzero(last)[np.argmax(size[last])])
    turned = math.atan2(seen[at, L.SZ], seen[at, L.SY])
    turned -= math.pi * round(turned / math.pi)  # a swing has two ends
    assert -turned / waves / motion.times[at] / spin == pytest.approx(lag, rel=0.01)


def test_energy_and_waves_of_a_run() -> None:
    """Compare waves with the equilibrium, balance energy.

    Waves settle about those of the equilibrium; energy closes to 1e-3.
    """
    model = api.check("6319-cp10-3000", soft("100 N/um"))
    engine = BearingEngine(model)
    assert engine.advance(0.02).ok
    integrals = engine.integrals()
    lost = sum(value for name, value in integrals.items() if name.startswith(("loss.", "support")))
    assert abs(integrals["input"] - lost - integrals["stored"]) < 1e-3 * integrals["input_abs"]
    assert integrals["loss.bending"] > 0.0
    samples = engine.samples()
    ellipse = samples["outer_ring_waves_2"]
    assert ellipse.shape == (samples["time"].size, 2)
    (start,) = api.quasistatic(model).ring_shapes
    assert 1e6 * ellipse[-1, 0] == pytest.approx(start.cosine_um[0], rel=0.2)


def test_a_continued_run_is_the_uninterrupted_one() -> None:
    model = api.check("6319-cp10-3000", soft("100 N/um", 3))
    complete, first, second = (BearingEngine(model) for _ in range(3))
    complete.advance(2e-3)
    complete.advance(4e-3)
    first.advance(2e-3)
    second.restore(first.state())
    second.advance(4e-3)
    for name, value in complete.now().items():
        np.testing.assert_array_equal(second.now()[name], value, err_msg=name)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"orders": 4}, "elastic.outer_ring.housing_stiffness"),
        ({"housing_stiffness": "-1 N/m"}, "elastic.outer_ring.housing_stiffness"),
        ({"housing_stiffness": "1 N/m", "orders": 1}, "elastic.outer_ring.orders"),
        ({"housing_stiffness": "1 N/m", "section_height": "300 mm"}, "leaves no hole in the ring"),
        ({"housing_stiffness": "1 N/m", "bedding": 3}, "elastic.outer_ring.bedding"),
    ],
)
def test_mistakes(changes: dict[str, object], said: str) -> None:
    with pytest.raises(CaseError) as caught:
        api.check(api.case(CASE).with_(elastic={"outer_ring": changes}))
    assert said in str(caught.value)


def test_numbers_of_a_thin_housing(tmp_path: Path) -> None:
    """Compare waves of the thin housing by hand.

    The case that `init --template thin-housing` writes: its 6208's outer ring by ring theory.

    c_n = sum of Q cos(alpha) cos(n psi)/k_n with k_n = pi E I (n^2 - 1)^2/R^3 + 300 N/um, the case's housing stiffness
    (Timoshenko, Vibration Problems in Engineering, art. 74, on a Winkler bedding); E = 210 GPa of 100Cr6. The friction
    of the balls is not in the sum: 1e-3 of the largest.
    """
    api.init_case("drive", path=tmp_path / "drive.toml", template="thin-housing")
    model = api.check(tmp_path / "drive.toml")
    found = api.quasistatic(model)
    (ring,) = (one for one in found.ring_shapes if one.ring == "outer")
    g = model.geometry
    inside, outside = 0.5 * g.race_diameter_outer, 0.5 * g.outside_diameter
    radius, second_moment = 0.5 * (inside + outside), g.width * (outside - inside) ** 3 / 12.0
    bending = math.pi * 210e9 * second_moment / radius**3
    outer = [contact for contact in found.contacts if contact.ring == "outer"]
    push = np.array([c.load_N * math.cos(math.radians(c.contact_angle_deg)) for c in outer])
    azimuths = np.radians([c.azimuth_deg for c in outer])
    waves = zip(ring.orders, ring.cosine_um, ring.sine_um, strict=True)
    largest = max(abs(c) for c in (*ring.cosine_um, *ring.sine_um))
    for n, cosine, sine in waves:
        stiffness = bending * (n**2 - 1) ** 2 + 300e6
        assert cosine == pytest.approx(1e6 * push @ np.cos(n * azimuths) / stiffness, abs=1e-3 * largest)
        assert sine == pytest.approx(1e6 * push @ np.sin(n * azimuths) / stiffness, abs=1e-3 * largest)
    assert largest > 0.1
