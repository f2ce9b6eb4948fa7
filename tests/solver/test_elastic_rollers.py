"""Test elastic rings and cage of rollers in motion."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.elements import CAGE as CAGE_BODY
from lambda_core.domain.errors import CaseError
from lambda_core.model.roller_case import roller_model
from lambda_core.results.roller_quasistatic import solve_rollers
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.dynamics import BearingEngine, initial_state
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve
from lambda_core.solver.drivers.right_hand_side import Handle
from lambda_core.solver.drivers.wave_tables import waves_at

from .support import FloatArray

CASE: dict[str, Any] = {
    "name": "rollers",
    "bearing": {"designation": "SKF NU 208 ECP"},
    "lubricant": {"name": "FVA3", "temperature": "70 degC"},
    "loads": {"radial": "5 kN"},
    "operation": {"speed": "3000 rpm"},
}
TAPERED = CASE | {"bearing": {"designation": "SKF 32208"}, "loads": {"radial": "5 kN", "axial": "3 kN"}}
SOFT = {"housing_stiffness": "100 N/um", "orders": 4}
CAGE = {"section_height": "2 mm", "section_width": "2 mm", "orders": 3}


@cache
def soft() -> Equilibrium:
    """Return an NU 208 whose outer ring and cage bend."""
    return solve(api.check(CASE | {"elastic": {"outer_ring": SOFT, "cage": CAGE}}))


@cache
def cones() -> Equilibrium:
    """Return a 32208 whose rings and cage bend."""
    return solve(api.check(TAPERED | {"elastic": {"inner_ring": SOFT, "outer_ring": SOFT, "cage": CAGE}}))


def waves_of(found: Equilibrium) -> dict[str, FloatArray]:
    context = found.context
    return {**waves_at(context.bundle, context.model, context.shared_part(found.state))}


def kicked(found: Equilibrium, size: float) -> Equilibrium:
    """Return an equilibrium with an oval cage [m]."""
    context, state = found.context, found.state.copy()
    ellipse = next(int(wave["body"]) for wave in context.bundle.waves if wave["ring"] == CAGE_BODY)
    context.shared_part(state)[np.searchsorted(context.bundle.active, L.NS * ellipse + L.SY)] = size
    return replace(found, state=state)


@pytest.mark.parametrize("name", ["NU 208", "32208"])
def test_both_equilibria_bend_alike(name: str) -> None:
    """Compare compiled code with the convex energy.

    Friction moves loads and amplitudes by up to 1 and 2 % of the largest.
    """
    found, case = (soft(), CASE | {"elastic": {"outer_ring": SOFT}}) if name == "NU 208" else (cones(), TAPERED)
    if name != "NU 208":
        case = case | {"elastic": {"inner_ring": SOFT, "outer_ring": SOFT}}
    assert found.converged
    model = roller_model(case | {"bodies": {"inner_ring": {"mass": f"{found.context.model.inner_ring.mass} kg"}}})
    assert model is not None
    theirs = solve_rollers(model, (0.0,)).state
    loads, largest = found.arcs[:, 0, L.R.CONTACT_CHANNELS.index("load")], theirs.inner.sum(axis=1)
    assert loads == pytest.approx(largest, abs=0.01 * largest.max())
    bent = waves_of(found)
    ours = np.concatenate([bent[ring] for ring in ("inner_ring", "outer_ring") if ring in bent])
    assert np.abs(ours - theirs.waves).max() < 0.02 * np.abs(theirs.waves).max()
    assert not bent["cage"].any()  # nothing pushes it in the equilibrium


def test_a_stiff_housing_is_a_rigid_one_in_motion() -> None:
    stiff = {"outer_ring": {"housing_stiffness": "1e6 N/um", "orders": 2}}
    rigid, bent = solve(api.check(CASE)), solve(api.check(CASE | {"elastic": stiff}))
    assert bent.arcs[..., 0] == pytest.approx(rigid.arcs[..., 0], abs=1e-3 * rigid.arcs[..., 0].max())
    assert bent.displacement[2] == pytest.approx(rigid.displacement[2], rel=1e-3)


def test_jacobian_of_waves() -> None:
    """Compare compiled blocks with differences: 1e-4.

    All of them, and those of the waves of cone, cup and cage.
    """
    context = cones().context
    y = initial_state(cones())
    y = y + np.random.default_rng(0).uniform(-1.0, 1.0, y.size) * 1e-3 * context.scale
    handle, n = Handle(context), y.size
    ours, exact = np.zeros((n, n)), np.zeros((n, n))
    assert handle.jacobian(0.0, y, ours) == 1
    for k in range(n):
        step, ahead, back = 1e-5 * context.scale[k], np.zeros(n), np.zeros(n)
        moved: FloatArray = y.copy()
        moved[k] += step
        handle.slope(0.0, moved, ahead)
        moved[k] -= 2.0 * step
        handle.slope(0.0, moved, back)
        exact[:, k] = (ahead - back) / (2.0 * step)
    scaled, found = (m * context.scale[None, :] / context.scale[:, None] for m in (exact, ours))
    tail, waves = int(context.bundle.system["tail"][0]), context.bundle.waves["body"]
    of_waves = tail + np.flatnonzero(np.isin(context.bundle.active // L.NS, waves))
    others = np.setdiff1d(np.arange(n), of_waves)
    for rows, columns in ((of_waves, of_waves), (of_waves, others), (others, of_waves), (others, others)):
        block = scaled[np.ix_(rows, columns)]
        assert np.linalg.norm(found[np.ix_(rows, columns)] - block) < 1e-4 * np.linalg.norm(block)


def test_energy_of_a_ring_and_a_ringing_cage() -> None:
    """Balance all powers of an oval cage.

    It loses energy to bending and pockets: 1e-3 of what flowed.
    """
    engine = BearingEngine(soft().context.model, equilibrium=kicked(soft(), 0.15e-3))
    while engine.time < 4e-3:
        engine.advance(4e-3)
    sums = engine.integrals()
    lost = sum(value for name, value in sums.items() if name.startswith(("loss.", "support")))
    assert abs(sums["input"] - lost - sums["stored"]) < 1e-3 * sums["input_abs"]
    assert sums["loss.bending"] > 1e-4
    samples = engine.samples()
    assert np.ptp(samples["cage_waves_2"][:, 0]) > 0.1e-3
    assert samples["outer_ring_ovality"].min() > 20e-6


def test_a_continued_run_is_the_uninterrupted_one() -> None:
    complete, first, second = (BearingEngine(cones().context.model, equilibrium=cones()) for _ in range(3))
    complete.advance(1e-3)
    complete.advance(2e-3)
    first.advance(1e-3)
    second.restore(first.state())
    second.advance(2e-3)
    for name, value in complete.now().items():
        np.testing.assert_array_equal(second.now()[name], value, err_msg=name)


def test_the_answer_says_how_rings_bend() -> None:
    """Report it; the answer was that of rigid rings."""
    case = CASE | {"elastic": {"outer_ring": SOFT}}
    found = api.quasistatic(case, band=False)
    (ring,) = found.ring_shapes
    assert ring.ring == "outer"
    assert ring.orders == [2, 3, 4]
    assert ring.outwards_um > 5.0
    assert "shape of rings   outer" in found.text()
    assert found.max_load_N < 0.8 * api.quasistatic(CASE, band=False).max_load_N
    assert any("the outer ring bends in its plane" in sentence for sentence in found.assumptions)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"elastic": {"outer_ring": {"orders": 4}}}, "elastic.outer_ring.housing_stiffness"),
        ({"elastic": {"outer_ring": SOFT | {"section_height": "90 mm"}}}, "leaves no hole in the ring"),
        ({"elastic": {"cage": CAGE}, "depth": {"cage": False}}, "there is no cage"),
    ],
)
def test_mistakes(changes: dict[str, Any], said: str) -> None:
    with pytest.raises(CaseError, match=said):
        api.check(CASE | changes)
