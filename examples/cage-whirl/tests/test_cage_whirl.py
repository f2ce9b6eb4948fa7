"""Test that the event happens beyond its limit only."""

import numpy as np
from cage_whirl import Whirl, whirl_section, whirls

from lambda_core.testing import run_data


def test_limit():
    places = np.zeros((2, 3, 3))
    places[:, 2, 1] = 0.9e-4, 1.1e-4
    found = whirls({"body_position": places}, Whirl(), {"cage": {"pocket_clearance": 2e-4}})
    assert found.tolist() == [False, True]


def test_the_report_has_the_farthest_place():
    places = np.zeros((2, 3, 3))
    places[1, 2, 2] = 3e-5
    assert whirl_section(run_data(time=[0.0, 1.0], body_position=places))[1].rows == (("farthest", "30"),)
