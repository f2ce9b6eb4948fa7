"""Start a simulation from a resolved model.

It places the result and checks what a continued run must have in common.
"""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.domain.errors import UsageError
from lambda_core.domain.files import check_folder, check_new, check_target
from lambda_core.domain.time_limit import time_limit
from lambda_core.domain.units import show
from lambda_core.laws.pack import NATIVE, code, other_code
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.machine_model import MachineModel
from lambda_core.model.settings.resolve_solver import MOST_TIME
from lambda_core.results.opening import ResultError
from lambda_core.results.provenance import Provenance
from lambda_core.results.reader import Result
from lambda_core.runs.beginning import begin
from lambda_core.runs.law_blame import BlamingEngine
from lambda_core.runs.loop import resume, run
from lambda_core.runs.progress import Report
from lambda_core.runs.run_engine import BearingsInMotion, RunEngine
from lambda_core.runs.same_case import changed_values, named_models
from lambda_core.runs.session import Attachments
from lambda_core.solver.code_files import physics_key

if TYPE_CHECKING:
    from lambda_core.analysis.electric.live import Live
    from lambda_core.analysis.static_point import StaticPoint
Announce = Callable[[str], None]
Runnable = BearingModel | MachineModel


def launch(
    model: Runnable,
    out: Path | None = None,
    *,
    overwrite: bool = False,
    band: bool = False,
    report: Report | None = None,
    announce: Announce | None = None,
) -> Result:
    """Run a model into a result file.

    The run starts from the model's quasi-static equilibrium.

    Parameters
    ----------
    out : pathlib.Path, optional
        The result file; by default the case's name in the working directory, with a number
        where that is taken.
    overwrite : bool
        Overwrite `out`.
    band : bool
        Write the model band of each bearing.
    report, announce : callable, optional
        Called with the progress of the run; with a sentence before what takes a while.
    """
    began = time.perf_counter()
    path = destination(model, out, overwrite)
    _check_end(model)
    with time_limit(began + model.solver.max_wall):
        engine, provenance, attached = prepared(model, announce, band=band)
    return run(engine, provenance, path, overwrite=overwrite, report=report, attached=attached, began=began)


def relaunch(path: Path, model: Runnable, *, report: Report | None = None, announce: Announce | None = None) -> Result:
    """Go on with the run in `path`.

    Its case resolves to `model` today.

    Raises
    ------
    ResultError
        When the catalogue, the models or the code have changed, so that it would not be the same run.
    """
    began = time.perf_counter()
    result = Result(path)
    _check_end(model)
    _check_same(result, model)
    keys = {name: own.kernel_keys for name, own in result.bearings.items()}
    for known in keys.values():
        if why := other_code(known.get("code", NATIVE)):
            raise ResultError(f"{path} cannot go on: {why}")
    engine, provenance, attached = prepared(model, announce)
    for name, origin in provenance.bearings.items():
        other = sorted(part for part, key in origin.kernel_keys.items() if keys[name].get(part) != key)
        if other:
            raise ResultError(f"{path} cannot go on: the code has changed since: {_some(other)}; {_anew(path)}")
    return resume(engine, provenance, path, report=report, attached=attached, began=began)


def _check_same(result: Result, model: Runnable) -> None:
    """Refuse a case with other values.

    It resolves to other values than those of the run.
    """
    models = named_models(model)
    if tuple(models) != result.bearing_names:
        raise ResultError(f"{result.path} is damaged: its case has other bearings than the result")
    for name, changed in changed_values(result, model).items():
        moved = _moved(models[name], result.bearings[name].model) if name else []
        of = f"{name}: " if name and result.is_machine else ""
        why = (
            f"its laws have changed: {_some(moved)}"
            if moved
            else f"the case now resolves to other values: {of}{_some(changed)}"
        )
        raise ResultError(f"{result.path} cannot go on: {why}; {_anew(result.path)}")


def _check_end(model: Runnable) -> None:
    """Refuse a run without an end.

    The end is missing or cannot be reached.
    """
    asked = model.solver.duration
    end = asked or max(one.solver.max_duration for one in model.bearing_models.values())
    if not end:
        raise UsageError("nothing turns, so the run needs a duration: give --duration, or one in the file")
    if end > MOST_TIME:
        slow = "" if asked else ", 30 turns of a cage; give --duration"
        raise UsageError(f"a duration of {show(end, 'time', 3)}{slow}: at most {show(MOST_TIME, 'time')} are simulated")


def destination(model: Runnable, out: Path | None, overwrite: bool) -> Path:
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
        check_new(check_target(path), overwrite)
    check_folder(path.absolute().parent, path)
    return path


def prepared(
    model: Runnable, announce: Announce | None, *, band: bool = False
) -> tuple[RunEngine, Provenance, Attachments]:
    """Return the engine at t = 0 and origin.

    Also return what is computed from its samples.
    """
    live, begun = _live(model, announce), begin(model, announce)
    if announce is not None:
        announce(begun.sentence())
    engine = BlamingEngine(begun.motion, announce)
    provenance = begun.provenance(engine)
    attached = Attachments.of(provenance, live)
    shared = {"core": physics_key(), "code": code(), **(live.keys() if live is not None else {})}
    origins = {
        name: dataclasses.replace(origin, kernel_keys={**origin.kernel_keys, **attached.watches[name].keys(), **shared})
        for name, origin in provenance.bearings.items()
    }
    provenance = dataclasses.replace(provenance, bearings=origins)
    return BearingsInMotion(engine), _with_bands(begun.point, provenance, announce) if band else provenance, attached


def _with_bands(point: StaticPoint, provenance: Provenance, announce: Announce | None) -> Provenance:
    """Return the origin of a run with bands.

    They are the model bands of each bearing.
    """
    from lambda_core.analysis.band.model_band import bands_or_reason

    if announce is not None:
        announce("computing the model band from the ranges of parameters and laws")
    bands = bands_or_reason(point).bearings.values()
    origins = {
        name: dataclasses.replace(origin, band=band)
        for (name, origin), band in zip(provenance.bearings.items(), bands, strict=True)
    }
    return dataclasses.replace(provenance, bearings=origins)


def _live(model: Runnable, announce: Announce | None) -> Live | None:
    """Return the electric circuit of the run.

    None where the case has none.
    """
    if model.electric is None:
        return None
    from lambda_core.analysis.electric.live import Live

    return Live(model, announce)


def _moved(model: BearingModel, before: Mapping[str, Any]) -> list[str]:
    """Return a sentence for each changed law.

    It comes from another package, version or text of a file than before.
    """
    found: dict[str, None] = {}
    for element, roles in model.laws.items():
        for role, law in roles.items():
            then = before["laws"].get(element, {}).get(role, {}).get("model", {}).get("distribution", "")
            now = law.model.distribution
            if then != now:
                found[f"{role}/{law.model.name} is of {now} now, it was of {then}"] = None
    return list(found)


def _anew(path: Path) -> str:
    return f'what was computed can be read; lambda_core.api.result("{path.name}").with_() runs its case from the start'


def _some(names: list[str]) -> str:
    shown = ", ".join(names[:5])
    return shown if len(names) <= 5 else f"{shown} and {len(names) - 5} more"
