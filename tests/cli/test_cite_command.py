"""Test that `cite` names the sources of the laws used."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.discovery.manager import registry
from lambda_core.domain.roles import ROLES


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a short run of other laws.

    Some are not the default.
    """
    path = tmp_path_factory.mktemp("cite") / "run.h5"
    changes = ["models.film_thickness=hamrock-dowson", "forces.ball_inner.models.traction=bair-winer"]
    api.run("6208-axial-700", [*changes, "solver.duration=0.2 ms"], out=path)
    return path


def test_exactly_the_laws_of_the_run_are_named(file: Path) -> None:
    found = api.cite(file)
    used = {
        (element, role, law.model.name)
        for element, roles in api.check(api.case(_case(file))).laws.items()
        for role, law in roles.items()
    }
    named = {(element, *law.law.split("/")) for law in found.laws for element in law.elements}
    assert named == {entry for entry in used if _reference(entry) != "-"}
    assert set(found.without_reference) == {
        f"{role}/{name}" for _, role, name in used if _reference((role, name)) == "-"
    }
    for law in found.laws:
        assert law.reference == _reference(law.law.split("/"))


def _case(file: Path) -> str:
    path = file.with_suffix(".toml")
    path.write_text(api.result(file).case_toml, encoding="utf-8")
    return str(path)


def _reference(entry: tuple[str, ...] | list[str]) -> str:
    return registry().model(entry[-2], entry[-1]).reference


def test_the_two_rings_may_have_laws_of_their_own(file: Path) -> None:
    elements = {law.law: law.elements for law in api.cite(file).laws}
    assert elements["traction/bair-winer"] == ["ball_inner"]
    assert elements["traction/ree-eyring"] == ["ball_outer"]
    assert elements["film_thickness/hamrock-dowson"] == ["ball_inner", "ball_outer"]


def test_the_text_has_the_program_its_version_and_every_used_law(
    file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["cite", str(file)]) == 0
    text = capsys.readouterr().out
    for law in api.cite(file).laws:
        assert law.law in text
        assert law.reference in text
    assert f"version {api.result(file).versions['lambda-bearing']}" in text
    assert "chittenden" not in text
    unused = {registry().model(role, name).reference for role in ROLES for name in registry().names(role)}
    unused -= {law.reference for law in api.cite(file).laws} | {"-"}
    assert unused
    lines = [line.strip() for line in text.splitlines()]
    assert not [reference for reference in unused if reference in lines]


def test_the_data_of_bearing_and_oil_are_named(file: Path) -> None:
    sources = {source for data in api.cite(file).data for source in [data.source]}
    assert any("Table 6" in source for source in sources)
    paths = {path for data in api.cite(file).data for path in data.values}
    assert "bearing.ball_diameter" in paths


def test_json_is_the_complete_answer(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["cite", str(file), "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == api.cite(file).model_dump(mode="json")


def test_a_file_that_is_no_result_is_said_so(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "x.h5"
    path.write_text("no")
    assert main(["cite", str(path)]) == 2
    assert "is not a result file" in capsys.readouterr().err


def test_bibtex_has_the_publications_of_the_run_and_no_other(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["cite", str(file), "--bibtex"]) == 0
    text = capsys.readouterr().out
    for key in ("@software{lambda-bearing,", "@article{syla2026,", "@article{hamrock1977,", "@article{bair1979,"):
        assert key in text
    assert "chittenden" not in text
    assert main(["cite", str(file), "--bibtex", "--json"]) == 2
    assert "give either --json or --bibtex" in capsys.readouterr().err
