"""Measure performance: ``python -m benchmarks``.

``--write`` puts the tables into docs/performance.md.
"""

from __future__ import annotations

import argparse
import dataclasses
import importlib
import json
import sys
import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from benchmarks import against, machine, performance, timing
from benchmarks.performance import Report
from benchmarks.tables import Section
from benchmarks.timing import Effort
from lambda_core.domain.errors import LambdaError, UsageError, unknown_name

NAMES = {
    "parts": "right-hand side by grid, Jacobian, factorisation, solve; where a simulated second goes",
    "speed": "wall time per simulated second and per revolution at measured accuracy",
    "integrators": "CVODE and SciPy on the same right-hand side",
    "scaling": "number of balls, cells of a contact",
    "bearings": "number of bearings on a shaft",
    "shaft_cost": "a shaft in motion over the sum of its bearings run alone",
    "operating_point": "quasi-static points",
    "foreign_law": "a traction law from another distribution",
    "startup": "cold and warm start of the command line; what each command costs, warm",
    "memory": "memory over a long run",
    "parallel": "several processes at once",
    "peer": "Exudyn's ball bearing",
    "catalogue": "search in the catalogue while one types",
    "currents": "what the electric circuit adds to a simulated second; a risk map",
    "thermal": "an hour of warm-up; losses at printed reference speeds over the heat of ISO 15312",
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the benchmarks and return the exit code.

    0, 1 when one of them failed, 2 for a wrong name.
    """
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"what to measure, default all: {', '.join(NAMES)}")
    parser.add_argument("--quick", action="store_true", help="fewer points, shorter runs, no cold start")
    parser.add_argument("--json", action="store_true", help="one JSON object on stdout instead of tables")
    parser.add_argument("--write", action="store_true", help="write the tables into docs/performance.md")
    parser.add_argument("--clock", choices=tuple(timing.CLOCKS), default="wall", help="cpu: time of the thread only")
    parser.add_argument(
        "--against", metavar="ENVIRONMENT", type=Path, help="folder of another version's environment: both in turn"
    )
    options = parser.parse_args(arguments)
    if options.against is not None and (options.names or options.write):
        print("--against measures both versions at its own points: leave NAME and --write out", file=sys.stderr)
        return 2
    for name in options.names:
        if name not in NAMES:
            print(UsageError(unknown_name("benchmark", name, NAMES)), file=sys.stderr)
            return 2
    timing.use_clock(options.clock)
    report = Report(machine.describe(), options.clock, options.quick, machine.load())
    work = {name: partial(_named, name, Effort(options.quick)) for name in options.names or NAMES}
    if options.against is not None:
        work = {"against": partial(against.measure, options.against, Effort(options.quick))}
    for name, measure in work.items():
        try:
            report.sections.append(_measure(name, measure))
        except UsageError as error:
            print(error, file=sys.stderr)
            return 2
        if not options.json:
            print(performance.section_text(report.sections[-1]), flush=True)
    if options.json:
        print(json.dumps(report.data(), indent=2))
    else:
        print(performance.report_text(report))
    if options.write:
        performance.write(report)
    return 1 if any(section.failed for section in report.sections) else 0


def _named(name: str, effort: Effort) -> Section:
    """Run one of NAMES."""
    measure: Callable[[Effort], Section] = importlib.import_module(f"benchmarks.{name}").measure
    return measure(effort)


def _measure(name: str, measure: Callable[[], Section]) -> Section:
    """Run one benchmark.

    An error is printed and does not stop the others.
    """
    print(f"{name}: {NAMES.get(name, 'this version and another one in turn')}", file=sys.stderr, flush=True)
    began = time.perf_counter()
    try:
        section = measure()
    except UsageError:
        raise
    except (LambdaError, RuntimeError) as error:
        section = Section(name, missing=str(error), failed=True)
    return dataclasses.replace(section, name=name, seconds=time.perf_counter() - began, load=machine.load())


if __name__ == "__main__":
    sys.exit(main())
