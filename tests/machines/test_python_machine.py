"""Test machines built in Python.

They are the case that they write, and every question takes them.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

import lambda_core as lb
from lambda_core import api
from lambda_core.domain.errors import CaseError, UsageError


def gearbox() -> lb.Machine:
    machine = lb.Machine("gearbox", speed="3000 rpm", oil=("FVA3", "70 degC"))
    machine.shaft("30 mm x 40 mm", "110 mm x 48 mm", "30 mm x 30 mm x 10 mm")
    machine.bearing("left", "SKF 6208", at="21 mm")
    machine.bearing("right", "SKF 6206", at="148 mm", support={"x": "free"})
    return machine.gear("wheel", at="85 mm", pitch_diameter="120 mm", power="15 kW", role="driven", mesh="90 deg")


def test_a_machine_says_what_its_file_says(tmp_path: Path) -> None:
    machine = gearbox()
    file = machine.save(tmp_path / "gearbox.toml")
    assert lb.Machine.from_case(file).written() == machine.written()
    of_file, built = api.quasistatic(file), machine.quasistatic()
    assert of_file.model_dump_json() == built.model_dump_json()
    assert built.bearing("left").radial_load_N == pytest.approx(424.0, rel=0.05)
    assert "left" in str(built)
    assert "wheel" in str(built)


def test_a_changed_copy_leaves_the_machine_as_it_was() -> None:
    machine = gearbox()
    before = machine.written()
    stronger = machine.with_(gears={"wheel": {"power": "30 kW"}})
    assert machine.written() == before
    assert stronger.written()["gears"]["wheel"] == before["gears"]["wheel"] | {"power": "30 kW"}
    loads = [made.quasistatic().bearing("right").radial_load_N for made in (machine, stronger)]
    assert loads[1] == pytest.approx(2.0 * loads[0], rel=0.1)


def test_one_bearing_is_two_lines_shorter() -> None:
    machine = lb.Machine.of_bearing("SKF 6208", radial="3 kN", speed="3000 rpm", oil=("FVA3", "70 degC"))
    found = machine.quasistatic()
    assert found.friction_torque_Nmm > 50.0
    assert found.max_load_N == pytest.approx(3000.0 * 5.0 / 9.0, rel=0.1)  # Stribeck: Q_max = 5 F / Z (no clearance)


def test_a_part_makes_one_bearing_a_machine() -> None:
    """Compare 1 kN more with 3 kN from the start.

    It was refused, and the case had to be written as a machine by a command.
    """
    given: dict[str, Any] = {"speed": "3000 rpm", "oil": ("FVA3", "70 degC")}
    single = lb.Machine.of_bearing("SKF 6208", radial="3 kN", **given).quasistatic()
    machine = lb.Machine.of_bearing("SKF 6208", radial="2 kN", **given)
    machine.load("belt", at="0 mm", force_z="-1 kN")
    found = machine.quasistatic()
    assert found.bearing("bearing").max_load_N == pytest.approx(single.max_load_N, rel=1e-4)
    machine.shaft("80 mm x 40 mm").bearing("right", "SKF 6206", at="80 mm")
    assert list(machine.quasistatic().bearings) == ["bearing", "right"]


def test_mistakes_are_named_at_once_or_by_the_case() -> None:
    machine = gearbox()
    with pytest.raises(UsageError, match=r"bearings\.left exists already"):
        machine.bearing("left", "SKF 6206", at="10 mm")
    with pytest.raises(UsageError, match="length x diameter"):
        machine.shaft("30 mm")
    with pytest.raises(UsageError, match="list is not a section of a shaft; give each section as an argument"):
        machine.shaft(["30 mm x 40 mm"])  # type: ignore[arg-type]
    with pytest.raises(UsageError, match="name and temperature"):
        lb.Machine(speed="3000 rpm", oil="FVA3")
    machine.disc("flywheel", at="10 mm", mas="2 kg")
    with pytest.raises(CaseError, match="mass"):
        machine.quasistatic()


@pytest.mark.parametrize("table", ["shaft", "gears", "discs", "connections", "housing"])
def test_tables_of_machines_without_a_bearing_are_a_machine(table: str) -> None:
    """Ask for its bearings.

    Without them it counted as the case of one bearing, which has no gears.
    """
    machine = lb.Machine(speed="3000 rpm", oil=("FVA3", "70 degC"), **{table: {}})
    with pytest.raises(CaseError, match=r"bearings +(is required|must have)") as refused:
        machine.check()
    assert "only machines have it" not in str(refused.value)


def test_a_shaft_that_carries_only_its_weight_has_an_equilibrium() -> None:
    machine = lb.Machine(speed="3000 rpm", oil=("FVA3", "70 degC"))
    machine.shaft("170 mm x 40 mm")
    machine.bearing("left", "SKF 6208", at="21 mm").bearing("right", "SKF 6206", at="148 mm", support={"x": "free"})
    found = machine.quasistatic()
    carried = [
        found.bearing(one.name).radial_load_N - 9.80665 * one.model.inner_ring.mass for one in machine.check().bearings
    ]
    assert sum(carried) == pytest.approx(9.80665 * found.shaft_mass_kg, rel=1e-3)
    assert carried[1] / carried[0] == pytest.approx((85.0 - 21.0) / (148.0 - 85.0), rel=0.05)  # the lever, in mm


def test_a_machine_shows_itself_in_one_line() -> None:
    assert repr(gearbox()) == ("Machine('gearbox', speed='3000 rpm', bearings=['left', 'right'], gears=['wheel'])")


def test_the_package_offers_what_users_ask_for() -> None:
    """Compare the package's names for types and run time.

    Each name has one meaning whatever was imported before.
    """
    import lambda_core.fitting
    import lambda_core.runs.api
    import lambda_core.studies.folders  # noqa: F401  # with submodules, their packages are known

    assert set(lb.__all__) <= set(dir(lb))
    assert len(lb.__all__) <= 30
    for name in set(lb.__all__) - {"Machine"}:
        assert getattr(lb, name) is getattr(lb.api, name)
        assert callable(getattr(lb, name))
    listed = Path(lb.__file__).read_text(encoding="utf-8").split("if TYPE_CHECKING:")[1].split("__version__")[0]
    assert set(re.findall(r"^ {8}(\w+),$", listed, re.MULTILINE)) | {"Machine"} == set(lb.__all__)
    with pytest.raises(AttributeError, match="Machin"):
        _ = lb.Machin  # type: ignore[attr-defined]


def test_functions_take_a_machine() -> None:
    """Pass a machine in place of its case."""
    machine = gearbox()
    assert lb.quasistatic(machine) == machine.quasistatic()
    assert lb.check(machine).name == "gearbox"
    single = lb.Machine.of_bearing("SKF 6208", radial="3 kN", speed="3000 rpm", oil=("FVA3", "70 degC"))
    assert lb.quasistatic(single).max_load_N == single.quasistatic().max_load_N
    table = lb.study(single, {"loads.radial": ["2 kN", "3 kN"]}, asks=["max_load_N"], executor="here")
    assert table.rows()[1]["max_load_N"] == pytest.approx(single.quasistatic().max_load_N, rel=1e-9)
