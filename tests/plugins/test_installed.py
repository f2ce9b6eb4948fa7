"""Test a good third-party package among bad ones.

It works, each bad one is named, the program goes on.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from .conftest import Installation, write_package

HEAD = """
import math
from lambda_core.plugins import Parameters, Quantity, hookimpl, law, parameter

class Limit(Parameters):
    ratio: float = parameter(0.07, "limiting stress over pressure")

"""
LAW = """
@law("traction", "{name}", Limit, role_api={api}, reference="own work")
def kernel(slip, p, T, ln_eta, h, par, tau):
    for i in range(tau.size):
        newtonian = math.exp(min(ln_eta[i], 40.0)) * slip[i] / h[i]
        limit = {ratio} * p[i]
        tau[i] = {result}
    return {status}

@hookimpl
def {hook}(register):
    register(kernel)
"""
SOUND = "newtonian * limit / (newtonian + limit + 1e-300)"


def code(
    result: str = SOUND,
    status: str = "1",
    hook: str = "lambda_laws",
    name: str = "",
    api: int = 3,
    ratio: str = "par.ratio",
) -> str:
    return HEAD + LAW.format(result=result, status=status, hook=hook, name=name, api=api, ratio=ratio)


# A whole plugin as it was written for version 1.
OLD = """
from pydantic import BaseModel
from lambda_core.plugins import hookimpl, model

class Parameters(BaseModel):
    ratio: float = 0.07

def kernel(slip, p, T, ln_eta, h, par, tau):
    for i in range(tau.size):
        tau[i] = par[0] * p[i]
    return 1

@hookimpl
def lambda_models(register):
    register(model("traction", "old-form", kernel, Parameters, reference="own work"))
