"""Draw hostile options and files of commands that ask questions.

Choosing a bearing, measured series, fits and FMUs. Most options are right but for one.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tests.attacks import hostile as of_one
from tests.attacks.damage import Said, line
from tests.attacks.hostile import Leaf
from tests.attacks.machines import changed, machines, spoilt
from tests.attacks.trial import attempt
from tests.attacks.written import toml

_LIMIT = 120.0  # [s] of wall time of a trial
_POINTS = (
    "speed [1/min],radial load [kN],oil temperature [degC],friction torque [N mm],friction torque error [%]\n"
    "1000,1,60,100,2\n2000,2,60,180,2\n3000,3,70,220,2\n"
)
_SERIES: dict[str, Any] = {
    "title": "a rig",
    "source": "own",
    "licence": "own",
    "how_read": "a torque meter",
    "uncertainty": "2 %",
    "case": {
        "bearing": {"designation": "SKF 6208"},
        "lubricant": {"name": "mineral-vg68", "temperature": "60 degC"},
        "loads": {"radial": "1 kN"},
        "operation": {"speed": "1000 rpm"},
    },
}
_CHOICE = {
    "--radial": "5 kN", "--axial": "1 kN", "--speed": "3000 rpm", "--life": "20000 h", "--bore": "40 mm",
    "--outside": "90 mm", "--kind": "deep groove", "--maker": "SKF", "--oil": "mineral-vg68",
    "--temperature": "70 degC", "--contamination": "normal cleanliness", "--static-safety": "1", "--limit": "5",
}  # fmt: skip
_QUANTITIES = {
    "--radial": "N", "--axial": "N", "--speed": "rpm", "--life": "h", "--bore": "mm", "--outside": "mm",
    "--temperature": "degC",
}  # fmt: skip
_NEEDED = ("--radial", "--speed", "--life")
_VARIED = ("loss_factor", "mu", "tau_eyring=1 MPa..9 MPa", "lubricant.temperature", "clearance=1 um..30 um", "x", "")
_MORE = ((), ("--json",), ("--out", "f.toml"), ("--sample", "8"), ("--predict", "rig.csv"))
_EXPORTED = {"--fmi": ("1", "2", "3"), "--couple": ("force", "motion", "x"), "--platform": ("linux", "vax")}


def question(seed: int, number: int, folder: Path) -> Said:
    """Ask with one hostile option or a hostile file."""
    pick = random.Random(seed * 1_000_003 + number)
    kind = pick.choice(tuple(_ASKED))
    arguments = _ASKED[kind](pick, folder)
    data = {"LAMBDA_BEARING_DATA": str(folder / "data")}
    outcome = attempt(arguments, folder, _LIMIT, data)
    return outcome, line(arguments), {"kind": kind}


def _choose(pick: random.Random, folder: Path) -> tuple[str, ...]:
    given = {name: text for name, text in _CHOICE.items() if name in _NEEDED or pick.random() < 0.3}
    odd = pick.choice(tuple(_CHOICE))
    unit = _QUANTITIES.get(odd, "")
    given[odd] = str(of_one.value(pick, Leaf((odd,), (unit,)), bool(unit) and pick.random() < 0.7))
    words = [word for pair in given.items() for word in pair]
    return ("db", "choose", *words, *pick.choice([(), ("--json",), ("--units", "us")]))


def _series(pick: random.Random, folder: Path) -> tuple[str, ...]:
    described = changed(_SERIES, pick) if pick.random() < 0.6 else _SERIES
    points = _POINTS.encode() if described is not _SERIES else spoilt(_POINTS, pick)
    (folder / "rig.toml").write_text(toml(described), encoding="utf-8", errors="surrogateescape")
    (folder / "rig.csv").write_bytes(points)
    return pick.choice([("measured", "add", "rig.toml"), ("measured", "compare", "rig.toml", "--band", "none")])


def _fit(pick: random.Random, folder: Path) -> tuple[str, ...]:
    (folder / "rig.csv").write_bytes(_POINTS.encode() if pick.random() < 0.5 else spoilt(_POINTS, pick))
    varied = [word for name in pick.sample(_VARIED, pick.choice((1, 1, 2))) for word in ("--vary", name)]
    source = "6208-axial-1300"
    more: tuple[str, ...] = pick.choice(
        [(), ("--json",), ("--out", "f.toml"), ("--sample", "8"), ("--predict", "rig.csv")]
    )
    if pick.random() < 0.3:
        (folder / "box.toml").write_text(toml(machines()[0]), encoding="utf-8")
        source, more = "box.toml", (*more, "--bearing", pick.choice(("left", "right", "x", "")))
    return ("fit", source, "rig.csv", *varied, *more, "--workers", "1")


def _export(pick: random.Random, folder: Path) -> tuple[str, ...]:
    """Ask for an FMU that needs no compiling."""
    name = pick.choice(tuple(_EXPORTED))
    odd = pick.choice((("--vary", str(of_one.value(pick, Leaf(("x",)), False))), ("--set", "loads.radial=x"), ("--x",)))
    return ("export", "fmu", "6208-axial-1300", name, pick.choice(_EXPORTED[name]), *odd, "--out", "out.fmu")


_ASKED: dict[str, Callable[[random.Random, Path], tuple[str, ...]]] = {
    "choose": _choose, "series": _series, "fit": _fit, "export": _export,
}  # fmt: skip
