"""Test the pull against Maxwell's stress around the rotor."""

import numpy as np
import pytest
from magnetic_pull import VACUUM, magnetic_pull

from lambda_core.testing import check_model, evaluate


def test_contract():
    check_model(magnetic_pull)


def test_stress_summed_around_the_rotor():
    radius, length, gap, density, eccentricity, pairs = 0.06, 0.1, 0.6e-3, 0.8, 1e-7, 2
    angle = np.linspace(0.0, 2.0 * np.pi, 20_000, endpoint=False)
    field = density * np.cos(pairs * angle) * gap / (gap - eccentricity * np.cos(angle))
    stress = field**2 / (2.0 * VACUUM)
    expected = np.mean(stress * np.cos(angle)) * 2.0 * np.pi * radius * length
    still = {"t": 0.0, "tilt": np.zeros(3), "v_rel": np.zeros(3), "omega_rel": np.zeros(3)}
    force = evaluate(magnetic_pull, place=np.array([0.0, eccentricity, 0.0]), **still)
    assert force[1] == pytest.approx(expected, rel=1e-3)
    assert np.count_nonzero(force) == 1
