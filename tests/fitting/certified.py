"""Provide regression data of NIST with certified values.

Statistical Reference Datasets, 1997; public domain.
"""

from __future__ import annotations

import numpy as np

MISRA_X = np.array([
    77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0,
])  # fmt: skip
MISRA_Y = np.array([
    10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78,
])  # fmt: skip
MISRA_STARTS = ((500.0, 1e-4), (250.0, 5e-4))
MISRA_VALUES = np.array([2.3894212918e2, 5.5015643181e-4])
MISRA_DEVIATIONS = np.array([2.7070075241, 7.2668688436e-6])
MISRA_SCATTER = 1.0187876330e-1

THURBER_X = np.array([
    -3.067, -2.981, -2.921, -2.912, -2.840, -2.797, -2.702, -2.699, -2.633, -2.481, -2.363, -2.322, -1.501, -1.460,
    -1.274, -1.212, -1.100, -1.046, -0.915, -0.714, -0.566, -0.545, -0.400, -0.309, -0.109, -0.103, 0.010, 0.119,
    0.377, 0.790, 0.963, 1.006, 1.115, 1.572, 1.841, 2.047, 2.200,
])  # fmt: skip
THURBER_Y = np.array([
    80.574, 84.248, 87.264, 87.195, 89.076, 89.608, 89.868, 90.101, 92.405, 95.854, 100.696, 101.060, 401.672, 390.724,
    567.534, 635.316, 733.054, 759.087, 894.206, 990.785, 1090.109, 1080.914, 1122.643, 1178.351, 1260.531, 1273.514,
    1288.339, 1327.543, 1353.863, 1414.509, 1425.208, 1421.384, 1442.962, 1464.350, 1468.705, 1447.894, 1457.628,
])  # fmt: skip
THURBER_STARTS = ((1000.0, 1000.0, 400.0, 40.0, 0.7, 0.3, 0.03), (1300.0, 1500.0, 500.0, 75.0, 1.0, 0.4, 0.05))
THURBER_VALUES = np.array([
    1.2881396800e3, 1.4910792535e3, 5.8323836877e2, 7.5416644291e1, 9.6629502864e-1, 3.9797285797e-1, 4.9727297349e-2,
])  # fmt: skip
THURBER_DEVIATIONS = np.array([
    4.6647963344, 3.9571156086e1, 2.8698696102e1, 5.5675370270, 3.1333340687e-2, 1.4984928198e-2, 6.5842344623e-3,
])  # fmt: skip
THURBER_SCATTER = 1.3714600784e1


def misra(values: np.ndarray) -> np.ndarray:
    """Return Misra's curve of dental research (1978)."""
    return np.asarray(values[0] * (1.0 - np.exp(-values[1] * MISRA_X)))


def thurber(values: np.ndarray) -> np.ndarray:
    """Return Thurber's curve of electron mobility (1979)."""
    top = np.polyval(values[3::-1], THURBER_X)
    return np.asarray(top / (1.0 + THURBER_X * np.polyval(values[:3:-1], THURBER_X)))
