"""Convert validated parameters to the kernel's record.

`prepare` runs once and returns the record.
"""

from __future__ import annotations

import contextlib
import inspect
import math
import sys
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

from pydantic import BaseModel

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.plugin_errors import PluginError, describe
from lambda_core.domain.roles import ROLES
from lambda_core.laws.context import Context
from lambda_core.laws.jit.binding import bound
from lambda_core.laws.law import Law
from lambda_core.laws.named_numbers import Layout, Member, RecordError, flatten, is_record, layout_of
from lambda_core.laws.state import names_behind, values_behind

_DECLARE = (
    "declare its names, class Constants(NamedTuple): factor: float, and "
    "def prepare(parameters, context) -> Constants; the kernel reads par.factor"
)


def par_layout(law: Law) -> Layout:
    """Return the names that a law's kernel reads from ``par``.

    Raises
    ------
    PluginError
        When `prepare` does not say what it returns, or a name is neither a number nor an array.
    """
    try:
        found = layout_of(_record_type(law))
    except RecordError as error:
        advice = "" if law.prepare else ": give the law a prepare that makes numbers of it"
        raise PluginError(f"{law.label}: a kernel cannot read its parameters: {error}{advice}") from None
    behind = names_behind(law)
    twice = next((name for name in behind if name in found.names), None)
    if twice is not None:
        raise PluginError(f"{law.label} has a parameter and a state of one name, {twice}: rename the parameter")
    return replace(found, members=(*found.members, *(Member(name, "float") for name in behind)))


def number_in(law: Law, par: FloatArray, name: str, otherwise: float) -> float:
    """Return a named number of :func:`make_par`'s array.

    `otherwise` where the law has none of that name.

    It is looked for among the numbers before the first array or record.
    """
    for place, member in enumerate(par_layout(law).members):
        if member.kind not in ("float", "int", "bool"):
            break
        if member.name == name:
            return float(par[place])
    return otherwise


def make_par(law: Law, parameters: BaseModel, context: Context) -> FloatArray:
    """Return the flat array of ``par``.

    The solver uses it, for one run and force element.

    Parameters
    ----------
    law : Law
        The law.
    parameters : pydantic.BaseModel
        Instance of ``law.parameters``, SI.
    context : Context
        Geometry, materials and oil of the force element.

    Returns
    -------
    ndarray of float64, shape (n,)
        Contiguous and finite, laid out as :func:`par_layout` says.

    Raises
    ------
    PluginError
        When ``prepare`` raises or returns anything else; the sentence names law and distribution.
    """
    wanted = _record_type(law)
    try:
        with contextlib.redirect_stdout(sys.stderr):  # stdout is for data
            made: Any = law.prepare(parameters, context) if law.prepare else parameters
            states = values_behind(law, parameters, context)
    except (Exception, SystemExit) as error:
        raise PluginError(f"{law.label}: the parameters cannot be prepared: {describe(error)}") from error
    if not isinstance(made, wanted):
        raise PluginError(f"{law.label}: prepare returns a {type(made).__name__}, its annotation is {wanted.__name__}")
    if not all(map(math.isfinite, states)):
        raise PluginError(f"{law.label}: a state does not start with a finite number")
    for state, value in zip(law.states, states[len(law.reads) :], strict=True):
        if not state.lower <= value <= state.upper:
            limits = f"{state.lower:g} to {state.upper:g} {state.unit}"
            raise PluginError(f"{law.label}: its state {state.name} starts at {value:g}; allowed: {limits}")
    try:
        return flatten(layout_of(wanted), made, states)
    except RecordError as error:
        source = "prepare returns" if law.prepare else "the parameters have"
        raise PluginError(f"{law.label}: {source} {error}") from None


def flat_kernel(law: Law, *, strict: bool = False) -> Callable[..., int]:
    """Return a law's kernel for one contact.

    It is in plain Python and takes the flat array of :func:`make_par`.

    Parameters
    ----------
    law : Law
        The law.
    strict : bool
        Refuse to read parameters by position, for the checks of laws.
    """
    return bound(law.kernel, ROLES[law.role], par_layout(law), alone=True, strict=strict)


def batched_kernel(law: Law) -> Callable[..., int]:
    """Return a law's kernel for all contacts.

    The solver calls it so for a raceway; it is in plain Python.
    """
    return bound(law.kernel, ROLES[law.role], par_layout(law))


def _record_type(law: Law) -> type:
    """Return the type of the record.

    It is the annotation of `prepare`, or that of the parameters themselves.
    """
    if law.prepare is None:
        return law.parameters
    try:
        return _annotated(law.prepare)
    except RecordError as error:
        raise PluginError(f"{law.label}: prepare {error}") from None


@cache
def _annotated(prepare: Callable[..., Any]) -> type:
    """Return the annotated type of `prepare`.

    RecordError, the end of a sentence, where it is no record.
    """
    said = getattr(prepare, "__annotations__", {}).get("return", inspect.Parameter.empty)
    if isinstance(said, str):
        try:
            said = eval(said, getattr(prepare, "__globals__", {}))
        except Exception:
            raise RecordError(f'is annotated with "{said}", which its module does not have at the top level') from None
    if not is_record(said):
        what = "does not say what it returns" if said is inspect.Parameter.empty else "returns no record"
        raise RecordError(f"{what}: {_DECLARE}")
    found: type = said
    return found
