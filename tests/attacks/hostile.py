"""Draw hostile cases, studies and command lines.

Most values are of the right kind and unit, so that they get behind validation: tiny, huge, or merely unusual. What an
option also needs (the kind and the other values of a time function, the rest of a material) is filled in with
usual values, so that the one hostile value decides.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from lambda_core import api
from lambda_core.domain.errors import LambdaError
from tests.attacks import draw
from tests.attacks.written import toml

_EXPONENTS = (-30, 30)  # of a wild value in a unit that its option takes
_USUAL = (-4, 4)  # of one that is merely unusual
_NUMBERS = (0, -1, 1, 2, 1e-300, 1e300, 5e-324, 1.7976931348623157e308, math.inf, -math.inf, math.nan, 2**63, -(2**64))
_WORDS = (
    "", " ", "\x00", "\x1b[31m", "..", "/dev/null", "a" * 5000, "=cmd|'/c calc'!A1", "$\\frac{", "%s%n",
    "{0.__class__}", "\uff46\uff55\uff4c\uff4c", "\u202e", "6,000 rpm", "1e999 N", "nan N", "inf rpm", "-0 degC",
    "1 furlong", "1 N N", "0x10 N", "1_0 N",
)  # fmt: skip
_SIMPLE: tuple[Any, ...] = (None, True, [], {}, [[]], [1, "2"], {"kind": "ramp"}, {"kind": "sum", "terms": []})
# Commands that compute, and how often: runs take longest.
_COMPUTING = ("quasistatic",) * 15 + ("run",) * 4 + ("compare",)
_BANDED = ("quasistatic", "run")  # commands with a model band, which costs more than all else
_BAND = 0.2  # share of them that compute it
_LIMITS = ("gt", "ge", "lt", "le", "minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum")
_RIGHT = 0.88  # share of hostile values of the right kind
_WILD = 0.4  # share of those that lie anywhere between the largest and the smallest exponents
_NEGATIVE = 0.08
_SHORT = "0.2 ms"  # of simulated time
_AT_MOST = "2 s"  # of wall time
_BASES = 150  # cases that hostile values are put into
_SEED_OF_BASES = 7
# Options that seldom fit the rest of a case: they are hit less often.
_SELDOM = (
    ("bearing", "geometry"), ("lubricant", "properties"), ("forces", "ball_ball"), ("parameters", "cage_contact"),
    ("models", "cage_contact"), ("loads", "outer_ring"),
)  # fmt: skip
# Sections that decide what is computed, and how much likelier than the others they are hit.
_DECIDE = {"bearing": 2, "loads": 2, "operation": 2, "lubricant": 6, "bodies": 3, "parameters": 4, "solver": 6,
           "depth": 4, "surface": 6, "materials": 3, "output": 6, "gravity": 4}  # fmt: skip
_KIND = "kind"  # what tells time functions apart
Path_ = tuple[str, ...]


@dataclass(frozen=True)
class Leaf:
    """Option of a case.

    Its place, its units, and the options that it requires.
    """

    path: Path_
    units: tuple[str, ...] = ()
    limits: tuple[tuple[str, float], ...] = ()
    choices: tuple[str, ...] = ()
    integer: bool = False  # an integer
    needs: tuple[tuple[Path_, Any], ...] = ()

    @property
    def can_be_right(self) -> bool:
        """True if the schema describes right values."""
        return bool(self.units or self.choices or self.limits)


@cache
def leaves() -> tuple[Leaf, ...]:
    """Return every option of cases.

    Those of the schema, every kind of time function, every parameter of a law.
    """
    schema = api.schema()
    return (*_walk(schema["$defs"]["Case"], schema["$defs"], (), (), 0), *_of_laws())


def _walk(
    node: dict[str, Any], definitions: dict[str, Any], path: Path_, needs: tuple[tuple[Path_, Any], ...], depth: int
) -> Iterator[Leaf]:
    if depth > 6:
        return
    if path[-1:] == ("motion",):
        needs = (*needs, ((*path[:-1], "mode"), "prescribed"))
    for variant in _variants(node, definitions):
        if "properties" in variant:
            required = [name for name in variant.get("required", ()) if path]
            usual = {name: _usual(variant["properties"][name], definitions) for name in required}
            for name, child in variant["properties"].items():
                if "const" in child:
                    continue
                neighbour = tuple(((*path, other), value) for other, value in usual.items() if other != name)
                yield from _walk(child, definitions, (*path, name), needs + neighbour, depth + 1)
        elif path and variant.get("type") != "null":
            yield _leaf(variant, path, needs)


def _variants(node: dict[str, Any], definitions: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield what may stand in one place, references followed."""
    for variant in node.get("anyOf") or node.get("oneOf") or [node]:
        if "$ref" in variant:
            variant = definitions[variant["$ref"].rsplit("/", 1)[1]]
        if "anyOf" in variant or "oneOf" in variant:
            yield from _variants(variant, definitions)
        else:
            yield variant


