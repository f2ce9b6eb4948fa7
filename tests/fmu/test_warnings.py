"""Test an FMU's warnings at the limits of laws."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from lambda_core import api
from lambda_core.results.limits import Grooves, shoulders

CASE, CHANGES = "6208-axial-1300", ("solver.duration=0.2 s",)
STEP = 1e-4  # [s]
Export = Callable[[int, str], Path]


@pytest.mark.full
def test_where_laws_end_the_host_is_told(host: Any, exported: Export, tmp_path: Path) -> None:
    """Warn at the start and after a tenth second.

    The text gives the present values.
    """
    unit = host.Unit(exported(2, "force"), tmp_path)
    bearing = host.Instance(unit).ready()

    def told(load: float, steps: int = 1) -> list[str]:
        before = len(bearing.said)
        assert bearing.set("inner_ring.force_x", load) == host.OK
        for _ in range(steps):
            assert bearing.step(STEP) == host.OK
            bearing.get(["bearing.load"])
        return list(bearing.said[before:])

    assert told(0.0, 3) == []
    pressed = told(60e3, 12)
    kinds = ("where steel yields (ISO 76)", "over the inner ring's shoulder", "over the outer ring's shoulder")
    assert [sum(kind in said for said in pressed) for kind in kinds] == [1, 1, 1]
    assert len(pressed) == 3
    found = api.iterate(CASE, CHANGES, exact=True)
    (said,) = (said for said in pressed if kinds[1] in said)
    time, ball, over = re.findall(r"t = (\S+) s the contact of ball (\d+) runs (\d+) um", said)[0]
    for k in range(3):
        found.step_to(STEP * (k + 1))
    found.push((60e3, 0.0, 0.0))
    while found.time_s < float(time) - 0.5 * STEP:
        step = found.step_to(found.time_s + STEP)
    grooves = Grooves.of(dataclasses.asdict(found.model.geometry))
    inner, _ = shoulders(grooves, step["load"], step["contact_angle"], step["semi_axis_a"])
    assert (inner.ball, round(-inner.margin_um)) == (int(ball), int(over))
    assert inner.warning()[0] in said
    assert told(60e3, 3) == []


@pytest.mark.full
def test_a_film_thinner_than_the_roughness_is_told(host: Any, exported: Export, tmp_path: Path) -> None:
    """Warn of thin films at 60 degrees and slow shafts.

    The warning comes at the start, from the equilibrium that is solved there.
    """
    unit = host.Unit(exported(2, "force"), tmp_path)
    bearing = host.Instance(unit)
    assert [bearing.set(*each) for each in (("lubricant.temperature", 333.15), ("inner_ring.spin", 20.0))] == [0, 0]
    (film,) = bearing.get(["bearing.film_parameter"])
    assert film < 1.0
    assert re.fullmatch(
        r"at t = 0 s the film parameter Lambda of (\S+) at ball \d on the (inner|outer) ring is below 1: the film is "
        r"thinner than the roughness, asperities carry a share of (\S+) of the load there",
        bearing.said[-1],
    )
    assert float(re.findall(r"Lambda of (\S+)", bearing.said[-1])[0]) == pytest.approx(film, rel=5e-2)
    assert 0.0 < float(re.findall(r"share of (\S+)", bearing.said[-1])[0]) < 1.0
    count = len(bearing.said)
    bearing.ready()
    for _ in range(3):
        bearing.step(STEP)
        bearing.get(["bearing.film_parameter"])
    assert len(bearing.said) == count


@pytest.mark.full
def test_metal_that_touches_is_no_infinite_capacitor(host: Any, exported: Export, tmp_path: Path) -> None:
    """Report mixed friction as contact, not as capacitance.

    Balls in mixed friction on both rings connect these; they count as contacts of a run do and are left out.
    """
    bearing = host.Instance(host.Unit(exported(2, "force"), tmp_path))
    pushed = (("inner_ring.spin", 44.0), ("inner_ring.force_z", -4000.0))
    assert [bearing.set(*each) for each in pushed] == [host.OK] * 2
    assert bearing.ready().step(STEP) == host.OK
    changes = ("operation.speed=44 rad/s", "loads.radial=4000 N")
    step = api.iterate(CASE, (*CHANGES, *changes), exact=True).step_to(STEP)
    series = (1.0 / step["capacitance"].reshape(-1, 2)).sum(axis=1)
    count = int((series == 0.0).sum())
    assert 0 < count < series.size
    assert step["bearing_capacitance"] == float("inf")
    found = bearing.get(["bearing.capacitance", "bearing.shorted"])
    assert found == pytest.approx([(1.0 / series[series > 0.0]).sum(), count], rel=1e-2)
    said = [text for text in bearing.said if "metal touches metal on both rings of" in text]
    assert [re.findall(r"of (\d) balls? \(Lambda below 2\.03\)", text) for text in said] == [[str(count)]]
    assert bearing.set("inner_ring.spin", -1e155) == host.OK  # what no law refuses and no number holds
    with pytest.raises(AssertionError, match=r"bearing\.loss is -?nan with these inputs; are loads in N"):
        bearing.get(["bearing.loss"])
    assert bearing.set("inner_ring.spin", 44.0) == host.OK
    assert bearing.get(["bearing.shorted"]) == [count]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("designation", "axial", "push", "kinds"),
    [
        ("7208BE", 1000.0, (-1100.0, 0.0, -3000.0), {"low shoulder"}),
        ("QJ208", 2000.0, (-1900.0, 0.0, -60e3), {"edge between the arcs"}),
        ("3208A", 2000.0, (60e3, 0.0, 0.0), {"ring's shoulder"}),
        ("1208E", 200.0, (15e3, 0.0, 0.0), {"ring's shoulder"}),
    ],
)
def test_edges_of_every_kind_are_those_of_the_program(
    host: Any, c_compiler: Any, tmp_path: Path, designation: str, axial: float, push: Any, kinds: set[str]
) -> None:
    """Compare the FMU's limits with those of the program.

    Both look at the same instant.
    """
    case = {
        "name": designation,
        "bearing": {"designation": designation},
        "lubricant": {"name": "bode-mineral", "temperature": "60 degC"},
        "operation": {"speed": "3000 1/min"},
        "loads": {"axial": f"{axial} N"},
        "solver": {"duration": "0.2 s"},
    }
    unit = host.Unit(api.export_fmu(case, out=tmp_path / "it.fmu", processor="native"), tmp_path / "unit")
    bearing, inside = host.Instance(unit).ready(), api.iterate(case, exact=True)
    inside.push(push)
    assert [bearing.set(f"inner_ring.force_{axis}", load) for axis, load in zip("xyz", push, strict=True)] == [0, 0, 0]
    grooves, said = Grooves.of(dataclasses.asdict(inside.model.geometry)), list[str]()  # by both
    for _ in range(6):
        step, count = inside.step_to(bearing.time + STEP), len(bearing.said)
        assert bearing.step(STEP) == host.OK
        bearing.get(["bearing.load"])
        told = [text.partition(" s ")[2] for text in bearing.said[count:] if "computed as if" in text]
        edges = shoulders(grooves, step["load"], step["contact_angle"], step["semi_axis_a"])
        said += [text for edge in edges for text in edge.warning() if text in told]
    assert {kind for kind in kinds if any(kind in text for text in said)} == kinds
