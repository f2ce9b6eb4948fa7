"""Test that `warmup` compiles what is missing."""

from __future__ import annotations

import json
from types import SimpleNamespace

import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.discovery.manager import registry
from lambda_core.domain.roles import ROLES
from lambda_core.solver import entry


def test_after_it_nothing_is_left_to_compile(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["warmup", "--json"]) == 0
    first = json.loads(capsys.readouterr().out)
    assert first["laws"] == sum(len(registry().names(role)) for role in ROLES)
    assert first["solver_parts"] == len(entry.UNITS) + len(entry.OF_ROLLERS)
    assert first["faults"] == []
    assert entry.missing((*entry.UNITS, *entry.OF_ROLLERS)) == []
    said: list[str] = []
    again = api.warmup(announce=said.append)
    assert said == []
    assert again.laws_compiled == again.solver_parts_compiled == 0


def test_what_is_compiled_is_announced(
    monkeypatch: pytest.MonkeyPatch, tmp_path: object, capsys: pytest.CaptureFixture[str]
) -> None:
    """Compile every law into an empty cache.

    The solver is left out because it takes too long.
    """
    monkeypatch.setenv("LAMBDA_BEARING_CACHE", str(tmp_path))
    monkeypatch.setattr("lambda_core.runs.warmup.begin", lambda announce, units, has_rollers: None)
    solver = SimpleNamespace(find=lambda name: None)
    monkeypatch.setattr("lambda_core.runs.warmup.core", lambda announce: solver)
    monkeypatch.setattr("lambda_core.runs.warmup.roller_unit", lambda solver, name: None)
    monkeypatch.setattr("lambda_core.runs.warmup.missing", list)
    wanted = ("damping", "asperity_load")
    monkeypatch.setattr("lambda_core.runs.warmup.ROLES", {role: ROLES[role] for role in wanted})
    assert main(["warmup"]) == 0
    out, err = capsys.readouterr()
    for role in wanted:
        for name in registry().names(role):
            assert f"compiling {role}/{name}" in err
    laws = sum(len(registry().names(role)) for role in wanted)
    assert f"{laws}, {len(err.splitlines())} compiled now" in out
    assert str(tmp_path) in out


def test_a_law_that_cannot_be_compiled_is_named_and_the_others_are_compiled(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from lambda_core.domain.plugin_errors import PluginError
    from lambda_core.laws.kernels import compile_kernel

    def compile_most(model: object, announce: object) -> object:
        if model.name == "cubic":  # type: ignore[attr-defined]
            raise PluginError("damping/cubic cannot be compiled: of a test")
        return compile_kernel(model, announce)  # type: ignore[arg-type]

    monkeypatch.setattr("lambda_core.runs.warmup.compile_kernel", compile_most)
    monkeypatch.setattr("lambda_core.runs.warmup.ROLES", {"damping": ROLES["damping"]})
    assert main(["warmup", "--quiet"]) == 3
    assert "not compiled: damping/cubic cannot be compiled: of a test" in capsys.readouterr().out