def _leaf(node: dict[str, Any], path: Path_, needs: tuple[tuple[Path_, Any], ...] = ()) -> Leaf:
    limits = tuple((key, float(node[key])) for key in _LIMITS if key in node)
    integer = node.get("type") == "integer"
    return Leaf(path, tuple(node.get("x-units", ())), limits, tuple(node.get("enum", ())), integer, needs)


def _usual(node: dict[str, Any], definitions: dict[str, Any]) -> Any:
    """Return a harmless value for what an option also requires."""
    first = next(_variants(node, definitions))
    if "const" in first:
        return first["const"]
    if first.get("enum"):
        return first["enum"][0]
    return f"1 {first['x-units'][0]}" if first.get("x-units") else 0.3


def _of_laws() -> Iterator[Leaf]:
    """Yield the parameters of every law.

    With the choice of that law.
    """
    models = api.registry()
    for role, names in draw.stock().laws.items():
        for name in names:
            schema = models.model(role, name).parameters.model_json_schema()
            if schema.get("required"):  # data of an oil, which most oils lack
                continue
            for parameter, node in schema.get("properties", {}).items():
                made = _leaf(node, ("parameters", role, parameter), ((("models", role), name),))
                yield made if made.can_be_right else Leaf(made.path, ("",), needs=made.needs)


def value(pick: random.Random, leaf: Leaf, allowed: bool) -> Any:
    """Return a value for an option.

    Of the right kind and unit when `allowed`, otherwise anything.
    """
    if allowed and leaf.choices:
        return pick.choice(leaf.choices)
    if allowed:
        return _extreme(pick, leaf)
    kind = pick.random()
    if kind < 0.4:
        return pick.choice(_WORDS)
    if kind < 0.8:
        number = pick.choice(_NUMBERS)
        return f"{number} {pick.choice(leaf.units)}" if leaf.units and pick.random() < 0.7 else number
    return pick.choice(_SIMPLE)


def _extreme(pick: random.Random, leaf: Leaf) -> Any:
    """Return an unusual number of the kind.

    It is within the limits that the schema gives.
    """
    limits = dict(leaf.limits)
    number = 10.0 ** pick.uniform(*(_EXPONENTS if pick.random() < _WILD else _USUAL))
    lowest = max(limits.get(name, -math.inf) for name in ("gt", "ge", "minimum", "exclusiveMinimum"))
    highest = min(limits.get(name, math.inf) for name in ("lt", "le", "maximum", "exclusiveMaximum"))
    if lowest < 0.0 and pick.random() < _NEGATIVE:
        number = -number
    if not leaf.units and highest < math.inf:
        number = lowest + (highest - lowest) * pick.random() ** 4 if lowest > -math.inf else highest - number
    if leaf.integer:
        return int(min(number, 2**62))
    return f"{number:.6g} {pick.choice(leaf.units)}".strip() if leaf.units else number


@cache
def base(number: int) -> dict[str, Any]:
    """Return one of the valid cases.

    They are of many bearings, oils and laws.
    """
    seed = (_SEED_OF_BASES * 1000 + number) * 1000
    while True:
        seed += 1
        made = draw.case(seed)
        try:
            api.check(made)
        except LambdaError:
            continue
        return made


@cache
def _weights(right: bool) -> tuple[tuple[Leaf, ...], tuple[float, ...]]:
    """Return the options with their weights.

    Time functions, which are many, count as a few.
    """
    chosen = tuple(leaf for leaf in leaves() if not right or leaf.can_be_right)
    return chosen, tuple(_weight(leaf) for leaf in chosen)


def _weight(leaf: Leaf) -> float:
    weight = float(_DECIDE.get(leaf.path[0], 1))
    if _is_in_function(leaf):
        weight *= 0.2
    if leaf.path[:2] in _SELDOM or leaf.path[-1] == "mode":
        weight *= 0.2
    return weight


def _is_in_function(leaf: Leaf) -> bool:
    return any(path[-1] == _KIND for path, _ in leaf.needs)


