"""Blame a plugin law that caused a solver failure.

A negative shear stress drives what it should brake, and a write outside an array changes somebody else's numbers: what
fails then is the step, or the next law that reads them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import RINGS
from lambda_core.domain.errors import SolverError
from lambda_core.domain.plugin_errors import PluginError
from lambda_core.elements.ball.raceways import raceways
from lambda_core.laws.check import check_choice
from lambda_core.laws.law import Law
from lambda_core.laws.runaway import FAR
from lambda_core.laws.state import ROLE
from lambda_core.model.laws.law_packages import foreign_laws
from lambda_core.model.laws.state_channels import states_of
from lambda_core.solver.drivers.dynamics import MotionEngine
from lambda_core.solver.drivers.engine import Advance
from lambda_core.solver.drivers.law_inputs import RACEWAYS
from lambda_core.solver.drivers.readings import ReadBearing
from lambda_core.solver.drivers.solver_context import SolverContext

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import BearingModel

_SAMPLES = 1500  # of a law under suspicion; a second at the most
_CELLS = 64


def took_part(others: Iterable[Law]) -> str:
    """Say which laws of others took part in what failed."""
    names = dict.fromkeys(law.label for law in others)
    return f"laws of others took part: {', '.join(names)}"


@contextmanager
def naming_laws(*models: BearingModel) -> Iterator[None]:
    """Name the laws of plugins after a failure.

    An equilibrium was not found, and the sentence names none of them.
    """
    try:
        yield
    except SolverError as error:
        others = [law for model in models for law in foreign_laws(model)]
        if not others or any(law.label in str(error) for law in others):
            raise
        raise SolverError(f"{error}; {took_part(others)}") from None


class BlamingEngine(MotionEngine):
    """Dynamics of bearings that name failing laws.

    When they fail, the laws of plugins are looked at first.
    """

    def advance(self, until: float, pause: Callable[[], bool] | None = None) -> Advance:
        """Integrate as the engine does.

        Report a failure with the law behind it, where one can be found.
        """
        found = super().advance(until, lambda: bool(self._run_away()) or (pause is not None and pause()))
        if gone := self._run_away():
            return Advance(False, gone)
        others = [law for one in self.bearings for law in foreign_laws(one.context.model)]
        if found.ok or not others or any(law.label in found.message for law in others):
            return found
        return Advance(False, f"{found.message}; {next(self._suspicions(), '') or took_part(others)}")

    def _run_away(self) -> str:
        """Report the state that is beyond all bounds.

        It is one of a contact; or nothing.
        """
        for number, one in enumerate(self.bearings):
            values, first, model = self.kept_states(number), 0, one.context.model
            for raceway in raceways(model.geometry) if values.size else ():
                kept, balls = states_of(model, raceway.element), model.geometry.ball_count
                own = values[first : first + len(kept) * balls].reshape(balls, len(kept))
                first += own.size
                for state, column in zip(kept, own.T, strict=True):
                    far = np.flatnonzero(~(np.abs(column) < FAR * state.scale))
                    if far.size:
                        law = model.laws[raceway.element][ROLE].model
                        ball = raceway.row * balls + int(far[0]) + 1
                        return _of(
                            one,
                            f"{law.label}: its state {state.name} runs away, {column[far[0]]:.3g} {state.unit} at ball "
                            f"{ball}, ball - {RINGS[raceway.ring]}, t = {self.time:.6g} s: more than {FAR:.0e} times "
                            "its scale",
                        )
        return ""

    def _suspicions(self) -> Iterator[str]:
        """Yield the faults of laws of plugins.

        The present state comes first, then any state.
        """
        for number, one in enumerate(self.bearings):
            labels = {law.label for law in foreign_laws(one.context.model)}
            if labels:
                yield from (_of(one, sentence) for sentence in self._suspicions_in(number, one.context, labels))

    def _suspicions_in(self, number: int, context: SolverContext, labels: set[str]) -> Iterator[str]:
        """Yield the faults of labelled laws.

        They are laws in a bearing.
        """
        now, laws = self.channels_now(number), context.model.laws
        for ring, side in enumerate(RINGS):
            element = f"ball_{side}"
            if laws[element]["traction"].model.label in labels:
                yield from _shear(
                    context, element, {name: values[:, ring] for name, values in now.items() if name in _READ}
                )
        for element in RACEWAYS:
            for role, law in laws[element].items():
                if law.model.label in labels:
                    try:
                        check_choice(law.model, context.parameters(element, role), samples=_SAMPLES)
                    except PluginError as error:
                        yield str(error)


def _of(one: ReadBearing, sentence: str) -> str:
    """Return a sentence with its bearing if there are several."""
    return f"{one.name}: {sentence}" if one.name else sentence


def _shear(context: SolverContext, element: str, now: dict[str, FloatArray]) -> Iterator[str]:
    """Yield contacts with impossible shear stress.

    The stress of the film drives, or is beyond the pressure.
    """
    law, compiled = context.model.laws[element]["traction"].model, context.kernels.compiled
    for ball in np.flatnonzero(now["load"] > 0.0):
        pressure = np.linspace(0.0, float(now["max_pressure"][ball]), _CELLS)
        temperature = np.full(_CELLS, float(now["film_temperature"][ball]))
        reach = abs(float(now["slip"][ball])) + abs(float(now["spin_velocity"][ball] * now["semi_axis_a"][ball]))
        slip = np.resize(np.linspace(0.0, reach, 7), _CELLS)
        film = float(now["film_central"][ball])
        if not all(map(np.isfinite, (pressure[-1], temperature[0], reach, film))):
            continue
        ln_eta, rho, tau = np.zeros((3, _CELLS))
        compiled[element, "rheology"].dispatcher(
            pressure, temperature, context.parameters(element, "rheology"), ln_eta, rho
        )
        compiled[element, "traction"].dispatcher(
            slip, pressure, temperature, ln_eta, np.full(_CELLS, film), context.parameters(element, "traction"), tau
        )
        odd = np.flatnonzero(~(tau >= 0.0) | (tau > np.maximum(pressure, 1e6)))
        if odd.size:
            cell = int(odd[0])
            yield (
                f"{law.label} returns a shear stress of {tau[cell]:.4g} Pa under {pressure[cell]:.4g} Pa at ball "
                f"{ball + 1}, {element.replace('_', ' - ')} (slip = {slip[cell]:.4g}, T = {temperature[cell]:.4g}, "
                f"ln_eta = {ln_eta[cell]:.4g}, h = {film:.4g})"
            )
            return


_READ = ("load", "max_pressure", "film_temperature", "slip", "spin_velocity", "semi_axis_a", "film_central")
