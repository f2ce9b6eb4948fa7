"""Test that plugin errors name the plugin.

The other plugins continue to work.
"""

from __future__ import annotations

import json
import logging
import time
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest
import typer
from lambda_cli import commands
from lambda_cli.main import main
from pydantic import field_validator

from lambda_core import api
from lambda_core.discovery import manager, survey
from lambda_core.discovery.manager import discover, registry
from lambda_core.discovery.shown import data_of
from lambda_core.domain.installed import COMMANDS, PLUGINS, Source, in_use, installed
from lambda_core.domain.plugin_errors import PluginError, blamed, failures_so_far
from lambda_core.laws.check import check_model
from lambda_core.laws.jit.reach import UnreachableError, reach
from lambda_core.laws.law import Law
from lambda_core.plugins import Axis, NoParameters, Options, Panel, Parameters, ViewData, hookimpl, parameter
from lambda_core.studies import job
from lambda_core.views.method import Method, MethodRow, MethodTable, NotApplicable, evaluate_methods
from lambda_core.views.view import View


def fail(*_: Any) -> Any:
    raise KeyError("rows")


def leave(*_: Any) -> Any:
    raise SystemExit(9)


def number(*_: Any) -> Any:
    return 42


def test_a4_a_method_that_fails_does_not_stop_the_others() -> None:
    good = MethodTable(())
    methods = [
        Method("failing", "", "none", fail, distribution="guest 1.0", method_api=1),
        Method("leaving", "", "none", leave, distribution="guest 1.0", method_api=1),
        Method("counting", "", "none", number, distribution="guest 1.0", method_api=1),
        Method("good", "", "none", lambda inputs: good, method_api=1),
    ]
    answers = evaluate_methods(methods, SimpleNamespace())  # type: ignore[arg-type]
    assert [answer.table for answer in answers] == [None, None, None, good]
    assert answers[0].reason.startswith("the method \"failing\" (guest 1.0) fails: KeyError: 'rows' (test_faulty")
    assert "SystemExit: 9" in answers[1].reason
    assert answers[2].reason == 'the method "counting" (guest 1.0) returns a int, not a MethodTable'


@pytest.mark.parametrize(("data", "words"), [(fail, "KeyError"), (leave, "SystemExit"), (number, "not a ViewData")])
def test_a4_a_view_that_fails_is_named(data: Any, words: str) -> None:
    view = View("guest", "a guest", "result", data, distribution="guest 1.0", view_api=1)
    with pytest.raises(PluginError, match=rf'the view "guest" \(guest 1\.0\) .*{words}'):
        data_of(view, None, {})


@pytest.mark.parametrize(("catalogue", "words"), [(fail, "fails: KeyError"), (number, 'a int, which has no "bearing"')])
def test_a4_a_catalogue_that_fails_is_named(catalogue: Any, words: str, monkeypatch: pytest.MonkeyPatch) -> None:
    one = SimpleNamespace(plugin_name="guest:main", function=lambda: catalogue(), argnames=())
    hook = SimpleNamespace(lambda_catalogue=SimpleNamespace(get_hookimpls=lambda: [one]))
    found = registry()
    monkeypatch.setattr(found, "_hooks", SimpleNamespace(hook=hook))
    with pytest.raises(PluginError, match=f"lambda_catalogue of guest .*{words}|lambda_catalogue of guest {words}"):
        found.catalogue()


def test_a4_the_programs_own_errors_keep_their_words() -> None:
    with pytest.raises(NotApplicable, match="no cage"), blamed("the view"):
        raise NotApplicable("no cage")
    with pytest.raises(KeyboardInterrupt), blamed("the view"):
        raise KeyboardInterrupt


def test_a4_a_kernel_that_prints_is_refused() -> None:
    def kernel(delta: float, out: Any) -> int:
        print(delta)
        return 1

    with pytest.raises(UnreachableError, match="prints: a kernel is a function of its arguments only"):
        reach(kernel)


def test_a4_words_at_import_do_not_go_where_data_goes(capsys: pytest.CaptureFixture[str]) -> None:
    def load() -> ModuleType:
        print("words at import")
        return ModuleType("guest")

    source = Source("guest", "1.0", "main", load)
    discover([source])
    said = capsys.readouterr()
    assert said.out == ""
    assert "words at import" in said.err


def package(name: str = "guest", **hooks: Any) -> Source:
    """Return a package with faulty hooks.

    It registers one item per hook, or implements a hook that answers.
    """
    module = ModuleType(name)
    for hook, item in hooks.items():

        def registering(register: Any, item: Any = item) -> None:
            register(item)

        vars(module)[hook] = hookimpl(
            item if hook in ("lambda_figure", "lambda_catalogue", "lambda_frames") else registering
        )
    return Source(name, "1.0", "main", lambda: module)


