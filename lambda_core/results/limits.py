"""Report results beyond the range of their laws.

The limits concern shoulders, pressures and tilt.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, get_args

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from lambda_core.domain.arrays import FloatArray
from lambda_core.elements.ball.kinds import kind_of, kinds
from lambda_core.formulas.loading import CARRYING, Ring
from lambda_core.model.checks.operating_limits import tilt_warning
from lambda_core.results.record import Record

# Static contact pressure of ball bearings that leaves 1e-4 of the ball diameter behind (ISO 76:2006, 5.1 and 5.2).
_HIGHEST_PRESSURE, _HIGHEST_PRESSURE_ALIGNING = 4.2e9, 4.6e9  # [Pa] of self-aligning ball bearings the latter
# Film parameter Lambda below which lubrication counts as that of a boundary layer: asperities carry much of the load
# (Hamrock and Dowson 1981, Ball Bearing Lubrication).
THINNEST_FILM = 1.0
# Errors of integration are vibrations: beyond this tolerance they set a cage whirling that finer runs leave quiet
# (6208 under 700 N axial: at twice this after 2 s, at ten times within 0.1 s).
COARSEST_TOLERANCE = 1e-3


class Shoulder(Record):
    """Smallest distance of contact ellipses to the shoulder.

    It is the distance on one ring to the edge of the shoulder.
    """

    ring: Ring
    ball: int = Field(description="number of the ball, from 1")
    contact_angle_deg: float
    ellipse_end_deg: float = Field(description="contact angle at the end of the ellipse, towards the shoulder")
    shoulder_deg: float = Field(description="contact angle of the shoulder's edge")
    margin_um: float = Field(description="along the groove from the end of the ellipse to the edge; below 0: beyond it")
    low: bool = Field(default=False, description="whether it is the low shoulder of angular contact, at the bottom")
    ridge: bool = Field(default=False, description="whether it is the edge between the arcs of four-point contact")

    def warning(self) -> list[str]:
        """Return a warning of an ellipse over the edge.

        It is empty where no ellipse passes the edge.
        """
        if self.margin_um >= 0.0:
            return []
        if self.ridge:
            return [
                f"the contact of ball {self.ball} runs {-self.margin_um:.0f} um over the edge between the arcs of the "
                f"{self.ring} ring (ellipse to {self.ellipse_end_deg:.1f} deg): computed as if each arc continued"
            ]
        if self.low:
            return [
                f"the contact of ball {self.ball} runs over the low shoulder of the {self.ring} ring (ellipse to "
                f"{self.ellipse_end_deg:.1f} deg, where the groove ends at 0): more axial load holds an angular "
                "contact bearing together; computed as if the groove continued"
            ]
        return [
            f"the contact of ball {self.ball} runs {-self.margin_um:.0f} um over the {self.ring} ring's shoulder "
            f"(ellipse to {self.ellipse_end_deg:.1f} deg, edge at {self.shoulder_deg:.1f} deg): computed as if the "
            "groove went on"
        ]


@dataclass(frozen=True)
class Grooves:
    """Groove radius and shoulder angles of both rings.

    The inner ring comes first. An angular contact ring has the angle of its high shoulder.
    """

    radius: FloatArray  # (2,) [m]
    edge: FloatArray  # (2,) [rad]
    one_sided: bool = False  # angular contact: the groove ends at its bottom on the side without load
    ridge: FloatArray | None = None  # (2,) four-point contact: angle at which the two arcs of a ring meet [rad]
    kind: str = "deep groove"

    @property
    def least_share(self) -> float:
        """Least share of the largest load.

        Contacts with at least this share count at the high edges.

        A ball of the row that a thrust unloads leans far to the side under its weight alone.
        """
        return CARRYING if kinds()[self.kind].rows == 2 else 0.0

    @staticmethod
    def of(geometry: Mapping[str, Any]) -> Grooves:
        """Take the grooves from the geometry.

        The angle follows from cos(theta) = 1 - |d_shoulder - d_race|/(2 r_groove).
        """
        radius = np.array([float(geometry[f"groove_radius_{ring}"]) for ring in get_args(Ring)])
        height = np.array(
            [
                0.5 * abs(float(geometry[f"shoulder_diameter_{ring}"]) - float(geometry[f"race_diameter_{ring}"]))
                for ring in get_args(Ring)
            ]
        )
        edge = np.arccos(np.clip(1.0 - height / radius, -1.0, 1.0))
        resting, kind = float(geometry.get("resting_angle", 0.0)), kind_of(geometry)
        if kind.arcs == 2:
            shift = (radius - 0.5 * float(geometry["ball_diameter"])) * math.sin(resting)
            return Grooves(radius, edge, ridge=np.arcsin(shift / radius), kind=kind.name)
        return Grooves(radius, edge, kind.one_sided and kind.rows == 1, kind=kind.name)


def shoulders(grooves: Grooves, load: FloatArray, angle: FloatArray, semi_axis: FloatArray) -> list[Shoulder]:
    """Return the worst contact on each ring that carries any.

    Parameters
    ----------
    load, angle, semi_axis : float64[..., :, :], shape (..., ball, ring)
        Load [N], contact angle [rad] and semi-major axis [m] of every contact; the axes before are times.
    """
    half = semi_axis / grooves.radius
    end = np.abs(angle) + half
    found = _nearest(load > grooves.least_share * load.max(initial=0.0), angle, end, grooves.edge, grooves.radius)
    if grooves.one_sided and load.max(initial=0.0) > 0.0:
        side = -np.sign(float((load * angle).sum()))  # of the low shoulder
        carrying = load > CARRYING * load.max()
        low = _nearest(carrying, angle, side * angle + half, np.zeros(2), grooves.radius)
        found += [edge.model_copy(update={"low": True}) for edge in low if edge.margin_um < 0.0]
    if grooves.ridge is not None and load.max(initial=0.0) > 0.0:
        carrying = load > CARRYING * load.max()
        over = _nearest(carrying, angle, half - np.abs(angle), -grooves.ridge, grooves.radius)
        found += [
            edge.model_copy(
                update={"ridge": True, "ellipse_end_deg": -edge.ellipse_end_deg, "shoulder_deg": -edge.shoulder_deg}
            )
            for edge in over
            if edge.margin_um < 0.0
        ]
    return worst(found)


def _nearest(
    counted: NDArray[np.bool_], angle: FloatArray, end: FloatArray, edge: FloatArray, radius: FloatArray
) -> list[Shoulder]:
    """Return the nearest contact to an edge.

    Each ring has the contact whose ellipse ends nearest to the edge, or lies farthest beyond it.
    """
    margin = np.where(counted, (edge - end) * radius, np.inf)
    found = []
    for i, ring in enumerate(get_args(Ring)):
        at = np.unravel_index(int(np.argmin(margin[..., i])), margin.shape[:-1])
        if math.isfinite(margin[..., i][at]):
            found.append(
                Shoulder(
                    ring=ring,
                    ball=int(at[-1]) + 1,
                    contact_angle_deg=math.degrees(abs(float(angle[..., i][at]))),
                    ellipse_end_deg=math.degrees(float(end[..., i][at])),
                    shoulder_deg=math.degrees(float(edge[i])),
                    margin_um=1e6 * float(margin[..., i][at]),
                )
            )
    return found


def worst(found: list[Shoulder]) -> list[Shoulder]:
    """Return the one with the smallest margin for each ring."""
    rings = (min((e for e in found if e.ring == r), key=lambda e: e.margin_um, default=None) for r in get_args(Ring))
    return [edge for edge in rings if edge is not None]


def tolerance_warning(tolerance: float) -> list[str]:
    """Return a warning of a coarse tolerance.

    `solver.tolerance` is too coarse for reliable averages; or nothing.
    """
    if tolerance <= COARSEST_TOLERANCE:
        return []
    return [
        f"solver.tolerance {tolerance:g} is above {COARSEST_TOLERANCE:g}: errors of the integration may set the cage "
        "whirling where a finer run leaves it quiet, and losses with it"
    ]


def highest_pressure(kind: str) -> float:
    """Return the contact pressure at which steel yields [Pa].

    It depends on the kind of bearing.
    """
    return _HIGHEST_PRESSURE_ALIGNING if kinds()[kind].on_sphere else _HIGHEST_PRESSURE


def warnings(
    pressure: float, edges: list[Shoulder], tilt: float, kind: str = "deep groove", *, on_shaft: bool = False
) -> list[str]:
    """Return warnings of exceeded limits of laws.

    Everything in a solution beyond their range has a sentence.

    Parameters
    ----------
    pressure : float
        Largest Hertzian pressure [Pa]; NaN when nothing touches.
    tilt : float
        Largest angle between the axes of the rings [rad].
    kind : str
        Name of the bearing's kind.
    on_shaft : bool
        Whether a shaft decides the tilt.
    """
    found = [sentence for edge in edges for sentence in edge.warning()]
    most = highest_pressure(kind)
    if pressure > most:
        found.append(
            f"the contact pressure of {1e-9 * pressure:.3g} GPa is beyond {1e-9 * most:g} GPa, where steel yields "
            "(ISO 76): the contact laws are elastic"
        )
    return found + tilt_warning(tilt, kind, on_shaft=on_shaft)
