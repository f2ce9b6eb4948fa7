"""Test laws that are called once for all contacts."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.discovery import manager
from lambda_core.discovery.manager import registry
from lambda_core.domain import inline_laws
from lambda_core.domain.roles import DEFAULT_MODELS, ROLES
from lambda_core.laws.check import parameters_of
from lambda_core.laws.jit.binding import STRIDE
from lambda_core.laws.kernels import compile_kernel
from lambda_core.laws.law import Law
from lambda_core.laws.par import batched_kernel, make_par
from lambda_core.laws.probe import draw, trial_context
from lambda_core.plugins import OK, NoParameters, law
from lambda_core.solver import records as R
from lambda_core.solver.arrays.bundle import elements_in
from lambda_core.solver.drivers.contact_grid import contacts_at_once, unit_grid
from lambda_core.solver.drivers.dynamics import BearingEngine
from lambda_core.solver.drivers.equilibrium import fault_sentence, solve
from lambda_core.solver.drivers.right_hand_side import Handle
from lambda_core.solver.vec import cosine_sine


@pytest.fixture(scope="module", autouse=True)
def untouched() -> Iterator[None]:
    """Take back the inline law.

    Other tests of this process do not know it.
    """
    before = dict(inline_laws._laws)
    yield
    inline_laws._laws.clear()
    inline_laws._laws.update(before)
    manager.registry.cache_clear()


BATCHED = sorted(name for name, role in ROLES.items() if role.batched)
_CONTACTS, _CELLS = 11, 5


def together(role: Any, drawn: list[list[Any]]) -> list[Any]:
    """Return several contacts' law arguments.

    As a compiled law takes them.
    """
    found: list[Any] = []
    for argument, *values in zip(role.arguments, *drawn, strict=True):
        if argument.each:
            found.append(np.array(values))
        elif argument.kind == "a" and argument.name != "par":
            size = _CELLS if role.elementwise else STRIDE
            rows = np.full((len(values), size), np.nan)
            if not argument.output:
                rows[:] = values
            found.append(rows.ravel())
        else:
            found.append(values[0])
    return found


@pytest.mark.parametrize("name", BATCHED)
def test_contacts_do_not_depend_on_each_other(name: str) -> None:
    """Compare contacts in batches within rounding.

    A compiler fuses other products where it takes eight contacts at once.
    """
    role, its = ROLES[name], registry().model(name, DEFAULT_MODELS[name])
    par = make_par(its, parameters_of(its, None), trial_context(role.elements[0]))
    generator = np.random.default_rng(5)
    drawn = [draw(role, par, _CELLS, generator) for _ in range(_CONTACTS)]
    for each in drawn[1:]:  # geometry and oil are those of the raceway
        for place, argument in enumerate(role.arguments):
            if argument.kind == "f" and not argument.each:
                each[place] = drawn[0][place]
    compiled, results = compile_kernel(its), []
    for call in (compiled.dispatcher, batched_kernel(its)):
        arguments = together(role, drawn)
        assert call(*arguments) == OK
        results.append(next(v for a, v in zip(role.arguments, arguments, strict=True) if a.output))
    alone = np.full_like(results[0], np.nan)
    for k, each in enumerate(drawn):
        arguments = together(role, [each])
        assert compiled.dispatcher(*arguments) == OK
        written = next(v for a, v in zip(role.arguments, arguments, strict=True) if a.output)
        alone[k * written.size : (k + 1) * written.size] = written
    for found in results:
        np.testing.assert_allclose(found, alone, rtol=1e-13, equal_nan=True)
    width = _CELLS if role.elementwise else STRIDE
    assert np.isfinite(results[0].reshape(_CONTACTS, width)[:, : 1 if role.elementwise else len(role.outputs)]).all()


def test_a_status_of_one_contact_is_the_status_of_all() -> None:
    def picky(Lambda: float, par: Any, out: Any) -> int:
        out[0] = 0.5
        return 3 if Lambda > 2.0 else 1

    made = Law("asperity_load", "picky", picky, NoParameters, role_api=3, reference="own work", errors={3: "too thick"})
    dispatcher, out = compile_kernel(made).dispatcher, np.zeros(4 * STRIDE)
    ratios = np.array([1.0, 1.5, 1.0, 0.5])
    assert dispatcher(ratios, np.empty(0), out) == OK
    ratios[2] = 2.5
    assert dispatcher(ratios, np.empty(0), out) == 3


def test_a_fault_names_the_ball_whose_contact_has_it() -> None:
    """Name the ball of a refused load.

    Laws are called for nine contacts together, one of which has a load that the law refuses.
    """
    nominal = api.check("6208-axial-1300")
    most = 3.0 * float(solve(nominal).contacts[:, :, 0].max())

    @law("elastic_hysteresis", "tender", role_api=3, reference="own work", errors={2: "too much load"})
    def tender(load, semi_a, semi_b, R_x, R_y, R_ball, par, out):  # type: ignore[no-untyped-def]
        out[0] = 0.0
        return 2 if load > most else OK

    start = solve(api.check(api.case("6208-axial-1300").with_(models={"elastic_hysteresis": tender})))
    handle, y = Handle(start.context), BearingEngine(start.context.model, equilibrium=start).state()["memory.y"].copy()
    slope, balls = np.zeros(y.size), elements_in(start.context.bundle, y)
    assert handle.slope(0.0, y, slope) == 1
    balls["radius"][5] += 40e-6
    assert handle.slope(0.0, y, slope) == 0
    sentence = fault_sentence(start.context, 0.0)
    assert "too much load" in sentence
    assert "ball 6, ball - outer" in sentence


@pytest.mark.parametrize(("strips", "rows", "most"), [(31, 1, 16), (21, 11, R.SWEEPS), (101, 21, R.SWEEPS)])
def test_fine_grids_take_few_contacts_at_once(strips: int, rows: int, most: int) -> None:
    assert contacts_at_once(unit_grid(strips, rows).shape[1]) == most


def test_cosine_and_sine() -> None:
    """Compare sine and cosine to two last places.

    For a million turns the bound is the spacing of such numbers.
    """
    for angle in np.concatenate([np.linspace(-7.0, 7.0, 4001), np.random.default_rng(1).uniform(-1e6, 1e6, 2000)]):
        found = cosine_sine.py_func(float(angle))
        allowed = 2.5e-16 + 2.0**-53 * abs(angle)
        assert abs(found[0] - math.cos(angle)) <= allowed
        assert abs(found[1] - math.sin(angle)) <= allowed
    assert all(math.isnan(each) for each in cosine_sine.py_func(math.nan))
