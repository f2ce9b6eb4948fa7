"""Everything that one bearing has, on one run of a shaft in two bearings: commands on results, Python, the file."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.machine import Machine
from lambda_core.results.reader import Result

RUN = (
    "solver.duration=6 ms", "output.checkpoint_interval=2 ms", "electric.seed=1", "bearings.left.depth.strips=7",
    "bearings.right.depth.strips=7", "output.interval=0.1 ms", 'connections.seal.at="160 mm"',
    'connections.seal.z="1 N/um"',
)  # fmt: skip
# Row of the list of features: the command on the result, and what its output contains.
ROWS = {
    "show": (["show", "box.h5"], "rating life"),
    "show in units of the US": (["show", "box.h5", "--units", "us"], "lbf in"),
    "show as JSON": (["show", "box.h5", "--json"], '"discharges_per_s"'),
    "show of one bearing": (["show", "box.h5", "--bearing", "right"], "cage speed"),
    "show with assumptions": (["show", "box.h5", "--assumptions"], "film"),
    "show two": (["show", "box.h5", "box.h5"], "friction torque"),
    "view": (["view", "box.h5", "load-distribution", "--bearing", "left", "--format", "png"], ".png"),
    "animate": (["animate", "box.h5", "--bearing", "left", "--frames", "2", "--turns", "0.1"], ".gif"),
    "report": (["report", "box.h5"], ".html"),
    "cite": (["cite", "box.h5"], "SKF"),
    "electric": (["electric", "box.h5", "--json", "-q"], "left"),
    "thermal": (["thermal", "box.h5", "--json", "-q"], "temperatures_degC"),
}


@pytest.fixture(scope="session")
def box_run(once: Callable[[str, Callable[[Path], object]], Path]) -> Path:
    """Run a shaft in two bearings, with the circuit, a seal, finer contacts and an own interval of samples."""

    def fill(folder: Path) -> None:
        case = api.init_case("box", template="geared-shaft", path=folder / "box.toml")
        api.run(case, RUN, out=folder / "box.h5")

    return once("every-row-of-a-machine", fill) / "box.h5"


@pytest.fixture
def there(box_run: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in a folder with a copy of the run."""
    (tmp_path / "box.h5").write_bytes(box_run.read_bytes())
    monkeypatch.chdir(tmp_path)
    return tmp_path / "box.h5"


@pytest.mark.parametrize("row", ROWS)
def test_a_command_takes_the_run(row: str, there: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments, contained = ROWS[row]
    capsys.readouterr()
    assert main(arguments) == 0
    assert contained in capsys.readouterr().out


def test_the_file_has_lives_circuit_checkpoint_and_sums(box_run: Path) -> None:
    found = Result(box_run)
    summary = found.summary()
    assert all(one.rating is not None and one.rating.reference_life_h for one in summary.bearings.values())
    assert all(one.currents is not None for one in summary.bearings.values())
    assert np.diff(found.bearings["left"]["time"]).max() < 0.2e-3
    kept = found.checkpoint()
    assert kept is not None
    assert kept.position.sums


def test_results_in_a_notebook(box_run: Path) -> None:
    found, summary = Result(box_run), Result(box_run).summary()
    left = found.bearings["left"]
    assert "box" in repr(found)
    assert "<pre>" in found._repr_html_()
    assert "<pre>" in summary._repr_html_()
    assert left.plot("load-distribution").axes
    pytest.importorskip("xarray")
    assert left.to_xarray()["film_central"].units == "m"


def test_an_equilibrium_in_a_notebook(tmp_path: Path) -> None:
    machine = Machine.from_case(api.init_case("box", template="geared-shaft", path=tmp_path / "box.toml"))
    found = machine.quasistatic()
    assert "left" in repr(found)
    assert "<pre>" in found._repr_html_()
    assert len(found.plot().axes) > 1
    stronger = found.with_(gears={"wheel": {"power": "30 kW"}})
    assert stronger.system_life_h < found.system_life_h
    assert stronger.system_life_h == machine.with_(gears={"wheel": {"power": "30 kW"}}).quasistatic().system_life_h
    pytest.importorskip("xarray")
    table = found.to_xarray()
    assert table["radial_load_N"].dims == ("bearing",)
    assert table["radial_load_N"].sel(bearing="left") == found.bearing("left").radial_load_N
    assert table["deflection_um"].shape == (len(found.positions_mm), 3)


def test_a_study_from_python_has_a_row_for_every_point(tmp_path: Path) -> None:
    machine = Machine.from_case(api.init_case("box", template="geared-shaft", path=tmp_path / "box.toml"))
    asked = ["system_life_h", "left.force_N.z", "right.misalignment_mrad.y"]
    table = machine.study({"gears.wheel.power": ["5 kW", "15 kW"]}, asks=asked, executor="here")
    weak, strong = table.rows()
    assert weak["system_life_h"] > strong["system_life_h"]
    found = machine.quasistatic()
    assert strong["left.force_N.z"] == pytest.approx(found.bearing("left").force_N[2], rel=1e-6)
    assert strong["right.misalignment_mrad.y"] == pytest.approx(found.bearing("right").misalignment_mrad[0], rel=1e-4)
    assert json.dumps([column.label for column in table.responses])
