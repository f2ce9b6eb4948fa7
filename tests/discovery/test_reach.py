"""Test the hash of everything that a function reaches."""

from __future__ import annotations

import dis
import math
import os
import random
import subprocess
import sys
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from lambda_core.elements.roller.line_film import moes_line_film
from lambda_core.laws.jit.reach import UnreachableError, _instructions, content_key, kept_reach, reach

HELPERS = """
import math
import os
import numpy as np
SCALE = 2.0
TABLE = np.array([1.0, 2.0])
def deep(x):
    return SCALE * x
def shape(x, power=1.0):
    return deep(x) ** power + TABLE[0]
"""


def module(text: str = HELPERS) -> ModuleType:
    """Return a module from text.

    As an edited file would be in a new process.
    """
    made = ModuleType("trial_helpers")
    exec(text, made.__dict__)
    return made


def function(helpers: ModuleType, body: str = "helpers.shape(x)", **scope: Any) -> Any:
    names = {"helpers": helpers, "math": math, "np": np, **scope}
    exec(f"def kernel(x):\n    return {body}", names)
    return names["kernel"]


def test_equal_code_has_an_equal_key_and_names_its_helpers() -> None:
    one, other = reach(function(module())), reach(function(module()))
    assert one.key == other.key
    assert [helper.__name__ for helper in one.helpers] == ["shape", "deep"]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("SCALE = 2.0", "SCALE = 2.0000000000000004"),
        ("SCALE = 2.0", "SCALE = 2"),
        ("np.array([1.0, 2.0])", "np.array([1.0, 3.0])"),
        ("np.array([1.0, 2.0])", "np.array([1.0, 2.0], np.float32)"),
        ("power=1.0", "power=2.0"),
        ("SCALE * x", "SCALE + x"),
        ("deep(x) ** power", "deep(x + 1.0) ** power"),
    ],
)
def test_any_edit_changes_the_key(old: str, new: str) -> None:
    assert old in HELPERS
    assert reach(function(module())).key != reach(function(module(HELPERS.replace(old, new)))).key


def test_a_docstring_does_not_count_but_the_same_text_in_the_body_does() -> None:
    def key(text: str) -> str:
        return reach(module(f"def f(x):\n    {text}\n").f).key

    assert key("'one'; return x + 1.0") == key("'two'; return x + 1.0")
    assert key("'one'; return x + 1.0") != key("'one'; return x + 2.0")
    assert key("'one'; return len('one')") != key("'four'; return len('four')")
    assert key("return len('one')") != key("return len('four')")
    assert key("return ['a' for _ in x]") != key("return ['b' for _ in x]")


def test_names_that_are_not_used_do_not_matter() -> None:
    assert reach(function(module())).key == reach(function(module(HELPERS + "OTHER = object()\n"))).key


@pytest.mark.parametrize(
    ("body", "change"),
    [
        ("helpers.deep(x)", {"SCALE": 3.0}),
        ("helpers.deep(x)", {"deep": math.sin}),
        ("helpers.deep(x) + abs(x)", {"SCALE": 3.0}),
        ("helpers.shape(x)", {"TABLE": np.array([2.0, 2.0])}),
    ],
)
def test_a_function_is_followed_anew_only_when_it_reads_something_else(body: str, change: dict[str, Any]) -> None:
    helpers = module()
    kernel = function(helpers, body)
    before = kept_reach(kernel)
    assert (kept_reach(kernel) is before) == ("TABLE" not in change)  # the numbers of an array can change in place
    vars(helpers).update(change)
    assert kept_reach(kernel).key == reach(kernel).key != before.key


def test_a_name_that_comes_to_hide_a_function_of_python_is_seen() -> None:
    scope: dict[str, Any] = {}
    exec("def kernel(x):\n    return abs(x)", scope)
    before = kept_reach(scope["kernel"])
    scope["abs"] = math.sin
    assert kept_reach(scope["kernel"]).key != before.key


def test_closures_are_followed() -> None:
    def make(factor: float) -> Any:
        def kernel(x: float) -> float:
            return factor * x

        return kernel

    assert reach(make(2.0)).key == reach(make(2.0)).key
    assert reach(make(2.0)).key != reach(make(3.0)).key


def test_nested_code_is_followed() -> None:
    body = "(lambda y: helpers.deep(y))(x)"
    edited = module(HELPERS.replace("SCALE * x", "SCALE + x"))
    assert reach(function(module(), body)).key != reach(function(edited, body)).key


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ("thing", '"thing", used by kernel, is a dict'),
        ("helpers.nothing(x)", 'kernel uses "helpers.nothing", which does not exist'),
        ("nothing(x)", 'kernel uses "nothing", which does not exist'),
        ("math.nothing(x)", 'kernel uses "math.nothing", which does not exist'),
        ("(lambda m: m)(helpers)", 'hands the module "helpers" on'),
        ("random.random()", 'uses "random": a kernel is a function of its arguments only'),
        ("np.random.rand()", 'uses "numpy.random"'),
        ("loop(x)", "loop calls itself: write a loop"),
    ],
)
def test_what_cannot_be_followed_is_refused_by_name(body: str, words: str) -> None:
    scope: dict[str, Any] = {"thing": {"a": 1}, "random": random}
    exec("def loop(x):\n    return x if x < 1.0 else loop(x / 2.0)", scope)
    with pytest.raises(UnreachableError, match=words.replace("(", r"\(").replace(")", r"\)")):
        reach(function(module(), body, **scope))


@pytest.mark.full
def test_keys_of_the_core_are_equal_in_every_process() -> None:
    """Compare keys under another hash seed.

    It changes the order of sets, such as the flags of fast mathematics.
    """
    code = (
        "from lambda_core.solver import entry\n"
        "from lambda_core.laws.kernels import host_key\n"
        "print([host_key(function, entry.SOURCES) for function, _ in entry.UNITS.values()])"
    )
    found = {
        subprocess.run(
            [sys.executable, "-c", code],
            env={**os.environ, "PYTHONHASHSEED": str(seed)},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for seed in (1, 2, 3)
    }
    assert len(found) == 1


def test_names_are_read_as_the_disassembler_reads_them() -> None:
    from lambda_core.solver.entry import UNITS

    codes = {code for unit, _ in UNITS.values() for code in reach(unit, lenient=True).codes}
    crowded: dict[str, Any] = {}  # more names than an argument of one byte can count
    exec("def f():\n" + "".join(f"    name_{n}.attribute_{n}\n" for n in range(300)), crowded)
    codes.add(crowded["f"].__code__)
    assert len(codes) > 100
    reading = ("LOAD_GLOBAL", "LOAD_ATTR", "LOAD_METHOD")
    for code in codes:
        expected = [
            (found.opname, found.argval) if found.opname in reading else ("", "")
            for found in dis.get_instructions(code)
            if found.opname not in ("EXTENDED_ARG", "CACHE")
        ]
        assert list(_instructions(code)) == expected, code.co_qualname


def test_the_key_of_a_typed_function_follows_what_it_calls() -> None:
    typed: dict[str, Any] = {"__name__": "typed_in_a_notebook"}
    exec("def helper(x):\n    return x\n\n\ndef law(x):\n    return helper(x)\n", typed)
    before = content_key(typed["law"])
    exec("def helper(x):\n    return 2.0 * x\n", typed)
    assert content_key(typed["law"]) != before


def test_the_key_of_a_module_s_function_is_that_of_all_it_reaches() -> None:
    assert content_key(moes_line_film) == content_key(moes_line_film) == reach(moes_line_film, lenient=True).key
