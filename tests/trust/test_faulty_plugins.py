"""What a plugin's own code does wrong is told with the plugin's name, and the others go on."""

from __future__ import annotations

from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

from lambda_core.discovery.manager import discover, registry
from lambda_core.discovery.shown import data_of
from lambda_core.domain.installed import Source
from lambda_core.domain.plugin_errors import PluginError, blamed
from lambda_core.laws.jit.reach import UnreachableError, reach
from lambda_core.views.method import Method, MethodTable, NotApplicable, evaluate_methods
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
