"""Draw hostile machines: one wrong value in a right file.

And calls of the Python API with one argument that no caller should give.
"""

from __future__ import annotations

import copy
import os
import random
import re
import sys
import tomllib
from collections.abc import Callable, Iterator
from functools import cache, partial
from pathlib import Path
from typing import Any

from lambda_core import api
from lambda_core.domain.errors import CaseError, LambdaError, SolverError
from lambda_core.machine import Machine
from lambda_core.model.machine_templates import shaft_text
from tests.attacks import hostile as of_one
from tests.attacks.damage import Said, line
from tests.attacks.trial import attempt
from tests.attacks.written import toml

_LIMIT = 120.0  # [s] of wall time of a trial
_COMPILES = 600.0  # [s] of one that compiles a unit: minutes on a busy machine
_USUAL = (-3.0, 3.0)  # powers of ten by which a number of the right kind is changed
_WILD = (-30.0, 30.0)
_NUMBER = re.compile(r"^\s*([-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?)(.*)$", re.S)
_MOTOR = Path(__file__).parents[2] / "examples" / "motor-circuit" / "motor.toml"
_SHORT = {"duration": "0.2 ms", "max_wall": "3 s"}
_COMMANDS = (
    *(("quasistatic", "case.toml"),) * 4, ("modes", "case.toml"), ("thermal", "case.toml"), ("electric", "case.toml"),
    *(("run", "case.toml", "--out", "out.h5"),) * 3, ("estimate", "case.toml"), ("check", "case.toml"),
    ("stribeck", "case.toml", "--bearing", "left"), ("export", "fmu", "case.toml", "--out", "out.fmu"),
)  # fmt: skip
_CYCLE: dict[str, Any] = {
    "name": "day",
    "case": "case.toml",
    "phases": [{"name": "a", "time": "1 h"}, {"name": "b", "time": "3 h", "changes": {"operation.speed": "900 rpm"}}],
}
_MEASURED = (
    "speed [1/min],radial load [kN],oil temperature [degC],friction torque [N mm],friction torque error [%]\n"
    "1000,1,60,100,2\n2000,2,60,180,2\n3000,3,70,220,2\n"
)
_SERIES = "time [s],bearing voltage [V]\n0,0\n0.0001,5\n0.0002,0\n"


@cache
def machines() -> tuple[dict[str, Any], ...]:
    """Return the machines for hostile values.

    Gears, a network, a circuit, laws, held rings and cages.
    """
    box = tomllib.loads(shaft_text("geared-shaft", "box"))
    warm = {"conductances": "harris", "ambient": "20 degC"}
    seal = {"at": "160 mm", "z": {"stiffness": "1 N/um", "damping": "200 N s/m"}}
    extra = {"thermal": warm, "connections": {"seal": seal}, "markers": {"foot": {"x": "10 mm"}}}
    motor = tomllib.loads(_MOTOR.read_text(encoding="utf-8"))
    motor["bearings"]["left"] = motor["bearings"].pop("drive_end")
    fitted = copy.deepcopy(box) | {"bearings": {**box["bearings"]}}
    fitted["bearings"]["left"] = {**box["bearings"]["left"], "models": {"traction": "eyring"}}
    held = copy.deepcopy(box)
    held["bearings"]["left"] |= {
        "inner_ring": {"mass": "0.2 kg", "unbalance": "20 g mm"},
        "outer_ring": {"spin": {"motion": "-300 rpm"}, "mass": "0.3 kg", "polar_inertia": "300 kg mm2"},
        "cage": {"y": {"motion": "0.05 mm"}, "z": "2 N/um", "spin": "free", "mass": "30 g"},
    }
    return box | extra, motor, fitted, held, held


