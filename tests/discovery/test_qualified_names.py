"""Test laws of one name.

Each is known by its package, no package takes a name from another, and a case gets a message.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from types import FunctionType, ModuleType
from typing import Any

import pytest

from lambda_core import api
from lambda_core.case.case_io import read_case
from lambda_core.discovery import manager
from lambda_core.discovery.manager import discover
from lambda_core.domain.installed import PLUGINS, Source, installed
from lambda_core.domain.plugin_errors import PluginError
from lambda_core.laws.law import Law
from lambda_core.model.machine_templates import shaft_text
from lambda_core.plugins import Method, MethodTable, View, hookimpl
from lambda_core.studies.definition import Study
from lambda_core.studies.study_check import _case_toml


def kernel(slip: Any, p: Any, T: Any, ln_eta: Any, h: float, par: Any, tau: Any) -> int:
    for i in range(tau.size):
        tau[i] = 0.0
    return 1


def package(project: str, **items: Any) -> Source:
    """Return a package whose hooks register `items`: hook -> item."""

    def hook(item: Any) -> Any:
        def implementation(register: Callable[[Any], None]) -> None:
            register(item)

        return hookimpl(implementation)

    module = ModuleType(project.replace("-", "_"))
    vars(module).update({name: hook(item) for name, item in items.items()})
    return Source(project, "0.1", "main", lambda: module)


def law(name: str) -> Law:
    own = FunctionType(kernel.__code__, globals(), "kernel")  # each law has a kernel of its own
    return Law("traction", name, own, role_api=3, reference="own work")


@pytest.fixture
def crowded(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Return a program with ambiguous laws.

    Two packages have a law of one name, and one of a built-in's name.
    """
    sources = [
        *installed(PLUGINS),
        package("carreau-traction", lambda_laws=law("carreau")),
        package("other-oils", lambda_laws=law("carreau")),
        package("late", lambda_laws=law("ree-eyring")),
        package("alone", lambda_laws=law("single")),
    ]
    monkeypatch.setattr(manager, "installed", lambda group: sources)
    manager.registry.cache_clear()
    yield manager.registry()
    monkeypatch.undo()
    manager.registry.cache_clear()


def test_no_name_switches_a_package_off(crowded: Any) -> None:
    assert crowded.faults == ()
    names = crowded.names("traction")
    assert {"lambda-bearing:ree-eyring", "late:ree-eyring", "carreau-traction:carreau", "single"} <= set(names)
    assert crowded.origin("traction", "late:ree-eyring") == "late 0.1"
    assert crowded.model("traction", "other-oils:carreau").distribution == "other-oils 0.1"
    assert crowded.model("traction", "alone:single") is crowded.model("traction", "single")


def test_a_name_of_several_packages_is_told(crowded: Any) -> None:
    words = 'several traction models are called "carreau", choose one: carreau-traction:carreau, other-oils:carreau'
    with pytest.raises(PluginError, match=words):
        crowded.model("traction", "carreau")
    with pytest.raises(api.CaseError, match=f"models.traction +{words}"):
        api.check("6319-cp10-1500", ["models.traction=carreau"])


def test_a_case_that_says_nothing_keeps_the_built_in_law(crowded: Any) -> None:
    written = api.case("6319-cp10-1500").with_(models={"traction": None})
    assert api.check(written).laws["ball_inner"]["traction"].model.distribution.startswith("lambda-bearing ")
    with pytest.raises(api.CaseError, match="lambda-bearing:ree-eyring, late:ree-eyring"):
        api.check(written, ["models.traction=ree-eyring"])


def test_data_for_our_law_is_not_that_of_anothers_law_of_the_name(crowded: Any) -> None:
    model = api.check("6319-cp10-1500", ["models.traction=late:ree-eyring"])
    assert model.laws["ball_inner"]["traction"].model.qualified == "late:ree-eyring"


def test_results_write_the_qualified_name(crowded: Any) -> None:
    model = api.check("6319-cp10-1500", ["models.traction=single", "forces.ball_outer.models.traction=ree-eyring"][:1])
    assert 'traction = "alone:single"' in model.case_toml
    assert api.describe(model).headline[-1] == "laws of others: traction single (alone 0.1)"


def test_the_stored_case_of_a_machine_names_packages_of_laws(crowded: Any) -> None:
    """Name them for all bearings, one, and studies."""
    case = {
        **tomllib.loads(shaft_text("geared-shaft", "box")), "models": {"traction": "single"},
        "connections": {"foot": {"at": "left.outer_ring", "to": "ground", "law": "bushing"}},
    }  # fmt: skip
    case["bearings"]["left"]["models"] = {"traction": "late:ree-eyring"}
    study = {
        "name": "s", "case": "box", "parameters": [{"path": "operation.speed", "values": ["1 rpm"]}],
        "set": {"bearings.right.forces.ball_inner.models.traction": "single"},
    }  # fmt: skip
    stored = _case_toml(Study.model_validate(study), None, read_case(case))
    for text in (api.check(case).case_toml, stored):
        found = tomllib.loads(text)
        assert found["models"] == {"traction": "alone:single"}
        assert found["bearings"]["left"]["models"] == {"traction": "late:ree-eyring"}
        assert found["connections"]["foot"]["law"] == "bushing"
    assert found["bearings"]["right"]["forces"]["ball_inner"]["models"] == {"traction": "alone:single"}


def test_a_law_that_is_not_there_names_the_package_that_had_it(crowded: Any) -> None:
    with pytest.raises(PluginError, match=r'"gone:law" is not a traction model.*gone brings it: it is not installed'):
        crowded.model("traction", "gone:law")
    with pytest.raises(PluginError, match=r"law.py brings it: --plugin law.py takes it into use"):
        crowded.model("traction", "law.py:law")


def test_methods_and_views_of_a_taken_name_are_called_by_their_package() -> None:
    method = Method("skf", "t", "own work", lambda inputs: MethodTable(()), method_api=1)
    view = View("film", "t", "result", print, view_api=1)
    found = discover([*installed(PLUGINS), package("guest", lambda_methods=method, lambda_views=view)])
    assert found.faults == ()
    assert found.method("skf").distribution.startswith("lambda-bearing ")
    assert found.method("guest:skf").name == "guest:skf"
    assert found.view("guest:film").distribution == "guest 0.1"
    assert [str(note) for note in found.notes] == [
        f'guest 0.1 (skf): its method "skf" is called guest:skf: {found.origin("method", "skf")} has one of that name',
        f'guest 0.1 (film): its view "film" is called guest:film: {found.origin("view", "film")} has one of that name',
    ]
