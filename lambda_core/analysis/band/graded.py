"""Collect the ranges of a case's parameters.

A range is published with the law, that of the clearance class, or usual for an option.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from importlib.resources import files
from typing import TYPE_CHECKING, Any

from pydantic import ValidationError

from lambda_core.case.option import quantity_of
from lambda_core.domain.elements import RIBS
from lambda_core.domain.errors import UsageError, nearest
from lambda_core.domain.units import UNITS, from_si, parse
from lambda_core.domain.written_values import Scale, scale_of

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.case.thermal import Thermal
    from lambda_core.model.bearing_model import BearingModel

_FILE = "graded_ranges.toml"
Resolver = Callable[["Case"], "BearingModel"]
_BETWEEN = ".."
CLEARANCE = "bearing.clearance"


@dataclass(frozen=True)
class Graded:
    """A parameter of a case with its range.

    Attributes
    ----------
    path : str
        Option of the case.
    value : float
        Value in the case, NaN where the law computes it.
    low, high : float
        Ends of the range.
    scale : Scale
        Unit of the three.
    source, grade : str
        Where the range comes from; "published", "assumed", "given" for one of the user.
    law : str
        Law that the parameter belongs to, for a parameter of a law.
    models : tuple of BearingModel
        At the two ends, where the case had to be resolved to find them.
    """

    path: str
    value: float
    low: float
    high: float
    scale: Scale
    source: str
    grade: str
    law: str = ""
    models: tuple[BearingModel, ...] = ()

    @property
    def short(self) -> str:
        """Name for tables."""
        return self.path.removeprefix("bearings.").replace("parameters.", "")

    def written(self, number: float) -> str | float:
        """Return a value as it stands in a case."""
        return self.scale.text(number) if self.scale.unit else number

    def si(self, number: float) -> float:
        """Return a value in SI."""
        if not self.scale.unit:
            return number
        quantity = next(name for name, units in UNITS.items() if self.scale.unit in units)
        return parse(self.scale.text(number), quantity)

    def changes(self, number: float) -> tuple[str, ...]:
        """Return the changes of the case that set a value.

        They keep the law that it belongs to.
        """
        value = f"{self.path}={self.scale.text(number)}"
        if not self.law:
            return (value,)
        before, _, rest = self.path.rpartition("parameters.")  # of a bearing of a machine: bearings.NAME.
        return (f"{before}models.{rest.split('.')[0]}={self.law}", value)

    def example(self) -> str:
        """Return how a range is given."""
        return f'{self.path}="{_example(self)}"'


@dataclass(frozen=True)
class Exchange:
    """Laws of a role that published work cannot rank."""

    role: str
    laws: tuple[str, ...]
    source: str


@dataclass(frozen=True)
class NetworkRange:
    """A range of an option of the thermal network.

    Published sets may replace the range.

    Attributes
    ----------
    option : str
        Of the section `thermal`.
    ends : tuple
        Both ends of the range in SI, shares of the value that is filled in, or the other sets.
    source : str
        Where they come from.
    is_range, is_share : bool
        Whether the ends are those of a range, and whether they are shares.
    """

    option: str
    ends: tuple[float | str, ...]
    source: str
    is_range: bool = True
    is_share: bool = False

    def values(self, usual: float) -> list[float | str]:
        """Return the values of the option.

        Shares are those of the value that is filled in.
        """
        return [end * usual if self.is_share and not isinstance(end, str) else end for end in self.ends]


def network_ranges(section: Thermal) -> list[NetworkRange]:
    """Return the ranges of a thermal network.

    They belong to options that its section leaves open. Also return the sets that may replace its own.
    """
    found: list[NetworkRange] = []
    if section.conductances not in _with_housing():
        return found
    for row in _data()["network"]:
        option, source = row["option"], row["source"]
        if option in section.model_fields_set or (option == "emissivity" and section.conductances != "harris"):
            continue
        if "low_share" in row:
            found.append(NetworkRange(option, (row["low_share"], row["high_share"]), source, is_share=True))
            continue
        quantity = quantity_of(type(section), option)
        ends = tuple(parse(row[end], quantity) if quantity else float(row[end]) for end in ("low", "high"))
        found.append(NetworkRange(option, ends, source))
    for row in _data()["network_exchange"]:
        others = tuple(name for name in row["sets"] if name != section.conductances)
        found.append(NetworkRange(row["option"], others, row["source"], is_range=False))
    return found


def _with_housing() -> list[str]:
    """Return the sets of conductances that know a housing."""
    return [name for row in _data()["network_exchange"] for name in row["sets"]]


@cache
def _data() -> Mapping[str, list[dict[str, Any]]]:
    return tomllib.loads(files(__package__).joinpath(_FILE).read_text(encoding="utf-8"))


def exchanges(model: BearingModel) -> list[Exchange]:
    """Return the laws that may replace those of a model.

    The model's own laws and those of ribs are left out.
    """
    laws = [roles for element, roles in model.laws.items() if element not in RIBS]
    chosen = {role: law.model.name for roles in laws for role, law in roles.items()}
    found = []
    for entry in _data()["exchange"]:
        role = entry["role"]
        if chosen.get(role) in entry["laws"]:
            others = tuple(name for name in entry["laws"] if name != chosen[role])
            found.append(Exchange(role, others, entry["source"]))
    return found


def graded_parameters(model: BearingModel, resolver: Resolver | None = None) -> list[Graded]:
    """Return every parameter of a model that has a range."""
    of_laws = (_within_class(entry, model.oil.base_type) for entry in _of_laws(model, is_ranged=True))
    return [*(entry for entry in of_laws if entry is not None), *_of_options(model), *_of_clearance(model, resolver)]


def varied(model: BearingModel, specification: str) -> Graded:
    """Return the parameter that ``PATH`` or ``PATH=LOW..HIGH`` names.

    The path may be shortened to its end ("loss_factor") where that names one parameter only.

    Raises
    ------
    UsageError
        When no parameter or several have the name, or it has no range and none is given.
    """
    name, equals, ends = specification.partition("=")
    found, is_ranged = _named(model, name.strip())
    if equals:
        given = given_range(found, ends)
        _refuse_outside(model, given)
        return given
    if not is_ranged:
        raise UsageError(f"--vary: {found.path} has no published range: give one, for example {found.example()}")
    return found


def named(model: BearingModel, path: str, unit: str) -> Graded:
    """Return the parameter at a path, in a unit.

    It may have no range; an unknown path raises a UsageError.
    """
    found = _named(model, path)[0]
    both = (name for name, units in UNITS.items() if {found.scale.unit, unit} <= units.keys())
    quantity = next(both, "") if found.scale.unit != unit else ""
    value = from_si(found.si(found.value), quantity, unit) if quantity else found.value
    return replace(found, value=value, scale=Scale(unit))


def _named(model: BearingModel, name: str) -> tuple[Graded, bool]:
    """Return a named parameter, and whether it has a range."""
    ranged = {entry.path: entry for entry in graded_parameters(model)}
    if name in ranged:
        return ranged[name], True
    every = {entry.path: entry for entry in _of_laws(model, is_ranged=False)} | ranged | _plain(model, name)
    matching = [path for path in every if path == name or path.endswith(f".{name}")]
    if not matching:
        last = {path.rpartition(".")[2]: path for path in every}
        close = [last.get(word, word) for word in nearest(name, [*last, *every])]
        known = f"nearest: {', '.join(dict.fromkeys(close))}" if close else f"with a range: {', '.join(ranged)}"
        raise UsageError(f'--vary: "{name}" is not a known parameter of this case; {known}')
    if len(matching) > 1:
        raise UsageError(f'--vary: "{name}" names several parameters: write {" or ".join(sorted(matching))}')
    return every[matching[0]], matching[0] in ranged


def _refuse_outside(model: BearingModel, given: Graded) -> None:
    """Refuse a range with an end that the law refuses.

    A fit tries values between both ends.
    """
    if not given.law:
        return
    _, role, name = given.path.split(".")
    law = next(roles[role] for roles in model.laws.values() if role in roles and roles[role].model.name == given.law)
    written = law.parameters.model_dump(mode="json")
    for end in (given.low, given.high):
        try:
            type(law.parameters).model_validate(written | {name: given.written(end)})
        except ValidationError as error:
            why = error.errors()[0]["msg"].removeprefix("Value error, ").removeprefix("Input ")
            raise UsageError(f"--vary {given.path}: {given.scale.text(end)} {why}: give a smaller range") from None


def _example(entry: Graded) -> str:
    middle = entry.value if math.isfinite(entry.value) and entry.value else 1.0
    return f"{entry.scale.text(0.5 * middle)}{_BETWEEN}{entry.scale.text(2.0 * middle)}"


def given_range(entry: Graded, ends: str) -> Graded:
    """Return a parameter with a range of the user."""
    low, between, high = ends.partition(_BETWEEN)
    wrong = UsageError(f'--vary {entry.path}: "{ends}" is not a range: write LOW..HIGH, for example {_example(entry)}')
    if not between:
        raise wrong
    texts = [_number(low.strip()), _number(high.strip())]
    if entry.scale.unit and all(isinstance(text, float) for text in texts):
        raise UsageError(f'--vary {entry.path}: "{ends}" has no unit: write {_example(entry)}')
    own = entry.scale.text(entry.value) if math.isfinite(entry.value) else None
    try:
        read = scale_of([*texts] if own is None else [*texts, own if entry.scale.unit else entry.value])
    except ValueError as error:
        raise UsageError(f"--vary {entry.path}: {error}") from None
    if read is None or not read[1][0] < read[1][1]:
        raise wrong
    scale, numbers = read
    value = numbers[2] if own is not None else math.nan
    return Graded(entry.path, value, numbers[0], numbers[1], scale, "given on the command line", "given", entry.law)


def _number(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text


def _of_laws(model: BearingModel, *, is_ranged: bool) -> list[Graded]:
    """Return the parameters of the laws.

    These are the ones with a published range, or all numbers.
    """
    found: dict[str, Graded] = {}
    for roles in model.laws.values():
        for role, law in roles.items():
            written = law.parameters.model_dump(mode="json")
            for name, info in type(law.parameters).model_fields.items():
                path = f"parameters.{role}.{name}"
                extra = info.json_schema_extra if isinstance(info.json_schema_extra, dict) else {}
                ends = extra.get("published_range")
                if path in found or (is_ranged and not isinstance(ends, list)):
                    continue
                entry = _read(path, written[name], ends if isinstance(ends, list) else None, extra)
                if entry is not None:
                    found[path] = replace(entry, law=law.model.name)
    return list(found.values())


def _within_class(entry: Graded, base_type: str) -> Graded | None:
    """Return a parameter with its oil class's range.

    None where the class has none.
    """
    for row in _data()["within"]:
        if row["path"] == entry.path and row.get("base_type", base_type) == base_type:
            if "low" not in row:
                return None
            return replace(entry, low=_in_unit(row["low"], entry), high=_in_unit(row["high"], entry))
    return entry


def _read(path: str, value: Any, ends: Sequence[Any] | None, extra: Mapping[str, Any]) -> Graded | None:
    """Return one parameter of a law.

    None where it is no number.
    """
    values = [*(ends or ()), *([] if value is None else [value])]
    try:
        read = scale_of(values) if values else None
    except ValueError:
        return None
    if read is None:
        return None
    scale, numbers = read
    own = numbers[-1] if value is not None else math.nan
    low, high = numbers[:2] if ends else (math.nan, math.nan)
    return Graded(path, own, low, high, scale, str(extra.get("source", "")), "published" if ends else "")


def _plain(model: BearingModel, name: str) -> dict[str, Graded]:
    """Return the option that a name ends in.

    It is an option of the case, without a range.
    """
    found = {}
    for value in model.values:
        is_named = value.path == name or value.path.endswith(f".{name}")
        if is_named and value.path.split(".")[0] in ("lubricant", "surface", "bearing", "loads", "operation"):
            entry = _option(model, value.path)
            if entry is not None:
                found[value.path] = entry
    return found


def _option(model: BearingModel, path: str) -> Graded | None:
    """Return the value of an option of the case.

    None where it is no number.
    """
    value = next((value for value in model.values if value.path == path), None)
    if value is None or not isinstance(value.value, float):
        return None
    unit = next(iter(UNITS[value.quantity])) if value.quantity else ""
    number = from_si(value.value, value.quantity, unit) if value.quantity else value.value
    return Graded(path, number, math.nan, math.nan, Scale(unit), "", "")


def _of_options(model: BearingModel) -> list[Graded]:
    """Return the options of the case with a usual range."""
    found = []
    for entry in _data()["range"]:
        own = _option(model, entry["path"])
        if own is None:
            continue
        if "half_width" in entry:
            width = float(entry["half_width"].split()[0])
            low, high = own.value - width, own.value + width
        else:
            low, high = (_in_unit(entry[end], own) for end in ("low", "high"))
        found.append(Graded(own.path, own.value, low, high, own.scale, entry["source"], "assumed"))
    return found


def _in_unit(text: str, own: Graded) -> float:
    """Return a table value in an option's unit."""
    if not own.scale.unit:
        return float(text)
    quantity = next(name for name, units in UNITS.items() if own.scale.unit == next(iter(units)))
    return from_si(parse(text, quantity), quantity, own.scale.unit)


def _of_clearance(model: BearingModel, resolver: Resolver | None) -> list[Graded]:
    """Return the clearance with the limits of its class.

    It applies only where the case leaves the clearance to the class.
    """
    from lambda_core.case.case_io import apply_overrides
    from lambda_core.model.checking import resolve

    own = _option(model, CLEARANCE)
    status = next((value.status for value in model.values if value.path == CLEARANCE), "")
    if own is None or status != "assumed":
        return []
    case, moved = model.case, []
    for pick in ("minimum", "maximum"):
        picked = apply_overrides(case, (f"bearing.clearance_pick={pick}",))
        moved.append((resolver or partial(resolve, is_static=True))(picked))
    low, high = (found.value if found else math.nan for found in (_option(one, CLEARANCE) for one in moved))
    if not low < high:
        return []
    source = next(value.source for value in model.values if value.path == CLEARANCE)
    return [Graded(CLEARANCE, own.value, low, high, own.scale, source, "published", models=tuple(moved))]
