"""Hostile inputs: a case that is right but for one value, a study, a command line.

Half of the values are of the right kind and unit, so that they get behind validation: tiny, huge, zero, negative.
"""

from __future__ import annotations

import json
import math
import random
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from lambda_core import api
from tests.attacks import draw

_EXPONENTS = (-30, 30)  # of a wild value in a unit that its option takes
_USUAL = (-4, 4)  # of one that is merely unusual
_NUMBERS = (0, -1, 1, 2, 1e-300, 1e300, 5e-324, 1.7976931348623157e308, math.inf, -math.inf, math.nan, 2**63, -(2**64))
_WORDS = (
    "", " ", "\x00", "\x1b[31m", "..", "/dev/null", "a" * 5000, "=cmd|'/c calc'!A1", "$\\frac{", "%s%n",
    "{0.__class__}", "\uff46\uff55\uff4c\uff4c", "\u202e", "6,000 rpm", "1e999 N", "nan N", "inf rpm", "-0 degC",
    "1 furlong", "1 N N", "0x10 N", "1_0 N",
)  # fmt: skip
_SIMPLE: tuple[Any, ...] = (None, True, [], {}, [[]], [1, "2"], {"kind": "ramp"}, {"kind": "sum", "terms": []})
_COMMANDS = ("check", "quasistatic", "run", "run", "compare")
_LIMITS = ("gt", "ge", "lt", "le", "minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum")
_RIGHT = 0.85  # share of hostile values of the right kind
_SHORT = "0.2 ms"  # of simulated time


@dataclass(frozen=True)
class Leaf:
    """An option of a case: where it is, and the units that it takes."""

    path: tuple[str, ...]
    units: tuple[str, ...]
    limits: dict[str, float]
    choices: tuple[str, ...]
    whole: bool  # an integer


@cache
def leaves() -> tuple[Leaf, ...]:
    """Return every option that the schema of cases knows, time functions as one."""
    schema = api.schema()
    return tuple(_walk(schema, schema["$defs"], (), 0))


def _walk(node: dict[str, Any], definitions: dict[str, Any], path: tuple[str, ...], depth: int) -> Iterator[Leaf]:
    if depth > 6:
        return
    variants = node.get("anyOf") or node.get("oneOf") or [node]
    for variant in variants:
        if "$ref" in variant:
            target = definitions[variant["$ref"].rsplit("/", 1)[1]]
            yield from _walk(target, definitions, path, depth + 1)
        elif "properties" in variant:
            for name, child in variant["properties"].items():
                yield from _walk(child, definitions, (*path, name), depth + 1)
        elif path and variant.get("type") != "null":
            limits = {key: variant[key] for key in _LIMITS if key in variant}
            whole = variant.get("type") == "integer"
            yield Leaf(path, tuple(variant.get("x-units", ())), limits, tuple(variant.get("enum", ())), whole)


def value(pick: random.Random, leaf: Leaf, allowed: bool) -> Any:
    """Return a value for an option: of the right kind and unit when `allowed`, otherwise anything."""
    if allowed and leaf.choices:
        return pick.choice(leaf.choices)
    if allowed:
        number = 10.0 ** pick.uniform(*(_EXPONENTS if pick.random() < 0.5 else _USUAL))
        lowest = max(leaf.limits.get(name, -math.inf) for name in ("gt", "ge", "minimum", "exclusiveMinimum"))
        highest = min(leaf.limits.get(name, math.inf) for name in ("lt", "le", "maximum", "exclusiveMaximum"))
        if lowest < 0.0 and pick.random() < 0.2:
            number = -number
        if not leaf.units and highest < math.inf:
            number = lowest + (highest - lowest) * pick.random() ** 4
        if leaf.whole:
            number = int(min(number, 2**62))
        return f"{number:.6g} {pick.choice(leaf.units)}" if leaf.units else number
    kind = pick.random()
    if kind < 0.4:
        return pick.choice(_WORDS)
    if kind < 0.8:
        number = pick.choice(_NUMBERS)
        return f"{number} {pick.choice(leaf.units)}" if leaf.units and pick.random() < 0.7 else number
    return pick.choice(_SIMPLE)


