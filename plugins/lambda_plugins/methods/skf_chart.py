"""Read SKF's chart of the drag loss factor V_M.

SKF, Rolling bearings, catalogue 17000 EN (2018), chapter Friction, diagram of V_M over H/d_m, ball bearings. The points
are those of a public digitisation (JRaposo-m, SKF-Bearing-Selection-Tool): of the enlarged part of the chart up to 0.2,
of the whole chart beyond. Both parts differ by up to 15 % where they overlap: that is the uncertainty of V_M.
"""

from __future__ import annotations

import numpy as np

UNCERTAINTY = 0.15  # of V_M, relative
# Oil level H over d_m, V_M.
_CHART = np.array(
    [
        [0.0, 0.0], [0.00963, 1.62e-6], [0.01926, 6.10e-6], [0.03222, 1.055e-5], [0.04444, 1.501e-5],
        [0.05593, 2.235e-5], [0.06667, 3.142e-5], [0.07630, 4.166e-5], [0.08407, 5.134e-5], [0.09185, 6.159e-5],
        [0.10074, 7.413e-5], [0.10852, 8.554e-5], [0.11630, 9.809e-5], [0.12259, 1.0894e-4], [0.13185, 1.2435e-4],
        [0.13778, 1.3520e-4], [0.14481, 1.4777e-4], [0.15037, 1.5805e-4], [0.15778, 1.7175e-4], [0.16593, 1.8603e-4],
        [0.17481, 2.0144e-4], [0.18148, 2.1401e-4], [0.18926, 2.2656e-4], [0.19444, 2.3628e-4], [0.20037, 2.4713e-4],
        [0.25217, 3.162e-4], [0.28261, 3.641e-4], [0.32391, 4.051e-4], [0.36522, 4.462e-4], [0.43478, 5.111e-4],
        [0.5, 5.658e-4], [0.59783, 6.376e-4], [0.66087, 6.752e-4], [0.72391, 7.197e-4], [0.80870, 7.846e-4],
        [0.86739, 8.359e-4], [0.93913, 9.009e-4], [1.00217, 9.487e-4], [1.04130, 9.795e-4], [1.06957, 1.0068e-3],
        [1.10435, 1.0513e-3], [1.13478, 1.0889e-3], [1.15435, 1.1299e-3], [1.17174, 1.1778e-3], [1.18261, 1.2222e-3],
        [1.20870, 1.2462e-3], [1.4, 1.2462e-3],
    ]
)  # fmt: skip


# With the square law of 2008, 0 to 4.5e-5 agree with the SKF row of Table 4 of Syla et al. 2026: the middle.
EARLIER = 2.25e-5


def drag_loss_factor(level: float, edition: str = "2018") -> float:
    """Return V_M at the relative oil level H/d_m.

    Linear between the chart's points.

    0 without oil, constant above 1.4, where the bearing is drowned. The chart belongs to the edition of 2018; the other
    has one number for every level.
    """
    return float(np.interp(level, _CHART[:, 0], _CHART[:, 1])) if edition == "2018" else EARLIER
