"""Test order, stability and energy error of couplings.

docs/fmu.md states them.
"""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

from benchmarks import coupling, coupling_by_force
from benchmarks.coupling import COMMON, SCHEMES

_END = 1.92e-3  # [s] of the studies' time, half of it behind the push


def test_a_rotor_in_the_host_against_the_same_mass_inside(monkeypatch: pytest.MonkeyPatch) -> None:
    """Find order 2 and balanced energy with Verlet's scheme.

    With the position first, energy comes out of nothing.
    """
    monkeypatch.setattr(coupling, "END", _END)
    reference, bearing = coupling.inside(COMMON, 1e-4), coupling.FromProgram(1e-4)
    off, leak = {}, {}
    for name, step in (("Verlet", 40e-6), ("Verlet", 8e-6), ("place first", 8e-6)):
        path = coupling.hosted(SCHEMES[name], step, bearing, 1e-4)
        off[name, step], leak[name, step] = coupling.error(path, reference, step, COMMON), path.leak
    assert off["Verlet", 8e-6] < 2e-3
    assert off["Verlet", 40e-6] > 5.0**1.5 * off["Verlet", 8e-6]
    assert leak["Verlet", 8e-6] < 1e-3
    assert off["place first", 8e-6] > 10.0 * off["Verlet", 8e-6]


def test_a_spring_of_the_host_against_the_same_inside(monkeypatch: pytest.MonkeyPatch) -> None:
    """Compare a spring of 10 N/um in the host.

    Held through a step it has order 1, half a step ahead order 2.
    """
    monkeypatch.setattr(coupling_by_force, "END", _END)
    reference = coupling_by_force.path(COMMON, lambda bearing, pushed, *_: pushed, 1e7)
    off = {}
    for scheme in ("held", "ahead"):
        for step in (80e-6, 20e-6):
            path = coupling_by_force.path(step, partial(coupling_by_force.force, scheme, 1e7))
            off[scheme, step] = np.abs(path - reference[round(step / COMMON) - 1 :: round(step / COMMON)]).max()
    assert 3.0 < off["held", 80e-6] / off["held", 20e-6] < 6.0
    assert off["ahead", 80e-6] > 8.0 * off["ahead", 20e-6]
    assert off["ahead", 20e-6] < 0.2 * off["held", 20e-6]
