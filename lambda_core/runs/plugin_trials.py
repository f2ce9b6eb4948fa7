"""Try plugins on the first samples of a run.

It tries observers, events, views, sections and methods.

`plugins check` tries them on a short run of a 6208 in a process of its own; `check` tries the observers and events of a
case on the first two samples of that case.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from lambda_core.discovery.api import LIMIT, CheckCard, Registry, answer, check_apart, chosen_others, tried_apart
from lambda_core.domain.errors import LambdaError, Problem, SolverError
from lambda_core.model.bearing_model import BearingModel, ChosenEvent, ChosenObserver
from lambda_core.runs.observers import Watch

if TYPE_CHECKING:
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.results.reader import Result

Announce = Callable[[str], None] | None
_CASE = "6208-axial-1300"
_CHANGES = (
    "solver.duration=0.1 ms", "output.interval=2 us", "markers.trial.body=inner_ring", "markers.trial.y=10 mm"
)  # fmt: skip
_INTERVAL = 1e-5  # between the two samples of a case [s]
_NOT_HERE = {"study": "looks at the table of a study", "machine": "looks at a machine without time"}


def check_plugins(names: Sequence[str] = (), *, announce: Announce = None) -> Iterator[CheckCard]:
    """Test what plugins bring.

    Laws against the contract of their role, all else on a short run.

    Parameters
    ----------
    names : sequence of str
        Distributions, roles, kinds ("observer") or "role/name"; everything when empty.
    announce : callable, optional
        Called with a sentence about one that takes long.

    Yields
    ------
    CheckCard
        One for each: laws in the order of the pipeline, then methods, views, observers, events and sections.

    Raises
    ------
    UsageError
        When a name is none of these.
    """
    from lambda_core.discovery.api import registry

    found = registry()
    others = [f"{kind}/{name}" for kind, name in chosen_others(found, names)]
    yield from check_apart(found, names, announce=announce)
    yield from tried_apart(found, others, __name__, LIMIT, announce)


def watch_problems(model: BearingModel | MachineModel) -> list[Problem]:
    """Return the mistakes of observers and events.

    They are called with the first two samples of a case.

    Returns
    -------
    list of Problem
        Empty also where the case has none of them, or no start.
    """
    bearings = model.bearing_models
    if not any(one.observers or one.events for one in bearings.values()):
        return []
    try:
        samples = _first_two(model)
    except SolverError:  # the run reports it
        return []
    found: dict[Problem, None] = {}
    for name, own in bearings.items():
        watch = Watch(own, is_trial=True)
        watch.take(samples[name or next(iter(samples))])
        found |= {Problem(f"{key.replace('/', 's.', 1)}", fault): None for key, fault in watch.failed.items()}
    return list(found)


def _first_two(model: BearingModel | MachineModel) -> dict[str, Any]:
    """Return the first two samples by bearing.

    They are at the start and at a moment after it.
    """
    from lambda_core.runs.launch import prepared

    def often(one: BearingModel) -> BearingModel:
        return replace(one, output=replace(one.output, interval=_INTERVAL))

    engine, _, _ = prepared(replace(model.with_each(often), electric=None), None)
    advance = engine.advance(1.5 * _INTERVAL)
    if not advance.ok:
        raise SolverError(advance.message)
    return {name: {key: rows[:2] for key, rows in own.items()} for name, own in engine.samples().bearings.items()}


class _Trial:
    """Short run of a 6208.

    It is made when it is first needed.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    @cached_property
    def model(self) -> BearingModel:
        from lambda_core.model.checking import check_bearing

        return check_bearing(_CASE, _CHANGES)

    @cached_property
    def result(self) -> Result:
        from lambda_core.runs.launch import launch

        return launch(self.model, self._folder / "trial.h5")

    @cached_property
    def inputs(self) -> Any:
        from lambda_core.analysis.rating.compare_methods import comparison_inputs
        from lambda_core.solver.drivers.equilibrium import solve

        return comparison_inputs(solve(self.model))

    def of(self, kind: str, item: Any) -> tuple[list[str], list[str], str]:
        """Return the faults of one plugin.

        Also return its warnings, and the reason where it was not tested.
        """
        if kind in ("observer", "event"):
            return self._watched(kind, item)
        return self._asked(kind, item)

    def _watched(self, kind: str, item: Any) -> tuple[list[str], list[str], str]:
        required = [name for name, info in item.parameters.model_fields.items() if info.is_required()]
        if required:
            return [], [], f"has no defaults for {', '.join(required)}"
        chosen: Any
        if kind == "observer":
            chosen = replace(self.model, observers={item.name: ChosenObserver(item, item.parameters())})
        else:
            chosen = replace(self.model, events={item.name: ChosenEvent(item, item.parameters(), "record")})
        watch = Watch(chosen, is_trial=True)
        watch.take({channel.name: self.result[channel.name][:2] for channel in self.result.channels})
        return list(watch.faults), list(watch.without_numbers.values()), ""

    def _asked(self, kind: str, item: Any) -> tuple[list[str], list[str], str]:
        from lambda_core.discovery.api import data_of
        from lambda_core.views.method import NotApplicable, evaluate_methods
        from lambda_core.views.section import content_of

        try:
            if kind == "method":
                (answered,) = evaluate_methods([item], self.inputs)
                return ([answered.reason], [], "") if answered.failed else ([], [], answered.reason)
            if kind == "profile":
                return [], [], ""  # its values were checked when it was registered
            if kind == "section":
                content_of(item, self.result)
            elif item.subject in _NOT_HERE:
                return [], [], _NOT_HERE[item.subject]
            else:
                data_of(item, self.result if item.subject == "result" else [self.result, self.result], {})
        except NotApplicable as error:
            return [], [], f"does not apply to the trial: {error}"
        except LambdaError as error:
            return [str(error)], [], ""
        return [], [], ""


def _trial_cards(registry: Registry, labels: Sequence[str]) -> Iterator[CheckCard]:
    """Try each of "kind/name"."""
    with TemporaryDirectory() as folder:
        trial = _Trial(Path(folder))
        for label in labels:
            kind, _, name = label.partition("/")
            faults, warnings, not_tried = trial.of(kind, registry.by_kind()[kind][name])  # type: ignore[index]
            yield CheckCard(
                role=kind, name=name, distribution=registry.origin(kind, name), ok=not faults, faults=faults,
                warnings=warnings, not_tried="" if faults else not_tried, nanoseconds=None,
            )  # fmt: skip


if __name__ == "__main__":
    answer(_trial_cards, sys.argv[1:])
