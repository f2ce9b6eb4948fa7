"""Test views of rollers.

Loads along their contacts, angles of their axes, and ribs, against mechanics.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from lambda_core import api
from lambda_core.discovery.manager import registry
from lambda_core.domain.channels import RIBS
from lambda_core.elements.roller.roller_equilibrium import balance
from lambda_core.export.report.gallery import data_of
from lambda_core.export.report.run_scene import _rotations, scene_of
from lambda_core.model.roller_case import roller_model
from lambda_core.solver.drivers.line_field import line_field
from lambda_core.views.method import NotApplicable
from lambda_core.views.scene import RollerShape

if TYPE_CHECKING:
    from lambda_core.results.reader import Result

CASE: dict[str, Any] = {
    "name": "thrust",
    "bearing": {"designation": "SKF NJ 208 ECP"},
    "lubricant": {"name": "FVA3", "temperature": "60 degC"},
    "loads": {"radial": "6 kN", "axial": "1 kN"},
    "operation": {"speed": "1500 rpm"},
    "solver": {"duration": "4 ms"},
}
SLICES = 32
OFFERED = ("line-contact", "roller-lean", "rib-load")


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Result:
    return api.run(CASE, out=tmp_path_factory.mktemp("rollers") / "thrust.h5")


def show(run: Any, name: str, **options: Any) -> Any:
    return data_of(registry().view(name), run, options)


def test_rollers_of_an_animation_roll(run: Result) -> None:
    """Turn cylinders as their spin does, between both raceways.

    They were balls in grooves.
    """
    scene = scene_of(run, start=None, turns=0.02, frames=5)
    assert scene.element == "roller"
    assert scene.rollers is not None
    assert scene.rollers.length == pytest.approx(11e-3)
    turns = _rotations(run["time"], run["ball_azimuth"], run["ball_spin"], scene.time)
    now, then = (Rotation.from_quat(scene.ball_rotation[k]) for k in (-1, 0))
    own, before = (Rotation.from_quat(turns[k]) for k in (-1, 0))
    apart = (now * then.inv() * (own * before.inv()).inv()).magnitude()
    assert apart.max() < 2e-3  # tilt and skew
    assert (own * before.inv()).magnitude().min() > 0.05


def test_cones_touch_raceways_on_their_length() -> None:
    shape = RollerShape(22.7e-3, *(0.5 * (0.2 + 0.27), 0.2, 0.27))
    pitch, radius = 54e-3, 8.5e-3
    for ring, side in (("inner", -1.0), ("outer", 1.0)):
        along = np.linspace(-0.5, 0.5, 5) * shape.length
        line = np.stack([along, side * (radius - along * math.tan(shape.half)), 0.0 * along], axis=1)
        leaning = Rotation.from_euler("z", -shape.axis).apply(line)
        found = shape.raceway(ring, pitch + side * radius, radius, leaning[:, 0])
        np.testing.assert_allclose(found, pitch + leaning[:, 1], atol=1e-9)


@pytest.mark.parametrize("ring", ["inner", "outer"])
def test_slices_of_a_tilted_roller_are_those_of_its_equilibrium(ring: str) -> None:
    """Compare slices of a tilted roller.

    The equilibrium of ISO 16281 finds approach and tilt itself; load and tilt alone give its slices.

    To 1.5 % of the largest: it has the modulus of the standard, the model that of its steel.
    """
    alone = roller_model(CASE)
    assert alone is not None
    state = balance(alone.bearing, alone.loads, held=alone.held, slices=SLICES)
    roller = int(np.argmax(state.inner.sum(axis=1)))
    loads, lean = getattr(state, ring)[roller], float(state.rollers[roller, 2])
    assert lean > 2e-4
    model = api.check(CASE)
    assert isinstance(model, api.BearingModel)
    found = line_field(model, ring, float(loads.sum()), lean)
    width = alone.bearing.effective_length / SLICES
    assert found.line_load[::-1] * width == pytest.approx(loads, abs=0.015 * loads.max())  # it counts from +x


def test_contacts_of_a_tilted_roller_lean_to_opposite_ends(run: Result) -> None:
    """Load opposite ends of a tilted roller.

    Thrust along +x tilts rollers outwards at +x: the outer contact carries more there, the inner one at -x.
    """
    found = show(run, "line-contact")
    pressure, load = ({series.name: series for series in panel.series} for panel in found.panels)
    for ring, side in (("inner", -1.0), ("outer", 1.0)):
        x, y = load[f"{ring} ring"].x, load[f"{ring} ring"].y
        assert side * float((x * y).sum()) > 0.0
        sample = run["load"][-1, :, 0 if ring == "inner" else 1]
        assert float(y.sum() * (x[1] - x[0])) == pytest.approx(sample[int(np.argmax(run["load"][-1].max(axis=1)))])
        highest = run["max_pressure"][-1, :, 0 if ring == "inner" else 1].max()
        assert pressure[f"{ring} ring"].y.max() == pytest.approx(1e-9 * highest, rel=5e-3)


def test_ribs_carry_the_thrust(run: Result) -> None:
    """Sum rib forces to the thrust within 15 %.

    The inner rib at -x pushes rollers along +x, and the outer one at +x holds them.

    The rest is the traction of skewed rollers along the shaft.
    """
    sums = run["rib_load"].sum(axis=1)
    for name in RIBS:
        known = name in ("inner -x", "outer +x")
        total = sums[:, RIBS.index(name)]
        assert (total > 0.0).all() if known else (total < 50.0).all()
        if known:
            assert total.mean() == pytest.approx(1000.0, rel=0.15)
    over_time = {series.name: series.y for series in show(run, "rib-load").panels[1].series}
    assert over_time["outer +x"] == pytest.approx(sums[:, RIBS.index("outer +x")])


def test_angles_are_those_of_the_channels(run: Result) -> None:
    found, angles = show(run, "roller-lean"), 1e3 * run["roller_lean"]
    for number, name in enumerate(("tilt", "skew")):
        panel = next(panel for panel in found.panels if panel.title == f"{name} over time")
        assert panel.series[0].y == pytest.approx(angles[:, :, number].max(axis=1))
    assert angles[:, :, 0].max() > 0.2


@pytest.mark.parametrize("name", OFFERED)
def test_balls_have_no_such_view(name: str, radial_run: Result) -> None:
    view = registry().view(name)
    assert view.offered is not None
    assert not view.offered(radial_run)
    with pytest.raises(NotApplicable, match="balls"):
        show(radial_run, name)


def test_the_map_of_an_ellipse_is_not_that_of_a_line(run: Result) -> None:
    with pytest.raises(NotApplicable, match="line-contact"):
        show(run, "contact-map")


def test_a_roller_that_is_not_there_is_refused(run: Result) -> None:
    with pytest.raises(api.UsageError, match="roller 15 does not exist: this bearing has 14"):
        show(run, "line-contact", roller=15)
    with pytest.raises(api.UsageError, match="after the end"):
        show(run, "line-contact", time=1.0)


def test_views_are_drawn(run: Result, tmp_path: Path) -> None:
    for name in OFFERED:
        run.plot(name).savefig(tmp_path / f"{name}.png")
        assert (tmp_path / f"{name}.png").stat().st_size > 10_000