def case(pick: random.Random) -> dict[str, Any]:
    """Return a short case with one hostile value."""
    made = {**base(pick.randrange(_BASES)), "solver": {"duration": _SHORT, "max_wall": _AT_MOST}}
    right = pick.random() < _RIGHT
    leaf = pick.choices(*_weights(right))[0]
    if _is_in_function(leaf):
        place, name = _place(made, leaf.path[:-1])
        place[name] = {}
    for path, usual in leaf.needs:
        place, name = _place(made, path)
        if path[0] == "models" or name not in place:
            place[name] = usual
    place, name = _place(made, leaf.path)
    place[name] = value(pick, leaf, right)
    return made


def _place(made: dict[str, Any], path: Path_) -> tuple[dict[str, Any], str]:
    """Return an option's table and name.

    The table is made where it is missing.
    """
    place = made
    for name in path[:-1]:
        inner = place.get(name)
        place[name] = dict(inner) if isinstance(inner, dict) else {}
        place = place[name]
    return place, path[-1]


def study(pick: random.Random) -> dict[str, Any]:
    """Return a study with hostile values.

    Half of them are right but for one value.
    """
    leaf = pick.choices(*_weights(True))[0]
    right = pick.random() < 0.6
    parameter: dict[str, Any] = {"path": ".".join(leaf.path)}
    if right:
        parameter["values"] = [value(pick, leaf, True) for _ in range(pick.choice((1, 2)))]
    else:
        parameter |= pick.choice([{}, {"values": []}, {"range": ["1 N", "x"]}, {"values": [None]}, {"range": 5}])
    made: dict[str, Any] = {
        "name": "attack",
        "case": "6208-axial-1300",
        "mode": "quasi-static" if right else pick.choice(["quasi-static", "dynamic", "", 7]),
        "parameters": [parameter],
        "responses": ["friction_torque_Nmm"] if right else pick.choice([[], ["nothing"], "all"]),
    }
    if not right and pick.random() < 0.5:
        made[pick.choice(["max_points", "design", "optimise", "\x00"])] = pick.choice(_NUMBERS)
    return made


def damaged(text: str, pick: random.Random) -> str:
    """Return a document, now and then damaged."""
    if pick.random() < 0.03:
        at = pick.randrange(len(text))
        text = text[:at] + pick.choice(['"', "\x00", "[[", "]" * 500, "=", "\n[a.b.c]\n"]) + text[at:]
    if pick.random() < 0.005:
        text += "\nx = " + "[" * 3000 + "]" * 3000
    return text


def command(pick: random.Random) -> list[str]:
    """Return a senseless command line.

    Or nearly one.
    """
    words = [
        "run", "check", "show", "view", "report", "resume", "study", "db", "plugins", "cite", "compare", "animate",
        "init", "schema", "quasistatic", "search", "list", "status", "--json", "--set", "--out", "--force", "--limit",
        "loads.radial=1 N", "6208-axial-1300", "nothing.h5", "99999999999999999999", "-1", "--help", "", "a=b=c", "--x",
        "solver.duration=0.1 ms", "x" * 300, "/dev/zero", "/dev/null", ".", "--no-plugin", "lambda_db", "name\x1b[0m",
        "thermal", "electric", "electric-film", "cross-check", "--max-wall", "1 s", "--duration",
    ]  # fmt: skip
    first = pick.choice(words[:14]) if pick.random() < 0.7 else pick.choice(words)
    return [first, *(pick.choice(words) for _ in range(pick.randrange(0, 5)))]


def attack(seed: int, folder: Path) -> tuple[list[str], bool]:
    """Write the input of one attack into a folder.

    Returns
    -------
    arguments : list of str
        The command line that meets the input.
    computes : bool
        Whether that command computes with it, so that what is accepted has got behind validation.
    """
    pick = random.Random(seed)
    kind = pick.random()
    if kind < 0.93:
        (folder / "case.toml").write_text(damaged(toml(case(pick)), pick), encoding="utf-8", errors="surrogateescape")
        chosen = "check" if pick.random() < 0.03 else pick.choice(_COMPUTING)
        more = ["--out", "out.h5"] if chosen == "run" else []
        more += pick.choice([[], ["--json"]])
        return [chosen, "case.toml", *more, *without_band(pick, chosen)], chosen != "check"
    if kind < 0.945:
        (folder / "study.toml").write_text(damaged(toml(study(pick)), pick), encoding="utf-8", errors="surrogateescape")
        return ["study", "run", "study.toml", "--workers", "1"], True
    return command(pick), False


def without_band(pick: random.Random, command: str) -> list[str]:
    """Return the option that skips the model band, mostly."""
    return ["--band", "none"] if command in _BANDED and pick.random() > _BAND else []
