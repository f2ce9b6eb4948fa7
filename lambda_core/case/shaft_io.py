"""Reading the file of a shaft: TOML in, every mistake of the tables at once."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from lambda_core.case.case import NAME_PATTERN
from lambda_core.case.salvage import SHARED_STAND_INS, InvalidCase, StandIns, invalid_case
from lambda_core.case.shaft import NAMED, TAKEN, ShaftCase
from lambda_core.case.shaft_parts import length_in
from lambda_core.domain.errors import CaseError, Problem

STAND_IN = "stand-in"  # a bearing where no other is left
_PIECES = [{"length": "1 m", "diameter": "40 mm"}]
_STAND_INS: StandIns = {
    **SHARED_STAND_INS,
    ("shaft",): {"sections": _PIECES},
    ("shaft", "sections"): _PIECES,
    ("bearings",): {STAND_IN: {"at": "0 mm"}},
}


def validate_shaft(data: Mapping[str, Any], source: str = "shaft", folder: Path | None = None) -> ShaftCase:
    """Check plain tables as the case of a shaft; InvalidCase with every mistake of them, and what is left."""
    if "bearing" in data and "bearings" not in data:
        raise CaseError(
            source, [Problem("bearing", f"is one bearing, not a shaft: lambda-bearing quasistatic {source}")]
        )
    found = _names(data)
    try:
        case = ShaftCase.model_validate(data, context={"folder": folder})
    except ValidationError as error:
        wrong = invalid_case(source, error, data, folder, ShaftCase, _STAND_INS)
        raise InvalidCase(source, [*wrong.problems, *found], wrong.remainder) from None
    if found:
        raise InvalidCase(source, found, case)
    return case


def _names(data: Mapping[str, Any]) -> list[Problem]:
    """Return what is wrong with the names of named parts, each at its own path."""
    found = []
    for table in NAMED:
        parts = data.get(table)
        for name in parts if isinstance(parts, Mapping) else ():
            if not re.match(NAME_PATTERN, str(name)):
                found.append(Problem(f"{table}.{name}", "use letters, digits, dot, dash and underscore in names"))
            elif table == "markers" and length_in(str(name)) is not None:
                found.append(Problem(f"{table}.{name}", "reads as a length: choose a name that does not"))
            elif name in TAKEN.get(table, ()):
                found.append(Problem(f"{table}.{name}", f'"{name}" is there already: choose another name'))
    return found
