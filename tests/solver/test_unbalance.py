"""Test that unbalance uses the spin of its ring."""

from __future__ import annotations

import pytest

from lambda_core import api
from lambda_core.domain.channels import LOSSES
from lambda_core.solver.drivers.dynamics import BearingEngine

SHAKEN = (
    "bodies.inner_ring.unbalance=10000 g mm",
    "bodies.inner_ring.y.damping=2e5 N s/m",
    "bodies.inner_ring.z.damping=2e5 N s/m",
    "depth.cage=false",
    "depth.strips=15",
    "operation.speed=6000 rpm",
)
FIRST, LAST = 0.01, 0.02  # one turn of the ring, from rest of its first swing on [s]


def test_the_drive_pays_for_what_the_supports_dissipate() -> None:
    """Compare the drive's work with losses.

    It equals all that is lost and stored: the unbalance itself gives nothing.
    """
    engine = BearingEngine(api.check("6208-axial-700", SHAKEN))
    assert engine.advance(FIRST).ok
    before = engine.integrals()
    assert engine.advance(LAST).ok
    after = engine.integrals()
    work = {name: after[name] - before[name] for name in after}
    lost = work["support"] + sum(work[f"loss.{name}"] for name in LOSSES)
    assert work["support"] > 0.1 * lost
    assert work["drive"] == pytest.approx(lost + work["stored"], rel=0.02)


def test_a_free_spin_slows_down_for_the_supports() -> None:
    """Slow a free spin by its supports.

    Without a torque the ring's own energy feeds the damper; the balance closes.
    """
    still, shaken = (
        BearingEngine(api.check("6208-axial-700", [*changes, "bodies.inner_ring.spin=free"]))
        for changes in (SHAKEN[3:], SHAKEN)
    )
    speeds = []
    for engine in (still, shaken):
        assert engine.advance(FIRST).ok
        speeds.append(abs(float(engine.now()["body_spin"].reshape(-1)[0])))
    totals = shaken.integrals()
    lost = totals["support"] + sum(totals[f"loss.{name}"] for name in LOSSES)
    assert abs(totals["input"] - lost - totals["stored"]) < 2e-3 * lost
    assert totals["support"] > 0.0
    assert speeds[1] < speeds[0]