@pytest.fixture
def install_also(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Install further packages and commands.

    In addition to the present ones, for one test.
    """

    def install(*sources: Source, of: tuple[Source, ...] = ()) -> None:
        known = {PLUGINS: [*installed(PLUGINS), *sources], COMMANDS: [*in_use(COMMANDS), *of]}
        monkeypatch.setattr(manager, "installed", lambda group: known[group])
        for module in (commands, survey):
            monkeypatch.setattr(module, "in_use", lambda group: sorted(known[group], key=lambda each: each.name))
        manager.registry.cache_clear()

    yield install
    monkeypatch.undo()
    manager.registry.cache_clear()


def printing(*_: Any) -> MethodTable:
    print("words of a method")
    return MethodTable(())


def test_a4_compare_goes_on_without_a_method_that_fails(install_also: Any, capsys: pytest.CaptureFixture[str]) -> None:
    install_also(
        package("one", lambda_methods=Method("failing", "", "none", fail, method_api=1)),
        package("two", lambda_methods=Method("talking", "", "none", printing, method_api=1)),
    )
    changes = ["--method", "failing", "--method", "talking", "--method", "skf"]
    assert main(["compare", "6208-axial-1300", *changes, "--json", "--quiet"]) == 3
    said = capsys.readouterr()
    found = {method["name"]: method for method in json.loads(said.out)["methods"]}
    assert found["failing"]["failed"]
    assert "the method \"failing\" (one 1.0) fails: KeyError: 'rows' (test_faulty" in found["failing"]["reason"]
    assert found["skf"]["numbers"]
    assert not found["skf"]["failed"]
    assert "words of a method" in said.err


def test_a4_a_study_keeps_the_torque_of_a_point_at_which_a_method_fails(install_also: Any) -> None:
    install_also(package(lambda_methods=Method("failing", "", "none", fail, method_api=1)))
    names = ("friction_torque_Nmm", "failing/friction/total")
    case = api.check("6208-axial-1300").case_toml
    outcome = job.work(job.Task(0, case, (), "quasi-static", names, ""))
    assert outcome.state == "partial"
    assert (outcome.values["friction_torque_Nmm"] or 0.0) > 0.0
    assert outcome.values["failing/friction/total"] is None
    assert 'the method "failing" (guest 1.0) fails: KeyError' in outcome.reason


class Unsaved:
    """A figure that cannot be saved."""

    def savefig(self, *_: Any, **__: Any) -> None:
        raise KeyError("axes")


def nothing(subject: Any, options: Options) -> ViewData:
    return ViewData("guest", "a guest", "nowhere", (Panel("nothing", Axis("x", ""), Axis("y", "")),))


@pytest.mark.full
@pytest.mark.parametrize(
    ("figure", "words"),
    [(fail, "KeyError: 'rows'"), (number, 'a int, which has no "savefig"'), (lambda _: Unsaved(), "KeyError: 'axes'")],
)
def test_a4_a_drawing_that_fails_is_named_and_the_others_are_drawn(
    install_also: Any, figure: Any, words: str, combined_run: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    install_also(package(lambda_views=View("guest", "a guest", "result", nothing, figure=figure, view_api=1)))
    kept = {name: view for name, view in registry().views.items() if name in ("guest", "pressure")}
    monkeypatch.setattr(registry(), "views", kept)
    assert main(["view", str(combined_run.path), "--out", str(tmp_path), "--format", "svg"]) == 3
    said = capsys.readouterr()
    assert words in said.err
    assert "(guest 1.0)" in said.err
    assert [path.name.endswith("-pressure.svg") for path in tmp_path.iterdir()] == [True]
    page = tmp_path / "page.html"
    assert main(["report", str(combined_run.path), "--out", str(page), "--appendix", "views"]) == 3
    assert "(guest 1.0)" in page.read_text()


def test_a4_a_catalogue_or_drawing_that_fails_leaves_it_to_the_next(
    install_also: Any, caplog: pytest.LogCaptureFixture
) -> None:
    install_also(package(lambda_catalogue=lambda seed_folders: fail(), lambda_figure=lambda data: number()))
    before = len(failures_so_far())
    with caplog.at_level(logging.WARNING, "lambda_core"):
        model = api.check("6208-axial-1300")
        assert hasattr(registry().figure(None, nothing(None, Options())), "savefig")
    failure = "lambda_catalogue of guest fails: KeyError: 'rows' (test_faulty_plugins.py, line"
    assert any(line.startswith(f"values are those of another catalogue: {failure}") for line in model.assumptions)
    assert any(failure in record.getMessage() for record in caplog.records)
    assert any("lambda_figure of guest returns a int" in told for told in failures_so_far()[before:])


def test_a4_frames_that_fail_are_named(install_also: Any) -> None:
    def frames(scene: Any) -> Any:
        yield 1
        raise KeyError("frame")

    install_also(package(lambda_frames=frames))
    found = registry().frames(None)  # type: ignore[arg-type]
    assert next(found) == 1  # type: ignore[comparison-overlap]
    with pytest.raises(PluginError, match="lambda_frames fails: KeyError: 'frame'"):
        next(found)


def command(name: str, project: str, found: Any) -> Source:
    def load() -> Any:
        return fail() if found is fail else found

    return Source(project, "1.0", name, load, f"{project}:{name}")


def broken_at_call() -> None:
    raise RuntimeError("boom")


def leaving() -> None:
    raise typer.Exit(7)


@pytest.mark.parametrize(
    ("found", "code", "words"),
    [
        (broken_at_call, 3, 'the command "guest" of guest 1.0 fails: RuntimeError: boom (test_faulty_plugins.py'),
        (fail, 3, "the command \"guest\" of guest 1.0 fails: KeyError: 'rows'"),
        (42, 3, 'the command "guest" of guest 1.0 fails: TypeError'),
        (leaving, 7, ""),
    ],
)
def test_a4_a_command_that_fails_is_named(
    install_also: Any, found: Any, code: int, words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    install_also(of=(command("guest", "guest", found),))
    assert main(["guest"]) == code
    said = capsys.readouterr()
    assert (said.out, words in said.err) == ("", True)
    assert "bug" not in said.err


def test_a4_two_commands_of_one_name_are_told(install_also: Any, capsys: pytest.CaptureFixture[str]) -> None:
    def one() -> None:
        typer.echo("one")

    def two() -> None:
        typer.echo("two")

    install_also(
        of=(command("salt", "a-package", one), command("salt", "b-package", two), command("run", "b-package", two))
    )
    assert {"salt", "b-package:salt", "b-package:run", "run"} <= set(commands.entries())
    assert main(["salt"]) == 0
    assert main(["b-package:salt"]) == 0
    assert capsys.readouterr().out.split() == ["one", "two"]
    assert main(["plugins", "list", "--json"]) == 0
    listed = json.loads(capsys.readouterr().out)
    assert ("command", "salt", "a-package 1.0") in {(i["kind"], i["name"], i["distribution"]) for i in listed["items"]}
    assert listed["notes"] == [
        {"distribution": "b-package 1.0", "message": 'its command "run" is called b-package:run: the name is taken'},
        {"distribution": "b-package 1.0", "message": 'its command "salt" is called b-package:salt: the name is taken'},
    ]


def test_a4_a_slow_import_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(manager, "_SLOW_IMPORT", 0.01)

    def load() -> ModuleType:
        time.sleep(0.02)
        return package(lambda_methods=Method("fine", "", "none", printing, method_api=1)).load()  # type: ignore[return-value]

    (note,) = discover([Source("late", "1.0", "main", load)]).notes
    assert (note.distribution, "its import took " in note.message) == ("late 1.0", True)


class Rude(Parameters):
    """Parameters whose check raises what no check should."""

    share: float = parameter(0.5, "share")

    @field_validator("share")
    @classmethod
    def _check(cls, value: float) -> float:
        raise RuntimeError("not like this")


def still(delta: float, delta_dot: float, load: float, par: Any, out: Any) -> int:
    out[0] = 0.0
    return 1


def loud(parameters: Any, context: Any) -> NoParameters:
    print("words of prepare")
    raise SystemExit(9)


def test_a4_parameters_that_raise_at_discovery_leave_the_package_out() -> None:
    rude = Law("damping", "rude", still, Rude, role_api=3, reference="none")
    (fault,) = discover([package(lambda_laws=rude)]).faults
    assert fault.message.startswith("cannot be taken: RuntimeError: not like this (test_faulty_plugins.py, line ")


def test_a4_a_prepare_that_prints_and_leaves_is_a_sentence(capsys: pytest.CaptureFixture[str]) -> None:
    law = Law("damping", "loud", still, role_api=3, reference="none", prepare=loud, distribution="guest 1.0")
    report = check_model(law)
    assert "damping/loud (guest 1.0): the parameters cannot be prepared: SystemExit: 9" in report.faults[0]
    said = capsys.readouterr()
    assert (said.out, "words of prepare" in said.err) == ("", True)


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        ((3,), "a row that is a int, not a MethodRow"),
        ((MethodRow("friction", "total", "much", "N mm"),), "friction total = 'much', which is not a number"),  # type: ignore[arg-type]
    ],
)
def test_a4_rows_of_a_wrong_kind_are_named(rows: Any, words: str) -> None:
    method = Method("odd", "", "none", lambda inputs: MethodTable(rows), distribution="guest 1.0")
    (answer,) = evaluate_methods([method], SimpleNamespace())  # type: ignore[arg-type]
    assert (answer.failed, answer.reason.endswith(words)) == (True, True)
