"""Check laws: contract, calls, limits, monotony, symmetry."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from pydantic import BaseModel

from lambda_core.discovery.api import registry, split_label
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import unknown_name
from lambda_core.domain.roles import ROLES
from lambda_core.laws import check
from lambda_core.laws.calls import handed_over
from lambda_core.laws.check import ModelReport
from lambda_core.laws.context import Context
from lambda_core.laws.jit.binding import taken_by
from lambda_core.laws.kernels import CompiledKernel, compile_kernel
from lambda_core.laws.law import Law, law_of
from lambda_core.laws.par import make_par
from lambda_core.laws.probe import VECTORS, output_size, trial_context
from lambda_core.laws.state import ROLE as STATES

_EXACT = 1e-8  # relative error of integrated states
Parameters = BaseModel | Mapping[str, Any] | None


AnyLaw = Law | Callable[..., int] | str  # a law, the function below @law(...), or "role/name" of an installed one


def _model(model: AnyLaw) -> Law:
    found = registry().model(*split_label(model)) if isinstance(model, str) else law_of(model)
    if found is None:
        raise TypeError(f"{getattr(model, '__name__', model)} is not a law: write @law(role, name, ...) above it")
    return found


# By label: what is installed stays as it is while a process runs, and looking through all that it reaches takes longer
# than the call.
_installed: dict[str, tuple[Law, CompiledKernel]] = {}


def _compiled(model: AnyLaw, law: Law) -> CompiledKernel:
    if not isinstance(model, str):
        return compile_kernel(law)
    kept = _installed.get(law.label)
    if kept is None or kept[0] is not law:
        kept = _installed[law.label] = law, compile_kernel(law)
    return kept[1]


def check_model(
    model: AnyLaw, parameters: Parameters = None, context: Context | None = None, samples: int = 48
) -> ModelReport:
    """Assert that a model keeps the contract of its role.

    Names and order of the arguments, int64 status, no exceptions, no index outside the
    arrays, inputs left alone, outputs written, finite and within their bounds over the
    range of a ball bearing, machine code equal to plain Python, each cell on its own,
    and a time within bounds.

    Parameters
    ----------
    model : function, Law or str
        The function below ``@law(...)``, the law, or "role/name" of an installed one.
    parameters : pydantic.BaseModel or mapping, optional
        An instance, or what would stand in a case file; default: the model's defaults.
    context : Context, optional
        Default: a 6208 deep-groove ball bearing for each force element of the role.
    samples : int
        Number of argument sets.

    Returns
    -------
    ModelReport
        Without faults and warnings; with the time per call [s].

    Raises
    ------
    AssertionError
        With one sentence per fault.
    """
    report = check.check_model(_model(model), parameters, context, samples)
    problems = [*report.faults, *report.warnings]
    if problems:
        raise AssertionError("\n".join(problems))
    return report


def evaluate(
    model: AnyLaw, parameters: Parameters = None, context: Context | None = None, **arguments: ArrayLike
) -> Any:
    """Call a model's compiled kernel once.

    Parameters
    ----------
    model : function, Law or str
        The function below ``@law(...)``, the law, or "role/name" of an installed one.
    parameters, context
        As for :func:`check_model`; the context of the role's first force element by default.
    **arguments : float or array_like
        Every argument of the role except ``par``, the outputs and what the kernel leaves out, SI. Numbers stand for
        arrays of the common length in elementwise roles.

    Returns
    -------
    ndarray or tuple of ndarray
        The output, shape (cells,) or (number of outputs,); a tuple where the role has two
        output arrays (rheology).

    Raises
    ------
    AssertionError
        When the kernel returns another status than 1, with its sentence.
    TypeError
        When an argument is missing or unknown.
    """
    outputs = _prepared(_model(model), model, parameters, context, arguments)[1]()
    return outputs if len(outputs) > 1 else outputs[0]


def states_over_time(
    model: AnyLaw,
    times: ArrayLike,
    parameters: Parameters = None,
    context: Context | None = None,
    **arguments: ArrayLike | Callable[[float], float],
) -> FloatArray:
    """Integrate the states of a law from their start.

    As in a run no state leaves its bounds.

    Parameters
    ----------
    model : function, Law or str
        Law of the role ``contact_state``, as for :func:`evaluate`.
    times : array_like
        Rising times [s]; the states start at the first.
    parameters, context
        As for :func:`check_model`.
    **arguments : float or callable
        Every argument of the role as for :func:`evaluate`; a callable takes the time [s]. ``t`` is set here.

    Returns
    -------
    ndarray, shape (times, states)
        SI, in the order of the law's declaration.

    Raises
    ------
    TypeError
        For a law of another role, or a missing or unknown argument.
    AssertionError
        When the kernel returns another status than 1, or the integration fails.
    """
    from scipy.integrate import solve_ivp

    law, moments = _model(model), np.asarray(times, np.float64)
    if law.role != STATES:
        raise TypeError(f"{law.label} has no states of its own: give a law of the role {STATES}")
    courses = {name: value for name, value in arguments.items() if callable(value)}
    at_first = {name: value(float(moments[0])) for name, value in courses.items()}
    values, call = _prepared(law, model, parameters, context, {**arguments, **at_first, "t": moments[0]})
    places = {argument.name: place for place, argument in enumerate(ROLES[law.role].arguments)}
    start = values[places["par"]][-len(law.states) :]
    lower, upper = (np.array([getattr(state, end) for state in law.states]) for end in ("lower", "upper"))

    def rates(t: float, state: FloatArray) -> FloatArray:
        start[:] = np.clip(state, lower, upper)
        values[places["t"]] = t
        for name, course in courses.items():
            values[places[name]] = float(course(t))
        found = call()[0]
        outward = ((state <= lower) & (found < 0.0)) | ((state >= upper) & (found > 0.0))
        return np.where(outward, 0.0, found)

    finest = [_EXACT * state.scale for state in law.states]
    solved = solve_ivp(rates, (moments[0], moments[-1]), start.copy(), "LSODA", moments, rtol=_EXACT, atol=finest)
    if not solved.success:
        raise AssertionError(f"{law.label}: {solved.message}")
    return np.asarray(np.clip(solved.y.T, lower, upper), np.float64)


def _prepared(
    law: Law, model: AnyLaw, parameters: Parameters, context: Context | None, arguments: dict[str, Any]
) -> tuple[list[Any], Callable[[], tuple[FloatArray, ...]]]:
    """Return a kernel's values, and what calls it with them."""
    role = ROLES[law.role]
    wanted = [a.name for a in role.arguments if not a.output and a.name != "par"]
    spared = {a.name: np.nan for a in role.arguments if a.optional and a.name not in taken_by(law.kernel)}
    arguments = {**spared, **arguments}
    missing = [name for name in wanted if name not in arguments]
    if missing:
        raise TypeError(f"{law.label} needs {', '.join(missing)}")
    for name in arguments:
        if name not in wanted:
            raise TypeError(unknown_name(f"argument of {law.role}", name, wanted))
    par = make_par(law, check.parameters_of(law, parameters), context or trial_context(role.elements[0]))
    cells = int(np.broadcast(*(arguments[n] for n in wanted)).size) if role.elementwise else 1
    values: list[Any] = []
    for argument in role.arguments:
        if argument.name == "par":
            values.append(par)
        elif argument.output:
            values.append(np.full(output_size(role, cells, len(law.states)), np.nan))
        elif argument.kind == "a":
            size = 3 if argument.name in VECTORS else cells
            values.append(np.array(np.broadcast_to(np.asarray(arguments[argument.name], np.float64), size)))
        else:
            values.append(float(np.asarray(arguments[argument.name])))
    kernel = _compiled(model, law)

    def call() -> tuple[FloatArray, ...]:
        status = kernel.dispatcher(*handed_over(role, values))
        if status != 1:
            raise AssertionError(f"{law.label} returned {status}: {law.errors.get(status, 'no sentence declared')}")
        return tuple(v for a, v in zip(role.arguments, values, strict=True) if a.output)

    return values, call


