"""Compare the modes of a rotor with those of ROSS.

Skipped where ROSS is not installed.
"""

from __future__ import annotations

import tomllib

import pytest

from lambda_core.analysis.rotor.vibration import bearing_damping, criticals, damped, modes_at, supported
from lambda_core.export.ross import ross_rotor
from lambda_core.model.machine_templates import shaft_text
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.solver.drivers.machine_statics import solve_machine

pytest.importorskip("ross")


def test_natural_frequencies_and_critical_speeds_agree() -> None:
    """Compare frequencies and critical speeds with ROSS.

    The same matrices, discs and pieces: six frequencies and four critical speeds to 1 %, damping to 2 %.

    ROSS has two-node elements and Hutchinson's shear coefficient.
    """
    model = resolve_machine(tomllib.loads(shaft_text("geared-shaft", "box")))
    state = solve_machine(model)
    rotor, stiffness = ross_rotor(model, state), supported(model, state)
    damping = damped(model, state, bearing_damping(model, [ring.equilibrium() for ring in state.rings]))
    own = modes_at(model, stiffness, model.speed, damping)[:6]
    found = rotor.run_modal(speed=model.speed, num_modes=24)
    theirs = sorted((w, ratio) for w, ratio in zip(found.wd, found.damping_ratio, strict=True) if w > 10.0)
    assert [w for w, _ in theirs[:6]] == pytest.approx([mode.frequency for mode in own], rel=0.01)
    assert [ratio for _, ratio in theirs[:6]] == pytest.approx([mode.damping for mode in own], rel=0.02, abs=1e-5)
    own_critical = [mode.frequency for mode in criticals(model, stiffness)][:4]
    for speed in own_critical:  # at a critical speed one natural frequency is the speed
        found = rotor.run_modal(speed=speed, num_modes=40).wd
        assert min(abs(w / speed - 1.0) for w in found if w > 10.0) < 0.01
