"""Compare losses at SKF's reference speeds with ISO 15312.

A reference speed is the speed at which a bearing under 5 % of its static rating, in a mineral oil of 12 mm2/s to the
middle of the lowest ball, reaches 70 degC in surroundings of 20 degC. So the loss there should be q_r A_r.
"""

from __future__ import annotations

import math

import numpy as np
from pydantic import Field

from lambda_core.analysis.thermal import iso15312
from lambda_core.results.record import Record
from lambda_syla2026.job_runner import ANCHOR, Job, JobResult, JobRunner

SERIES = ("60", "62", "63", "64", "618", "619")
OIL = "mineral-vg32"  # 12 mm2/s at 70 degC
BAR = (0.8, 1.25)


class Rated(Record):
    """Losses over q_r A_r of one series.

    A row may also stand for all series. It has the median and the range that holds 90 % of the bearings.
    """

    series: str
    bearings: int
    contacts: list[float] = Field(description="median, 5 % and 95 % of the loss without drag")
    with_drag: list[float] = Field(description="the same with SKF's drag of an oil bath")
    skf: list[float] = Field(description="the same of SKF's friction model without drag")
    skf_with_drag: list[float] = Field(description="the same of SKF's friction model with drag")
    over_skf: list[float] = Field(
        description="median, 5 % and 95 % of the loss with drag over that of SKF's friction model with drag"
    )


def rated_speeds(runner: JobRunner) -> tuple[list[Rated], int]:
    """Compare the losses of all bearings and series.

    Return all together, each series, and the number without an answer.

    No answer: the catalogue does not decide the inner geometry.
    """
    plans, unknown = _plans()
    answers = runner.all([Job(ANCHOR, changes, "rated") for _, changes in plans])
    named = [(series, a) for (series, _), a in zip(plans, answers, strict=True) if a.state == "done"]
    found = [_rated(name, [a for series, a in named if name in ("all", series)]) for name in ("all", *SERIES)]
    return [each for each in found if each.bearings], unknown


def _plans() -> tuple[list[tuple[str, tuple[str, ...]]], int]:
    """Return the cases of SKF bearings with reference speeds.

    Their series and case, and how many have no geometry.
    """
    from lambda_core.discovery.api import registry

    found, unknown = [], 0
    for row in registry().catalogue().bearings("SKF", 10_000):
        if row.layer != "core" or row.series not in SERIES or row.reference_speed is None or row.static_rating is None:
            continue
        if row.ball_diameter is None:
            unknown += 1
            continue
        changes = (
            f"bearing.designation={row.designation}",
            f"bearing.maker={row.maker}",
            f"loads.radial={iso15312.LOAD_SHARE * row.static_rating.value:.6g} N",
            f"operation.speed={row.reference_speed.value * 30.0 / math.pi:.6g} rpm",
            f"lubricant.name={OIL}",
            "lubricant.temperature=70 degC",
        )
        found.append((row.series, changes))
    return sorted(found), unknown


def _rated(series: str, answers: list[JobResult]) -> Rated:
    def spread(*names: str, over: tuple[str, ...] = ("heat",)) -> list[float]:
        ratios = [sum(answer[name] for name in names) / sum(answer[name] for name in over) for answer in answers]
        return np.quantile(ratios, (0.5, 0.05, 0.95)).tolist() if ratios else []

    return Rated(
        series=series,
        bearings=len(answers),
        contacts=spread("contacts"),
        with_drag=spread("contacts", "drag"),
        skf=spread("skf"),
        skf_with_drag=spread("skf", "skf drag"),
        over_skf=spread("contacts", "drag", over=("skf", "skf drag")),
    )


def rated_bars(found: list[Rated]) -> list[str]:
    """Compare both medians with their limits.

    There is no limit for the heat with the drag of an oil bath: SKF's own model exceeds it about as much.
    """
    if not found:
        return []
    first, lines = found[0], []
    for what, (median, low, high) in (
        ("of the contacts over ISO 15312's heat", first.contacts),
        ("with drag over that of SKF's model with drag", first.over_skf),
    ):
        verdict = "met" if BAR[0] <= median <= BAR[1] else "missed"
        lines.append(
            f"{verdict}: {first.bearings} bearings at SKF's reference speeds, loss {what}: "
            f"median {median:.2f}, 90 % within {low:.2f} to {high:.2f}, limit {BAR[0]:g} to {BAR[1]:g}"
        )
    return lines
