"""Blame a plugin law that broke a machine's run.

Apart, so that one bearing loads no code of machines.
"""

from __future__ import annotations

from lambda_core.runs.law_blame import BlamingEngine
from lambda_core.solver.drivers.machine_motion import MachineEngine
from lambda_core.solver.drivers.readings import MachineSamples, Sums


class BlamingMachineEngine(BlamingEngine[MachineSamples, list[Sums]], MachineEngine):
    """Dynamics of a machine that name failing laws.

    When they fail, the laws of plugins are looked at first.
    """
