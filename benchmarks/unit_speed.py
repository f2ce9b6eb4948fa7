"""Compare the speed of an FMU with the program.

``python -m benchmarks.unit_speed``: export and steps of 0.1 ms.

All ways through the same time are taken in turn, the shortest of several counts: the engine in Python that stops where
a host stops; the same without stops, as a run has it; steps of ``api.iterate``, which look at every channel; FMUs whose
host reads nothing, or twenty outputs, at every communication point. Needs FMPy, and the extra ``fmu`` for Windows.
"""

from __future__ import annotations

import os
import resource
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from lambda_core import api
from lambda_core.solver.drivers.coupling import coupled_engine
from lambda_core.solver.drivers.dynamics import BearingEngine

CASE, CHANGES = "6208-axial-1300", ("solver.duration=0.2 s",)
STEP, STEPS = 1e-4, 300  # [s], communication steps
REPEATS = 8
_READ = 20  # outputs
UNITS: dict[str, dict[str, object]] = {
    "FMU, code for this machine": {"processor": "native"},
    "FMU as exported": {},
    "FMU with Windows in it": {"platforms": ("linux", "windows")},
}


def main() -> int:
    """Measure and print."""
    with tempfile.TemporaryDirectory() as folder:
        files = {name: _exported(name, Path(folder) / f"{k}.fmu") for k, name in enumerate(UNITS)}
        ways: dict[str, Callable[[], Callable[[], object]]] = {
            "Python engine, same stops": _with_stops,
            "Python engine, no stops": _without_stops,
            "api.iterate": _looking,
        }
        for name, file in files.items():
            ways[name] = lambda file=file: _unit(file, 0)  # type: ignore[misc]
        ways[f"the last one, {_READ} outputs read"] = lambda: _unit(file, _READ)
        best = dict.fromkeys(ways, (float("inf"), float("inf")))
        for _ in range(REPEATS):
            for name, way in ways.items():
                ready = way()
                wall, spent = time.perf_counter(), time.process_time()
                ready()
                found = time.perf_counter() - wall, time.process_time() - spent
                best[name] = min(best[name][0], found[0]), min(best[name][1], found[1])
    print(f"\n{STEPS} steps of {1e3 * STEP:g} ms, {CASE}, shortest of {REPEATS}; load {_load()}")
    print(f"{'':38}{'clock':>10}{'processor':>11}{'to the engine with the same stops':>36}")
    base = best["Python engine, same stops"]
    for name, (wall, spent) in best.items():
        print(f"{name:38}{1e3 * wall:7.1f} ms{1e3 * spent:8.1f} ms{wall / base[0]:28.2f} {spent / base[1]:7.2f}")
    return 0


def _exported(name: str, file: Path) -> Path:
    """Return a file that is exported twice.

    The second time is that of a warm export.
    """
    for words in ("first", "again"):
        wall, spent = time.perf_counter(), _processor()
        api.export_fmu(CASE, CHANGES, out=file, overwrite=True, **UNITS[name])  # type: ignore[arg-type]
        wall, spent = time.perf_counter() - wall, _processor() - spent
        print(f"{name}, {words}: {wall:.1f} s by the clock, {spent:.1f} s of processors, load {_load()}")
    print(f"{'':4}{1e-6 * file.stat().st_size:.2f} MB")
    return file


def _processor() -> float:
    """Return the processor time [s].

    Of this process and of those that it has waited for.
    """
    both = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(each.ru_utime + each.ru_stime for each in both)


def _load() -> str:
    return f"{os.getloadavg()[0]:.1f} on {os.cpu_count()} cores"


def _engine() -> BearingEngine:
    engine = coupled_engine(api.check(CASE, CHANGES), "force")
    assert isinstance(engine, BearingEngine)
    return engine


def _with_stops() -> Callable[[], object]:
    engine = _engine()

    def go() -> None:
        for k in range(STEPS):
            engine.advance_exactly((k + 1) * STEP)
            engine.forget_samples()

    return go


def _without_stops() -> Callable[[], object]:
    engine = _engine()
    return lambda: engine.advance(STEPS * STEP)


def _looking() -> Callable[[], object]:
    bearing = api.iterate(CASE, CHANGES, exact=True)

    def go() -> None:
        for k in range(STEPS):
            bearing.step_to((k + 1) * STEP)

    return go


def _unit(file: Path, outputs: int) -> Callable[[], object]:
    from fmpy import extract, read_model_description
    from fmpy.fmi2 import FMU2Slave

    about = read_model_description(str(file))
    names = about.guid, extract(str(file)), about.coSimulation.modelIdentifier
    unit = FMU2Slave(guid=names[0], unzipDirectory=names[1], modelIdentifier=names[2], instanceName="bearing")
    unit.instantiate()
    unit.setupExperiment(startTime=0.0)
    unit.enterInitializationMode()
    unit.exitInitializationMode()
    read = [each.valueReference for each in about.modelVariables if each.causality == "output"][:outputs]

    def go() -> None:
        for k in range(STEPS):
            unit.doStep(k * STEP, STEP)
            if read:
                unit.getReal(read)

    return go


if __name__ == "__main__":
    sys.exit(main())