"""


PACKAGES = {
    # not in use at all: found at discovery
    "bad-import": "import a_library_that_is_not_installed\n",
    "bad-hook": code(name="bad-hook", hook="lambda_lwas"),
    "bad-name": code(name="Bad_Name"),
    "bad-version": code(name="bad-version", api=1),
    "bad-second": code(name="bad-second", api=2),
    "bad-future": code(name="bad-future", api=4),
    "old-form": OLD,
    # listed, refused when chosen or checked
    "bad-signature": code(name="bad-signature").replace("p, T, ln_eta", "T, p, ln_eta"),
    "bad-return": code(name="bad-return", status="0.7"),
    "bad-number": code(name="bad-number", result="math.nan"),
    "bad-status": code(name="bad-status", status="4"),
    "bad-index": code(name="bad-index", result="p[i + 1]"),
    "bad-position": code(name="bad-position", ratio="par[0]"),
    "bad-speed": code(name="bad-speed", result=f"{SOUND} + 0.0 * burnt").replace(
        "    for i in",
        "    burnt = 0.0\n    for k in range(500):\n        burnt += math.exp(-slip[0] * k)\n    for i in",
    ),
    "harbour-traction": code(name="harbour"),
}
SENTENCES = {
    "bad-import": "cannot be imported: ModuleNotFoundError: No module named 'a_library_that_is_not_installed'",
    "bad-hook": '"lambda_lwas" is not a known hook; nearest: lambda_laws',
    "bad-name": 'the traction name "Bad_Name" is not in lower case with hyphens ("my-law")',
    "bad-version": "traction/bad-version is written for version 1 of the role interface; this program has 3: "
    'write @law("traction", "bad-version", Limit, role_api=3, reference=...) above the kernel and read par.ratio',
    "bad-second": "traction/bad-second is written for version 2 of the role interface; this program has 3: "
    "take the film as an array, h[i] in place of h, and write role_api=3",
    "bad-future": "traction/bad-future is written for version 4 of the role interface; this program has 3",
    "old-form": "model belongs to version 1 of the role interface: write @law(",
}
REFUSALS = {
    "bad-signature": "takes (slip, T, p, ln_eta, h, par, tau); traction kernels take (slip, p, T, ln_eta, h, par, tau)",
    "bad-return": "returns float64 in place of an int64 status",
    "bad-number": "leaves shear stress [Pa] unwritten or returns NaN with status 1",
    "bad-status": "returns the status 4; declared: 1",
    "bad-index": "reads or writes outside its arrays: IndexError",
    "bad-position": "reads par[0], but since version 2 its parameters have names: write par.ratio",
}


@pytest.fixture(scope="module")
def site(install: Callable[..., Installation], tmp_path_factory: pytest.TempPathFactory) -> Installation:
    root = tmp_path_factory.mktemp("sources")
    return install([write_package(root, name, text) for name, text in PACKAGES.items()])


def test_every_plugin_that_cannot_be_used_is_named(site: Installation) -> None:
    answer = site.program("plugins", "list", "--json")
    assert answer.code == 0
    faults = {fault["distribution"]: fault for fault in answer.data["faults"]}
    assert set(faults) == {f"{name} 0.3" for name in SENTENCES}
    for name, sentence in SENTENCES.items():
        assert sentence in faults[f"{name} 0.3"]["message"]
    found = {item["name"]: item["distribution"] for item in answer.data["items"] if item["role"] == "traction"}
    assert found["harbour"] == "harbour-traction 0.3"
    assert found["ree-eyring"].startswith("lambda-bearing ")
    assert set(REFUSALS) < set(found)


def test_the_list_for_people_names_them_too(site: Installation) -> None:
    answer = site.program("plugins", "list", "--role", "traction")
    lines = answer.out.splitlines()
    assert any(line.split()[:4] == ["model", "traction", "harbour", "harbour-traction"] for line in lines)
    assert any(line.startswith("not in use: bad-import 0.3 (main): cannot be imported") for line in lines)


# What the kernel does wrong: tests/discovery/test_check.py has more of that, without an installation.
WRONG_KERNELS = {"bad-number", "bad-return", "bad-status"}


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=[pytest.mark.full] * (name in WRONG_KERNELS), id=name) for name in sorted(REFUSALS)],
)
def test_a_model_that_breaks_the_convention_is_refused(site: Installation, name: str) -> None:
    answer = site.program("plugins", "check", name, "--json")
    assert answer.code == 3
    (card,) = answer.data["models"]
    assert not card["ok"]
    assert card["faults"][0].startswith(f"traction/{name} ({name} 0.3)")
    assert REFUSALS[name] in card["faults"][0]


@pytest.mark.timeout(900)  # the first test of a session that needs the solver compiles it
@pytest.mark.parametrize(
    "name", ["bad-number", *(pytest.param(name, marks=pytest.mark.full) for name in ("bad-return", "bad-index"))]
)
def test_a_run_with_such_a_model_is_refused_before_it_starts(site: Installation, tmp_path: Path, name: str) -> None:
    out = tmp_path / "result.h5"
    answer = site.program("run", "6319-cp10-1500", "--set", f"models.traction={name}", "--quiet", "--out", str(out))
    assert (answer.code, answer.out) == (3, "")
    assert f"traction/{name} ({name} 0.3)" in answer.err
    assert REFUSALS[name] in answer.err
    assert not out.exists()


@pytest.mark.full
def test_a_slow_model_is_named(site: Installation) -> None:
    answer = site.program("plugins", "check", "bad-speed")
    assert answer.code == 0
    assert "traction/bad-speed (bad-speed 0.3) is slow" in answer.out


def test_the_good_one_passes(site: Installation) -> None:
    answer = site.program("plugins", "check", "traction/harbour", "harbour-traction", "--json")
    assert answer.code == 0
    (card,) = answer.data["models"]
    assert card["ok"]
    assert card["nanoseconds"] > 0.0


def test_broken_plugins_make_the_check_of_everything_fail(site: Installation) -> None:
    answer = site.program("plugins", "check", "bad-import", "--json")
    assert answer.code == 3
    assert answer.data["models"] == []
    assert answer.data["faults"][0]["distribution"] == "bad-import 0.3"


@pytest.mark.parametrize("way", ["option", "variable"])
def test_a_plugin_is_switched_off(site: Installation, way: str) -> None:
    if way == "option":
        answer = site.program("--no-plugin", "harbour-traction", "plugins", "list", "--json")
    else:
        answer = site.program("plugins", "list", "--json", LAMBDA_BEARING_NO_PLUGIN="bad-import, harbour-traction")
    assert answer.code == 0
    assert "harbour" not in {item["name"] for item in answer.data["items"]}
    (fault,) = [f for f in answer.data["faults"] if f["distribution"] == "harbour-traction 0.3"]
    assert (fault["message"], fault["is_broken"]) == ("is switched off", False)


def test_switching_off_what_is_not_installed_is_a_usage_error(site: Installation) -> None:
    answer = site.program("--no-plugin", "harbor-traction", "plugins", "list")
    assert (answer.code, answer.out) == (2, "")
    assert answer.err.strip() == '"harbor-traction" is not a known plugin; nearest: harbour-traction'


@pytest.mark.parametrize(
    ("arguments", "code", "words"),
    [
        (["show", "harbor"], 2, '"harbor" is not a known model; nearest: traction/harbour'),
        (["show", "none"], 2, 'models of several roles are called "none", choose one: '),
        (["show", "tracton/harbour"], 2, '"tracton" is not a known role; nearest: traction'),
        (["show", "traction/harbor"], 3, '"harbor" is not a traction model; nearest: harbour'),
        (
            ["check", "harbour"],
            2,
            "is not a known distribution, role or ROLE/NAME; nearest: traction/harbour, harbour-traction",
        ),
        (["list", "--role", "tracton"], 2, '"tracton" is not a known role; nearest: traction'),
    ],
)
def test_mistakes_get_one_sentence(site: Installation, arguments: list[str], code: int, words: str) -> None:
    answer = site.program("plugins", *arguments)
    assert (answer.code, answer.out) == (code, "")
    assert words in answer.err


def test_show_says_everything_about_a_model(site: Installation) -> None:
    card = site.program("plugins", "show", "traction/harbour", "--json").data
    assert card["distribution"] == "harbour-traction 0.3"
    assert card["elements"] == ["ball_inner", "ball_outer"]
    assert card["parameters"][0]["name"] == "ratio"
    assert card["parameters"][0]["default"] == "0.07"
    text = site.program("plugins", "show", "traction/ree-eyring").out
    assert "tau_eyring" in text
    assert "8 MPa" in text
    assert "Johnson and Tevaarwerk 1977" in text


def test_listing_imports_no_compiler(site: Installation) -> None:
    answer = site.python(
        "import sys\nfrom lambda_core.discovery.manager import registry\nregistry().names('traction')\n"
        "print([m for m in ('numba', 'scipy', 'sqlalchemy', 'lambda_plugins.traction') if m in sys.modules])"
    )
    assert answer.out.strip() == "[]"