def _along(model: AnyLaw, argument: str, values: ArrayLike, output: int, given: dict[str, Any]) -> FloatArray:
    """Return one output over `argument`.

    It has one number at each value, which is scalar or the same in every cell.
    """
    results = []
    for value in np.atleast_1d(np.asarray(values, np.float64)):
        arguments = {**given, argument: float(value)}
        found = evaluate(model, **arguments)
        results.append(found[output][0] if isinstance(found, tuple) else found[min(output, found.size - 1)])
    return np.array(results)


def assert_increasing(model: AnyLaw, argument: str, values: ArrayLike, *, output: int = 0, **given: Any) -> None:
    """Assert that an output never falls while one argument rises.

    Parameters
    ----------
    model : function, Law or str
        The function below ``@law(...)``, the law, or "role/name" of an installed one.
    argument : str
        Name of the argument of the role.
    values : array_like
        Its values, increasing, SI.
    output : int
        Which output array (rheology has two), or which entry of the one.
    **given
        The other arguments, ``parameters`` and ``context`` as for :func:`evaluate`.

    Raises
    ------
    AssertionError
        With the place where it falls.
    """
    found = _along(model, argument, values, output, given)
    falls = np.flatnonzero(np.diff(found) < 0.0)
    if falls.size:
        at = np.asarray(values)[falls[0]]
        raise AssertionError(f"{_model(model).label} falls with {argument} from {argument} = {at:g} on: {found}")


