"""Test that one broken plugin is named and left out."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Annotated, Any, Literal

import pytest
from pydantic import BaseModel, Field

from lambda_core.discovery import manager
from lambda_core.discovery.manager import discover
from lambda_core.discovery.registry import Registry
from lambda_core.domain.errors import UsageError
from lambda_core.domain.installed import Source
from lambda_core.domain.plugin_errors import PluginError
from lambda_core.laws.law import Law, LazyLaw
from lambda_core.plugins import Method, MethodTable, Parameters, Quantity, hookimpl, parameter


def kernel(Lambda: float, par: Any, out: Any) -> int:
    """Write half of the load."""
    out[0] = 0.5
    return 1


class Unread(BaseModel):
    """A default that pydantic does not read."""

    tau: Annotated[float, Quantity("pressure")] = Field("6 MPa")


class Misspelt(Parameters):
    """A default with a unit that is none."""

    tau: Annotated[float, Quantity("pressure")] = parameter("6 MPs", "stress")


class Wordy(Parameters):
    """Parameters that no kernel can read."""

    edition: Literal["2008", "2018"] = parameter("2008", "edition")


def law(name: str = "half", *, role: str = "asperity_load", **changes: Any) -> Law:
    return Law(role, name, kernel, **({"reference": "own work", "role_api": 3} | changes))


def method(**changes: Any) -> Method:
    given = {
        "name": "trial",
        "title": "A trial",
        "reference": "own work",
        "evaluate": lambda inputs: MethodTable(()),
        "method_api": 1,
    }
    return Method(**(given | changes))


def hooks(**functions: Any) -> ModuleType:
    """Return a plugin module with these functions in it."""
    module = ModuleType("trial_plugin")
    vars(module).update(functions)
    return module


def plugin(*items: Any, hook: str = "lambda_laws") -> Any:
    """Return a plugin object whose hook registers `items`."""

    def implementation(register: Callable[[Any], None]) -> None:
        for item in items:
            register(item)

    return hooks(**{hook: hookimpl(implementation)})


def source(project: str, found: Any, name: str = "main") -> Source:
    """Return a plugin to load.

    An exception is raised instead of returned.
    """

    def load() -> object:
        if isinstance(found, BaseException):
            raise found
        return found

    return Source(project, "1.2", name, load)


GOOD = source("good", plugin(law("good-law")))


def faults(registry: Registry) -> dict[str, str]:
    return {fault.distribution: fault.message for fault in registry.faults}


def test_models_know_their_distribution_and_keep_their_order() -> None:
    registry = discover([source("first", plugin(law("b"), law("a"))), GOOD])
    assert registry.names("asperity_load") == ("b", "a", "good-law")
    assert registry.model("asperity_load", "a").distribution == "first 1.2"
    assert registry.model("asperity_load", "a").label == "asperity_load/a (first 1.2)"
    assert [m.name for m in registry.models("asperity_load").values()] == ["b", "a", "good-law"]
    assert registry.faults == ()


@pytest.mark.parametrize(
    ("broken", "words"),
    [
        (ModuleNotFoundError("No module named 'nowhere'"), ["cannot be imported", "ModuleNotFoundError", "nowhere"]),
        (SystemExit(3), ["cannot be imported", "SystemExit"]),
        (plugin(law(), hook="lambda_lwas"), ['"lambda_lwas" is not a known hook', "lambda_laws"]),
        (hooks(lambda_laws=hookimpl(lambda enrol: None)), ["does not fit the hooks", "enrol"]),
        (hooks(lambda_laws=lambda register: None), ["lambda_laws is not marked", "@hookimpl"]),
        (hooks(), ["has no law and implements no hook"]),
        ({"lambda_laws": 1}, ["is a dict", "has to name a module"]),
        (hooks(lambda_laws=hookimpl(lambda register: 1 / 0)), ["lambda_laws raised", "ZeroDivisionError"]),
        (plugin(law("twice"), law("twice")), ['"twice" is already taken by broken 1.2']),
        (
            plugin(law(role_api=1)),
            ["version 1 of the role interface; this program has 3", '@law("asperity_load", "half"'],
        ),
        (plugin(law(role="asperity_laod")), ['"asperity_laod"', "nearest: asperity_load"]),
        (plugin(law(parameters=Unread)), ['the default of tau is a text: declare it with parameter("6 MPa", ']),
        (plugin(law(parameters=Misspelt)), ["the default of tau is not valid", "MPs"]),
        (plugin(law(parameters=Wordy)), ["Wordy.edition (Literal) is neither a number nor an array of numbers"]),
        (plugin(law(prepare=lambda parameters, context: 1)), ["prepare does not say what it returns", "NamedTuple"]),
        (plugin(law("none")), ['the asperity_load name "none" has a meaning of its own']),
        (plugin(law("Half Load")), ['"Half Load" is not in lower case with hyphens']),
        (plugin(law(reference=" ")), ["has no reference"]),
        (plugin(law(parameters=dict)), ["not a pydantic BaseModel"]),
        (plugin(kernel), ["registers a function", "write @law(role, name"]),
        (plugin(LazyLaw("asperity_load", "x", "no target")), ['"package.module:attribute"']),
        (plugin("/nowhere/at/all", hook="lambda_data"), ["/nowhere/at/all does not exist"]),
        (plugin(object(), hook="lambda_methods"), ["lambda_methods registers a object", "Method(name, title"]),
        (plugin(method(method_api=7), hook="lambda_methods"), ["method trial is written for version 7"]),
        (plugin(method(method_api=None), hook="lambda_methods"), ["does not say for which version", "method_api=1"]),
        (plugin(method(reference=""), hook="lambda_methods"), ["method trial has no reference"]),
        (plugin(method(evaluate=3), hook="lambda_methods"), ["evaluates with a int, not a function"]),
        (plugin(object(), hook="lambda_views"), ["lambda_views registers a object", "View(name, title"]),
    ],
)
def test_a_broken_plugin_is_named_and_the_rest_works(broken: Any, words: list[str]) -> None:
    registry = discover([GOOD, source("broken", broken)])
    assert list(faults(registry)) == ["broken 1.2"]
    for word in words:
        assert word in faults(registry)["broken 1.2"]
    assert registry.names("asperity_load") == ("good-law",)


def test_a_plugin_is_taken_completely_or_not_at_all() -> None:
    registry = discover([GOOD, source("broken", plugin(law("fine"), law("Not a name")))])
    assert registry.names("asperity_load") == ("good-law",)


def test_methods_know_their_distribution() -> None:
    registry = discover([source("good", plugin(method(), hook="lambda_methods"))])
    assert registry.method("trial").distribution == "good 1.2"
    assert registry.origin("method", "trial") == "good 1.2"
    with pytest.raises(PluginError, match='"trail" is not a known method; nearest: trial'):
        registry.method("trail")


def test_the_catalogue_hook_of_a_refused_plugin_is_not_called() -> None:
    broken = plugin(law("Not a name"))
    broken.lambda_catalogue = hookimpl(lambda seed_folders: "a catalogue")
    with pytest.raises(PluginError, match=r"no plugin provides a catalogue; not in use: broken 1\.2"):
        discover([GOOD, source("broken", broken)]).catalogue()


def test_the_catalogue_gets_the_folders_of_all_plugins(tmp_path: Path) -> None:
    opener = hooks(lambda_catalogue=hookimpl(lambda seed_folders: SimpleNamespace(bearing=list(seed_folders))))
    registry = discover([source("store", opener), source("rows", plugin(str(tmp_path), hook="lambda_data"))])
    assert registry.catalogue().bearing == [tmp_path]  # type: ignore[comparison-overlap]
    assert registry.data_folders == (("rows 1.2", tmp_path),)


@pytest.mark.parametrize("name", ["good", "main"])
def test_a_plugin_is_switched_off_by_distribution_or_entry_point(name: str) -> None:
    registry = discover([GOOD], off=[name])
    assert registry.names("asperity_load") == ()
    assert faults(registry) == {"good 1.2": "is switched off"}
    assert not registry.faults[0].is_broken


def test_switching_off_what_is_not_installed_is_said() -> None:
    registry = discover([GOOD], off=["goood"])
    assert faults(registry) == {"goood": "is switched off but not installed; nearest: good"}
    assert registry.names("asperity_load") == ("good-law",)


def test_an_unknown_model_names_the_nearest_and_everything_there_is() -> None:
    own = source("lambda-bearing", plugin(law("zhou"), law("none")))
    registry = discover([own, GOOD, source("broken", RuntimeError("no"))])
    with pytest.raises(PluginError) as error:
        registry.model("asperity_load", "good-lwa")
    assert str(error.value) == (
        '"good-lwa" is not an asperity_load model; nearest: good-law; '
        "available: zhou, none, good-law (good 1.2); not in use: broken 1.2"
    )
    with pytest.raises(PluginError, match='"asperity" is not a known role; nearest: asperity_load'):
        registry.model("asperity", "none")


class TestLazyLaws:
    """A law that is named without being imported."""

    def lazy(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str, attribute: str = "kernel") -> Registry:
        (tmp_path / "lazy_laws.py").write_text(text)
        monkeypatch.syspath_prepend(str(tmp_path))
        monkeypatch.delitem(__import__("sys").modules, "lazy_laws", raising=False)
        return discover([source("lazy", plugin(LazyLaw("asperity_load", "half", f"lazy_laws:{attribute}")))])

    GOOD_TEXT = (
        "from lambda_core.plugins import law\n"
        "@law('asperity_load', {name!r}, reference='r', role_api={api})\n"
        "def kernel(Lambda, par, out):\n    out[0] = 0.5\n    return 1\n"
    )

    def test_imported_when_chosen(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        import sys

        registry = self.lazy(tmp_path, monkeypatch, self.GOOD_TEXT.format(name="half", api=3))
        assert registry.names("asperity_load") == ("half",)
        assert "lazy_laws" not in sys.modules
        assert registry.model("asperity_load", "half").distribution == "lazy 1.2"
        assert "lazy_laws" in sys.modules

    @pytest.mark.parametrize(
        ("text", "attribute", "words"),
        [
            ("import nowhere_at_all", "kernel", "cannot be imported: ModuleNotFoundError.*lazy_laws.py, line 1"),
            ("kernel = (", "kernel", "cannot be imported: SyntaxError"),
            ("", "kernel", "has no attribute 'kernel'"),
            ("kernel = 3", "kernel", "lazy_laws:kernel is a int, not a law"),
            (GOOD_TEXT.format(name="other", api=3), "kernel", "lazy_laws:kernel is asperity_load/other"),
            (GOOD_TEXT.format(name="half", api=9), "kernel", "version 9 of the role interface"),
        ],
    )
    def test_faults_name_the_model_and_its_distribution(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str, attribute: str, words: str
    ) -> None:
        registry = self.lazy(tmp_path, monkeypatch, text, attribute)
        with pytest.raises(PluginError, match=rf"asperity_load/half \(lazy 1\.2\).*{words}"):
            registry.model("asperity_load", "half")


def test_switch_off_knows_what_is_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(manager, "installed", lambda group: [GOOD])
    monkeypatch.setenv(manager.OFF_VARIABLE, " other ,")
    with pytest.raises(UsageError, match='"goo" is not a known plugin; nearest: good'):
        manager.switch_off(["goo"])
    manager.switch_off(["good", "good"])
    assert manager.switched_off() == ("other", "good")
    assert faults(manager.registry())["good 1.2"] == "is switched off"
    manager.registry.cache_clear()
