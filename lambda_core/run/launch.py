"""From a resolved model to a running simulation: where the result goes, and what must be the same to go on."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.discovery.manager import registry
from lambda_core.domain.errors import UsageError
from lambda_core.domain.files import check_folder, check_new, check_target
from lambda_core.laws.kernels import sources_key
from lambda_core.laws.pack import NATIVE, code, other_code
from lambda_core.results.opening import ResultError
from lambda_core.results.provenance import Provenance, differences, model_data
from lambda_core.results.quasistatic import QuasiStatic, quasistatic_of
from lambda_core.results.reader import Result
from lambda_core.run.engineering import rating_of
from lambda_core.run.law_blame import BlamingBearingEngine, naming_laws
from lambda_core.run.loop import resume, run
from lambda_core.run.progress import Report
from lambda_core.run.watch import Watch
from lambda_core.solver.code_files import physics_sources
from lambda_core.solver.drivers.equilibrium import solve
from lambda_core.system.bearing import BearingModel

if TYPE_CHECKING:
    from lambda_core.electric.live import Live

Announce = Callable[[str], None]


def launch(
    model: BearingModel,
    out: Path | None = None,
    *,
    force: bool = False,
    report: Report | None = None,
    announce: Announce | None = None,
) -> Result:
    """Run a model from its quasi-static equilibrium into a result file.

    Parameters
    ----------
    out : pathlib.Path, optional
        The result file; by default the case's name in the working directory, with a number
        where that is taken.
    force : bool
        Overwrite `out`.
    report, announce : callable, optional
        Called with the progress of the run; with a sentence before what takes a while.
    """
    path = destination(model, out, force)
    live = _live(model, announce)
    watch = Watch(model)
    engine, provenance = _engine(model, announce, live, watch)
    return run(engine, provenance, path, force=force, report=report, live=live, watch=watch)


def relaunch(
    path: Path, model: BearingModel, *, report: Report | None = None, announce: Announce | None = None
) -> Result:
    """Go on with the run in `path`, whose case resolves to `model` today.

    Raises
    ------
    ResultError
        When the catalogue, the models or the code have changed, so that it would not be the same run.
    """
    result = Result(path)
    changed = differences(result.model, model_data(model))
    if changed:
        moved = _moved(model, result.model)
        why = (
            f"its laws have changed: {_some(moved)}"
            if moved
            else f"the case now resolves to other values: {_some(changed)}"
        )
        raise ResultError(f"{path} cannot go on: {why}")
    keys = result.kernel_keys
    if why := other_code(keys.get("code", NATIVE)):
        raise ResultError(f"{path} cannot go on: {why}")
    live = _live(model, announce)
    watch = Watch(model)
    engine, provenance = _engine(model, announce, live, watch)
    other = sorted(name for name, key in provenance.kernel_keys.items() if keys.get(name) != key)
    if other:
        raise ResultError(f"{path} cannot go on: the code has changed since: {_some(other)}")
    return resume(engine, provenance, path, report=report, live=live, watch=watch)


def destination(model: BearingModel, out: Path | None, force: bool) -> Path:
    """Return where the result goes; UsageError where that cannot be."""
    if out is None:
        path, number = Path(f"{model.name}.h5"), 1
        while path.exists():
            number += 1
            path = Path(f"{model.name}-{number}.h5")
    else:
        path = out
        if path.is_dir():
            raise UsageError(f"{path} is a folder: name a file in it, for example {path / model.name}.h5")
        check_new(check_target(path), force)
    check_folder(path.absolute().parent, path)
    return path


def _live(model: BearingModel, announce: Announce | None) -> Live | None:
    """Return the electric circuit of the run, where the case has one."""
    if model.electric is None:
        return None
    from lambda_core.electric.live import Live

    return Live(model, announce)


def _engine(
    model: BearingModel, announce: Announce | None, live: Live | None, watch: Watch
) -> tuple[BlamingBearingEngine, Provenance]:
    with naming_laws(model):
        start = solve(model, announce=announce)
    if announce is not None:
        announce(_start_line(quasistatic_of(start)))
    engine = BlamingBearingEngine(model, announce, start)
    core = sources_key(*physics_sources())
    rating = rating_of(start, registry().methods)
    keys = live.keys() if live is not None else {}
    return engine, Provenance(
        model, {**engine.kernel_keys, **keys, **watch.keys(), "core": core, "code": code()}, rating
    )


def _start_line(start: QuasiStatic) -> str:
    return (
        f"equilibrium: {start.loaded_balls} balls loaded, "
        f"Q_max {start.max_load_N / 1e3:.2f} kN ({start.max_load_ring} ring), p_max {start.max_pressure_GPa:.2f} GPa"
    )


def _moved(model: BearingModel, before: Mapping[str, Any]) -> list[str]:
    """Return a sentence for each law that comes from another package, version or text of a file than before."""
    found: dict[str, None] = {}
    for element, roles in model.laws.items():
        for role, law in roles.items():
            then = before["laws"].get(element, {}).get(role, {}).get("model", {}).get("distribution", "")
            now = law.model.distribution
            if then != now:
                found[f"{role}/{law.model.name} is of {now} now, it was of {then}"] = None
    return list(found)


def _some(names: list[str]) -> str:
    shown = ", ".join(names[:5])
    return shown if len(names) <= 5 else f"{shown} and {len(names) - 5} more"
