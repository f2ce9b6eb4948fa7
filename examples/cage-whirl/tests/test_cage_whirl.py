"""Test that the event happens beyond its limit only."""

import numpy as np
from cage_whirl import Whirl, whirls


def test_limit():
    places = np.zeros((2, 3, 3))
    places[:, 2, 1] = 0.9e-4, 1.1e-4
    found = whirls({"body_position": places}, Whirl(), {"cage": {"pocket_clearance": 2e-4}})
    assert found.tolist() == [False, True]
