"""Test powers at a state.

Every dissipator takes, and what goes in is dissipated or stored.
"""

from __future__ import annotations

import numpy as np
import pytest

from .support import ALL_FREE, FloatArray, Machine, jostle, machine, rolling

TIGHT = "bearing.clearance=10 um"
SUPPORTS = tuple(
    f"bodies.{body}.{dof}.{what}={value}"
    for body in ("inner_ring", "outer_ring")
    for dof, stiffness, damping in (
        ("x", "2e7 N/m", "300 N s/m"),
        ("y", "3e7 N/m", "500 N s/m"),
        ("z", "4e7 N/m", "700 N s/m"),
        ("tilt_y", "1e4 N m/rad", "0.5 N m s/rad"),
        ("tilt_z", "2e4 N m/rad", "0.7 N m s/rad"),
    )
    for what, value in (("stiffness", stiffness), ("damping", damping))
)
HARMONIC_OUTER_RING = tuple(
    f"bodies.outer_ring.{dof}.{what}"
    for dof, amplitude in (("x", "5 um"), ("z", "3 um"), ("tilt_y", "0.1 mrad"))
    for what in ("mode=prescribed", "motion.kind=harmonic", f"motion.amplitude={amplitude}",
                 "motion.frequency=900 Hz", "motion.phase=40 deg")
)  # fmt: skip
LOADS = (
    "loads.axial=3 kN", "loads.moment_y=20 N m", "loads.moment_z=-30 N m", "loads.inner_ring.force_y=500 N",
    "loads.outer_ring.force_z=300 N", "loads.outer_ring.moment_y=5 N m", "loads.cage.force_x=2 N",
    "bodies.inner_ring.unbalance=50 g mm", "bodies.cage.unbalance=20 g mm", "gravity.x=3 m/s2", "gravity.y=-5 m/s2",
)  # fmt: skip
LINKS = (
    "markers.edge.body=outer_ring", "markers.edge.x=20 mm", "markers.edge.y=90 mm",
    "markers.end.body=inner_ring", "markers.end.x=-50 mm", "markers.end.z=10 mm",
    "elements.bush.first=edge", "elements.bush.second=end", "elements.bush.parameters.stiffness_x=3 N/um",
    "elements.bush.parameters.stiffness_y=1 N/um", "elements.bush.parameters.damping_z=50 N s/m",
    "elements.bush.parameters.tilt_stiffness=2 N m/mrad", "elements.bush.parameters.spin_damping=0.01 N m s/rad",
    "elements.spring.second=cage", "elements.spring.parameters.stiffness_z=0.1 N/um",
    "elements.spring.parameters.preload_x=20 N",
)  # fmt: skip
ELASTIC = (
    "elastic.outer_ring.housing_stiffness=100 N/um", "elastic.outer_ring.orders=4",
    "elastic.inner_ring.housing_stiffness=300 N/um", "elastic.inner_ring.orders=3",
)  # fmt: skip
CAGE = ("elastic.cage.orders=4", "elastic.cage.section_height=3 mm", "elastic.cage.section_width=5 mm")
MODELS: dict[str, tuple[str, ...]] = {
    "force elements": (TIGHT, *ALL_FREE, *LINKS),
    "default": (TIGHT,),
    "every body free": (TIGHT, *ALL_FREE),
    "no cage": (TIGHT, "depth.cage=false"),
    "moved and loaded over time": (
        TIGHT, *HARMONIC_OUTER_RING, "loads.axial.kind=harmonic", "loads.axial.amplitude=2 kN",
        "loads.axial.frequency=700 Hz", "operation.speed.kind=ramp", "operation.speed.start=1000 rpm",
        "operation.speed.end=2000 rpm", "operation.speed.end_time=0.02 s",
    ),
    "cells": (TIGHT, "depth.strips=11", "depth.rows=7"),
    "loads, unbalance, oblique gravity": (TIGHT, *ALL_FREE, *LOADS),
    "supports": (TIGHT, *ALL_FREE, *SUPPORTS),
    "driven by a torque": (TIGHT, "bodies.inner_ring.spin=free", "operation.torque=2 N m"),
    "resisted spins": (
        TIGHT, *ALL_FREE, "bodies.inner_ring.spin=free", "bodies.inner_ring.spin.damping=0.01 N m s/rad",
        "bodies.outer_ring.spin.damping=0.02 N m s/rad",
    ),
    "elastic rings": (TIGHT, *ALL_FREE, *ELASTIC),
    "elastic cage": (TIGHT, *ALL_FREE, *CAGE),
    "elastic ring-guided cage": (
        TIGHT, *CAGE, "bodies.cage.guidance=outer ring", "bodies.cage.land_clearance=2 um",
        "elastic.outer_ring.housing_stiffness=100 N/um", "elastic.outer_ring.orders=3",
    ),
    "elastic cage on the inner ring": (
        TIGHT, *CAGE, "bodies.cage.guidance=inner ring", "bodies.cage.land_clearance=2 um",
    ),
    "ring-guided cage": (TIGHT, "bodies.cage.guidance=outer ring", "bodies.cage.land_clearance=2 um"),
    "exact Hertz, no friction": (
        TIGHT, "models.normal_contact=hertz-exact", "models.traction=newtonian", "models.rolling_resistance=none",
        "models.elastic_hysteresis=none", "models.asperity_load=none", "models.fluid_drag=none",
    ),
    "other laws": (
        TIGHT, "models.traction=bair-winer", "models.rolling_resistance=goksem-hargreaves",
        "models.elastic_hysteresis=houpert", "models.boundary_friction=coulomb-regularised",
        "models.fluid_drag=sphere-drag", "models.contact_temperature=isothermal", "models.damping=none",
    ),
    "wavy raceways": (
        TIGHT, *ALL_FREE, "bodies.inner_ring.spin=free", "models.surface=waviness",
        "parameters.surface.axial_share=0.6", "forces.ball_inner.parameters.surface.waves=41",
        "forces.ball_inner.parameters.surface.amplitude=3 um", "forces.ball_outer.parameters.surface.waves=17",
    ),
    "pitted inner raceway": (
        TIGHT, "forces.ball_inner.models.surface=defect", "forces.ball_inner.parameters.surface.width=48 mm",
        "forces.ball_inner.parameters.surface.extent=20 mm", "forces.ball_inner.parameters.surface.azimuth=10 deg",
        "forces.ball_inner.parameters.surface.depth=8 um",
    ),
    "thin film": (TIGHT, "surface.roughness=2 um", "operation.speed=20 rpm"),
}  # fmt: skip
MODES = ("rolling", "sliding", "standing")


