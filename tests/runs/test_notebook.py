"""Test results in a notebook.

They complete, show themselves, and go wherever a path goes.
"""

from __future__ import annotations

import pickle
import sys
import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import h5py
import pytest
from fake_engine import FakeEngine, MakeProvenance

from lambda_core import api
from lambda_core.domain.errors import UsageError
from lambda_core.model.machine_templates import shaft_text
from lambda_core.results import summary
from lambda_core.results.file_format import STATUS, STATUS_BYTES
from lambda_core.results.reader import Result
from lambda_core.results.summary import Summary, summarise
from lambda_core.runs.loop import run


@pytest.fixture
def result(provenance: MakeProvenance, tmp_path: Path) -> Result:
    return run(FakeEngine(), provenance(duration=0.05), tmp_path / "r.h5")


def test_a_result_completes_and_shows_itself(result: Result) -> None:
    assert {"friction_torque_Nmm", "power_loss_W", "contacts", "to_xarray", "summary"} <= set(dir(result))
    assert repr(result).startswith(f"<Result {result.path}: ")
    assert result.summary().state in repr(result)
    shown = result._repr_html_()
    assert shown.startswith("<pre>")
    assert "friction torque" in shown


def test_numbers_of_a_result_are_computed_once_for_each_state_of_its_file(
    result: Result, monkeypatch: pytest.MonkeyPatch
) -> None:
    counted: list[Result] = []

    def counting(of: Result) -> Summary:
        counted.append(of)
        return summarise(of)

    monkeypatch.setattr(summary, "summarise", counting)
    seen = Result(result.path)
    assert (seen.friction_torque_Nmm, seen.state, seen.reasons) == (
        result.friction_torque_Nmm,
        "finished",
        seen.reasons,
    )
    assert counted == [seen, result]
    with h5py.File(result.path, "r+") as file:
        file[STATUS][()] = replace(result.status(), state="interrupted").to_bytes(STATUS_BYTES)
    assert seen.state == "interrupted"


def test_a_result_is_taken_where_a_path_is(result: Result) -> None:
    assert api.view(result, "energy-balance").as_dict() == api.view(result.path, "energy-balance").as_dict()
    assert api.view([result], "energy-balance").as_dict() == api.view([result.path], "energy-balance").as_dict()


def test_a_result_stands_for_its_file(result: Result, tmp_path: Path) -> None:
    assert api.summary(result) == api.summary(result.path)
    assert api.cite(result) == api.cite(result.path)
    assert api.view_stem([result]) == "r"
    assert Path(result) == result.path
    (tmp_path / "page.html").touch()
    with pytest.raises(UsageError, match=r"page\.html exists"):
        api.report(result, tmp_path / "page.html")


def test_a_result_plots_a_view_that_a_notebook_shows(result: Result) -> None:
    figure = result.plot("energy-balance")
    assert figure._repr_png_().startswith(b"\x89PNG")
    with pytest.raises(UsageError, match='"enrgy-balance" is not a known view; nearest: energy-balance'):
        result.plot("enrgy-balance")
    with pytest.raises(UsageError, match="bal"):
        result.plot("contact-map", bal=1)


def test_a_case_completes_to_what_it_has() -> None:
    assert {"bearing", "loads", "with_"} <= set(dir(api.case("6319-cp10-1500")))
    assert not [name for name in dir(api.case("6319-cp10-1500")) if name in ("copy", "parse_obj", "model_fields")]


def test_progress_says_where_it_stands_in_a_line() -> None:
    numbers: dict[str, Any] = dict.fromkeys(api.Progress.model_fields, None) | {
        "time_s": 0.1, "percent": 41.6, "cage_revolutions": 2.04, "cage_revolutions_wanted": 5.0, "averaged": 1,
        "friction_torque_Nmm": 160.2, "friction_torque_ci_Nmm": 1.5, "inner_loads_N": (), "wall_s": 1.0, "left_s": 2.2,
    }  # fmt: skip
    assert str(api.Progress(**numbers)) == (
        "42 %   2.0 of 5 cage revolutions   friction torque 160.2 ± 1.5 N mm   2 s left"
    )


def test_without_xarray_it_says_which_extra(result: Result, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(UsageError, match=r'extra "data": pip install "lambda-bearing\[data\]"'):
        result.to_xarray()


def test_an_equilibrium_shows_and_draws_itself_and_answers_for_a_changed_case() -> None:
    found = api.quasistatic("6208-axial-1300", ["loads.radial=1 kN"])
    assert repr(found).startswith("<QuasiStatic 6208-axial-1300")
    (panel,) = found.plot().axes
    assert "load" in panel.get_ylabel()
    stronger = found.with_(loads={"radial": "3 kN"})
    assert stronger.max_load_N > found.max_load_N
    assert stronger == api.quasistatic("6208-axial-1300", ["loads.radial=3 kN"])
    assert stronger.with_(loads={"radial": "1 kN"}) == found
    assert pickle.loads(pickle.dumps(found)).with_(loads={"radial": "3 kN"}) == stronger
    with pytest.raises(UsageError, match="has no case"):
        type(found).model_validate(found.model_dump()).with_(loads={"radial": "3 kN"})
    pytest.importorskip("xarray")
    table = found.to_xarray()
    assert table["load_N"].dims == ("contact",)
    assert float(table["load_N"].max()) == found.max_load_N
    assert table["inner_ring_displacement_um"].sel(xyz="z", bearing=found.case) == found.inner_ring_displacement_um[2]


@pytest.mark.full
def test_other_answers_answer_for_a_changed_case() -> None:
    """Change temperature and load in a notebook.

    Temperatures in warmer air; friction over speed under more load.
    """
    warm = api.thermal("6208-axial-1300")
    warmer = warm.with_(thermal={"ambient": "40 degC"}).temperatures_degC
    assert all(warmer[part] > value for part, value in warm.temperatures_degC.items())
    course = api.warm_up("6208-axial-1300", 20.0, ["thermal.ambient=10 degC"])
    assert "model band       of steady temperatures only" in course.text()
    assert course.with_(thermal={"ambient": "30 degC"}).time_s[-1] == course.time_s[-1] == 20.0
    curve = api.stribeck("6208-axial-1300", speeds_rpm=[500.0, 1000.0])
    assert curve.with_(loads={"axial": "2 kN"}).torque_Nmm[0] > curve.torque_Nmm[0]


def test_an_answer_goes_to_another_process() -> None:
    """Pickle an answer with a local progress function.

    The builder's helper process sends such answers.
    """
    found = api.estimate(api.check("6208-axial-1300"), announce=lambda _: None)
    assert pickle.loads(pickle.dumps(found)) == found


def test_an_estimate_of_a_machine_goes_to_another_process() -> None:
    found = api.estimate(api.check(tomllib.loads(shaft_text("geared-shaft", "box"))), announce=lambda _: None)
    assert pickle.loads(pickle.dumps(found)) == found
