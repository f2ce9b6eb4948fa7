"""Test friction at low speed and of starved contacts."""

from __future__ import annotations

import math

import pytest

from lambda_core import api
from lambda_core.solver.drivers.dynamics import BearingEngine

CASE = "6319-cp10-500"
CREEP = "models.boundary_friction=micro-slip"


def torque(*changes: str) -> float:
    found = api.quasistatic(CASE, list(changes)).friction_torque_Nmm
    assert found is not None
    return found


def test_friction_falls_from_rest_with_speed() -> None:
    """Find friction falling from rest with speed.

    Stribeck's curve where asperities creep; smoothed at 10 mm/s of slip it rises from next to nothing.

    Against 100 1/min: hysteresis, a fifth of the torque, does not fall with the speed.
    """
    slow, faster = (torque(CREEP, f"operation.speed={rpm} rpm") for rpm in (1, 100))
    assert slow > 1.2 * faster
    assert torque("models.boundary_friction=cubic", "operation.speed=1 rpm") < 0.25 * slow


def test_friction_of_rest_does_not_depend_on_the_slowness() -> None:
    """Compare friction at a fifth of the speed.

    At Lambda below 0.05 contacts are nearly dry: only creep and film change.
    """
    one, five = (torque(CREEP, f"operation.speed={rpm} rpm") for rpm in (1, 5))
    assert one == pytest.approx(five, rel=0.2)


def test_starvation_takes_film_and_rolling_resistance() -> None:
    full, starved = (api.quasistatic(CASE, [f"lubricant.starvation={share}"]) for share in (1, 0.5))
    assert starved.film_um[0] == pytest.approx(0.5 * full.film_um[0], rel=0.01)
    rolling = [found.friction_breakdown_Nmm["rolling_inner"] or 0.0 for found in (full, starved)]
    assert 0.0 < rolling[1] < 0.2 * rolling[0]


def test_a_little_starvation_changes_little() -> None:
    """Compare films of 1 - e and 1.

    No law replaces another: the change goes to nothing with e, in rolling and torque.
    """
    full = api.quasistatic(CASE)
    for short, most in ((1e-3, 0.08), (1e-5, 0.003), (1e-12, 1e-6)):
        found = api.quasistatic(CASE, [f"lubricant.starvation={1.0 - short!r}"])
        for name in ("rolling_inner", "rolling_outer", "sliding_inner"):
            complete, part = full.friction_breakdown_Nmm[name], found.friction_breakdown_Nmm[name]
            assert complete is not None
            assert part == pytest.approx(complete, rel=most), (short, name)
        assert found.friction_torque_Nmm == pytest.approx(full.friction_torque_Nmm, rel=most)


def test_what_starvation_assumes_is_said() -> None:
    model = api.check(CASE, ["lubricant.starvation=0.9"])
    assert model.laws["ball_inner"]["supply"].model.name == "skf-replenishment"
    assert any("films are 0.9 of the flooded ones" in text for text in model.assumptions)
    assert not any("fully flooded" in text for text in model.assumptions)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        (["models.supply=oil-layer", "parameters.supply.layer=2 um"], '"oil-layer" computes the film itself'),
        (["parameters.supply.film_factor=0.8"], "gives the film, too"),
    ],
)
def test_a_film_is_prescribed_once(changes: list[str], sentence: str) -> None:
    with pytest.raises(api.CaseError, match=sentence):
        api.check(CASE, ["lubricant.starvation=0.5", *changes])


def test_a_run_at_ten_rpm_has_the_torque_of_its_equilibrium() -> None:
    """Compare torque with the equilibrium to 3 %.

    Micro-slip in the dynamics as in the statics, 6316 at 13.24 kN; the cage, at rest at first, left out.
    """
    changes = [
        "bearing.designation=6316", "bearing.maker=SKF", "loads.radial=13.24 kN", "operation.speed=10 rpm",
        "lubricant.name=mineral-vg68", "lubricant.temperature=60 degC", "models.fluid_drag=none",
        "bodies.inner_ring.tilt_y=locked", "bodies.inner_ring.tilt_z=locked",
    ]  # fmt: skip
    engine = BearingEngine(api.check(CASE, changes))
    assert engine.advance(0.3).ok
    found = engine.integrals()
    lost = {name: value for name, value in found.items() if name.startswith("loss.")}
    cage = lost["loss.pocket"] + lost["loss.land"]
    moved = 0.3 * 10.0 * math.pi / 30.0
    assert 1e3 * (sum(lost.values()) - cage) / moved == pytest.approx(torque(*changes), rel=0.03)
    assert abs(found["input"] - sum(lost.values()) - found["stored"]) < 1e-3 * found["input_abs"]
