"""Compare dynamics with the quasi-static solution under excitation.

Each bearing runs with and without excitation.
"""

from __future__ import annotations

from pydantic import Field

from lambda_core.results.record import Record
from lambda_syla2026.boundary import CASE, Setting
from lambda_syla2026.job_runner import Job, JobRunner

SETTING = Setting("A", 5.0)
FREQUENCY = 8.9  # [Hz]
ACCELERATIONS = (0.0, 20.0, 40.0, 80.0, 160.0)  # amplitudes [m/s2]


class Apart(Record):
    """Run over the quasi-static solution of its case.

    The quasi-static solution ignores the excitation.
    """

    acceleration_m_per_s2: float
    friction_difference_pct: float = Field(description="of the torque without the cage's part")
    load_difference_pct: float = Field(description="of the mean load of the most loaded ball")
    cage_Nmm: float = Field(description="what the cage adds, in the run only")


def apart(runner: JobRunner) -> list[Apart]:
    """Run the 6220 under growing excitation and compare.

    It runs variant A with axial excitation.
    """
    jobs = [Job(CASE, SETTING.changes(), "friction")]
    jobs += [Job(CASE, SETTING.changes(FREQUENCY, a), "torque") for a in ACCELERATIONS]
    still, *runs = runner.all(jobs)
    return [
        Apart(
            acceleration_m_per_s2=a,
            friction_difference_pct=100.0 * ((run["torque"] - run["cage"]) / still["torque"] - 1.0),
            load_difference_pct=100.0 * (run["max_load_N"] / still["max_load_N"] - 1.0),
            cage_Nmm=run["cage"],
        )
        for a, run in zip(ACCELERATIONS, runs, strict=True)
    ]
