"""Detect states that grow without bound."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from lambda_core.domain.roles import ROLES
from lambda_core.laws.calls import compiled_call
from lambda_core.laws.kernels import CompiledKernel
from lambda_core.laws.law import Law
from lambda_core.laws.probe import output_size
from lambda_core.laws.state import ROLE

FAR = 1e12  # times its scale: no state of a bearing gets there
_LONG, _STEPS = 10.0, 60  # time over which a contact is held as it is [s]
_SMALL = 1e-6  # of the scale: step of the difference that tells how a rate changes with its state


def runaways(law: Law, machine: CompiledKernel, trials: list[list[Any]]) -> Iterator[str]:
    """Yield the first state that runs away.

    The contact of the law is constant, as it is drawn.

    Each state is followed on its own by the exponential Euler step, dS = r (exp(J h) - 1)/J, J = dr/dS, over steps that
    grow from a microsecond: exact where the rate is linear, so that no stiff decay looks like growth.
    """
    role = ROLES[ROLE]
    names = [argument.name for argument in role.arguments]
    for arguments in trials:
        for place, state in enumerate(law.states):
            found = _followed(law, machine, arguments, place, names)
            if found is not None:
                time, value = found
                load = float(arguments[names.index("load")])
                yield (
                    f"{law.label}: its state {state.name} runs away where a contact is held at a load of {load:.3g} N: "
                    f"{value:.1e} {state.unit} after {time:.2g} s, the rate growing with the state"
                )
                return


def _followed(
    law: Law, machine: CompiledKernel, arguments: list[Any], place: int, names: list[str]
) -> tuple[float, float] | None:
    """Return when and how far a state runs away.

    [s, its unit], None where it stays.
    """
    par = arguments[names.index("par")].copy()
    at = par.size - len(law.states) + place
    size, scale = output_size(ROLES[ROLE], 1, len(law.states)), law.states[place].scale

    def rate(value: float) -> float:
        held = par.copy()
        held[at] = value
        handed = [held if name == "par" else each for name, each in zip(names, arguments, strict=True)]
        outcome = compiled_call(machine.dispatcher, ROLES[ROLE], handed)
        return float(outcome.outputs[0][place]) if outcome.status == 1 and outcome.outputs[0].size == size else math.nan

    value, time = float(par[at]), 0.0
    for number in range(_STEPS):
        step = 1e-6 * (_LONG / 1e-6) ** (number / (_STEPS - 1))
        now = rate(value)
        slope = (rate(value + _SMALL * scale + 1e-9 * abs(value)) - now) / (_SMALL * scale + 1e-9 * abs(value))
        if not math.isfinite(now) or not math.isfinite(slope):
            return None
        power = min(slope * step, 600.0)
        value += now * (math.expm1(power) / slope if abs(power) > 1e-12 else step)
        time += step
        if slope > 0.0 and not abs(value) < FAR * scale:
            return time, value
    return None
