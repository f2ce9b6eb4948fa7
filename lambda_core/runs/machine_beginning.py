"""Begin the motion of a machine.

Apart, so that one bearing loads no code of machines.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from lambda_core.analysis.rating.engineering import mounted_rating
from lambda_core.analysis.rotor.bearing_alone import alone_under_load
from lambda_core.analysis.rotor.machine_equilibrium import MachineEquilibrium, equilibrium_of
from lambda_core.analysis.rotor.machine_modes import MachineModes, modes_of
from lambda_core.domain.number_text import counted
from lambda_core.model.checks.describe import headline, machine_headline
from lambda_core.model.machine_model import MachineModel
from lambda_core.results.provenance import BearingOrigin, MachineOrigin, Provenance, machine_data
from lambda_core.solver.drivers.dynamics import MotionEngine, MotionStart
from lambda_core.solver.drivers.equilibrium import Equilibrium
from lambda_core.solver.drivers.machine_motion import MachineStart, machine_start

_DIMS = {"bearings": "bearing", "bodies": "body", "markers": "marker"}  # lists of names, and their dimensions


@dataclass(frozen=True)
class BegunMachine:
    """A machine at t = 0."""

    start: MachineStart

    @property
    def equilibria(self) -> Sequence[Equilibrium]:
        """Equilibria of the bearings."""
        return self.start.equilibria

    @property
    def motion(self) -> MotionStart:
        """Start of the dynamics."""
        return self.start.motion

    def sentence(self) -> str:
        """Return a sentence about the equilibrium."""
        start = self.start
        return (
            f"equilibrium of {counted(len(start.equilibria), 'bearing')} and "
            f"{counted(start.shaft.positions.size, 'lump')} of the shaft: {start.motion.state.size} states"
        )

    def provenance(self, engine: MotionEngine) -> Provenance:
        """Return the fixed part of a result from here."""
        start, model = self.start, self.start.machine
        bearings = {}
        for i, one in enumerate(model.bearings):
            rating = mounted_rating(model, start.state, i, start.equilibria[i])
            keys = engine.bearings[i].context.kernels.keys()
            own = headline(alone_under_load(model, start.state, i))
            bearings[one.name] = BearingOrigin(one.model, keys, rating, "\n".join(own))
        title, *_ = lines = machine_headline(model)
        origin = MachineOrigin(
            headline="\n".join(lines),
            model=machine_data(model),
            numbers={"drive_torque": start.drive_torque},
            labels={
                "lump": start.shaft.positions,
                "connection": [link.name for link in model.links],
                **{_DIMS[what]: names for what, names in model.names.items()},
            },
            assumptions=model.assumptions,
            warnings=model.warnings,
        )
        return Provenance(model.name, title, model.case_toml, bearings, origin)

    def answer(self) -> MachineEquilibrium:
        """Return the equilibrium in the words of the interface."""
        return equilibrium_of(self.start.machine, self.start.state, self.start.equilibria)

    def modes(self) -> MachineModes:
        """Return the modes of the shaft."""
        return modes_of(self.start.machine, self.start.state)


def begin_machine(machine: MachineModel, announce: Callable[[str], None] | None, *, guides_cages: bool) -> BegunMachine:
    """Return a machine in equilibrium; see :func:`.beginning.begin`."""
    return BegunMachine(machine_start(machine, announce, guides_cages=guides_cages))
