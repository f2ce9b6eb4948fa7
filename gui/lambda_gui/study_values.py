"""Convert the values of the study form into a study."""

from __future__ import annotations

import re
from functools import cache
from typing import Any

from lambda_core.api import Case, FieldCard, Kind, field_card
from lambda_core.domain.option_tree import field_at, model_at, option_paths
from lambda_gui.nodes import Keys

MODES = ("quasi-static", "dynamic")
# What is asked where nothing else is: the simulation, catalogues beside it on one axis, film, pressure, life.
ASKED = (
    "friction_torque_Nmm",
    "skf/friction/total",
    "schaeffler/friction/total",
    "power_loss_W",
    "min_film_parameter",
    "max_pressure_GPa",
)
POINTS = 11  # of a range where none are said
_NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*)")
Values = dict[Keys, Any]


@cache
def studied() -> tuple[str, ...]:
    """Return the paths of the options that a study can vary: numbers with or without unit, and names."""
    kinds = ("quantity", "number", "integer", "choice", "signal", "text")
    texts = ("name", "description")
    return tuple(path for path in option_paths(Case) if path not in texts and card_of(path).kind in kinds)


def card_of(path: str) -> FieldCard:
    """Return the card of an option of the case; of a plain text where there is none at this path."""
    *parents, name = path.split(".")
    table = model_at(Case, parents)
    if table is None or name not in table.model_fields:
        return card("value", "")
    return field_card(table, name)


def card(
    name: str, description: str, *, choices: tuple[str, ...] = (), kind: Kind = "text", default: str = ""
) -> FieldCard:
    """Return the card of one row of the form."""
    return FieldCard(
        name=name,
        description=description,
        default=default,
        required=False,
        quantity="",
        units=[],
        limits=[],
        kind="choice" if choices else kind,
        choices=list(choices),
        reference="",
    )


def first_values(case: str, path: str, written: str) -> Values:
    """Return what a new form holds: the option under the keyboard from half to twice what it is.

    Parameters
    ----------
    case : str
        Name of the case.
    path : str
        Option that varies first, "" where none was meant.
    written : str
        Its value now, "" where there is none.
    """
    values: Values = {("name",): f"{case}-{path.rpartition('.')[2] or 'study'}".replace("_", "-")}
    if path in studied():
        values["0", "path"] = path
        match = _NUMBER.fullmatch(written)
        if match is not None and float(match[1]) > 0.0 and match[2] != "degC":
            number, unit = float(match[1]), match[2]
            values["0", "from"], values["0", "to"] = (f"{share * number:g} {unit}".strip() for share in (0.5, 2.0))
    return values


def study_tables(values: Values) -> dict[str, Any]:
    """Return the study as it would stand in a file; what is missing or wrong is for its check to say."""
    asked = [name.strip() for name in str(values.get(("responses",)) or ", ".join(ASKED)).split(",")]
    mode = str(values.get(("mode",)) or MODES[0])
    study: dict[str, Any] = {
        "name": str(values.get(("name",)) or "study"),
        "case": "case.toml",
        "mode": mode,
        "responses": [name for name in asked if name],
        "parameters": [_parameter(values, number) for number in ("0", "1") if values.get((number, "path"))],
    }
    return study


def _parameter(values: Values, number: str) -> dict[str, Any]:
    path = str(values[number, "path"])
    info = field_at(Case, path)
    found: dict[str, Any] = {"path": path}
    listed = str(values.get((number, "values")) or "")
    if listed:
        found["values"] = [_plain(part.strip()) for part in listed.split(",") if part.strip()]
    else:
        ends = [values.get((number, end)) for end in ("from", "to")]
        found |= {"range": [_plain(str(end)) for end in ends if end is not None], "points": _points(values, number)}
    if info is not None:
        found["label"] = path.rpartition(".")[2].replace("_", " ")
    return found


def _points(values: Values, number: str) -> Any:
    points = values.get((number, "points"))
    return POINTS if points is None else points


def _plain(text: str) -> Any:
    """Return a number without unit as a number."""
    match = _NUMBER.fullmatch(text)
    return float(match[1]) if match is not None and not match[2] else text
