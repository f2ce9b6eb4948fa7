"""Evaluate the two stability criteria of Fig. 5.

They describe the balls outside the static load zone.

S: rms over azimuth of the mean of (orbital speed over kinematic speed - 1). T: share of time in which the
inner ring presses a ball there. Both with a standard error by leaving out one tenth of the window after the other.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import RINGS
from lambda_core.formulas.kinematics import cage_speed
from lambda_core.results.reader import Result

BINS = 72  # over azimuth, 5 degrees each
BLOCKS = 10  # of the window, whole cage turns or nearly so
MARGIN = math.radians(5.0)  # beyond the edge of the load zone: the ring moves a little while balls pass
_INNER = RINGS.index("inner")


@dataclass(frozen=True)
class Zone:
    """The static load zone."""

    middle: float  # azimuth of the load [rad]
    half: float  # half its angle [rad]; pi when all balls are loaded, 0 when none

    def outside(self, azimuth: FloatArray) -> NDArray[np.bool_]:
        """Tell which azimuths [rad] are outside the zone.

        An azimuth counts as outside beyond the margin.
        """
        away = np.abs(np.mod(azimuth - self.middle + math.pi, 2.0 * math.pi) - math.pi)
        return np.asarray(away > self.half + MARGIN)


def half_zone(shift: float, clearance: float) -> float:
    """Return half the angle of the load zone [rad].

    It follows cos(psi_l) = P_d/(2 delta_r), P_d the clearance and delta_r the radial displacement of the rings against
    each other: Harris and Kotzalas, Essential Concepts of Bearing Technology, 5th ed., eq. 7.12.
    """
    if shift == 0.0:
        return math.pi if clearance < 0.0 else 0.0
    return math.acos(max(-1.0, min(1.0, 0.5 * clearance / shift)))


def static_zone(result: Result) -> Zone:
    """Return the load zone of the initial equilibrium."""
    start = result.sample(0, ("body_position",))["body_position"]
    y, z = (float(start[0, i] - start[1, i]) for i in (1, 2))
    return Zone(math.atan2(z, y), half_zone(math.hypot(y, z), float(result.model["geometry"]["clearance"])))


def excitation_frequency(result: Result) -> float:
    """Return the outer ring's axial excitation frequency [Hz].

    0 when it does not move.
    """
    terms = result.model["outer_ring"]["dofs"]["x"]["motion"]["terms"]
    return max((float(t["values"][1]) for t in terms if t["kind"] == "harmonic"), default=0.0)


def jackknife(sums: NDArray[Any], counts: NDArray[Any]) -> tuple[float, float]:
    """Return the rms of means and its standard error.

    They are taken over bins of the mean of a quantity (Efron and Tibshirani 1993, eq. 11.5).

    Parameters
    ----------
    sums, counts : float64[:, :], shape (blocks, bins)
        Sum of the quantity and number of its samples.
    """

    def rms(total: NDArray[Any], number: NDArray[Any]) -> float:
        seen = number > 0
        return float(np.sqrt(np.mean((total[seen] / number[seen]) ** 2)))

    without = np.array([rms(sums.sum(0) - s, counts.sum(0) - c) for s, c in zip(sums, counts, strict=True)])
    n = len(without)
    return rms(sums.sum(0), counts.sum(0)), float(np.sqrt((n - 1) / n * np.sum((without - without.mean()) ** 2)))


def stability(result: Result) -> dict[str, float | None]:
    """Return S, T and their standard errors.

    They cover the whole excitation periods after the first cage turn.
    """
    zone, frequency = static_zone(result), excitation_frequency(result)
    time, turn = result["time"], _cage_turn(result)
    window = float(result.model["solver"]["duration"]) - turn
    if frequency > 0.0:
        window = math.floor(window * frequency + 1e-3) / frequency
    rows = time > time[-1] - window - 1e-12
    azimuth, load = result["ball_azimuth"][rows], result["load"][rows][:, :, _INNER]
    block = np.minimum(((time[rows] - time[rows][0]) / window * BLOCKS).astype(int), BLOCKS - 1)
    ratio = _over_kinematic(result, rows)
    outside = zone.outside(azimuth)
    place = np.floor(np.mod(azimuth, 2.0 * math.pi) / (2.0 * math.pi) * BINS).astype(int) % BINS
    index = (block[:, None] * BINS + place)[outside]
    shape = (BLOCKS, BINS)
    counts = np.bincount(index, np.ones(index.size), BLOCKS * BINS).reshape(shape)
    slip = np.bincount(index, ratio[outside] - 1.0, BLOCKS * BINS).reshape(shape)
    touch = np.bincount(index, (load[outside] > 0.0).astype(float), BLOCKS * BINS).reshape(shape)
    s, s_error = jackknife(slip, counts)
    t, t_error = jackknife(touch.sum(1, keepdims=True), counts.sum(1, keepdims=True))
    return {
        "S": s,
        "S_error": s_error,
        "T": t,
        "T_error": t_error,
        "zone_half_deg": math.degrees(zone.half),
        "cage_turns": window / turn,
        "wall_s": result.summary().wall_s,
    }


def _cage_turn(result: Result) -> float:
    """Return the time of one nominal cage turn [s]."""
    geometry, spin = result.model["geometry"], result.sample(0, ("body_spin",))["body_spin"]
    gamma = geometry["ball_diameter"] / geometry["pitch_diameter"]
    return 2.0 * math.pi / abs(cage_speed(float(spin[0]), float(spin[1]), gamma))


def _over_kinematic(result: Result, rows: NDArray[np.bool_]) -> FloatArray:
    """Return orbital over kinematic speed of every ball.

    The shape is (time, ball).

    Kinematic: no slip at the mean contact angle of the loaded balls.
    """
    geometry, spin = result.model["geometry"], result["body_spin"][rows]
    load, angle = result["load"][rows][:, :, _INNER], result["contact_angle"][rows][:, :, _INNER]
    cosine = float((load * np.cos(angle)).sum() / load.sum())
    gamma = geometry["ball_diameter"] * cosine / geometry["pitch_diameter"]
    kinematic = cage_speed(float(spin[:, 0].mean()), float(spin[:, 1].mean()), gamma)
    ratio: FloatArray = result["ball_velocity"][rows][:, :, 2] / result["ball_radius"][rows] / kinematic
    return ratio