def case(pick: random.Random) -> dict[str, Any]:
    """Return a short case with one hostile value."""
    made = draw.case(pick.randrange(2**31))
    made["solver"] = {"duration": _SHORT}
    right = pick.random() < _RIGHT
    leaf = pick.choice([leaf for leaf in leaves() if not right or leaf.units or leaf.choices or leaf.limits])
    place = made
    for name in leaf.path[:-1]:
        inner = place.get(name)
        place[name] = inner if isinstance(inner, dict) else {}
        place = place[name]
    place[leaf.path[-1]] = value(pick, leaf, right)
    return made


def study(pick: random.Random) -> dict[str, Any]:
    """Return a study whose parameter, kind or response is hostile."""
    path = ".".join(pick.choice(leaves()).path)
    made: dict[str, Any] = {
        "name": "attack",
        "case": "6208-axial-1300",
        "kind": pick.choice(["quasistatic", "quasistatic", "dynamic", "", 7]),
        "parameters": {path: pick.choice([["1 N", "2 N"], [], {"from": "1 N", "to": "x"}, 5, {"values": [None]}])},
        "responses": pick.choice([["friction_torque_Nmm"], [], ["nothing"], "all"]),
    }
    if pick.random() < 0.5:
        made[pick.choice(["samples", "workers", "seed", "limit", "\x00"])] = pick.choice(_NUMBERS)
    return made


def written(made: dict[str, Any], file: Path, pick: random.Random) -> None:
    """Write a table as TOML, now and then damaged."""
    text = "\n".join(_toml(made))
    if pick.random() < 0.05:
        at = pick.randrange(len(text))
        text = text[:at] + pick.choice(['"', "\x00", "[[", "]" * 500, "=", "\n[a.b.c]\n"]) + text[at:]
    if pick.random() < 0.01:
        text += "\nx = " + "[" * 3000 + "]" * 3000
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8", errors="surrogateescape")


def _toml(made: dict[str, Any]) -> Iterator[str]:
    for key, content in made.items():
        yield f"{_key(key)} = {_inline(content)}"


def _key(text: str) -> str:
    return json.dumps(text, ensure_ascii=True)


def _inline(content: Any) -> str:
    """Return a value as TOML; what TOML has no word for is left to the reader to refuse."""
    if isinstance(content, dict):
        return "{" + ", ".join(f"{_key(key)} = {_inline(inner)}" for key, inner in content.items()) + "}"
    if isinstance(content, list):
        return "[" + ", ".join(_inline(inner) for inner in content) + "]"
    if isinstance(content, str):
        return json.dumps(content, ensure_ascii=True)
    if isinstance(content, bool):
        return str(content).lower()
    return "null" if content is None else repr(content)


def command(pick: random.Random) -> list[str]:
    """Return a command line that makes no sense, or nearly one."""
    words = [
        "run", "check", "show", "view", "report", "resume", "study", "db", "plugins", "cite", "compare", "animate",
        "init", "schema", "quasistatic", "search", "list", "status", "--json", "--set", "--out", "--force", "--limit",
        "loads.radial=1 N", "6208-axial-1300", "nothing.h5", "99999999999999999999", "-1", "--help", "", "a=b=c", "--x",
        "solver.duration=0.1 ms", "x" * 300, "/dev/zero", "/dev/null", ".", "--no-plugin", "lambda_db", "name\x1b[0m",
    ]  # fmt: skip
    return [pick.choice(words) for _ in range(pick.randrange(1, 6))]


def attack(seed: int, folder: Path) -> list[str]:
    """Write the input of one attack into a folder and return the command line that meets it."""
    pick = random.Random(seed)
    kind = pick.random()
    if kind < 0.8:
        written(case(pick), folder / "case.toml", pick)
        chosen = pick.choice(_COMMANDS)
        more = ["--out", "out.h5"] if chosen == "run" else []
        return [chosen, "case.toml", *more, *pick.choice([[], ["--json"]])]
    if kind < 0.9:
        written(study(pick), folder / "study.toml", pick)
        return ["study", pick.choice(["check", "run"]), "study.toml", *pick.choice([[], ["--dry-run"]])]
    folder.mkdir(parents=True, exist_ok=True)
    return command(pick)
