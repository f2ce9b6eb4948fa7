"""Vary every assumed parameter of the 6319 over its range.

The response is the torque.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from pydantic import Field

from lambda_core.results.record import Record
from lambda_syla2026 import parameters as P
from lambda_syla2026.job_runner import Job, JobResult, JobRunner
from lambda_syla2026.published import POINTS, known_mean, mean_absolute_error

# The run that says what the cage's parameters do: the shortest one.
_CAGE_CASE = "6319-cp10-3000"
# What an option's name does not say by itself, for figures.
_SHORT = {
    "rheology: vogel k": "viscosity (Vogel K)",
    "rheology: dicke a1": "pressure viscosity (Dicke a1)",
    "fluid drag: v m": "drag V_M",
    "lubricant: temperature": "oil temperature",
    "lubricant: properties.thermal conductivity": "oil conductivity",
    "traction: tau eyring": "tau_e",
    "elastic hysteresis: loss factor": "hysteresis loss factor",
    "boundary friction: mu s": "boundary friction",
    "cage contact: mu s": "cage friction",
    "cage contact: stiffness": "cage stiffness",
    "bodies: cage.type": "cage type",
    "bodies: cage.pocket clearance": "pocket clearance",
    "asperity load: B": "asperity load B",
    "asperity load: C": "asperity load C",
}
# Conductivity of the oil is a class value of the catalogue, +-15 %; the case can only replace the complete oil.
_CONDUCTIVITY = P.Entry(
    "lubricant.properties.thermal_conductivity",
    "0.137 W/(m K)",
    "class value of mineral oils, +-15 % (after Larsson and Andersson 2000)",
    ("0.116 W/(m K)", "0.158 W/(m K)"),
    sampled=False,
)


class Sensitivity(Record):
    """Change of the torque over one parameter's range.

    All others as in the blind set.
    """

    name: str
    value: str
    low: str
    high: str
    low_change_pct: float = Field(description="mean change over the points")
    high_change_pct: float
    low_error_pct: float | None = Field(description="mean absolute error there; null where only one point was run")
    high_error_pct: float | None
    published: bool = Field(description="whether the range is published")
    basis: str
    source: str

    @property
    def short(self) -> str:
        """Name without its law or section."""
        return _SHORT.get(self.name, self.name.rpartition(": ")[2])

    @property
    def span(self) -> str:
        """Both ends of the range.

        It is the other law where there is one only.
        """
        return self.low if self.low == self.high else f"{self.low} to {self.high}"

    @property
    def effect(self) -> str:
        """Change of the torque at both ends [%].

        It is the change with the other law where there is one only.
        """
        low, high = f"{self.low_change_pct:+.1f}", f"{self.high_change_pct:+.1f}"
        return f"{low} % with {self.low}" if self.low == self.high else f"{low} to {high} %"


def ends_of(entry: P.Entry) -> tuple[str, str]:
    """Return the two values to try for a parameter.

    A law without a second alternative counts once.
    """
    ends = entry.ends
    return ends[0], ends[-1]


def sensitivities(
    runner: JobRunner, static: Sequence[JobResult], runs: Sequence[JobResult], quick: bool = False
) -> list[Sensitivity]:
    """Return the effect of every parameter with a range.

    The largest effect comes first.

    Parameters
    ----------
    static, runs : sequence of JobResult
        The blind set at the six points.
    quick : bool
        Leave out what needs further runs (the cage).
    """
    varied = [entry for entry in (*P.blind_set(), _CONDUCTIVITY) if entry.ends and not entry.cage]
    jobs = [
        Job(point.case, _changes(entry, end), "friction")
        for entry in varied
        for end in ends_of(entry)
        for point in POINTS
    ]
    answers = runner.all(jobs)
    found, n = [], len(POINTS)
    for i, entry in enumerate(varied):
        low, high = answers[2 * n * i : 2 * n * i + n], answers[2 * n * i + n : 2 * n * (i + 1)]
        found.append(_static(entry, low, high, static, runs))
    if not quick:
        found += _of_cage(runner, runs)
    return sorted(found, key=lambda s: -max(abs(s.low_change_pct), abs(s.high_change_pct)))


def _changes(entry: P.Entry, end: str) -> tuple[str, ...]:
    if entry is _CONDUCTIVITY:
        return (*P.changes(), *_own_oil(), f"{entry.path}={end}")
    return P.changes({entry.path: end})


def _own_oil() -> tuple[str, ...]:
    """Return the changes that write the catalogue's oil.

    Into the case, so that one of its properties can change.
    """
    from lambda_core.domain.units import show
    from lambda_core.studies.job import resolve_point
    from lambda_syla2026.job_runner import case_text

    model = resolve_point(case_text(_CAGE_CASE), P.changes())
    law, given = model.laws["ball_inner"]["rheology"], dict(c.split("=", 1) for c in P.changes())
    texts = {}
    for name, value in law.parameters.model_dump(mode="json").items():
        texts[f"parameters.rheology.{name}"] = str(value)
    rows = {path: text for path, text in texts.items() if path not in given}
    rows["lubricant.properties.base_type"] = model.oil.base_type
    rows["models.permittivity"] = model.laws["ball_inner"]["permittivity"].model.name
    rows["lubricant.properties.rheology"] = law.model.name
    rows["lubricant.properties.specific_heat"] = show(model.oil.specific_heat, "specific_heat")
    return tuple(f"{path}={text}" for path, text in rows.items())


def _static(
    entry: P.Entry,
    low: Sequence[JobResult],
    high: Sequence[JobResult],
    static: Sequence[JobResult],
    runs: Sequence[JobResult],
) -> Sensitivity:
    def effect(end: Sequence[JobResult]) -> tuple[float, float]:
        share = [moved["torque"] / still["torque"] - 1.0 for moved, still in zip(end, static, strict=True)]
        torque = [
            run["torque"] + moved["torque"] - still["torque"]
            for run, moved, still in zip(runs, end, static, strict=True)
        ]
        return 100.0 * known_mean(np.array(share)), mean_absolute_error(torque)

    (low_change, low_error), (high_change, high_error) = effect(low), effect(high)
    first, last = ends_of(entry)
    return Sensitivity(
        name=entry.label,
        value=entry.value,
        low=first,
        high=last,
        low_change_pct=low_change,
        high_change_pct=high_change,
        low_error_pct=low_error,
        high_error_pct=high_error,
        published=entry.sampled,
        basis="quasi-static, six points",
        source=entry.source,
    )


def _of_cage(runner: JobRunner, runs: Sequence[JobResult]) -> list[Sensitivity]:
    """Return the effects of the cage's parameters.

    Runs at one point give them.
    """
    mine = next(i for i, point in enumerate(POINTS) if point.case == _CAGE_CASE)
    varied = [entry for entry in P.blind_set() if entry.cage and entry.ends]
    answers = runner.all(
        [Job(_CAGE_CASE, P.changes({entry.path: end}), "torque") for entry in varied for end in ends_of(entry)]
    )
    blind, found = runs[mine]["torque"], []
    for i, entry in enumerate(varied):
        first, last = ends_of(entry)
        low, high = (100.0 * (answer["torque"] / blind - 1.0) for answer in answers[2 * i : 2 * i + 2])
        found.append(
            Sensitivity(
                name=entry.label,
                value=entry.value,
                low=first,
                high=last,
                low_change_pct=low,
                high_change_pct=high,
                low_error_pct=None,
                high_error_pct=None,
                published=entry.sampled,
                basis=f"runs at {POINTS[mine].label}",
                source=entry.source,
            )
        )
    return found
