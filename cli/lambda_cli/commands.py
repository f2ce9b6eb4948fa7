"""List the commands; load each one when it is called.

A command is a function or a typer application in a module of its own. One whose module is
not installed is not listed. Further packages bring commands through the entry-point group
``lambda_bearing.commands``; these are listed without being imported.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec
from typing import Any

import typer

from lambda_core.domain.errors import LambdaError
from lambda_core.domain.installed import COMMANDS as GROUP
from lambda_core.domain.installed import OWN, first_line, in_use
from lambda_core.domain.plugin_errors import PluginError, describe


@dataclass(frozen=True)
class Entry:
    """One command: name, help line and loader."""

    name: str
    help: str
    load: Callable[[], Any]  # a function, or a typer application
    panel: str = "Commands"
    distribution: str = ""  # of another package


def _built_in(name: str, target: str, text: str) -> Entry:
    return Entry(name, text, partial(_load, target))


def _load(target: str) -> Any:
    module, _, attribute = target.partition(":")
    return getattr(importlib.import_module(module), attribute)


COMMANDS: dict[str, tuple[str, str]] = {
    "init": ("lambda_cli.case:init", "Write a commented case file to start from."),
    "check": ("lambda_cli.case:check", "Check a case: errors, model and assumptions."),
    "recent": ("lambda_cli.recent:recent", "List recent case files."),
    "schema": ("lambda_cli.case:schema", "Print the JSON schema of case files, for editors."),
    "run": ("lambda_cli.run:run", "Simulate a case over time and write its result."),
    "estimate": ("lambda_cli.estimate:estimate", "Estimate the processor time of a run."),
    "resume": ("lambda_cli.resume:resume", "Continue an interrupted run."),
    "quasistatic": (
        "lambda_cli.quasistatic:quasistatic",
        "Solve the equilibrium of a case: loads, lives, films, friction.",
    ),
    "modes": ("lambda_cli.quasistatic:modes", "Compute critical speeds and natural frequencies of a machine."),
    "stribeck": ("lambda_cli.stribeck:stribeck", "Compute friction torque over speed, compared with SKF's model."),
    "fit": ("lambda_cli.fit:fit", "Fit parameters of a case to measured operating points."),
    "traction": ("lambda_cli.traction:traction", "Compute the traction of an oil over slide-roll ratio."),
    "measured": ("lambda_cli.measured:app", "Compare measured series with the program."),
    "thermal": ("lambda_cli.thermal:thermal", "Compute the temperatures of a bearing or a machine."),
    "electric-map": ("lambda_cli.electric:risk_map", "Map bearing currents over speed and temperature."),
    "electric-film": ("lambda_cli.electric:film", "Find the film from a measured capacitance."),
    "electric": ("lambda_cli.electric:electric", "Compute bearing voltage and currents in an electric machine."),
    "show": ("lambda_cli.show:show", "Show the summary of a result."),
    "view": ("lambda_cli.view:view", "Draw a view of one or more results."),
    "animate": ("lambda_cli.animate:animate", "Show a run in motion: GIF, MP4 or glTF."),
    "compare": ("lambda_cli.compare:compare", "Compare the simulation with catalogues and standards."),
    "duty": ("lambda_cli.duty:duty", "Compute rating life and losses over a duty cycle."),
    "cross-check": ("lambda_cli.cross_check:cross_check", "Compare the integrator with SUNDIALS CVODE."),
    "study": ("lambda_cli.study:app", "Evaluate a case over many operating points."),
    "export": ("lambda_cli.export:app", "Export a case for other programs (FMU)."),
    "report": ("lambda_cli.report:report", "Write a report of results."),
    "cite": ("lambda_cli.cite:cite", "Print the references of the models that a result used."),
    "db": ("lambda_cli.db:app", "Search and edit the catalogue of bearings, oils and materials."),
    "plugins": ("lambda_cli.plugins:app", "List, show, check and create plugins."),
    "warmup": ("lambda_cli.warmup:warmup", "Compile before the first run."),
    "gui": ("lambda_gui.command:gui", "Build cases and look at results in the terminal."),
}


def entries() -> dict[str, Entry]:
    """Return every command that exists here, by name.

    It imports none of them.
    """
    found = {
        name: _built_in(name, target, text)
        for name, (target, text) in COMMANDS.items()
        if find_spec(target.partition(":")[0]) is not None
    }
    for source in in_use(GROUP):
        own = source.project == OWN
        text = first_line(source.target) if own else f"From {source.distribution}."
        # A name that is taken is called with its package before it.
        name = source.name if source.name not in found else f"{source.project}:{source.name}"
        distribution = "" if own else source.distribution
        found[name] = Entry(name, text, source.load, "Commands" if own else "Plugins", distribution)
    return found


def renamed() -> list[tuple[str, str]]:
    """Return (distribution, sentence) of every renamed command.

    Its name was taken when its package came.
    """
    return [
        (entry.distribution, f'its command "{name.partition(":")[2]}" is called {name}: the name is taken')
        for name, entry in entries().items()
        if ":" in name
    ]


@contextmanager
def guarded(entry: Entry) -> Iterator[None]:
    """Blame errors of another package's command on it.

    Errors of the program itself stay with the program.
    """
    try:
        yield
    except (LambdaError, BrokenPipeError, typer.Abort):
        raise
    except Exception as error:
        if not entry.distribution or hasattr(error, "exit_code"):
            raise
        raise PluginError(f'the command "{entry.name}" of {entry.distribution} fails: {describe(error)}') from error


def invoked(invoke: Callable[[Any], Any], entry: Entry) -> Callable[[Any], Any]:
    """Return how a command of another package is run: guarded."""

    def run(context: Any) -> Any:
        with guarded(entry):
            return invoke(context)

    return run
