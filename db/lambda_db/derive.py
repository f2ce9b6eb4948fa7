"""Estimate inner geometry that no catalogue prints.

Every number of balls with every standard ball is ranked by the printed values.

A candidate (Z, D_w) on the pitch circle is scored by squared residuals over their standard deviations:

- static rating: C_0 = f_0 Z D_w^2 (ISO 76), 1 % or the rounding of the printed number. f_0 is interpolated for
  conformities 0.52/0.52: the standard's own table from D_w/D_pw = 0.10 on; below, where the table is made for
  0.52/0.53, makers' ratings of thin-section bearings agree with 0.52/0.52 within 0.6 % and miss the table by 8 %;
- dynamic rating: C = b_m f_c Z^(2/3) D_w^1.8 (ISO 281, f_c in closed form), 2 % for an ISO 281 rating, 3 % for a
  maker's uprated one after division by 1.05;
- Conrad assembly: the balls are filled into the sickle between eccentric rings, so that they span
  2 (Z - 1) asin(D_w/D_pw) = 188 +- 5 deg, never more than 200 deg; angular contact bearings are filled over a low
  shoulder, and hold as many balls as leave room for the cage: 283 +- 18 deg, never more than 330 deg; the rings of
  self-aligning ones are swivelled out for it: 278 +- 18 deg, never more than 335 deg; double row ones without
  filling slots are filled like deep groove ones;
- shoulder diameters, where printed and equal on both sides: D_1 - d_1 = 1.21 D_w within 6 %.

The contact angle alpha stands in both ratings: gamma = D_w cos(alpha)/D_pw, C_0 times cos(alpha), C times
(cos alpha)^0.7. Four-point contact, whose inner ring is split, is filled without end, and rated as two rows. Of
self-aligning bearings f_0 and f_c are those of the spherical outer raceway.

Only ratings of the same maker enter: another maker's balls differ. Weights are exp(-score/2) over the ranked
candidates. Lengths in mm, ratings in N inside this module.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from lambda_core.elements.ball.kinds import kinds
from lambda_core.formulas.ratings import dynamic_factor, sphere_factor, static_factor
from lambda_db.standards import iso76_f0, standard_balls

FILLING_ANGLE = (188.0, 5.0)  # mean and standard deviation [deg]
FILLING_LIMIT = 200.0  # [deg]
# Of angular contact bearings: mean and scatter of the designs that fit NSK's ratings of 70, 72 and 73 (166 bearings).
COUNTERBORED_ANGLE, COUNTERBORED_LIMIT = (283.0, 18.0), 330.0
# Of four-point contact: the same of the designs that fit SKF's ratings of QJ 2 and QJ 3 (46 bearings).
SPLIT_ANGLE, SPLIT_LIMIT = (302.0, 24.0), 345.0
# Of self-aligning bearings: the same of those that fit SKF's ratings of 12, 13, 22 and 23 (86 bearings).
SWIVELLED_ANGLE, SWIVELLED_LIMIT = (278.0, 18.0), 335.0
SHOULDER_RATIO = (1.21, 0.06)  # (D_1 - d_1)/D_w, mean and relative standard deviation
STATIC_DEVIATION = 0.01
DYNAMIC_DEVIATION = {"iso": 0.02, "uprated": 0.03}
GOOD_FIT, NO_FIT, CLEAR_WEIGHT, TELLING_WEIGHT, GOOD_RATING, SAME_BALL = 9.0, 25.0, 0.8, 0.05, 0.01, 0.01
UPRATED = 1.05  # makers' premium classes over ISO 281
_KEPT = 5
_BALL_COUNTS = np.arange(5, 41)
# gamma beyond the tables of both standards does not occur in deep-groove bearings
_GAMMA = (0.01, 0.40)

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Printed:
    """Printed data of one bearing.

    They are in mm and N, and None where the maker prints nothing.
    """

    bore_diameter: float
    outside_diameter: float
    static_rating: float | None = None
    dynamic_rating: float | None = None
    uprated: bool = False
    static_rounding: float = 0.0  # half of the last printed digit, relative
    dynamic_rounding: float = 0.0
    shoulder_diameter_inner: float | None = None
    shoulder_diameter_outer: float | None = None
    known_pitch: float | None = None
    contact_angle: float = 0.0  # [rad]
    rows: int = 1  # by which it is rated: two of four-point contact
    kind: str = ""  # as in the table of bearings

    @property
    def on_sphere(self) -> bool:
        """True if the outer raceway is a sphere."""
        return self.kind in kinds() and kinds()[self.kind].on_sphere

    @property
    def filling(self) -> tuple[float, float, float]:
        """Mean, standard deviation and limit of the filling angle [deg]."""
        if self.on_sphere:
            return (*SWIVELLED_ANGLE, SWIVELLED_LIMIT)
        if self.kind in kinds() and kinds()[self.kind].rows == 2:
            return (*FILLING_ANGLE, FILLING_LIMIT)
        if self.rows == 2:
            return (*SPLIT_ANGLE, SPLIT_LIMIT)
        return (*COUNTERBORED_ANGLE, COUNTERBORED_LIMIT) if self.contact_angle else (*FILLING_ANGLE, FILLING_LIMIT)

    @property
    def pitch_diameter(self) -> float:
        """Pitch diameter [mm].

        It is known, or the middle of bore and outside diameter, averaged with the shoulders' if printed.
        """
        if self.known_pitch is not None:
            return self.known_pitch
        middle = 0.5 * (self.bore_diameter + self.outside_diameter)
        if self.shoulder_diameter_inner is None or self.shoulder_diameter_outer is None or self.contact_angle:
            return middle
        return 0.5 * (middle + 0.5 * (self.shoulder_diameter_inner + self.shoulder_diameter_outer))


@dataclass(frozen=True)
class RankedDesign:
    """One candidate in mm and degrees.

    `weight` is relative among the candidates returned.
    """

    ball_count: int
    ball_diameter: float
    pitch_diameter: float
    score: float
    filling_angle: float
    weight: float


def relative_rounding(number: float) -> float:
    """Return the relative rounding of a printed number.

    It is half a unit of its last digit: 17.9 is known within 0.28 %.
    """
    decimals = len(repr(number).partition(".")[2]) if not float(number).is_integer() else 0
    return float(0.5 * 10.0**-decimals / number)


def filling_angle(ball_count: int | Array, ball_diameter: float | Array, pitch_diameter: float) -> Array:
    """Return the filling angle of the balls [deg].

    The balls are side by side, as when a Conrad bearing is filled: 2 (Z - 1) asin(D_w/D_pw).
    """
    ratio = np.clip(np.asarray(ball_diameter) / pitch_diameter, 0.0, 1.0)
    return np.asarray(2.0 * (np.asarray(ball_count) - 1.0) * np.degrees(np.arcsin(ratio)), dtype=np.float64)


@cache
def _factors_on_a_sphere() -> tuple[Array, Array]:
    """Return the table of f_0 for self-aligning bearings.

    It has D_w cos(alpha)/D_pw and f_0, close enough for 1e-5 between two of them.

    Solved for each design in question, contacts took half of the time in which the catalogue is built.
    """
    gamma = np.linspace(0.5 * _GAMMA[0], 1.1 * _GAMMA[1], 871)
    return gamma, np.array([static_factor(float(value), on_sphere=True) for value in gamma])


def static_rating_of(
    ball_count: Array,
    ball_diameter: Array,
    pitch_diameter: float,
    contact_angle: float = 0.0,
    rows: int = 1,
    *,
    on_sphere: bool = False,
) -> Array:
    """Return the static load rating C_0 [N].

    It is f_0 i Z D_w^2 cos(alpha), with f_0 interpolated for conformities 0.52/0.52, or of the sphere.
    """
    cosine = np.cos(contact_angle)
    gamma = ball_diameter * cosine / pitch_diameter
    known = _factors_on_a_sphere() if on_sphere else iso76_f0(both_052=True)
    factor = np.interp(gamma, *known)
    return np.asarray(rows * factor * ball_count * ball_diameter**2 * cosine)


def dynamic_rating_of(
    ball_count: Array,
    ball_diameter: Array,
    pitch_diameter: float,
    contact_angle: float = 0.0,
    rows: int = 1,
    *,
    on_sphere: bool = False,
) -> Array:
    """Return the dynamic load rating C [N].

    It is b_m f_c (i cos alpha)^0.7 Z^(2/3) D_w^1.8 (3.647 D_w^1.4 above 25.4 mm), with b_m = 1.3 (ISO 281).
    """
    balls, index = np.unique(ball_diameter, return_inverse=True)
    cosine = float(np.cos(contact_angle))
    factor_of = sphere_factor if on_sphere else dynamic_factor
    factors = np.array([factor_of(float(ball) * cosine / pitch_diameter) for ball in balls])[index]
    size = np.where(ball_diameter <= 25.4, ball_diameter**1.8, 3.647 * ball_diameter**1.4)
    return np.asarray(rows**0.7 * 1.3 * factors * cosine**0.7 * ball_count ** (2.0 / 3.0) * size)


def _score(printed: Printed, count: Array, ball: Array, pitch: float) -> Array:
    (mean, deviation, _), angle = printed.filling, printed.contact_angle
    kind, on_sphere = (angle, printed.rows), printed.on_sphere
    score = ((filling_angle(count, ball, pitch) - mean) / deviation) ** 2
    if printed.static_rating is not None:
        scatter = max(STATIC_DEVIATION, printed.static_rounding)
        static = static_rating_of(count, ball, pitch, *kind, on_sphere=on_sphere)
        score += (np.log(static / printed.static_rating) / scatter) ** 2
    if printed.dynamic_rating is not None:
        scatter = max(DYNAMIC_DEVIATION["uprated" if printed.uprated else "iso"], printed.dynamic_rounding)
        rating = printed.dynamic_rating / (UPRATED if printed.uprated else 1.0)
        dynamic = dynamic_rating_of(count, ball, pitch, *kind, on_sphere=on_sphere)
        score += (np.log(dynamic / rating) / scatter) ** 2
    if printed.shoulder_diameter_inner is not None and printed.shoulder_diameter_outer is not None and not angle:
        ratio = (printed.shoulder_diameter_outer - printed.shoulder_diameter_inner) / ball
        score += ((ratio / SHOULDER_RATIO[0] - 1.0) / SHOULDER_RATIO[1]) ** 2
    return np.asarray(score)


def candidates(printed: Printed, kept: int = _KEPT) -> list[RankedDesign]:
    """Rank the designs that fit what is printed, best first.

    Parameters
    ----------
    printed : Printed
        Dimensions and ratings of one maker.
    kept : int
        How many candidates to return.

    Returns
    -------
    list of RankedDesign
        Weights add up to 1. Empty if no standard ball fits between the rings.
    """
    pitch = printed.pitch_diameter
    sizes = np.array(standard_balls())
    # at least a tenth of the ball as wall on each side of the raceways
    room = min(pitch - printed.bore_diameter, printed.outside_diameter - pitch) / 1.1
    sizes = sizes[(sizes <= room) & (sizes >= _GAMMA[0] * pitch) & (sizes <= _GAMMA[1] * pitch)]
    count, ball = (grid.ravel().astype(np.float64) for grid in np.meshgrid(_BALL_COUNTS, sizes))
    possible = filling_angle(count, ball, pitch) <= printed.filling[2]
    count, ball = count[possible], ball[possible]
    if count.size == 0:
        return []
    score = _score(printed, count, ball, pitch)
    best = np.argsort(score, kind="stable")[:kept]
    weight = np.exp(-0.5 * (score[best] - score[best[0]]))
    weight /= weight.sum()
    angles = filling_angle(count[best], ball[best], pitch)
    return [
        RankedDesign(int(count[i]), float(ball[i]), pitch, float(score[i]), float(angle), float(w))
        for i, angle, w in zip(best, angles, weight, strict=True)
    ]


def family_weight(ranked: list[RankedDesign], design: RankedDesign) -> float:
    """Return the weight of all equivalent candidates.

    The same ball count and a ball within 1 % are the same design for every purpose.
    """
    return sum(
        other.weight
        for other in ranked
        if other.ball_count == design.ball_count and abs(other.ball_diameter / design.ball_diameter - 1.0) <= SAME_BALL
    )


def grade_of(printed: Printed, ranked: list[RankedDesign], design: RankedDesign) -> str:
    """Grade one of the ranked candidates.

    B fits and no other is near, C fits but others come near, D does not fit.

    B needs a score of at most 9, a :func:`family_weight` of at least 0.8 and, where the printed dynamic rating is a
    plain ISO 281 one, the recomputed rating within 1 % of it. A score beyond 25 (one residual of five standard
    deviations, or several of three), or a family weight below 0.05, is no estimate.
    """
    weight = family_weight(ranked, design)
    if design.score > NO_FIT or weight < TELLING_WEIGHT:
        return "D"
    good = design.score <= GOOD_FIT and weight >= CLEAR_WEIGHT
    if printed.dynamic_rating is not None and not printed.uprated:
        count, ball = np.array([float(design.ball_count)]), np.array([design.ball_diameter])
        kind, on_sphere = (printed.contact_angle, printed.rows), printed.on_sphere
        rating = float(dynamic_rating_of(count, ball, design.pitch_diameter, *kind, on_sphere=on_sphere)[0])
        good = good and abs(rating / printed.dynamic_rating - 1.0) <= max(GOOD_RATING, printed.dynamic_rounding)
    return "B" if good else "C"
