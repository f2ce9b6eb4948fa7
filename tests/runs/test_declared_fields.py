"""Test that a result field is declared once."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from lambda_gui.summary_view import summary_view

from lambda_core import api
from lambda_core.analysis.rotor.machine_equilibrium import BearingEquilibrium
from lambda_core.export.report.key_tables import more_figures, run_figures
from lambda_core.results.bearing_summary import BearingSummary
from lambda_core.results.quantity import quantities, quantity
from lambda_core.results.quasistatic import QuasiStatic
from lambda_core.results.rating import Rating
from lambda_core.results.summary import Summary
from lambda_core.results.text import PLACED
from lambda_core.studies import responses

COLOURS = dict.fromkeys(("success", "warning", "error"), "red")


class WiderSummary(BearingSummary):
    """Summary with one more number.

    Only its declaration knows it.
    """

    creep_um: float = quantity(
        "creep of the outer ring in its seat", "um", label="creep of the outer ring", column="creep", decimals=2,
        group="cage", default=12.34,
    )  # fmt: skip


class WiderStatic(QuasiStatic):
    """An equilibrium with one more number."""

    creep_um: float = quantity(
        "creep of the outer ring in its seat", "um", label="creep of the outer ring", column="creep", decimals=2,
        group="contact", default=12.34,
    )  # fmt: skip


@pytest.fixture(scope="session")
def run_file(once: Callable[[str, Callable[[Path], object]], Path]) -> Path:
    def fill(folder: Path) -> None:
        api.run("6208-axial-1300", ["solver.duration=2 ms"], out=folder / "run.h5")

    return once("declared-fields", fill) / "run.h5"


def widened(path: Path) -> Summary:
    """Return a summary with the number.

    It is that of the run's bearing.
    """
    found = api.summary(path)
    (name, one), *_ = found.bearings.items()
    return found.model_copy(update={"bearings": {name: WiderSummary(**dict(one))}})


def test_the_builder_shows_the_torque_of_the_drive(run_file: Path) -> None:
    found = api.summary(run_file).model_copy(update={"drive_torque_Nm": 1.234})
    assert re.search(r"^drive torque +1\.234 N m$", summary_view(found, COLOURS).plain, re.MULTILINE)


def test_a_new_number_of_a_run_is_everywhere(run_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = widened(run_file)
    assert re.search(r"^creep +12\.34 um$", found.text(), re.MULTILINE)
    assert next(iter(found.bearings.values())).model_dump(mode="json")["creep_um"] == 12.34
    assert "12.34" in summary_view(found, COLOURS).plain
    assert ("creep of the outer ring", "12.3", "um") in run_figures(found).rows
    monkeypatch.setattr(responses, "BearingSummary", WiderSummary)
    known = responses._catalogue()["creep_um"]
    assert (known.unit, known.meaning) == ("um", "creep of the outer ring")


def test_a_new_number_of_a_machines_bearing_has_a_line(tmp_path: Path) -> None:
    case = api.init_case("box", template="geared-shaft", path=tmp_path / "box.toml")
    found = api.run(case, ["solver.duration=1 ms"], out=tmp_path / "box.h5").summary()
    wide = found.model_copy(update={"bearings": {n: WiderSummary(**dict(one)) for n, one in found.bearings.items()}})
    assert len(re.findall(r"^creep +12\.34 um$", wide.text(), re.MULTILINE)) == 2


def test_a_new_number_of_an_equilibrium_is_everywhere(monkeypatch: pytest.MonkeyPatch) -> None:
    found = WiderStatic(**dict(api.quasistatic("6208-axial-1300")))
    assert re.search(r"^creep +12\.34 um$", found.text(), re.MULTILINE)
    assert found.model_dump(mode="json")["creep_um"] == 12.34
    assert ("creep of the outer ring", "12.3", "um") in more_figures(found)
    monkeypatch.setattr(responses, "QuasiStatic", WiderStatic)
    assert responses._catalogue()["creep_um"].static is not None


def test_numbers_that_are_placed_by_hand_exist() -> None:
    declared = {
        name for kind in (Summary, BearingSummary, QuasiStatic, Rating, BearingEquilibrium) for name in quantities(kind)
    }
    assert declared >= PLACED
