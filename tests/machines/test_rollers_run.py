"""Test rollers on a shaft in motion.

Energy, loads, skew, and the friction of the equilibrium that they start from.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.case.case_io import read_tables
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.machine_motion import MachineEngine, machine_engine

EXAMPLES = Path(__file__).parents[2] / "examples" / "roller-shafts"
CASES = ("motor", "gearbox")
WITH_ROLLERS = {"motor": ("belt",), "gearbox": ("left", "right")}


def tables(name: str) -> dict[str, Any]:
    """Return the tables of an example."""
    return dict(read_tables(EXAMPLES / f"{name}.toml").data)


@pytest.mark.parametrize("name", CASES)
def test_a_shaft_with_rollers_runs(name: str) -> None:
    """Run 20 ms and balance energy to 3e-4.

    Rollers carry the loads of the equilibrium to 5 %, and no roller turns aside.

    Balls and skewed rollers share the workspace of contacts: nothing of a roller may stay behind in a ball's.
    """
    engine: MachineEngine = machine_engine(api.check(tables(name)))
    while engine.time < 0.02:
        engine.advance(0.02)
    _, states = engine.buffered()  # the integrals take the samples
    for row in engine.integrals():
        lost = sum(value for name, value in row.items() if name.startswith(("loss.", "support")))
        assert lost > 0.0
        assert abs(row["input"] - lost - row["stored"]) < 3e-4 * row["input_abs"]
    start, now = engine.start, engine.now()
    for mounted, found, channels in zip(start.machine.bearings, start.equilibria, now.bearings, strict=True):
        if mounted.name not in WITH_ROLLERS[name]:
            continue
        assert channels["load"][:, 0].sum() == pytest.approx(found.contacts[:, 0, 0].sum(), rel=0.05), mounted.name
    for one in start.readings.bearings:
        if one.context.model.rollers is None:
            continue
        rollers = L.elements_in(one.context.bundle, np.ascontiguousarray(states[:, one.span.begin : one.span.end]))
        assert np.abs(rollers["tilt"]).max() < 0.02


@pytest.mark.full
@pytest.mark.parametrize("name", ["motor", pytest.param("gearbox", marks=pytest.mark.slow)])
def test_a_run_has_the_friction_of_its_equilibrium(name: str, tmp_path: Path) -> None:
    """Compare torque with the equilibrium to 15 %.

    The run has another model of the raceways' films, a cage, and rollers that pass.
    """
    found = api.run(tables(name), out=tmp_path / "shaft.h5").summary()
    still = api.quasistatic(tables(name))
    assert abs(found.energy_residual) < 1e-3
    assert found.friction_torque_Nmm == pytest.approx(still.friction_torque_Nmm, rel=0.15)
    for bearing in WITH_ROLLERS[name]:
        one = found.bearings[bearing]
        assert one.cage_speed_ratio == pytest.approx(one.epicyclic_ratio, rel=0.02)
