"""Time simulated seconds and revolutions at equal accuracy."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path

from benchmarks import accuracy, cases
from benchmarks.accuracy import Outcome
from benchmarks.cases import Point
from benchmarks.passage import Horizon, Passage, passage, wall
from benchmarks.tables import Section, Table, Target
from benchmarks.timing import Effort
from lambda_core import api
from lambda_core.model.bearing_model import BearingModel
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve

LADDER = (10.0, 3.0, 1.0)  # times the default tolerance
REFERENCE = 1e-5  # tolerance of the run that the others are compared with
_LIMIT = {cases.SLOW.name: 1.0, cases.MIDDLE.name: 1.0, cases.FINE.name: 2.0}  # s per simulated second


@dataclass(frozen=True)
class Run:
    """One model at one tolerance."""

    tolerance: float
    repeats: tuple[Passage, ...]

    @property
    def one(self) -> Passage:
        """Return a repeat; all say the same."""
        return self.repeats[0]

    @property
    def per_second(self) -> float:
        """Return wall seconds per simulated second."""
        return wall(self.repeats) / self.one.simulated

    def row(self, name: str, reference: Outcome | None) -> tuple[str | float | None, ...]:
        """Return the cells of COLUMNS."""
        one = self.one
        rate = one.statistics["steps"] / one.simulated
        jacobians = one.statistics["jacobians"] / one.simulated
        turns = wall(self.repeats) / one.turns * 1e3
        return (
            name,
            f"{self.tolerance:.0e}",
            self.per_second,
            turns,
            rate,
            jacobians,
            *one.outcome.cells(reference),
        )


COLUMNS = ("point", "tolerance", "wall s/s", "wall ms/rev", "steps/s", "Jacobians/s", *accuracy.COLUMNS)


def runs_of(
    model: BearingModel, start: Equilibrium, tolerances: list[float], horizon: Horizon, repeats: int
) -> list[Run]:
    """Integrate at several tolerances.

    Repeats of one tolerance are spread over time.
    """
    found: dict[float, list[Passage]] = {tolerance: [] for tolerance in tolerances}
    for _ in range(repeats):
        for tolerance in tolerances:
            found[tolerance].append(passage(cases.with_tolerance(model, tolerance), start, horizon))
    return [Run(tolerance, tuple(repeated)) for tolerance, repeated in found.items()]


def measure(effort: Effort) -> Section:
    """Integrate every point at several tolerances.

    And at a tight one as reference.
    """
    rows, targets = [], []
    horizon = Horizon(1.0, effort.pick(1, 4))
    for point in (cases.MIDDLE, cases.FINE) if effort.quick else cases.POINTS:
        model = point.model()
        start = solve(model)
        default = model.solver.tolerance
        tolerances = [default] if effort.quick else [factor * default for factor in LADDER]
        found = runs_of(model, start, tolerances, horizon, effort.repeats)
        reference = passage(cases.with_tolerance(model, REFERENCE), start, horizon)
        rows += [run.row(point.name, reference.outcome) for run in found]
        rows.append(Run(REFERENCE, (reference,)).row(f"{point.name}: reference", None))
        targets += _targets(point, found, reference.outcome)
    table = Table(
        "Wall time at measured accuracy",
        COLUMNS,
        tuple(rows),
        (
            f"{horizon.discarded + horizon.averaged:g} cage revolutions from the quasi-static equilibrium, the last "
            f"{horizon.averaged:g} averaged. Accurate: raceway loss within {100 * accuracy.RACEWAY:g} %, cage speed "
            f"within {100 * accuracy.CAGE:g} % of the reference, energy residual at most {accuracy.ENERGY:g}. Samples "
            "are converted to channels within these times; no files are written.",
        ),
    )
    return Section("speed", (table, _complete_runs(effort)), tuple(targets))


def _targets(point: Point, found: list[Run], reference: Outcome) -> list[Target]:
    """Compare the fastest accurate setting with what was asked for."""
    if point.name not in _LIMIT:
        return []
    accurate = [run.per_second for run in found if run.one.outcome.good(reference)]
    limit = _LIMIT[point.name]
    reached = min(accurate, default=float("inf"))
    return [Target(f"{point.name}, fastest accurate setting", "s per simulated s", reached, limit, 0.5 * limit)]


def _complete_runs(effort: Effort) -> Table:
    """Time the default run with records, result file and checkpoints."""
    rows = []
    for point in (cases.MIDDLE,) if effort.quick else (cases.SLOW, cases.MIDDLE):
        model = point.model()
        start = solve(model)
        duration = (1.0 + effort.pick(1, 4)) * 6.2831853 / abs(start.orbit)
        model = api.check(point.case, (*point.changes, f"solver.duration={duration:.6g} s"))
        summaries = []
        with tempfile.TemporaryDirectory() as folder:
            for k in range(effort.repeats):
                summaries.append(api.run(model, out=Path(folder) / f"{k}.h5").summary())
        quickest = min(summaries, key=lambda s: s.wall_s)
        rows.append(
            (
                point.name,
                quickest.wall_per_simulated_second,
                1e3 * (quickest.wall_per_revolution_s or 0.0),
                quickest.energy_residual,
            )
        )
    return Table(
        "Complete run, with records, result file and checkpoints",
        ("point", "wall s/s", "wall ms/rev", "energy residual"),
        tuple(rows),
    )
