"""Bisect the excitation at which the ball motion changes.

It bisects along several rays at once.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from lambda_syla2026.job_runner import Job, JobResult, JobRunner
from lambda_syla2026.parameters import laws

CRITERIA = ("S", "T")
# S: share by which the rms speed deviation changes; T: growth of the share of time under load outside the zone.
LIMITS = {"S": 0.2, "T": 0.05}
STANDARD_ERRORS = 3.0
FIRST = (20.0, 40.0)  # acceleration amplitudes tried first [m/s2]
STEP = 2.0  # factor to the next amplitude while a ray has no bracket
ENDS = (0.5, 500.0)  # amplitudes between which a boundary is looked for [m/s2]
CASE = "6220-excited"
# Cage turns averaged, those of the run without excitation that every ray is compared with, and those before.
TURNS, STILL_TURNS, DISCARDED = 30.0, 120.0, 1.0
CAGE = "steel-ribbon"  # what the designation 6220 without a suffix stands for (SKF); others have one, as M for brass
_GAMMA = 25.4 / 140.0  # of the 6220, for the nominal cage speed


@dataclass(frozen=True)
class Setting:
    """Bearing in one condition without its excitation.

    The excitation varies on top of it.

    Attributes
    ----------
    variant : str
        "A": the outer ring moves axially, the inner ring with its shaft is free; "B": both rings move together.
    load : float
        F_stat [kN].
    speed : float
        [1/min].
    extra : tuple of str
        Further changes to the case.
    share : float
        Of TURNS and STILL_TURNS that are averaged.
    """

    variant: str
    load: float
    speed: float = 1500.0
    extra: tuple[str, ...] = ()
    share: float = 1.0

    @property
    def cage_frequency(self) -> float:
        """Nominal cage speed [Hz]."""
        return 0.5 * (1.0 - _GAMMA) * self.speed / 60.0

    def changes(self, frequency: float = 0.0, acceleration: float = 0.0) -> tuple[str, ...]:
        """Return the changes for an axial motion.

        The motion has this amplitude [m/s2]; 0 stands for no motion.

        The motion X (cos(2 pi f t) - 1) starts from rest where the rings' equilibrium is.
        """
        turn = 1.0 / self.cage_frequency
        motion, duration = "locked", (self.share * STILL_TURNS + DISCARDED) * turn
        if acceleration > 0.0:
            amplitude = acceleration / (2.0 * math.pi * frequency) ** 2
            duration = DISCARDED * turn + math.ceil(self.share * TURNS * turn * frequency - 1e-9) / frequency
            motion = (
                f'{{ mode = "prescribed", motion = {{ kind = "sum", terms = ["{-1e3 * amplitude:.9g} mm", '
                f'{{ kind = "harmonic", amplitude = "{1e3 * amplitude:.9g} mm", frequency = "{frequency:.9g} Hz", '
                'phase = "90 deg" }] } }'
            )
        inner = motion if self.variant == "B" else "free"
        return (
            f"loads.radial={self.load:g} kN",
            f"operation.speed={self.speed:g} rpm",
            f"solver.duration={duration:.9g} s",
            "depth.strips=15",
            f"bodies.outer_ring.x={motion}",
            f"bodies.inner_ring.x={inner}",
            f"bodies.cage.type={CAGE}",
            "parameters.cage_contact.film_width=0",  # the paper's pockets have no film
            # A shaft on two bearings does not rock about the loaded balls of one.
            "bodies.inner_ring.tilt_y=locked",
            "bodies.inner_ring.tilt_z=locked",
            # Laws of the blind set, whatever the defaults are.
            *laws(),
            *self.extra,
        )


@dataclass(frozen=True)
class Boundary:
    """Point of a ray where a criterion is met.

    It has an uncertainty.

    Attributes
    ----------
    acceleration : float
        Amplitude [m/s2].
    own_error : float
        Standard error of its logarithm, from the runs at both ends of the bracket.
    still_error : float
        The same from the run without excitation, which all rays of a setting share.
    """

    acceleration: float
    own_error: float
    still_error: float


@dataclass
class Ray:
    """Growing excitation at one frequency.

    It holds the tried amplitudes and the bracket of each criterion.
    """

    setting: Setting
    frequency: float  # [Hz]
    tried: dict[float, JobResult] = field(default_factory=dict)  # acceleration amplitude [m/s2] -> stability reading
    lost: bool = False  # a run on it, or the one without excitation, has no result: no boundary is looked for

    def job(self, acceleration: float) -> Job:
        """Return the run at one amplitude."""
        return Job(CASE, self.setting.changes(self.frequency, acceleration), "stability")

    def bracket(self, criterion: str, still: JobResult) -> tuple[float | None, float | None]:
        """Return the bracket of a criterion [m/s2].

        It consists of the largest unaltered amplitude below the smallest altered one, and of that one.
        """
        altered = sorted(a for a, answer in self.tried.items() if excess(criterion, answer, still) > 0.0)
        high = altered[0] if altered else None
        low = [a for a in self.tried if high is None or a < high]
        return (max(low) if low else None), high

    def wanted(self, criterion: str, still: JobResult, ratio: float) -> float | None:
        """Return the next amplitude to try.

        None when the bracket is narrower than `ratio` or does not exist.
        """
        low, high = self.bracket(criterion, still)
        if low is not None and high is not None:
            return math.sqrt(low * high) if high / low > ratio else None
        if high is None:
            assert low is not None
            return low * STEP if low * STEP <= ENDS[1] else None
        return high / STEP if high / STEP >= ENDS[0] else None

    def boundary(self, criterion: str, still: JobResult) -> Boundary | None:
        """Return the amplitude that just meets a criterion.

        None when none does.

        Between the ends of the bracket the excess is interpolated linearly over the logarithm; the standard errors
        of S and T in the three runs are carried over to it to first order.
        """
        low, high = self.bracket(criterion, still)
        if self.lost or low is None or high is None:
            return None
        runs = self.tried[low], self.tried[high]
        below, above = (excess(criterion, run, still) for run in runs)
        rise, step = above - below, math.log(high / low)
        share = -below / rise if rise > 0.0 else 0.5
        scale = still["S"] if criterion == "S" else 1.0
        # The larger the excess at the other end, the more an end's own error moves the boundary.
        moved = [(1.0 - share) * runs[0][f"{criterion}_error"], share * runs[1][f"{criterion}_error"]]
        # S over S_0 at the boundary, by which S_0's own error counts.
        falls = math.copysign(1.0, still["S"] - runs[1]["S"])
        at_boundary = 1.0 - falls * LIMITS["S"] if criterion == "S" else 1.0
        per_excess = step / rise if rise > 0.0 else math.inf
        return Boundary(
            acceleration=float(low * (high / low) ** min(max(share, 0.0), 1.0)),
            own_error=per_excess * math.hypot(*moved) / scale,
            still_error=per_excess * at_boundary * still[f"{criterion}_error"] / scale,
        )


def excess(criterion: str, answer: JobResult, still: JobResult) -> float:
    """Return the excess over a criterion.

    Positive: the running is altered.

    S: |S/S_0 - 1| - 0.2, T: T - T_0 - 0.05; not counted as altered unless the change exceeds three standard errors.
    """
    change = abs(answer[criterion] - still[criterion])
    error = math.hypot(answer[f"{criterion}_error"], still[f"{criterion}_error"])
    if criterion == "T":
        change = answer["T"] - still["T"]
    size = change / still["S"] if criterion == "S" else change
    beyond = size - LIMITS[criterion]
    return beyond if change > STANDARD_ERRORS * error else min(beyond, -1e-9)


def search(runner: JobRunner, rays: Iterable[Ray], ratio: float) -> Mapping[Setting, JobResult]:
    """Narrow the brackets of both criteria on all rays.

    The rays are computed in parallel; returns the runs without excitation.

    Parameters
    ----------
    ratio : float
        Upper over lower end of a bracket that is narrow enough.
    """
    rays = list(rays)
    settings = list(dict.fromkeys(ray.setting for ray in rays))
    found = runner.all([Job(CASE, setting.changes(), "stability") for setting in settings])
    still = dict(zip(settings, found, strict=True))
    for ray in rays:
        ray.lost = still[ray.setting].state == "failed"
    requests: list[tuple[Ray, float]] = [(ray, a) for ray in rays if not ray.lost for a in FIRST]
    while requests:
        answers = runner.all([ray.job(amplitude) for ray, amplitude in requests])
        for (ray, amplitude), answer in zip(requests, answers, strict=True):
            if answer.state == "failed":
                ray.lost = True
            else:
                ray.tried[amplitude] = answer
        going = [ray for ray in rays if not ray.lost]
        requests = [(ray, amplitude) for ray in going for amplitude in _next(ray, still[ray.setting], ratio)]
    return still


def _next(ray: Ray, still: JobResult, ratio: float) -> list[float]:
    """Return the amplitudes that the criteria need next.

    Both criteria may need the same amplitude.
    """
    wanted = (ray.wanted(criterion, still, ratio) for criterion in CRITERIA)
    return sorted({amplitude for amplitude in wanted if amplitude is not None})