def places(node: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Yield where every value stands in nested tables and lists."""
    items = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    for key, inner in items:
        yield (*path, key)
        yield from places(inner, (*path, key))


def changed(node: dict[str, Any], pick: random.Random) -> dict[str, Any]:
    """Return tables with one value changed.

    In size, in kind, in name, or left out.
    """
    made = copy.deepcopy(node)
    *above, last = pick.choice(list(places(made)))
    inner: Any = made
    for key in above:
        inner = inner[key]
    kind = pick.random()
    if kind < 0.6:
        inner[last] = _resized(inner[last], pick)
    elif kind < 0.85:
        inner[last] = pick.choice((*of_one._WORDS, *of_one._NUMBERS, *of_one._SIMPLE))
    elif kind < 0.93 or not isinstance(inner, dict):
        del inner[last]
    else:
        inner[pick.choice((*of_one._WORDS, "axis", "left", "shaft"))] = inner.pop(last)
    return made


def _resized(value: Any, pick: random.Random) -> Any:
    """Return a value of another size.

    Times a power of ten, in its unit; a word becomes another one.
    """
    factor = 10.0 ** pick.uniform(*(_WILD if pick.random() < 0.3 else _USUAL)) * pick.choice((1, 1, 1, -1))
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        return pick.choice(of_one._SIMPLE)
    if not isinstance(value, str):
        return value * factor
    found = _NUMBER.match(value)
    return f"{float(found[1]) * factor:.6g}{found[2]}" if found else value + pick.choice(("", " ", "x", "\x00", "é"))


def hostile(seed: int, number: int, folder: Path) -> Said:
    """Give a command a hostile input.

    A machine, duty cycle, table of measurements or series.
    """
    pick = random.Random(seed * 1_000_003 + number)
    machine = {**copy.deepcopy(pick.choice(machines())), "solver": _SHORT}
    kind = pick.choice(("machine",) * 7 + ("cycle", "fit", "series"))
    (folder / "case.toml").write_text(toml(machine), encoding="utf-8")
    arguments = _WRITERS[kind](pick, machine, folder)
    outcome = attempt(arguments, folder, _COMPILES if arguments[0] == "export" else _LIMIT)
    return outcome, line(arguments), {"kind": kind}


def _machine(pick: random.Random, machine: dict[str, Any], folder: Path) -> tuple[str, ...]:
    text = of_one.damaged(toml(changed(machine, pick)), pick)
    (folder / "case.toml").write_text(text, encoding="utf-8", errors="surrogateescape")
    chosen = pick.choice(_COMMANDS)
    return (*chosen, *of_one.without_band(pick, chosen[0]))


def _cycle(pick: random.Random, machine: dict[str, Any], folder: Path) -> tuple[str, ...]:
    text = toml(changed(_CYCLE, pick))
    (folder / "day.toml").write_text(text, encoding="utf-8", errors="surrogateescape")
    return ("duty", "day.toml", *pick.choice([(), ("--json",)]))


def _fit(pick: random.Random, machine: dict[str, Any], folder: Path) -> tuple[str, ...]:
    (folder / "rig.csv").write_bytes(spoilt(_MEASURED, pick))
    return ("fit", "6208-axial-1300", "rig.csv", "--vary", "loss_factor")


def _series(pick: random.Random, machine: dict[str, Any], folder: Path) -> tuple[str, ...]:
    (folder / "volts.csv").write_bytes(spoilt(_SERIES, pick))
    (folder / "case.toml").write_text(
        toml({**machines()[1], "electric": {"duration": "1 ms", "series": {"file": "volts.csv"}}})
    )
    return ("electric", "case.toml")


_WRITERS: dict[str, Callable[[random.Random, dict[str, Any], Path], tuple[str, ...]]] = {
    "machine": _machine, "cycle": _cycle, "fit": _fit, "series": _series,
}  # fmt: skip


def spoilt(text: str, pick: random.Random) -> bytes:
    """Return a table with one fault.

    In a cell, a line or some bytes.
    """
    cells = re.split(r"([,\n])", text)
    at = pick.randrange(0, len(cells), 2)
    cells[at] = str(pick.choice((*of_one._WORDS, *of_one._NUMBERS)))
    data = bytearray("".join(cells).encode("utf-8", errors="surrogatepass"))
    if pick.random() < 0.3 and data:
        data[pick.randrange(len(data))] = pick.randrange(256)
    return bytes(data)


def call(seed: int, number: int, folder: Path) -> Said:
    """Call the API with a hostile argument.

    It answers, or raises an error of its own.
    """
    pick = random.Random(seed * 1_000_003 + number)
    name = pick.choice(sorted(_CALLS))
    odd = pick.choice((*of_one._WORDS, *of_one._NUMBERS, *of_one._SIMPLE, object, b"bytes", {1: 2}, Path("x"), 1j))
    outcome = attempt(("--version",), folder, _LIMIT, before=partial(_called, name, odd))
    return outcome, f"{name}({odd!r})", {"call": name}


def _box(**options: Any) -> Machine:
    return Machine.from_case(tomllib.loads(shaft_text("geared-shaft", "box"))).with_(**options)


_CALLS: dict[str, Callable[[Any], object]] = {
    "check a source": api.check,
    "check a change": lambda odd: api.check("6208-axial-1300", [odd]),
    "check changes": lambda odd: api.check("6208-axial-1300", odd),
    "quasistatic of a source": api.quasistatic,
    "run into a file": lambda odd: api.run("6208-axial-1300", ["solver.duration=0.1 ms"], out=odd),
    "a result": api.result,
    "resume": api.resume,
    "a duty cycle": api.duty,
    "what a study varies": lambda odd: api.study("6208-axial-1300", odd),
    "a fit": lambda odd: api.fit("6208-axial-1300", odd, ["loss_factor"]),
    "what a fit varies": lambda odd: api.fit("6208-axial-1300", "rig.csv", odd),
    "a bearing's speed": lambda odd: api.quasistatic("6208-axial-1300", {"operation.speed": odd}),
    "a machine's speed": lambda odd: _box(speed=odd).quasistatic(),
    "export": lambda odd: api.export_fmu("6208-axial-1300", odd),
    "thermal": api.thermal,
    "electric": api.electric,
    "modes": api.modes,
    "choose": lambda odd: api.choose(radial=odd, axial="1 kN", speed="1000 rpm", life="10000 h"),
}  # fmt: skip


def _called(name: str, odd: Any) -> None:
    """Make one call with exit code.

    0, 3 for an invalid case, 4 without a solution.

    A TypeError is Python's word for an argument of another type than the declared one.
    """
    code = 0
    try:
        _CALLS[name](odd)
    except (LambdaError, TypeError) as error:
        sys.stderr.write(f"{error}\n")
        code = 3 if isinstance(error, CaseError) else 4 if isinstance(error, SolverError) else 2
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)
