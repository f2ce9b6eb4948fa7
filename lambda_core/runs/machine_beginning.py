"""Begin the motion of a machine.

Apart, so that one bearing loads no code of machines.
"""

from __future__ import annotations

from lambda_core.analysis.rotor.machine_point import MachinePoint
from lambda_core.domain.number_text import counted
from lambda_core.model.checks.describe import headline, machine_headline
from lambda_core.model.machine_model import MachineModel
from lambda_core.results.provenance import BearingOrigin, MachineOrigin, Provenance, machine_data
from lambda_core.runs.beginning import Announce, Begun, rolling_warnings
from lambda_core.solver.drivers.dynamics import MotionEngine
from lambda_core.solver.drivers.machine_motion import machine_start

_DIMS = {"bearings": "bearing", "bodies": "body", "markers": "marker"}  # lists of names, and their dimensions


class BegunMachine(Begun):
    """A machine at t = 0."""

    point: MachinePoint

    def __init__(self, machine: MachineModel, announce: Announce, *, guides_cages: bool) -> None:
        self.start = start = machine_start(machine, announce, guides_cages=guides_cages)
        self.point = MachinePoint(machine, announce, state=start.state, equilibria=start.equilibria)
        self.motion = start.motion

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
        for one, moving in zip(self.point.bearings.values(), engine.bearings, strict=True):
            keys, own = moving.context.kernels.keys(), headline(one.alone)
            told = rolling_warnings(one.equilibrium)
            bearings[one.name] = BearingOrigin(one.model, keys, one.rating, "\n".join(own), warnings=told)
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
