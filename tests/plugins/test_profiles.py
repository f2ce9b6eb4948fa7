"""Test roller profiles of a plugin."""

from __future__ import annotations

import copy
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.discovery import local_files, manager
from lambda_core.discovery.collect import Collection, Entry
from lambda_core.domain.installed import ON_VARIABLE
from lambda_core.model.bearing_model import BearingModel
from lambda_core.plugins import RollerProfile
from lambda_core.results.quasistatic import QuasiStatic

PARABOLA = """from typing import Annotated
from lambda_core.plugins import Parameters, Quantity, RollerProfile, hookimpl, parameter

class Edge(Parameters):
    edge: Annotated[float, Quantity("small_length")] = parameter("8 um", "drop at the end", gt=0.0)

def drop(x, roller, parameters):
    return parameters.edge * (2.0 * x / roller.effective_length) ** 4

@hookimpl
def lambda_profiles(register):
    register(RollerProfile("quartic", "Fourth power", drop, "own work", Edge, profile_api=1))
"""
CASE: dict[str, Any] = {
    "name": "profiled",
    "bearing": {"designation": "NU 208"},
    "lubricant": {"name": "FVA3", "temperature": "60 degC"},
    "loads": {"radial": "5 kN"},
    "operation": {"speed": "3000 rpm"},
}


def case(**options: Any) -> dict[str, Any]:
    """Return the case with options of the rollers."""
    found = copy.deepcopy(CASE)
    found["bearing"]["rollers"] = options
    return found


@pytest.fixture
def quartic(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Take the file of a profile into use."""
    monkeypatch.setenv(ON_VARIABLE, "")
    known = dict(local_files._texts)
    (tmp_path / "quartic.py").write_text(PARABOLA)
    api.use_plugin(tmp_path / "quartic.py")
    yield
    local_files._texts.clear()
    local_files._texts.update(known)
    monkeypatch.undo()
    manager.registry.cache_clear()


@pytest.mark.usefixtures("quartic")
def test_a_plugin_gives_rollers_their_profile() -> None:
    own = case(profile="quartic", profile_parameters={"edge": "30 um"})
    model = api.check(own)
    assert isinstance(model, BearingModel)
    assert model.rollers is not None
    half = 0.5 * model.rollers.effective_length
    points = [[f"{1e3 * s * half:.9g} mm", f"{30.0 * s**4:.9g} um"] for s in np.linspace(0.0, 1.0, 151)]
    points[-1][0] = f"{1e3 * half * (1 + 1e-9):.12g} mm"
    table = case(profile="tabulated", profile_points=points)
    loads, pressures = [], []
    for one in (own, table, case(profile="iso")):
        found = api.quasistatic(one)
        assert isinstance(found, QuasiStatic)
        assert found.rollers is not None
        loads.append([roller.max_line_load_N_mm for roller in found.rollers.loads])
        pressures.append(found.max_pressure_GPa)
    assert loads[0] == pytest.approx(loads[1], rel=1e-4)
    assert pressures[0] == pytest.approx(pressures[1], rel=1e-4)
    assert abs(pressures[0] / pressures[2] - 1.0) > 0.02
    assert any("quartic.py" in str(value) for value in model.values)


@pytest.mark.usefixtures("quartic")
def test_a_profile_that_does_not_exist_or_fit_is_refused() -> None:
    for options, words in (
        ({"profile": "quartik"}, '"quartik" is not a known profile.*nearest: quartic'),
        ({"profile": "crownd"}, "nearest: crowned.*--plugin FILE"),
        ({"profile": "quartic", "profile_parameters": {"edg": "1 um"}}, "edg.*nearest: edge"),
        ({"profile": "quartic", "profile_radius": "1 m"}, "no option of the profile quartic"),
    ):
        with pytest.raises(api.CaseError, match=words):
            api.check(case(**options))


@pytest.mark.parametrize(
    ("drop", "words"),
    [
        (lambda x, roller, parameters: -np.abs(x), "below zero"),
        (lambda x, roller, parameters: np.abs(x + 1e-3), "must be even"),
        (lambda x, roller, parameters: np.where(np.abs(x) > 0.005, np.inf, 0.0), "not finite"),
        (lambda x, roller, parameters: 0.0, "shape"),
        (lambda x, roller, parameters: roller.bore, "has no attribute 'bore'"),
    ],
)
def test_a_profile_with_wrong_values_is_not_registered(drop: Any, words: str) -> None:
    item = RollerProfile("mine", "Mine", drop, "own work", profile_api=1)
    assert words in Collection().take([Entry("lambda_profiles", "guest 1.0", item)])


def test_a_profile_needs_a_free_name_a_version_and_a_reference() -> None:
    def flat(x: Any, roller: Any, parameters: Any) -> Any:
        return 0.0 * x

    for item, words in (
        (RollerProfile("crowned", "", flat, "own work", profile_api=1), "is one of the program"),
        (RollerProfile("mine", "", flat, "own work"), "write profile_api=1"),
        (RollerProfile("mine", "", flat, "own work", profile_api=2), "version 2 of the interface; this is 1"),
        (RollerProfile("mine", "", flat, " ", profile_api=1), "has no reference"),
    ):
        assert words in Collection().take([Entry("lambda_profiles", "guest 1.0", item)])


def test_plugins_show_and_check_know_a_profile(quartic: None, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("quartic.py", "profile/quartic", "quartic"):
        assert main(["plugins", "show", name if name != "quartic.py" else str(known_file())]) == 0
        out = capsys.readouterr().out
        assert out.startswith("profile/quartic   quartic.py")
        assert "drop at the end" in out
    assert main(["plugins", "check", "profile/quartic"]) == 0
    assert "ok  profile/quartic" in capsys.readouterr().out
    (card,) = api.plugin_parts("profile")
    assert (card.kind, card.parameters[0].default) == ("profile", "8 um")


def known_file() -> Path:
    """Return the file in use."""
    (path,) = local_files._texts
    return Path(path)
