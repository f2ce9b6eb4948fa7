"""Run the heavy work of the builder in a process.

It does equilibria, views and figures.

It is a process of its own because compiled code takes seconds to load and holds the
interpreter meanwhile. ``python -m lambda_gui.helper_process`` reads one JSON object per line
(``work`` and its arguments) and answers with pickled pairs, each behind its length in eight
bytes: ("say", sentence) while it works, then ("done", object) or ("error", sentence).
"""

from __future__ import annotations

import json
import os
import pickle
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lambda_core.api import FitProgress

Say = Callable[[str], None]


def estimate(say: Say, tables: dict[str, Any], folder: str | None) -> Any:
    """Estimate a case before a run.

    Equilibrium, lives, time of a run.
    """
    from lambda_core import api

    return api.estimate(api.check(tables, folder=Path(folder) if folder else None), announce=say)


def answer(say: Say, question: str, tables: dict[str, Any], folder: str | None, units: str) -> Any:
    """Return the answer about a case.

    It consists of text and views.
    """
    from lambda_core import api
    from lambda_core.domain.unit_systems import unit_system

    model = api.check(tables, folder=Path(folder) if folder else None)
    return _ANSWERS[question](say, model, unit_system(units))


def _equilibrium(say: Say, model: Any, units: Any) -> Any:
    from lambda_core import api

    found = api.quasistatic(model, band=True, announce=say)
    modes = api.modes(model, announce=say) if api.is_machine(model) else None
    told = [answer.text(None, units) for answer in (found, modes) if answer is not None]
    return "\n\n".join(told), api.machine_pictures(found, modes)


def _temperatures(say: Say, model: Any, units: Any) -> Any:
    from lambda_core import api

    found = api.thermal(model, announce=say)
    return found.text(units), api.thermal_pictures(found)


def _currents(say: Say, model: Any, units: Any) -> Any:
    from lambda_core import api

    return units.sentence(api.electric(model, announce=say).outcome.text()), []


def _friction(say: Say, model: Any, units: Any) -> Any:
    from lambda_core import api

    names = [name or None for name in model.bearing_models]
    case = tomllib.loads(model.case_toml)
    curves = [api.stribeck(case, bearing=name, announce=say) for name in names]
    return "\n".join(f"{curve.title}: {curve.note}" for curve in curves), [
        api.stribeck_picture(curve) for curve in curves
    ]


def _assumptions(say: Say, model: Any, units: Any) -> Any:
    from lambda_core import api

    return units.sentence(api.describe(model).text()), []


_ANSWERS: dict[str, Callable[[Say, Any, Any], Any]] = {
    "equilibrium": _equilibrium, "temperatures": _temperatures, "currents": _currents, "friction": _friction,
    "assumptions": _assumptions,
}  # fmt: skip


def summary(say: Say, path: str, bearing: str | None = None) -> Any:
    """Return the summary of a result.

    It may be that of one bearing.
    """
    from lambda_core import api

    return api.summary(api.result(path, bearing))


def bearings(say: Say, path: str) -> tuple[str, ...]:
    """Return the names of the bearings of a result."""
    from lambda_core import api

    return api.result(path).bearing_names


def case_text(say: Say, path: str) -> str:
    """Return the case that a result was computed from."""
    from lambda_core import api

    return api.result(path).case_toml


def views(say: Say, subject: str) -> Any:
    """Return the views of one kind of subject."""
    from lambda_core import api

    return api.views(subject)  # type: ignore[arg-type]


def view(say: Say, sources: list[str], name: str, bearing: str | None = None) -> Any:
    """Return what a view shows."""
    from lambda_core import api

    say(f"reading {', '.join(Path(source).name for source in sources)} ...")
    return api.view(sources if len(sources) > 1 else sources[0], name, bearing=bearing)