def assert_limit(
    model: AnyLaw,
    argument: str,
    value: float,
    expected: float,
    *,
    rtol: float = 1e-6,
    atol: float = 0.0,
    output: int = 0,
    **given: Any,
) -> None:
    """Assert that an output is `expected` at one end.

    Parameters
    ----------
    model : function, Law or str
        The function below ``@law(...)``, the law, or "role/name" of an installed one.
    argument : str
        Name of the argument of the role.
    value, expected : float
        The argument at the end of its range; the output there, SI.
    rtol, atol : float
        Allowed relative and absolute deviation.
    output : int
        Which output array (rheology has two), or which entry of the one.
    **given
        The other arguments, ``parameters`` and ``context`` as for :func:`evaluate`.

    Raises
    ------
    AssertionError
        With what it is instead.
    """
    found = float(_along(model, argument, [value], output, given)[0])
    if not abs(found - expected) <= atol + rtol * abs(expected):
        label = _model(model).label
        raise AssertionError(f"{label} is {found:g} at {argument} = {value:g}; the limit is {expected:g}")


def assert_symmetric(
    model: AnyLaw,
    argument: str,
    values: ArrayLike,
    *,
    odd: bool = False,
    rtol: float = 1e-12,
    output: int = 0,
    **given: Any,
) -> None:
    """Assert that an output is even or odd.

    Parameters
    ----------
    model : function, Law or str
        The function below ``@law(...)``, the law, or "role/name" of an installed one.
    argument : str
        Name of the argument of the role.
    values : array_like
        Its values on one side, SI; the other side is mirrored.
    odd : bool
        The output changes its sign with the argument; otherwise it keeps it.
    rtol : float
        Allowed relative deviation of the two sides.
    output : int
        Which output array (rheology has two), or which entry of the one.
    **given
        The other arguments, ``parameters`` and ``context`` as for :func:`evaluate`.

    Raises
    ------
    AssertionError
        With both sides.
    """
    array = np.asarray(values, np.float64)
    there = _along(model, argument, array, output, given)
    back = _along(model, argument, -array, output, given)
    mirrored = -back if odd else back
    if not np.allclose(there, mirrored, rtol=rtol, atol=0.0):
        kind = "odd" if odd else "even"
        raise AssertionError(f"{_model(model).label} is not {kind} in {argument}: {there} against {back}")
