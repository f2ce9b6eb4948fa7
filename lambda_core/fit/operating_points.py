"""Quasi-static predictions of measured quantities at operating points of one bearing."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from lambda_core.batch.job import kernels_of, resolve_point, with_temperatures
from lambda_core.batch.values import DIGITS
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import CaseError, LambdaError, SolverError, UsageError
from lambda_core.domain.loading import CARRYING
from lambda_core.domain.units import UNITS, from_si
from lambda_core.fit.quantities import CONDITIONS, MEASURED
from lambda_core.solver.drivers.compiled_laws import Kernels
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve
from lambda_core.solver.records import CONTACT_CHANNELS
from lambda_core.system.bearing import BearingModel

# Positions of the balls in pitches, equally weighted: half a pitch mirrors the other under a radial load, and two
# midpoints leave out all but the fourth harmonic of the ball pass.
POSITIONS = (0.125, 0.375)
_LOAD = CONTACT_CHANNELS.index("load")
UNITS_OF = {**{name: measured.unit for name, measured in MEASURED.items()}, "maximum pressure": "GPa"}
_SAME = 1e-6  # relative spread of the loads below which the position of the balls does not matter


def condition_change(name: str, value: float) -> str:
    """Return the change of the case that sets an operating condition, from SI."""
    condition = CONDITIONS[name]
    unit = next(iter(UNITS[condition.quantity]))
    return f"{condition.path}={from_si(value, condition.quantity, unit):.{DIGITS}g} {unit}"


def point_values(case_toml: str, changes: Sequence[str], names: Sequence[str], *, one: bool = False) -> FloatArray:
    """Return measured quantities as a case predicts them at several positions of the balls.

    Parameters
    ----------
    names : sequence of str
        Keys of `quantities.MEASURED`; the numbers have the units of that table.
    one : bool
        Solve the first position only: enough for slopes.

    Returns
    -------
    float64[:, :], shape (positions, len(names))
        Their mean is the prediction; one row where the position of the balls does not matter.

    Raises
    ------
    CaseError, SolverError
        When the case is not valid with these changes, or has no equilibrium.
    """
    model = with_temperatures(resolve_point(case_toml, tuple(changes)))
    return model_values(model, names, one=one)


def model_values(model: BearingModel, names: Sequence[str], *, one: bool = False) -> FloatArray:
    """Return measured quantities as a resolved model predicts them; see :func:`point_values`."""
    return read_values(model, kernels_of(model), [READ[name] for name in names], one=one)


def read_values(
    model: BearingModel,
    kernels: Kernels,
    readers: Sequence[Callable[[Equilibrium], float]],
    first: Equilibrium | None = None,
    *,
    one: bool = False,
) -> FloatArray:
    """Return what readers find in the equilibria at several positions of the balls; `first` where that is known."""
    found = []
    for position in POSITIONS[:1] if one else POSITIONS:
        equilibrium = first or solve(model, kernels, phase=position)
        first = None
        found.append([reader(equilibrium) for reader in readers])
        loads = equilibrium.contacts[:, 0, _LOAD]
        if np.ptp(loads) <= _SAME * loads.max():
            break
    return np.array(found)


def _torque(found: Equilibrium) -> float:
    if found.relative_speed <= 0.0:
        raise UsageError("a bearing at rest has no friction torque: remove the points at speed 0")
    return 1e3 * float(found.losses.sum()) / found.relative_speed


def _film(found: Equilibrium) -> float:
    load = found.contacts[:, :, _LOAD]
    film = found.contacts[:, :, CONTACT_CHANNELS.index("film_minimum")]
    return 1e6 * float(film[load > CARRYING * load.max()].min())


def _pressure(found: Equilibrium) -> float:
    return 1e-9 * float(found.contacts[:, :, CONTACT_CHANNELS.index("max_pressure")].max())


def _capacitance(found: Equilibrium) -> float:
    each = found.contacts[:, :, CONTACT_CHANNELS.index("capacitance")]
    with np.errstate(divide="ignore"):
        return 1e9 * float((1.0 / (1.0 / each).sum(axis=1)).sum())


def _displacement(axis: int) -> Callable[[Equilibrium], float]:
    return lambda found: 1e6 * float(found.displacement[axis])


READ: Mapping[str, Callable[[Equilibrium], float]] = {
    "friction torque": _torque,
    "power loss": lambda found: float(found.losses.sum()),
    "minimum film": _film,
    "maximum pressure": _pressure,
    "capacitance": _capacitance,
    **{f"displacement {axis}": _displacement(index) for index, axis in enumerate("xyz")},
}


def at_line(error: LambdaError, file: str, line: int) -> LambdaError:
    """Return an error of one operating point with the line of the file it belongs to."""
    message = f"{file} line {line}: {error}"
    if isinstance(error, CaseError):
        return CaseError(f"{file} line {line}: {error.source}", error.problems)
    return SolverError(message) if isinstance(error, SolverError) else UsageError(message)