def draw(
    say: Say, sources: list[str], name: str, folder: str, units: str, formats: list[str], bearing: str | None = None
) -> list[str]:
    """Draw a view into files."""
    from lambda_core import api
    from lambda_core.domain.unit_systems import unit_system
    from lambda_core.views.other_units import in_units

    say("drawing ...")
    data = in_units(api.view(sources if len(sources) > 1 else sources[0], name, bearing=bearing), unit_system(units))
    return [str(path) for path in api.draw(data, folder, api.view_stem(sources, bearing), formats)]


def report(say: Say, sources: list[str], target: str, bearing: str | None = None) -> list[str]:
    """Write a report of each result; several are numbered."""
    from lambda_core import api

    say("writing the report ...")
    path = Path(target)
    names = [path if n == 0 else path.with_stem(f"{path.stem}-{n + 1}") for n in range(len(sources))]
    return [str(api.report(source, name, bearing=bearing)) for source, name in zip(sources, names, strict=True)]


def study_cost(say: Say, study: dict[str, Any], case_toml: str) -> str:
    """Return what a study of a case will take."""
    from tempfile import TemporaryDirectory

    from lambda_core import api

    with TemporaryDirectory(prefix="lambda-bearing-") as folder:
        case = Path(folder) / "case.toml"
        case.write_text(case_toml, encoding="utf-8")
        return api.study_check(study | {"case": str(case)}, announce=say).text()


def duty(say: Say, cycle: dict[str, Any], case_toml: str) -> Any:
    """Return the sum of a duty cycle.

    It belongs to a case.
    """
    from tempfile import TemporaryDirectory

    from lambda_core import api

    with TemporaryDirectory(prefix="lambda-bearing-") as folder:
        case = Path(folder) / "case.toml"
        case.write_text(case_toml, encoding="utf-8")
        return api.duty(cycle | {"case": str(case)}, announce=say)


def fit(say: Say, case: dict[str, Any], data: str, vary: list[str], bearing: str | None, units: str) -> Any:
    """Return a fit in words and pictures.

    The fit is of a case to a file of measurements.
    """
    from lambda_core import api
    from lambda_core.domain.number_text import counted
    from lambda_core.domain.unit_systems import unit_system

    def follow(now: FitProgress) -> None:
        error = "" if now.error_pct is None else f", error {now.error_pct:.3g} %"
        say(f"{counted(now.solved, 'operating point')} solved{error}")

    found = api.fit(case, data, vary, bearing=bearing, progress=follow, announce=say)
    return found, found.text(None, unit_system(units)), found.pictures()


def study_summary(say: Say, path: str) -> Any:
    """Return where a study stands, and its table."""
    from lambda_core import api

    return api.study_status(path), api.study_table(path)


def differences(say: Say, sources: list[str]) -> Any:
    """Return a comparison of several results."""
    from lambda_core import api

    say("reading ...")
    return api.side_by_side(sources)


_DOES = (
    estimate, answer, summary, bearings, case_text, views, view, draw, report, study_cost, duty, fit, study_summary,
    differences,
)  # fmt: skip
_WORK: dict[str, Callable[..., Any]] = {work.__name__: work for work in _DOES}


def main() -> None:
    """Answer until the other side closes the line."""
    out = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # nothing else may write between the answers

    def reply(kind: str, content: Any) -> None:
        data = pickle.dumps((kind, content))
        out.write(len(data).to_bytes(8, "big") + data)
        out.flush()

    if hasattr(os, "nice"):
        os.nice(5)
    for line in sys.stdin:
        question = json.loads(line)
        _answer(question.pop("work"), question, reply)


def _answer(work: str, arguments: dict[str, Any], reply: Callable[[str, Any], None]) -> None:
    from lambda_core.domain.errors import LambdaError

    try:
        found = _WORK[work](lambda text: reply("say", text), **arguments)
    except LambdaError as error:
        reply("error", str(error))
    except KeyboardInterrupt:  # what can keep a part of its answer has done so
        reply("error", "stopped")
    except Exception as error:  # a plugin's view may fail in any way
        from lambda_core.domain.plugin_errors import describe

        reply("error", f"{work} failed: {describe(error)}")
    else:
        reply("done", found)


if __name__ == "__main__":
    main()
