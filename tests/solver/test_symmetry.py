"""Test that turned and mirrored bearings behave the same."""

from __future__ import annotations

import math

import numpy as np
import pytest

from lambda_core import api
from lambda_core.solver.drivers.dynamics import BearingEngine
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve

from .support import FloatArray

CASE = "6319-cp10-1500"
BALLS = 9
# Combined load, oblique to the balls' pattern. Oil that stands at one level knows up and down: see `level`.
RADIAL, AXIAL, DIRECTION, MOMENT_Y, MOMENT_Z = 16.0, 4.0, 281.0, 60.0, -25.0


def loads(direction: float, axial: float, moment_y: float, moment_z: float, speed: float) -> tuple[str, ...]:
    return (
        f"loads.radial={RADIAL!r} kN", f"loads.radial_direction={direction % 360.0!r} deg", f"loads.axial={axial!r} kN",
        f"loads.moment_y={moment_y!r} N m", f"loads.moment_z={moment_z!r} N m", f"operation.speed={speed!r} rpm",
    )  # fmt: skip


def turned(angle: float) -> tuple[str, ...]:
    """Return loads turned about the shaft.

    Moments and gravity, too, by `angle` [deg].
    """
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    g = 9.80665
    moment_y, moment_z = c * MOMENT_Y - s * MOMENT_Z, s * MOMENT_Y + c * MOMENT_Z
    return (
        *loads(DIRECTION + angle, AXIAL, moment_y, moment_z, 1500.0), "models.fluid_drag=none",
        f"gravity.y={s * g!r} m/s2", f"gravity.z={-c * g!r} m/s2",
    )  # fmt: skip


ORIGINAL = loads(DIRECTION, AXIAL, MOMENT_Y, MOMENT_Z, 1500.0)
MIRRORED_Y = loads(540.0 - DIRECTION, AXIAL, MOMENT_Y, -MOMENT_Z, -1500.0)  # y -> -y: moments are axial vectors
MIRRORED_X = loads(DIRECTION, -AXIAL, -MOMENT_Y, -MOMENT_Z, 1500.0)  # x -> -x: the sense of rotation stays
# How channels of contacts change: +1 or -1 under each mirror, in the order of observe.CONTACT_CHANNELS.
SIGNS_Y = np.array([1, 1, 1, 1, 1, 1, 1, 1, 1, 1, -1, -1, -1, 1, 1, 1.0])
SIGNS_X = np.array([1, -1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, -1, 1, 1, 1.0])


def equilibrium(overrides: tuple[str, ...], phase: float = 0.0) -> Equilibrium:
    return solve(api.check(CASE, overrides), phase=phase)


def check_contacts(found: FloatArray, expected: FloatArray, tolerance: float) -> None:
    """Compare every channel of every contact.

    Each relative to its own largest value.
    """
    largest = np.abs(expected).max(axis=(0, 1), where=np.isfinite(expected), initial=0.0)
    both = np.isfinite(expected)
    assert np.array_equal(both, np.isfinite(found))
    difference = np.abs(np.where(both, found, 0.0) - np.where(both, expected, 0.0))
    assert np.all(difference <= tolerance * largest)


@pytest.mark.parametrize("angle", [40.0, 17.3, -123.0, 180.0])
def test_azimuth_origin_quasi_static(angle: float) -> None:
    """Turn loads, balls and gravity together.

    40 degrees is one ball pitch.
    """
    base, other = equilibrium(turned(0.0)), equilibrium(turned(angle), phase=angle * BALLS / 360.0)
    check_contacts(other.contacts, base.contacts, 1e-8)
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    x, y, z, tilt_y, tilt_z = base.displacement
    expected = (x, c * y - s * z, s * y + c * z, c * tilt_y - s * tilt_z, s * tilt_y + c * tilt_z)
    assert other.displacement == pytest.approx(expected, abs=1e-8 * max(abs(v) for v in expected))


@pytest.mark.parametrize(
    ("mirrored", "signs", "displacement", "order"),
    [
        (MIRRORED_Y, SIGNS_Y, (1, -1, 1, 1, -1), -np.arange(BALLS) % BALLS),
        (MIRRORED_X, SIGNS_X, (-1, 1, 1, -1, -1), np.arange(BALLS)),
    ],
    ids=["y", "x"],
)
def test_mirrored_load_quasi_static(
    mirrored: tuple[str, ...], signs: FloatArray, displacement: tuple[int, ...], order: FloatArray
) -> None:
    base, other = equilibrium(ORIGINAL), equilibrium(mirrored)
    check_contacts(other.contacts[order] * signs, base.contacts, 1e-8)
    expected = np.array(base.displacement) * displacement
    assert other.displacement == pytest.approx(expected, abs=1e-8 * np.abs(expected).max())


def run(overrides: tuple[str, ...], phase: float = 0.0) -> dict[str, FloatArray]:
    """Return the samples of the first 5 ms.

    At a tight tolerance.

    Newton's iteration stops within a share of the tolerance, and a mirrored bearing gets there another way: the
    Jacobian's differences are one-sided. What remains is a small share of the tolerance.
    """
    model = api.check(CASE, (*overrides, "output.interval=0.5 ms", "solver.tolerance=1e-6"))
    engine = BearingEngine(model, equilibrium=solve(model, phase=phase))
    assert engine.advance(5e-3).ok
    return engine.samples()


SAME = ("load", "contact_angle", "film_central", "max_pressure", "slip", "spin_velocity", "contact_loss", "ball_radius")


def check_run(found: FloatArray, expected: FloatArray, name: str) -> None:
    assert expected.shape[0] > 5
    assert np.abs(found - expected).max() <= 1e-6 * np.abs(expected).max(), name


@pytest.mark.parametrize("angle", [40.0, 17.3])
def test_azimuth_origin_dynamic(angle: float) -> None:
    base, other = run(turned(0.0)), run(turned(angle), phase=angle * BALLS / 360.0)
    for name in (*SAME, "ball_velocity", "ball_spin", "body_spin", "loss", "input_torque", "pocket_force"):
        check_run(other[name], base[name], name)


@pytest.mark.parametrize(
    ("mirrored", "flipped", "order"),
    [
        (MIRRORED_Y, ("slip", "spin_velocity"), -np.arange(BALLS) % BALLS),
        (MIRRORED_X, ("contact_angle", "spin_velocity"), np.arange(BALLS)),
    ],
    ids=["y", "x"],
)
def test_mirrored_load_dynamic(mirrored: tuple[str, ...], flipped: tuple[str, ...], order: FloatArray) -> None:
    base, other = run(ORIGINAL), run(mirrored)
    for name in SAME:
        sign = -1.0 if name in flipped else 1.0
        check_run(sign * other[name][:, order], base[name], name)
    for name in ("loss", "stored_energy"):
        check_run(other[name], base[name], name)
