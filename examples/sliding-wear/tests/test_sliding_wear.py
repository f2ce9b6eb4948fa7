"""Test the wear rate against Archard's."""

import numpy as np
from sliding_wear import Archard, wear


def test_closed_form():
    loads, slips = np.full((1, 1, 2), 1e3), np.full((1, 1, 2), -0.5)
    samples = {"asperity_share": np.array([[[0.1, 0.0]]]), "load": loads, "slip": slips}
    np.testing.assert_allclose(wear(samples, Archard(), {})["wear_rate"], [[[1e-8 * 100.0 * 0.5 / 7.5e9, 0.0]]])
