"""Test that data packages that replace rows are named."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from lambda_db.check import check_catalogue

from lambda_core import api
from lambda_core.discovery import manager
from lambda_core.discovery.manager import registry
from lambda_core.domain.installed import PLUGINS, Source, installed
from lambda_core.plugins import hookimpl

CASE = "6319-cp10-1500"  # with the oil FVA3A
PARAMETER = (
    "lubricant,role,model,name,value,unit,source,grade\nFVA3A,traction,ree-eyring,tau_eyring,600,MPa,{source},A\n"
)
SOURCE = "key,title\n{key},Fabricated and Evil 2030\n"


@pytest.fixture
def brings(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Callable[..., None]]:
    """Install a package with seed files.

    Next to the installed ones.
    """
    monkeypatch.setenv("LAMBDA_BEARING_CACHE", str(tmp_path / "cache"))

    def install(**files: str) -> None:
        folder = tmp_path / "rows"
        folder.mkdir()
        for name, text in files.items():
            (folder / f"{name}.csv").write_text(text)

        def rows(register: Any) -> None:
            register(folder)

        module = ModuleType("evil")
        vars(module)["lambda_data"] = hookimpl(rows)
        sources = [*installed(PLUGINS), Source("evil", "1.0", "main", lambda: module)]
        monkeypatch.setattr(manager, "installed", lambda group: sources)
        registry.cache_clear()

    yield install
    monkeypatch.undo()
    registry.cache_clear()


def findings() -> list[tuple[str, str]]:
    catalogue = registry().catalogue()
    try:
        return [(found.where, found.message) for found in check_catalogue(catalogue, registry())]  # type: ignore[arg-type]
    finally:
        catalogue.close()


def source_of_fva3a() -> str:
    """Return the built-in oil's source key."""
    from lambda_db.built import BUILT_IN
    from lambda_db.seed_files import read_path

    rows = [cells for _, _, table, cells in read_path(BUILT_IN) if table == "lubricant_parameter"]
    return next(str(row["source"]) for row in rows if row["lubricant"] == "FVA3A" and row["role"] == "permittivity")


@pytest.mark.full
def test_a4_a_parameter_in_front_of_a_built_in_one_is_an_assumption(brings: Callable[..., None]) -> None:
    before = api.check(CASE).assumptions
    brings(lubricant_parameter=PARAMETER.format(source="evil"), source=SOURCE.format(key="evil"))
    words = "the data of the lubricant FVA3A for traction ree-eyring: from evil 1.0, in place of that of the built-in"
    model = api.check(CASE)
    assert not any("evil" in line for line in before)
    assert [line for line in model.assumptions if line.startswith(words)]
    assert [where for where, _ in findings() if where == "lubricant_parameter FVA3A traction ree-eyring"]
    assert not any("evil" in line for line in api.check("6208-axial-1300", ["lubricant.name=FVA2"]).assumptions)


def test_a4_a_source_of_another_text_is_an_assumption(brings: Callable[..., None]) -> None:
    key = source_of_fva3a()
    brings(source=SOURCE.format(key=key))
    (line,) = [line for line in api.check(CASE).assumptions if "evil" in line]
    assert line.startswith(
        f'the source {key} is "Fabricated and Evil 2030" by evil 1.0; in the built-in catalogue it is'
    )
    (message,) = [message for where, message in findings() if where == f"source {key}"]
    assert message.startswith('evil 1.0 makes it "Fabricated and Evil 2030", it was "')


def test_a4_new_rows_shadow_nothing(brings: Callable[..., None]) -> None:
    brings(source=SOURCE.format(key="quite-new"))
    assert not any("evil" in line for line in api.check(CASE).assumptions)
    assert not any("evil" in message for _, message in findings())


def test_a4_bad_rows_are_named_and_the_rest_goes_on(brings: Callable[..., None]) -> None:
    brings(lubricant_parameter=PARAMETER.format(source="evil").replace("600", "much"))
    model = api.check(CASE)
    assert any("evil" in line and '"much" is not a number' in line for line in model.assumptions)


def test_a2_an_oil_that_passes_the_check_runs(brings: Callable[..., None]) -> None:
    """Resolve an oil with data for its rheology.

    Every default law accepts it; missing data are reported.
    """
    brings(
        source="key,title\nmine,My own measurement\n",
        lubricant="name,base_type,rheology,note\nmine,mineral,roelands,my own\n",
        lubricant_parameter="lubricant,role,model,name,value,unit,source,grade\n"
        + "".join(
            f"mine,rheology,roelands,{name},{value},{unit},mine,B\n"
            for name, value, unit in (
                ("kinematic_viscosity_40", 46, "mm2/s"), ("kinematic_viscosity_100", 6.8, "mm2/s"),
                ("density_15", 870, "kg/m3"), ("density_slope", -0.65, ""), ("alpha_p", 20, "1/GPa"),
            )
        ),
    )  # fmt: skip
    assert not [message for where, message in findings() if where == "lubricant mine"]
    model = api.check(CASE, ["lubricant.name=mine"])
    assert any("mine has no data for bode" in line for line in model.assumptions)
    assert api.law_problems(model) == ()


def test_a2_the_check_of_a_package_looks_at_its_rows(brings: Callable[..., None]) -> None:
    brings(lubricant_parameter=PARAMETER.format(source="evil").replace("600", "much"))
    (fault,) = api.plugin_faults(["evil"])
    assert (fault.distribution, fault.entry_point) == ("evil 1.0", "lambda_data")
    assert '"much" is not a number' in fault.message
