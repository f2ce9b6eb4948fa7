"""Test duty cycles of a machine.

Every bearing's life by its damages, the life of all, spectra from CSV files.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from lambda_cli.main import main

from lambda_core import api

SPECTRUM = """\
# measured at the test bench
name;time [min];operation.speed [rpm];gears.wheel.power [kW];loads.belt.at;loads.belt.force_z [N]
climb;30;1500;20;5 mm;-800

drive;90;3000;10;5 mm;
"""


@pytest.fixture
def box(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return api.init_case("box", template="geared-shaft")


def cycle(**tables: Any) -> dict[str, Any]:
    return {"name": "day", "case": "box.toml", **tables}


def test_damages_of_every_bearing_add_and_their_lives_join(box: Path) -> None:
    """Add up damages and join lives by hand.

    Miner's rule and the system life, 10/9, from the equilibria of the phases; losses from theirs.
    """
    changes = {"operation.speed": "1500 rpm", "gears.wheel.power": "20 kW"}
    found = api.duty(cycle(phases=[{"name": "a", "time": "1 h", "changes": changes}, {"name": "b", "time": "3 h"}]))
    first = api.quasistatic(box, [f"{path}={value}" for path, value in changes.items()])
    second = api.quasistatic(box)
    lives = []
    for name in ("left", "right"):
        each = [state.bearing(name).rating.reference_life_h for state in (first, second)]
        lives.append(1.0 / (0.25 / each[0] + 0.75 / each[1]))
        assert found.bearings[name].reference_life_h == pytest.approx(lives[-1], rel=1e-9)
        assert found.bearings[name].phases[0].damage == pytest.approx(0.25 * lives[-1] / each[0], rel=1e-9)
    assert found.system_life_h == pytest.approx(sum(life ** (-10.0 / 9.0) for life in lives) ** -0.9, rel=1e-12)
    loss = [sum(one.power_loss_W for one in state.bearings.values()) for state in (first, second)]
    assert found.mean_power_loss_W == pytest.approx(0.25 * loss[0] + 0.75 * loss[1], rel=1e-9)
    assert found.energy_loss_kJ == pytest.approx(3.6 * (loss[0] + 3.0 * loss[1]), rel=1e-9)
    assert "system life" in found.text()


def test_a_spectrum_is_its_phases(box: Path) -> None:
    """Read speed, gear power and load by line.

    An empty cell keeps the value of the case.
    """
    Path("loads.csv").write_text(SPECTRUM)
    belt = {"loads.belt.at": "5 mm"}
    climb = {"operation.speed": "1500 rpm", "gears.wheel.power": "20 kW", "loads.belt.force_z": "-800 N"}
    drive = {"operation.speed": "3000 rpm", "gears.wheel.power": "10 kW"}
    written = cycle(phases=[
        {"name": "climb", "time": "30 min", "changes": {**climb, **belt}},
        {"name": "drive", "time": "90 min", "changes": {**drive, **belt}},
    ])  # fmt: skip
    assert api.duty(cycle(spectrum="loads.csv")) == api.duty(written)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("time [min],operation.speed [rpm]\n0,1\n3,x\n3\n", ("line 2, time", "line 3, operation.speed", "line 4")),
        ("time [min],operation.sped [rpm]\n1,1000\n", ("loads.csv, line 2, operation.sped", "nearest: speed")),
        ("time [min],gears.wheel.power [kN]\n1,1\n", ("loads.csv, line 2, gears.wheel.power", "unit of power")),
        ("operation.speed [rpm]\n1000\n", ("line 1", 'a column "time [s]"')),
        ("time,operation.speed [rpm]\n1,1000\n", ("line 1", "needs a unit")),
        ("time [s],time [min]\n1,1000\n", ("line 1", "names time twice")),
        ("time [s],[rpm]\n1,1000\n", ("line 1", "name every column")),
        ('time [s],operation.speed [rpm]\n1,"10\n', ("line 2", "has a single quote mark at character 3")),
        ("time [s]\n", ("one line per phase",)),
        ("time [min],operation.speed [rpm]\n1,1000\n3,0\n", ("loads.csv, line 3 of box", "needs a speed")),
    ],
)
def test_mistakes_of_a_spectrum_are_said_with_their_lines(
    box: Path, text: str, said: tuple[str, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    Path("loads.csv").write_text(text)
    Path("day.toml").write_text('name = "day"\ncase = "box.toml"\nspectrum = "loads.csv"\n')
    assert main(["duty", "day.toml", "-q"]) == 3
    err = capsys.readouterr().err
    assert all(part in err for part in said), err


def test_a_cycle_has_phases_or_a_spectrum(box: Path) -> None:
    for tables in ({}, {"spectrum": "loads.csv", "phases": [{"name": "a", "time": "1 h"}]}):
        with pytest.raises(api.CaseError, match=r"either \[\[phases\]\] or a spectrum"):
            api.duty(cycle(**tables))
    with pytest.raises(api.UsageError, match=r"none\.csv"):
        api.duty(cycle(spectrum="none.csv"))
