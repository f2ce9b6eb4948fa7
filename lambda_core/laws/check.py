"""Check a model against the kernel convention.

Compiled code checks neither bounds nor exceptions, so the order matters: names and order of
the arguments, what the kernel reaches, a probe in plain Python (which does notice a wrong
index), the inferred return type, and only then the same probe in machine code.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from pydantic import BaseModel, ValidationError

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.installed import OWN, project_of
from lambda_core.domain.plugin_errors import PluginError
from lambda_core.domain.role import Role
from lambda_core.domain.roles import ROLES
from lambda_core.laws.calls import Outcome, compiled_call, handed_over, plain_call, relative_difference
from lambda_core.laws.context import Context
from lambda_core.laws.jit.reach import raises
from lambda_core.laws.kernels import CompiledKernel, compile_kernel, kernel_reach
from lambda_core.laws.law import Law
from lambda_core.laws.pack import compiled_here
from lambda_core.laws.par import flat_kernel, make_par, par_layout
from lambda_core.laws.probe import WRENCHES, draw, open_contact, trial_context
from lambda_core.laws.runaway import runaways
from lambda_core.laws.shear_limit import SHEAR_LIMIT, limitless_sentence, stress_ratio
from lambda_core.laws.state import ROLE as STATES
from lambda_core.laws.state import names_behind
from lambda_core.laws.thresholds import trials_at_thresholds

RTOL = 1e-9  # machine code against plain Python: a few roundings of exp and pow
_CELLS = (1, 5, 9)
_HELD = 4  # contacts of each kind in which states are followed
_STEPS = {"t": 1e-6}  # of central differences, where 1e-4 of the argument's unit is coarse
# About twenty times what the built-in defaults take on a machine of 2020; measured here with
# the call from Python included (0.3 us).
SLOW_CALL = 10e-6  # per call of a scalar role [s]
SLOW_CELL = 1e-6  # per cell of an elementwise role [s]


@dataclass(frozen=True)
class ModelReport:
    """Result of a model's test.

    Attributes
    ----------
    model : Law
        The law.
    faults : tuple of str
        Sentences that keep the model from being used; empty when it may be used.
    warnings : tuple of str
        Sentences that do not (slow).
    calls : int
        Number of argument sets tried.
    seconds : float
        Time per call, or per cell of an elementwise role [s]; NaN when it was not reached.
    """

    model: Law
    faults: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    calls: int = 0
    seconds: float = field(default=float("nan"))

    @property
    def ok(self) -> bool:
        """True if the model may be used."""
        return not self.faults


def check_choice(model: Law, par: FloatArray, compiled: CompiledKernel | None = None, samples: int = 12) -> None:
    """Check a model with the run's `par`.

    It takes a few milliseconds.

    Raises
    ------
    PluginError
        With the first fault.
    """
    for message in _faults(model, par, compiled, samples):
        raise PluginError(message)


def check_model(
    model: Law,
    parameters: BaseModel | Mapping[str, Any] | None = None,
    context: Context | None = None,
    samples: int = 48,
) -> ModelReport:
    """Check a model against its role's contract, on its own.

    Parameters
    ----------
    model : Law
        The law.
    parameters : pydantic.BaseModel or mapping, optional
        An instance, or what would stand in a case file; default: the model's defaults.
    context : Context, optional
        Default: a 6208 deep-groove ball bearing for each force element of the role.
    samples : int
        Number of argument sets drawn from :data:`lambda_core.laws.probe.RANGES`.
    """
    if model.role not in ROLES:
        return ModelReport(model, (f"{model.label}: there is no role of this name",))
    contexts = [context] if context else [trial_context(element) for element in ROLES[model.role].elements]
    try:
        values = parameters_of(model, parameters)
        pars = [make_par(model, values, each) for each in contexts]
        faults = tuple(dict.fromkeys(m for par in pars for m in _faults(model, par, None, samples)))
    except PluginError as error:
        return ModelReport(model, (str(error),))
    if faults:
        return ModelReport(model, faults, calls=samples)
    seconds = time_per_call(model, pars[0])
    bound = SLOW_CELL if ROLES[model.role].elementwise else SLOW_CALL
    unit = "cell" if ROLES[model.role].elementwise else "call"
    slow = f"{model.label} is slow: {seconds * 1e6:.3g} us per {unit}, above {bound * 1e6:g} us"
    warnings = [slow] if seconds > bound else []
    if model.role == "traction" and (ratio := stress_ratio(model, pars[0])) > SHEAR_LIMIT:
        warnings.append(f"{model.label} {limitless_sentence(ratio)}")
    if model.states:
        states, generator = len(model.states), np.random.default_rng(20261)
        trials = [draw(ROLES[model.role], par, 1, generator, states) for par in pars for _ in range(_HELD)]
        warnings += runaways(model, compile_kernel(model), trials)
    return ModelReport(model, (), tuple(warnings), samples * len(pars), seconds)


def parameters_of(model: Law, parameters: BaseModel | Mapping[str, Any] | None) -> BaseModel:
    """Return validated parameters of a law.

    They come from an instance, from values of a case file, or from the defaults.

    Raises
    ------
    PluginError
        Naming each parameter that is missing or invalid.
    """
    if isinstance(parameters, BaseModel):
        return parameters
    try:
        return model.parameters.model_validate(dict(parameters or {}))
    except ValidationError as error:
        problems = "; ".join(f"{'.'.join(map(str, e['loc']))}: {e['msg']}" for e in error.errors())
        raise PluginError(f"{model.label}: its parameters are not complete or not valid: {problems}") from None


def _faults(model: Law, par: FloatArray, compiled: CompiledKernel | None, samples: int) -> Iterator[str]:
    """Yield every fault that can be reported safely.

    Faults that make machine code unsafe end the search.
    """
    role = ROLES[model.role]
    for code in kernel_reach(model).codes:
        if raises(code):
            yield f"{model.label} raises an exception in {code.co_name}: return a status of 2 and up instead"
            return
    generator = np.random.default_rng(20260)
    states = len(model.states)
    trials = [draw(role, par, _CELLS[i % len(_CELLS)], generator, states) for i in range(samples)]
    if states:
        trials += [open_contact(role, trials[0])]
    if project_of(model.distribution) != OWN:  # ours are tried so once, by the tests
        trials += trials_at_thresholds(role, kernel_reach(model).codes, par, generator, states)
    plain, names = [], par_layout(model).names
    in_python = flat_kernel(model, strict=True)
    for arguments in trials:
        outcome = plain_call(in_python, role, arguments)
        if "par[" in outcome.error:
            words = ", ".join(f"par.{name}" for name in names)
            yield f"{model.label} {outcome.error}: {f'write {words}' if words else 'it has none'}"
            return
        if outcome.error:
            yield f"{model.label} {outcome.error} {_where(model, role, arguments)}"
            return
        plain.append(outcome)
    if role.elementwise:
        several = trials[_CELLS.index(max(_CELLS))]
        faults = list(_cell_faults(model, role, in_python, [several, *trials[samples:]]))
        yield from faults
        if faults:
            return
    machine = compiled or compile_kernel(model)
    outcomes = [compiled_call(machine.dispatcher, role, arguments) for arguments in trials]
    for arguments, expected, outcome in zip(trials, plain, outcomes, strict=True):
        message = _fault_of(model, role, arguments, expected, outcome)
        if message:
            yield f"{model.label} {message} {_where(model, role, arguments)}"
            return
    if all(outcome.status != 1 for outcome in outcomes):
        sentence = model.errors.get(outcomes[0].status, "")
        yield f"{model.label} is valid nowhere in the range of a ball bearing: status {outcomes[0].status} ({sentence})"
    if role.elementwise:
        yield from _rest_faults(model, role, machine, several)
    for slope in role.slopes:
        yield from _slope_faults(model, role, machine, trials, slope)


def _fault_of(model: Law, role: Role, arguments: list[Any], expected: Outcome, found: Outcome) -> str:
    """Report the fault of one machine code result.

    The text is empty without a fault.
    """
    if found.error:
        return found.error
    if found.status != 1 and found.status not in model.errors:
        known = ", ".join(map(str, [1, *sorted(model.errors)]))
        reason = "0 (an exception in machine code)" if found.status == 0 else str(found.status)
        return f"returns the status {reason}; declared: {known}"
    if found.status == 1:
        message = _value_fault(model, role, arguments, found)
        if message:
            return message
    if expected.comparable and found.status != expected.status:
        return f"returns {found.status} compiled and {expected.status} in plain Python"
    if expected.comparable and found.status == 1:
        difference = relative_difference(found.outputs, expected.outputs)
        if difference > RTOL:
            return f"differs by {difference:.1e} between machine code and plain Python (allowed {RTOL:g})"
    return ""


def _value_fault(model: Law, role: Role, arguments: list[Any], found: Outcome) -> str:
    """Report an output with a wrong value.

    It is not finite, out of its bounds or of the wrong sign.
    """
    names = [argument.name for argument in role.arguments]
    for index, values in _by_meaning(role, found.outputs):
        meaning = role.outputs[min(index, len(role.outputs) - 1)]
        if np.isnan(values).any():
            return f"leaves {meaning} unwritten or returns NaN with status 1"
        if not np.isfinite(values).all():
            return f"returns an infinite {meaning} with status 1"
        if role.bounds:
            low, high = role.bounds[index]
            worst = values.min() if values.min() < low else values.max()
            if not low <= worst <= high:
                return f"returns {meaning} = {worst:g}; allowed: {low:g} to {high:g}"
    if role.sign_of:
        value, cause = found.outputs[0][0], arguments[names.index(role.sign_of)]
        if value * cause < 0.0:
            return f"returns {role.outputs[0]} = {value:g} against the sign of {role.sign_of}"
    return ""


def _by_meaning(role: Role, outputs: tuple[FloatArray, ...]) -> Iterator[tuple[int, FloatArray]]:
    """Yield (index of the meaning in role.outputs, values)."""
    if role.elementwise:
        yield from enumerate(outputs)
    elif role.name in WRENCHES:
        yield from ((0, outputs[0][:3]), (1, outputs[0][3:]))
    elif role.name == STATES:
        yield from ((0, outputs[0][index : index + 1]) for index in range(outputs[0].size))
    else:
        yield from ((index, outputs[0][index : index + 1]) for index in range(len(role.outputs)))


def _cell_faults(model: Law, role: Role, kernel: Callable[..., int], trials: list[list[Any]]) -> Iterator[str]:
    """Check that each cell depends on its own inputs only.

    The solver hands over the cells of all contacts of a raceway at once: a law of the program that writes into another
    cell than its own would change the next contact. A law of others is handed one cell at a time.
    """
    for tried in trials:
        together = plain_call(kernel, role, tried)
        if together.status != 1 or together.outputs[0].size == 1:
            continue
        for cell in range(together.outputs[0].size):
            part = [
                value[cell : cell + 1].copy() if argument.kind == "a" and argument.name != "par" else value
                for argument, value in zip(role.arguments, tried, strict=True)
            ]
            single = plain_call(kernel, role, part)
            pieces = tuple(values[cell : cell + 1] for values in together.outputs)
            if single.status == 1 and relative_difference(single.outputs, pieces) > RTOL:
                yield f"{model.label} is not elementwise: a cell computed alone differs {_where(model, role, part)}"
                return


def _rest_faults(model: Law, role: Role, machine: CompiledKernel, arguments: list[Any]) -> Iterator[str]:
    """Check that an elementwise output vanishes at rest.

    It looks only at outputs that must vanish.
    """
    name = role.vanishes_with
    if name:
        still = [
            np.zeros_like(value) if argument.name == name else value
            for argument, value in zip(role.arguments, arguments, strict=True)
        ]
        at_rest = compiled_call(machine.dispatcher, role, still)
        if at_rest.status == 1 and np.any(at_rest.outputs[0] != 0.0):
            yield f"{model.label} returns {role.outputs[0]} = {np.abs(at_rest.outputs[0]).max():g} where {name} is 0"


def _slope_faults(
    model: Law, role: Role, machine: CompiledKernel, trials: list[list[Any]], slope: tuple[int, int, str]
) -> Iterator[str]:
    """Compare an output with another one's differences.

    They are central; where two steps disagree there is a bend, which is left out.
    """
    index, of, name = slope
    place = [argument.name for argument in role.arguments].index(name)

    def at(arguments: list[Any], shift: float) -> FloatArray:
        moved = [value + shift if i == place else value for i, value in enumerate(arguments)]
        return compiled_call(machine.dispatcher, role, moved).outputs[0].copy()

    step = _STEPS.get(name, 1e-4)
    for arguments in trials:
        here, after, before = (at(arguments, shift) for shift in (0.0, step, -step))
        found, fine = float(here[index]), (after[of] - before[of]) / (2.0 * step)
        coarse = (at(arguments, 2.0 * step)[of] - at(arguments, -2.0 * step)[of]) / (4.0 * step)
        bent = abs(after[of] - 2.0 * here[of] + before[of]) / step > 0.1 * abs(fine) + 1e-9
        smooth = not bent and abs(coarse - fine) <= 0.01 * abs(fine) + 1e-12
        if smooth and abs(found - fine) > 0.02 * abs(fine) + 1e-9:
            yield (
                f"{model.label} returns {role.outputs[index]} = {found:.4g}, but by differences it is {fine:.4g} "
                f"{_where(model, role, arguments)}"
            )
            return


def _where(model: Law, role: Role, arguments: list[Any]) -> str:
    """Write the inputs of a call.

    Scalars, the ends of arrays, and the states of the contact.
    """
    words = []
    for argument, value in zip(role.arguments, arguments, strict=True):
        if argument.output:
            continue
        if argument.name == "par":
            states = names_behind(model)
            words += [f"par.{name} = {value[len(value) - len(states) + i]:.4g}" for i, name in enumerate(states)]
        elif argument.kind == "f":
            words.append(f"{argument.name} = {value:.4g}")
        else:
            words.append(f"{argument.name} = {np.min(value):.4g}..{np.max(value):.4g}")
    return f"at {', '.join(words)}"


def time_per_call(model: Law, par: FloatArray) -> float:
    """Return the time of one call [s].

    It is the best of several; for an elementwise role it is per cell.
    """
    role = ROLES[model.role]
    cells = 512 if role.elementwise else 1
    arguments = handed_over(role, draw(role, par, cells, np.random.default_rng(1), len(model.states)))
    with compiled_here():  # calls from Python cost more there than what they call
        dispatcher = compile_kernel(model).dispatcher
    best = float("inf")
    for _ in range(7):
        start = time.perf_counter()
        for _ in range(20):
            dispatcher(*arguments)
        best = min(best, (time.perf_counter() - start) / 20)
    return best / cells
