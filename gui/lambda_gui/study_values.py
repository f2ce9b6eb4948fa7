"""Convert the values of the study form into a study."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from lambda_core.api import FieldCard, Kind, field_card
from lambda_core.domain.option_tree import model_at
from lambda_gui.nodes import Keys

if TYPE_CHECKING:
    from pydantic import BaseModel

MODES = ("quasi-static", "dynamic")
# Responses of a bearing where none are written: the simulation and catalogues on one axis, losses, film, pressure
_OF_A_BEARING = (
    "friction_torque_Nmm",
    "skf/friction/total",
    "schaeffler/friction/total",
    "power_loss_W",
    "min_film_parameter",
    "max_pressure_GPa",
)
_OF_A_MACHINE = ("friction_torque_Nmm", "power_loss_W", "system_life_h", "max_deflection_um")
_OF_EACH = ("radial_load_N", "friction_torque_Nmm", "skf/friction/total", "min_film_parameter", "max_pressure_GPa")
POINTS = 11  # of a range without a number of its own
_NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*)")
Values = dict[Keys, Any]


def asked(bearings: Iterable[str]) -> tuple[str, ...]:
    """Return a study's default responses.

    The study is of one bearing or of a machine with these bearings.
    """
    names = list(bearings)
    if not names:
        return _OF_A_BEARING
    return (*_OF_A_MACHINE, *(f"{name}.{response}" for name in names for response in _OF_EACH))


def studied(root: type[BaseModel], paths: Iterable[str]) -> tuple[str, ...]:
    """Return the paths that a study can vary.

    They are numbers with or without unit, and names.

    Parameters
    ----------
    root : type of BaseModel
        The class of the case.
    paths : iterable of str
        Options that the case has.
    """
    kinds = ("quantity", "number", "integer", "choice", "signal", "text")
    texts = ("name", "description")
    return tuple(path for path in paths if path not in texts and card_of(root, path).kind in kinds)


def card_of(root: type[BaseModel], path: str) -> FieldCard:
    """Return the card of an option.

    It is that of a plain text where the case has none at this path.
    """
    *parents, name = path.split(".")
    table = model_at(root, [int(key) if key.isdecimal() else key for key in parents])
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
    """Return the contents of a new form.

    The option under the keyboard runs from half to twice its value.

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
    if path:
        values["0", "path"] = path
        match = _NUMBER.fullmatch(written)
        if match is not None and float(match[1]) > 0.0 and match[2] != "degC":
            number, unit = float(match[1]), match[2]
            values["0", "from"], values["0", "to"] = (f"{share * number:g} {unit}".strip() for share in (0.5, 2.0))
    return values


def study_tables(values: Values, usual: Iterable[str]) -> dict[str, Any]:
    """Return the study as in a file.

    It may be right or wrong.

    Parameters
    ----------
    values : dict
        Of the form.
    usual : iterable of str
        Responses where none are written.
    """
    responses = [name.strip() for name in str(values.get(("responses",)) or ", ".join(usual)).split(",")]
    mode = str(values.get(("mode",)) or MODES[0])
    study: dict[str, Any] = {
        "name": str(values.get(("name",)) or "study"),
        "case": "case.toml",
        "mode": mode,
        "responses": [name for name in responses if name],
        "parameters": [_parameter(values, number) for number in ("0", "1") if values.get((number, "path"))],
    }
    return study


def _parameter(values: Values, number: str) -> dict[str, Any]:
    path = str(values[number, "path"])
    found: dict[str, Any] = {"path": path}
    listed = str(values.get((number, "values")) or "")
    if listed:
        found["values"] = [_plain(part.strip()) for part in listed.split(",") if part.strip()]
    else:
        ends = [values.get((number, end)) for end in ("from", "to")]
        found |= {"range": [_plain(str(end)) for end in ends if end is not None], "points": _points(values, number)}
    found["label"] = path.rpartition(".")[2].replace("_", " ")
    return found


def _points(values: Values, number: str) -> Any:
    points = values.get((number, "points"))
    return POINTS if points is None else points


def _plain(text: str) -> Any:
    """Return a number without unit as a number."""
    match = _NUMBER.fullmatch(text)
    return float(match[1]) if match is not None and not match[2] else text
