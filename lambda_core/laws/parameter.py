"""Declare a law's parameters with unit, range and source."""

from __future__ import annotations

from collections.abc import Mapping
from inspect import signature
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from lambda_core.domain.plugin_errors import PluginError
from lambda_core.domain.units import UNITS

Bound = float | str
_KNOWN = signature(Field).parameters.keys() - {"extra"}  # others would be ignored


class Parameters(BaseModel):
    """Base of a law's parameters.

    They have no unknown fields and are frozen; defaults are checked like input.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, validate_default=True)


class NoParameters(Parameters):
    """Parameters of a law that has none."""


def parameter(
    default: Any,
    description: str,
    *,
    source: str = "",
    status: Literal["published", "measured", "unconfirmed", "assumed", "numerical", "lubricant"] | None = None,
    published_range: tuple[Bound, Bound] | None = None,
    by_kind: Mapping[str, Bound] | None = None,
    **constraints: Any,
) -> Any:
    """Declare one parameter.

    Parameters
    ----------
    default : Any
        What would stand in a case file ("6 MPa", 0.12); ``...`` makes the parameter required.
    description : str
        What the number is, for files, help and forms.
    source : str
        Where default and range come from.
    status : str, optional
        "published", what it is where a source is named; "measured" by the author; "unconfirmed" for a value in
        common use whose original was not seen; "assumed" for an assumption to be printed with results, what a default
        without a source is; "numerical" for a regularisation without physical meaning; "lubricant" for a property that
        the oil's catalogue row brings.
    published_range : tuple of float or str, optional
        Range found in the literature, written as in a case file; studies sample it.
    by_kind : mapping of str to float or str, optional
        Default of kinds of bearings that have another one, by `Geometry.kind` ("angular contact", "self-aligning").
    **constraints
        Bounds as pydantic knows them (``gt``, ``ge``, ``lt``, ``le``), in SI.

    Returns
    -------
    Any
        A field of a pydantic model, for the class body of `Parameters`.

    Raises
    ------
    PluginError
        For another keyword, such as ``unit``.
    """
    if unknown := sorted(constraints.keys() - _KNOWN):
        remedy = '; for a unit declare the field as Annotated[float, Quantity("pressure")]' if "unit" in unknown else ""
        raise PluginError(f"parameter() has no `{unknown[0]}`: bounds are ge, gt, le, lt{remedy}")
    sourced = bool(source) or default is ...  # who has to give a value answers for it
    extra: dict[str, Any] = {"status": status or ("published" if sourced else "assumed")}
    if source:
        extra["source"] = source
    if published_range is not None:
        extra["published_range"] = list(published_range)
    if by_kind:
        extra["by_kind"] = dict(by_kind)
    return Field(default, validate_default=True, description=description, json_schema_extra=extra, **constraints)


def kind_defaults(parameters: type[BaseModel], kind: str) -> dict[str, Bound]:
    """Return a kind's defaults of parameters.

    A kind of bearings has them instead of the declared ones of a law.
    """
    found = {}
    for name, info in parameters.model_fields.items():
        extra = info.json_schema_extra
        others = extra.get("by_kind") if isinstance(extra, dict) else None
        if isinstance(others, dict) and kind in others:
            found[name] = others[kind]
    return found  # type: ignore[return-value]


def _fault_of_default(name: str, error: Any) -> str:
    """Report a wrong default.

    For a text with a unit it explains the declaration of such a parameter.
    """
    text = error.get("input")
    if error["type"] == "float_parsing" and isinstance(text, str):
        quantities = [key for key, units in UNITS.items() if text.strip().split(" ", 1)[-1] in units]
        if quantities:
            return (
                f'"{text}" has a unit, and {name} is declared a plain number: declare '
                f'{name}: Annotated[float, Quantity("{quantities[0]}")] with Quantity of lambda_core.plugins'
            )
    return str(error["msg"])


def default_fault(parameters: type[BaseModel]) -> str:
    """Report a default that is not valid.

    Also report a text that would reach the kernel unread; report nothing when all are valid.
    """
    try:
        parameters.model_validate({})
    except ValidationError as error:
        for each in error.errors():
            if each["type"] != "missing":
                name = ".".join(map(str, each["loc"]))
                return f"the default of {name} is not valid: {_fault_of_default(name, each)}"
    for name, info in parameters.model_fields.items():
        checked = info.validate_default or parameters.model_config.get("validate_default")
        if isinstance(info.default, str) and not checked and info.annotation is float:
            return f'the default of {name} is a text: declare it with parameter("{info.default}", "what it is")'
    return ""
