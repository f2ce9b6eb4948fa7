"""Compare the torque change by an axial load with catalogues.

The catalogues are those of SKF and Schaeffler.

Each is compared with itself under the radial load alone, so that only the axial load's part is seen.
"""

from __future__ import annotations

from pydantic import Field

from lambda_core.results.record import Record
from lambda_syla2026.job_runner import ANCHOR, Job, JobRunner

BEARING = ("6208", "SKF", 1500.0, 1000.0)  # designation, maker, radial load [N], speed [1/min]
SHARES = (0.0, 0.002, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 1.0)  # F_a/F_r
_SMALL = 0.1  # up to which an axial load changes next to nothing in the contacts


class AxialStep(Record):
    """Torques over those without axial load."""

    share: float = Field(description="axial over radial load")
    rolling: float = Field(description="rolling resistance and hysteresis of the simulation")
    sliding: float = Field(description="sliding, spin and boundary friction of the simulation")
    skf_rolling: float = Field(description="M_rr")
    skf_sliding: float = Field(description="M_sl")
    total: float
    skf: float
    schaeffler: float = Field(description="the load-dependent M_1; M_0 does not know the load")
    ratio: float = Field(description="torque over SKF's")


def axial_load(runner: JobRunner) -> list[AxialStep]:
    """Return the torques at growing axial load."""
    designation, maker, radial, speed = BEARING
    case = (f"bearing.designation={designation}", f"bearing.maker={maker}", f"loads.radial={radial:g} N")
    jobs = [
        Job(ANCHOR, (*case, f"operation.speed={speed:g} rpm", f"loads.axial={share * radial:g} N"), "axial load")
        for share in SHARES
    ]
    answers = runner.all(jobs)
    parts = [
        {
            "rolling": a["rolling"] + a["hysteresis"],
            "sliding": a["sliding"] + a["spin"] + a["boundary"],
            "skf_rolling": a["skf rolling"],
            "skf_sliding": a["skf sliding"],
            "total": a["torque"],
            "skf": a["skf"],
            "schaeffler": a["schaeffler load"],
        }
        for a in answers
    ]
    return [
        AxialStep(
            share=share,
            ratio=part["total"] / part["skf"],
            **{name: value / parts[0][name] for name, value in part.items()},
        )
        for share, part in zip(SHARES, parts, strict=True)
    ]


def axial_notes(steps: list[AxialStep]) -> list[str]:
    """Say where the difference comes from."""
    small = [step for step in steps if 0.0 < step.share <= _SMALL]
    if not small:
        return []
    last = small[-1]
    return [
        f"an axial load of {100 * small[0].share:g} to {100 * last.share:g} % of the radial one makes SKF's M_sl "
        f"{small[0].skf_sliding:.2f} and M_rr up to {last.skf_rolling:.2f} times as large, Schaeffler's M_1 "
        f"{last.schaeffler:.2f} times and the simulation's torque {last.total:.2f} times"
    ]
