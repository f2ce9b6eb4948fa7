"""The table of commands: where each one lives, loaded only when it is called.

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
    """One command: its name, its line in the list, and how to get it."""

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
    "check": ("lambda_cli.case:check", "Say what a case is, what it assumes, and everything that is wrong with it."),
    "recent": ("lambda_cli.recent:recent", "List the case files worked on last."),
    "schema": ("lambda_cli.case:schema", "Print the JSON schema of case files, for editors."),
    "run": ("lambda_cli.run:run", "Run a case and write its result."),
    "estimate": ("lambda_cli.estimate:estimate", "Processor time that a run will take."),
    "resume": ("lambda_cli.resume:resume", "Go on with an interrupted run."),
    "quasistatic": ("lambda_cli.quasistatic:quasistatic", "Equilibrium of a case without running it."),
    "modes": ("lambda_cli.quasistatic:modes", "Critical speeds and natural frequencies of a machine."),
    "stribeck": ("lambda_cli.stribeck:stribeck", "Friction torque over speed, compared with SKF's model."),
    "fit": ("lambda_cli.fit:fit", "Fit parameters of a case to measured operating points."),
    "traction": ("lambda_cli.traction:traction", "Traction of an oil over slide-roll ratio."),
    "measured": ("lambda_cli.measured:app", "Measured series, compared with the program."),
    "thermal": ("lambda_cli.thermal:thermal", "Temperatures of a bearing by its own losses."),
    "electric-map": ("lambda_cli.electric:risk_map", "Discharges over speed and temperature."),
    "electric-film": ("lambda_cli.electric:film", "Film thickness from a measured capacitance of the bearing."),
    "electric": ("lambda_cli.electric:electric", "Bearing voltage, discharges, impedance in an electric machine."),
    "show": ("lambda_cli.show:show", "Show the summary of a result."),
    "view": ("lambda_cli.view:view", "Draw a view of one or more results."),
    "animate": ("lambda_cli.animate:animate", "Show a run in motion: GIF, MP4 or glTF."),
    "compare": ("lambda_cli.compare:compare", "Compare the simulation with catalogues and standards."),
    "duty": ("lambda_cli.duty:duty", "Rating life and losses over a duty cycle."),
    "cross-check": ("lambda_cli.cross_check:cross_check", "Integrate a case with SUNDIALS CVODE as well, and compare."),
    "study": ("lambda_cli.study:app", "Many runs: sweeps, samples, maps."),
    "export": ("lambda_cli.export:app", "A bearing for other programs: co-simulation units (FMU)."),
    "report": ("lambda_cli.report:report", "Write a report of results."),
    "cite": ("lambda_cli.cite:cite", "Print the references of the models a result used."),
    "db": ("lambda_cli.db:app", "Search and edit the catalogue of bearings, oils and materials."),
    "plugins": ("lambda_cli.plugins:app", "List, show, check and start plugins."),
    "warmup": ("lambda_cli.warmup:warmup", "Compile ahead of the first run."),
    "gui": ("lambda_gui.command:gui", "Build cases and look at results in the terminal."),
}


def entries() -> dict[str, Entry]:
    """Return every command that exists here, by name; imports none of them."""
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
    """Return (distribution, sentence) of every command whose name was taken when its package came."""
    return [
        (entry.distribution, f'its command "{name.partition(":")[2]}" is called {name}: the name is taken')
        for name, entry in entries().items()
        if ":" in name
    ]


@contextmanager
def guarded(entry: Entry) -> Iterator[None]:
    """Blame what a command of another package does wrong on that package; our own mistakes stay ours."""
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
