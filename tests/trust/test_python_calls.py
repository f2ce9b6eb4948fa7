"""Test that wrong arguments of Python calls are refused."""

from __future__ import annotations

import inspect
import math
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.domain import public_call
from lambda_core.domain.errors import LambdaError, UsageError, name_parameters

API: Any = api  # for calls that a type checker refuses
CASE = "6208-axial-1300"
FUNCTIONS = {name: getattr(api, name) for name in api._HOME if inspect.isfunction(getattr(api, name))}


@pytest.mark.parametrize("source", [True, 1, None, 2.5, b"bytes"])
def test_a_source_that_is_no_case_is_named(source: Any) -> None:
    with pytest.raises(UsageError, match=rf"{type(source).__name__} is not a case: give a file"):
        api.check(source)


@pytest.mark.parametrize("change", [1, None, ["loads.radial", "1 N"], {"loads.radial": "1 N"}])
def test_a_change_that_is_no_text_is_named(change: Any) -> None:
    with pytest.raises(UsageError, match="is not a change: write path=value"):
        api.check("6208-axial-1300", [change])


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: API.electric_map(CASE, points=0), r"points = 0 is not allowed: give a text\. Speeds times"),
        (lambda: API.fit(CASE, None, ["loss_factor"]), "fit: measured = None is not allowed: give a path or"),
        (lambda: API.resume(None), "resume: path = None is not allowed: give a path. Result file of a run that"),
        (lambda: API.stribeck(CASE, speeds_rpm="100"), 'stribeck: speeds_rpm: "100" is a text, not a list'),
        (lambda: API.stribeck(CASE, speeds_rpm=[math.nan]), r"speeds_rpm = \[nan\] .*, a finite number"),
        (lambda: API.iterate(CASE, couple="x"), 'couple = \'x\' is not allowed: give "force" or "motion"'),
        (lambda: API.run(CASE, progress=3), "run: progress = 3 is not allowed: give callable"),
        (lambda: API.describe("model"), "describe: model = 'model' is not allowed: give BearingModel"),
        (lambda: API.check(CASE, catalogue=3), "check: catalogue = 3 is not allowed: give Catalogue"),
        (lambda: API.run(CASE, ou="x.h5"), "unexpected keyword argument 'ou'; nearest: out; it takes source,"),
        (lambda: API.fit(CASE), "fit: missing a required argument: 'measured'; it takes source, measured, vary"),
        (lambda: API.result("a" * 300), 'result: cannot use "aaa.*File name too long'),
        (lambda: list(API.view_all("a" * 300)), 'view_all: cannot use "aaa.*File name too long'),
        (lambda: list(API.view_all([])), "the list of results is empty: give at least one"),
        (lambda: API.view_stem([]), "the list of results is empty: give at least one"),
        (lambda: API.study_status("a\0b"), "study_status: folder holds a NUL character"),
        (lambda: API.check({"name": "x", 1: 2}), "1 is no name of an option: names are texts"),
    ],
)  # fmt: skip
def test_an_argument_of_another_type_or_range_is_named(call: Callable[[], object], words: str) -> None:
    with pytest.raises(LambdaError, match=words):
        call()


def test_numbers_of_numpy_and_arrays_are_numbers_and_lists() -> None:
    assert len(API.stribeck(CASE, speeds_rpm=np.array([100, 200])).speeds_rpm) == 2
    assert len(API.stribeck(CASE, points=np.int64(2)).speeds_rpm) == 2


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
def test_every_public_function_checks_and_keeps_its_face(name: str) -> None:
    """Compare signature, docstring and pickling of each function.

    Each argument has a check that works.
    """
    function = FUNCTIONS[name]
    plain = inspect.unwrap(function)
    assert inspect.signature(function) == inspect.signature(plain)
    assert function.__doc__ == plain.__doc__
    assert pickle.loads(pickle.dumps(function)) is function
    for parameter in inspect.signature(plain).parameters:
        public_call._adapter(plain, parameter)
    with pytest.raises(UsageError, match=f"^{name}: .*; it takes "):
        function(nothing_of_the_kind=1)


def test_errors_name_parameters_to_python_and_options_on_the_command_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    taken = api.init_case("taken", path=tmp_path / "taken.toml", bearing="SKF 6208")
    with pytest.raises(UsageError, match=r"another name \(out\), or overwrite it \(overwrite=True\)"):
        api.init_case("taken", path=taken, bearing="SKF 6208")
    assert main(["init", "taken", "--out", str(taken), "--bearing", "SKF 6208"]) == UsageError.exit_code
    assert "another name (--out), or overwrite it (--force)" in capsys.readouterr().err


def test_commands_in_errors_of_calls_can_be_typed() -> None:
    error = UsageError("leave out --bearing; lambda-bearing init NAME --as-machine writes a machine")
    name_parameters(error)
    assert str(error) == "leave out bearing; lambda-bearing init NAME --as-machine writes a machine"
