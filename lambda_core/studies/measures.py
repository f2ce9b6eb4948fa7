"""Compute responses from an equilibrium or a run."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import RINGS
from lambda_core.formulas.between_rings import between_rings
from lambda_core.formulas.kinematics import cage_speed
from lambda_core.formulas.loading import CARRYING
from lambda_core.results.convergence import window_of

if TYPE_CHECKING:
    from lambda_core.analysis.static_point import BearingPoint
    from lambda_core.results.reader import Result
    from lambda_core.studies.points import DynamicPoint

_INNER = RINGS.index("inner")
_BINS = 72  # over azimuth: 5 degrees each


# -- quasi-static --


def _contacts(point: BearingPoint, name: str) -> FloatArray:
    from lambda_core.solver.records import CONTACT_CHANNELS

    found: FloatArray = point.equilibrium.contacts[:, :, CONTACT_CHANNELS.index(name)]
    return found


def _under_load(point: BearingPoint, name: str) -> FloatArray:
    load = _contacts(point, "load")
    found: FloatArray = _contacts(point, name)[load > CARRYING * load.max()]
    return found


def static_power(point: BearingPoint) -> float | None:
    """Return the power of all contacts [W].

    None of rollers where nothing turns.
    """
    return float(point.equilibrium.losses.sum()) if point.rollers is None else point.summary.power_loss_W


def static_film(point: BearingPoint) -> float:
    """Return the smallest film of the loaded contacts [um]."""
    return 1e6 * float(_under_load(point, "film_minimum").min())


def static_lambda(point: BearingPoint) -> float:
    """Return the smallest Lambda under load."""
    return float(_under_load(point, "film_parameter").min())


def static_capacitance(point: BearingPoint) -> float:
    """Return the capacitance of the balls [nF].

    It is infinite where asperities short a ball.
    """
    return 1e9 * between_rings(_contacts(point, "capacitance"))


# -- dynamic --


def _start(result: Result) -> float:
    return float(window_of(result).interval.first[0])


def dynamic_power(point: DynamicPoint) -> float:
    """Return the mean power [W].

    It is dissipated in the averaging window.
    """
    interval = window_of(point.result).interval
    return interval.torque() * interval.ratio("relative_angle", "time")


def max_load(point: DynamicPoint) -> float:
    """Return the largest contact load [N].

    It is the larger one of both rings in the averaging window.
    """
    return max(float(block["load"].max()) for block in point.result.blocks(("load",), _start(point.result)))


def dynamic_lambda(point: DynamicPoint) -> float:
    """Return the smallest Lambda under load in the averaging window."""
    smallest = math.inf
    for block in point.result.blocks(("load", "film_parameter"), _start(point.result)):
        load = block["load"]
        carrying = load > CARRYING * load.max(axis=(1, 2), keepdims=True)
        if carrying.any():
            smallest = min(smallest, float(block["film_parameter"][carrying].min()))
    return smallest


def dynamic_capacitance(point: DynamicPoint) -> float:
    """Return the bearing's mean capacitance in the averaging window [nF]."""
    values = [
        block["bearing_capacitance"] for block in point.result.blocks(("bearing_capacitance",), _start(point.result))
    ]
    return 1e9 * float(np.concatenate(values).mean())


def cage_speed_deviation(point: DynamicPoint) -> float | None:
    """Return the relative deviation of the cage's speed.

    Standard deviation of its angular speed over its mean, in the averaging window.

    Small for a cage that turns steadily; a usual measure of cage stability (Ghaisas, Wassgren and Sadeghi 2004,
    J. Tribol. 126, 681, use the deviation ratio of the cage's velocity in the same way).
    """
    if not point.result.model["depth"]["cage"]:
        return None
    spin = np.concatenate(
        [block["body_spin"][:, 2] for block in point.result.blocks(("body_spin",), _start(point.result))]
    )
    mean = abs(float(spin.mean()))
    return float(spin.std()) / mean if mean > 0.0 else None


def ball_speed_deviation(point: DynamicPoint) -> float | None:
    """Return the rms deviation of the balls' speed.

    It is the deviation of (orbital over kinematic speed - 1) over azimuth bins outside the static load zone.

    The static load zone is where the inner ring loads balls in the equilibrium at the start of the run, from the first
    to the last loaded ball; None when it goes all round.
    """
    result = point.result
    spin = result["body_spin"]
    geometry = result.model["geometry"]
    angle = result.sample(0, ("contact_angle", "load", "ball_azimuth"))
    load = angle["load"][:, _INNER]
    loaded = load > CARRYING * load.max()
    zone = np.floor(np.mod(angle["ball_azimuth"][loaded], 2.0 * math.pi) / (2.0 * math.pi) * _BINS).astype(int) % _BINS
    outside = _outside(np.unique(zone))
    if not outside.any():
        return None
    cosine = float((load * np.cos(angle["contact_angle"][:, _INNER])).sum() / load.sum())
    gamma = geometry["ball_diameter"] * cosine / geometry["pitch_diameter"]
    rows = slice(int(np.searchsorted(result["time"], _start(result))), None)
    kinematic = cage_speed(float(spin[rows, 0].mean()), float(spin[rows, 1].mean()), gamma)
    if kinematic == 0.0:
        return None
    ratio = result["ball_velocity"][rows, :, 2] / result["ball_radius"][rows] / kinematic
    turn = np.mod(result["ball_azimuth"][rows], 2.0 * math.pi) / (2.0 * math.pi)
    index = np.floor(turn * _BINS).astype(int) % _BINS
    count = np.bincount(index.ravel(), minlength=_BINS)
    with np.errstate(invalid="ignore"):
        mean = np.bincount(index.ravel(), ratio.ravel(), _BINS) / count
    chosen = mean[outside & (count > 0)] - 1.0
    return float(np.sqrt(np.mean(chosen**2))) if chosen.size else None


def _outside(loaded: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Return the bins of the largest gap.

    It is between loaded bins, shape (bins,).
    """
    outside = np.zeros(_BINS, bool)
    gaps = np.diff(np.append(loaded, loaded[0] + _BINS))
    widest = int(np.argmax(gaps))
    for step in range(1, int(gaps[widest])):
        outside[(loaded[widest] + step) % _BINS] = True
    # Balls stand apart by 360 deg / Z: a gap no wider than two of these is a bearing loaded all round.
    return outside if gaps[widest] > 2 * _BINS // max(loaded.size, 3) else np.zeros(_BINS, bool)


def pocket_share(point: DynamicPoint) -> float | None:
    """Return the share of samples with pocket contact.

    The share is taken over the averaging window; a contact is a pocket that touches its ball.
    """
    if not point.result.model["depth"]["cage"]:
        return None
    touching = [
        np.linalg.norm(block["pocket_force"], axis=2) > 0.0
        for block in point.result.blocks(("pocket_force",), _start(point.result))
    ]
    return float(np.concatenate(touching).mean())