def random_state(m: Machine, seed: int, mode: str) -> FloatArray:
    """Return a well-loaded random state.

    Near rolling, balls sliding anyhow, or hardly moving.
    """
    rng = np.random.default_rng(seed)
    state = rolling(m, {"rolling": 150.0, "sliding": -80.0, "standing": 0.0}[mode])
    state = jostle(m, state, rng, motion={"rolling": 1.0, "sliding": 2.0, "standing": 1e-5}[mode])
    if mode == "sliding":
        state.balls[:, 6:] += rng.uniform(-400.0, 400.0, (m.count, 3))
        state.balls[:, 5] += rng.uniform(-8.0, 8.0, m.count)
    if m.model.depth.cage:
        state.balls[:3, 2] += (0.5 * m.model.cage.pocket_clearance / state.balls[0, 1]) * np.array([1.0, -1.0, 1.02])
    else:
        pair = 2.0 * np.arcsin((m.model.geometry.ball_diameter - 3e-6) / (2.0 * state.balls[0, 1]))
        state.balls[1, :3] = state.balls[0, :3] + (0.0, 0.0, pair)
    return m.vector(state)


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("name", MODELS)
def test_no_mechanism_gives_energy(name: str, mode: str) -> None:
    m = machine(*MODELS[name])
    active = dict.fromkeys(m.evaluate(random_state(m, 0, mode)).losses, 0.0)
    for seed in range(12):
        losses = m.evaluate(random_state(m, seed, mode)).losses
        assert min(losses.values()) >= 0.0, losses
        active = {key: max(active[key], value) for key, value in losses.items()}
    expected = {"sliding_inner", "sliding_outer", "pocket" if m.model.depth.cage else "land"}
    assert all(active[name] > 0.0 for name in expected)


def energy_rate(m: Machine, y: FloatArray, dydt: FloatArray, t: float) -> tuple[float, float]:
    """Return the stored energy's rate [W].

    Along the motion, a central difference of fourth order, and its rounding.

    The state is moved along the straight line dy/dt, and time with it, by some nanometres: energy is quadratic in
    the velocities and smooth in the positions at that scale. Rounding of positions costs force times eps times radius.
    """
    velocities = m.state(dydt)
    moving = max(np.abs(velocities.balls[:, :2]).max(), np.abs(velocities.shared[:, :3]).max())
    h = min(1e-6, 2e-9 / moving)

    def at(k: float) -> float:
        return m.stored(y + k * h * dydt, t + k * h)

    size = at(0.0) + 0.5 * m.model.geometry.pitch_diameter * float(m.observe(y, t)["load"].sum())
    rounding = 8.0 * np.finfo(float).eps * size / h
    return (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h), rounding


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("name", MODELS)
def test_power_balance(name: str, mode: str) -> None:
    """Balance powers in any state.

    Input = losses + rate of stored energy: an identity of the equations, whatever the laws.

    A few 1e-9 of the powers remain from the difference, and what rounding of the stored energy leaves. The energy of a
    cage contact is a sum over points of its force, 1e-5 of it off where the law bends: seen where two balls collide.
    """
    m, t = machine(*MODELS[name]), 3e-3
    rel = 1e-6 if name == "no cage" else 1e-8
    for seed in range(3):
        y = random_state(m, seed, mode)
        found = m.evaluate(y, t)
        rate, rounding = energy_rate(m, y, found.dydt, t)
        lost = sum(found.losses.values())
        amount = abs(found.input_power) + lost + abs(rate)
        assert found.input_power == pytest.approx(lost + rate, abs=rel * amount + rounding)
