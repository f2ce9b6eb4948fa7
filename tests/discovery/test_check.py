"""Test the messages about kernels that break the convention."""

from __future__ import annotations

import math
import re
import time
from dataclasses import replace
from typing import Any, ClassVar, NamedTuple

import numpy as np
import pytest
from pydantic import BaseModel
from scipy.special import erf

from lambda_core.discovery import apart
from lambda_core.discovery.manager import registry
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.plugin_errors import PluginError
from lambda_core.domain.roles import ROLES
from lambda_core.laws.check import check_choice, check_model
from lambda_core.laws.kernels import compile_kernel
from lambda_core.laws.law import Law
from lambda_core.laws.par import make_par
from lambda_core.laws.probe import RANGES, draw, trial_context
from lambda_core.plugins import Context, NoParameters
from lambda_core.testing import assert_increasing, assert_limit, assert_symmetric, evaluate
from lambda_core.testing import check_model as assert_contract

CACHED = {"x": 1.0}


class Ratio(BaseModel):
    """One number."""

    ratio: float = 0.07


@pytest.fixture(autouse=True)
def _own_cache(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LAMBDA_BEARING_CACHE", str(tmp_path_factory.getbasetemp() / "kernels"))


def scalar(kernel: Any, **more: Any) -> Law:
    given = {"reference": "own work", "role_api": 3, "distribution": "trials 0.3"}
    return Law("asperity_load", "trial", kernel, **(given | more))


def elementwise(kernel: Any, **more: Any) -> Law:
    given = {"reference": "own work", "role_api": 3, "distribution": "trials 0.3"}
    return Law("boundary_friction", "trial", kernel, Ratio, **(given | more))


# Kernels of the scalar role asperity_load.
def good(Lambda, par, out):
    out[0] = math.exp(-2.0 * Lambda)
    return 1


def missing_argument(Lambda, out):
    return 1


def swapped_arguments(Lambda, out, par):
    return 1


def default_argument(Lambda, par, out, more=1.0):
    return 1


def returns_float(Lambda, par, out):
    out[0] = 0.5
    return 0.7


def returns_bool(Lambda, par, out):
    out[0] = 0.5
    return True


def returns_nothing(Lambda, par, out):
    out[0] = 0.5


def undeclared_status(Lambda, par, out):
    out[0] = 0.5
    return 2 if Lambda > 5.0 else 1


def always_invalid(Lambda, par, out):
    return 3


def unwritten(Lambda, par, out):
    if Lambda > 1.0:
        out[0] = 0.5
    return 1


def nan(Lambda, par, out):
    out[0] = math.nan if Lambda > 1.0 else 0.5
    return 1


def infinite(Lambda, par, out):
    out[0] = math.inf
    return 1


def out_of_bounds(Lambda, par, out):
    out[0] = 1.5
    return 1


def raises(Lambda, par, out):
    if Lambda > 5.0:
        raise ValueError("too thick")
    out[0] = 0.5
    return 1


def reads_outside(Lambda, par, out):
    out[0] = out[3]
    return 1


def reads_by_position(Lambda, par, out):
    out[0] = par[3]
    return 1


def unpacks(Lambda, par, out):
    (out[0],) = par
    return 1


def misspells(Lambda, par, out):
    out[0] = par.ratoi
    return 1


def writes_outside(Lambda, par, out):
    out[0] = 0.5
    out[1] = 0.5
    return 1


def reads_its_output(Lambda, par, out):
    out[0] = out[0] * 0.5 if out[0] < 0.75 else 0.1
    return 1


def allocates(Lambda: float, par: Any, out: Any) -> int:
    share = np.zeros(1)
    out[0] = share[0]
    return 1


def uses_scipy(Lambda, par, out):
    out[0] = erf(Lambda)
    return 1


def uncompilable(Lambda, par, out):
    out[0] = 0.5 if Lambda < 1e9 else "thick"
    return 1


def uses_a_dict(Lambda, par, out):
    out[0] = CACHED["x"]
    return 1


@pytest.mark.parametrize(
    ("kernel", "words"),
    [
        (missing_argument, "takes (Lambda, out); asperity_load kernels take (Lambda, par, out)"),
        (swapped_arguments, "takes (Lambda, out, par); asperity_load kernels take (Lambda, par, out)"),
        (default_argument, "takes (Lambda, par, out, more=1.0); asperity_load kernels take (Lambda, par, out)"),
        (np.exp, "the kernel is a ufunc: write a plain Python function"),
        (returns_float, "returns float64 in place of an int64 status"),
        (returns_bool, "returns bool in place of an int64 status"),
        (returns_nothing, "returns nothing, or a number on some paths only, in place of an int64 status"),
        (undeclared_status, "returns the status 2; declared: 1"),
        (always_invalid, "valid nowhere in the range of a ball bearing: status 3 (never)"),
        (unwritten, "leaves share of the load psi [-], 0..1 unwritten or returns NaN with status 1"),
        (nan, "returns NaN with status 1 at Lambda ="),
        (infinite, "returns an infinite share of the load psi"),
        (out_of_bounds, "returns share of the load psi [-], 0..1 = 1.5; allowed: 0 to 1"),
        (raises, "raises an exception in raises: return a status of 2 and up instead"),
        (reads_outside, "reads or writes outside its arrays: IndexError: index 3 is out of bounds"),
        (reads_by_position, "reads par[3], but since version 2 its parameters have names: it has none"),
        (unpacks, "reads par[...], but since version 2 its parameters have names"),
        (misspells, 'reads par.ratoi: "ratoi" is not a known parameter'),
        (writes_outside, "reads or writes outside its arrays: IndexError: index 1 is out of bounds"),
        (reads_its_output, "answers differently when called again"),
        (uncompilable, "cannot be compiled: Cannot unify float64"),
        (allocates, "cannot be compiled: it makes an array or a list: a kernel works in the arrays that it is given"),
        (uses_scipy, '"erf", used by uses_scipy, is a ufunc: a kernel may use'),
        (uses_a_dict, '"CACHED", used by uses_a_dict, is a dict'),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_faults_of_a_scalar_kernel(kernel: Any, words: str) -> None:
    errors = {3: "never"} if kernel is always_invalid else {}
    report = check_model(scalar(kernel, errors=errors))
    assert len(report.faults) == 1, report.faults
    assert report.faults[0].startswith("asperity_load/trial (trials 0.3)")
    assert words in report.faults[0]


# Kernels of the elementwise role boundary_friction.
def good_cells(slip, p, u_mean, par, mu):
    for i in range(mu.size):
        mu[i] = par.ratio * slip[i] / (slip[i] + 0.01)
    return 1


def first_cell_only(slip, p, u_mean, par, mu):
    for i in range(mu.size):
        mu[i] = par.ratio * slip[0] / (slip[0] + 0.01)
    return 1


def neighbours(slip, p, u_mean, par, mu):
    for i in range(mu.size):
        mu[i] = par.ratio * slip[i - 1] / (slip[i - 1] + 0.01)
    return 1


def neighbour_where_pressed(slip, p, u_mean, par, mu):
    for i in range(mu.size):
        mu[i] = par.ratio * slip[i] / (slip[i] + 0.01)
        if 1.234e9 < p[i] < 1.235e9 and i > 0:  # the cell before may be of another contact
            mu[i - 1] = 0.5 * mu[i]
    return 1


def one_too_many(slip, p, u_mean, par, mu):
    for i in range(mu.size):
        mu[i] = par.ratio * slip[i] / (slip[i] + p[i + 1])
    return 1


def writes_an_input(slip, p, u_mean, par, mu):
    for i in range(mu.size):
        slip[i] = abs(slip[i])
        mu[i] = par.ratio * slip[i] / (slip[i] + 0.01)
    return 1


def friction_at_rest(slip, p, u_mean, par, mu):
    for i in range(mu.size):
        mu[i] = par.ratio
    return 1


def driving(slip, p, u_mean, par, mu):
    for i in range(mu.size):
        mu[i] = -par.ratio * slip[i]
    return 1


def slow_cells(slip, p, u_mean, par, mu):
    for i in range(mu.size):
        total = 0.0
        for k in range(300):
            total += math.sin(slip[i] + k) ** 2
        mu[i] = slip[i] * total / 1e6
    return 1


@pytest.mark.parametrize(
    ("kernel", "words"),
    [
        (first_cell_only, "is not elementwise: a cell computed alone differs"),
        (neighbours, "is not elementwise: a cell computed alone differs"),
        (neighbour_where_pressed, "is not elementwise: a cell computed alone differs"),
        (one_too_many, "reads or writes outside its arrays: IndexError"),
        (writes_an_input, "writes into one of its inputs"),
        (friction_at_rest, "returns coefficient of friction [-], >= 0, 0 at rest = 0.07 where slip is 0"),
        (driving, "; allowed: 0 to inf"),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_faults_of_an_elementwise_kernel(kernel: Any, words: str) -> None:
    report = check_model(elementwise(kernel))
    assert len(report.faults) == 1, report.faults
    assert words in report.faults[0]


@pytest.mark.parametrize("law", [scalar(good), elementwise(good_cells)], ids=["scalar", "elementwise"])
def test_a_sound_kernel_passes(law: Law) -> None:
    report = assert_contract(law)
    assert report.calls >= 48
    assert 0.0 < report.seconds < 1e-5


@pytest.mark.full
def test_a_slow_kernel_may_be_used_but_is_told() -> None:
    report = check_model(elementwise(slow_cells), samples=3)
    assert report.ok
    assert "is slow" in report.warnings[0]
    with pytest.raises(AssertionError, match="is slow"):
        assert_contract(elementwise(slow_cells), samples=3)


def test_a_force_of_the_wrong_sign_is_told() -> None:
    def driving_damper(delta, delta_dot, load, par, out):
        out[0] = -delta_dot
        return 1

    report = check_model(Law("damping", "drive", driving_damper, role_api=3, reference="own work"))
    assert "against the sign of delta_dot" in report.faults[0]


def test_differences_between_machine_code_and_python_are_told() -> None:
    def wraps_around(Lambda, par, out):
        out[0] = 0.5 if 2**62 * (2 + int(Lambda)) > 0 else 0.25  # int64 in machine code, unbounded in Python
        return 1

    report = check_model(scalar(wraps_around))
    assert "between machine code and plain Python" in report.faults[0]


class Shape(NamedTuple):
    """A record that kernels read."""

    factor: float
    knots: FloatArray


class TestPreparation:
    """Test checks of `prepare`'s result before any kernel."""

    CONTEXT = trial_context("ball_inner")

    @pytest.mark.parametrize(
        ("made", "words"),
        [
            (np.ones(2), "prepare returns a ndarray, its annotation is Shape"),
            (Shape(math.nan, np.ones(2)), "prepare returns factor = nan, must be finite"),
            (Shape("thick", np.ones(2)), "prepare returns factor = 'thick', must be a number"),
            (Shape(1.0, np.array([1.0, np.inf])), r"prepare returns knots\[1\] = inf, must be finite"),
            (Shape(1.0, np.ones((2, 2))), "prepare returns knots has 2 dimensions"),
        ],
    )
    def test_only_records_of_finite_numbers_are_taken(self, made: Any, words: str) -> None:
        def prepare(parameters: NoParameters, context: Context) -> Shape:
            return made  # type: ignore[no-any-return]

        with pytest.raises(PluginError, match=words):
            make_par(scalar(good, prepare=prepare), NoParameters(), self.CONTEXT)

    @pytest.mark.parametrize(
        ("annotation", "words"),
        [
            (None, "prepare returns no record: declare its names, class Constants"),
            (np.ndarray, "prepare returns no record: declare its names"),
            ("Nowhere", 'prepare is annotated with "Nowhere", which its module does not have at the top level'),
        ],
    )
    def test_prepare_says_what_it_returns(self, annotation: Any, words: str) -> None:
        def prepare(parameters, context):
            return np.ones(2)

        prepare.__annotations__["return"] = annotation
        with pytest.raises(PluginError, match=re.escape(words)):
            make_par(scalar(good, prepare=prepare), NoParameters(), self.CONTEXT)

    def test_an_exception_is_told_with_its_place(self) -> None:
        def prepare(parameters: Any, context: Context) -> Shape:
            return Shape(parameters.nothing, np.ones(1))

        law = scalar(good, prepare=prepare)
        with pytest.raises(PluginError, match=r"trials 0\.3.*AttributeError.*test_check\.py, line"):
            make_par(law, NoParameters(), self.CONTEXT)

    def test_the_default_is_the_fields_in_order(self) -> None:
        law = elementwise(good_cells)
        assert make_par(law, Ratio(ratio=0.05), self.CONTEXT).tolist() == [0.05]


@pytest.mark.clock
def test_a_choice_is_checked_within_milliseconds() -> None:
    law = elementwise(good_cells)
    compiled = compile_kernel(law)
    start = time.perf_counter()
    check_choice(law, np.array([0.07]), compiled)
    assert time.perf_counter() - start < 0.25


def test_a_choice_is_checked_with_the_parameters_of_the_run() -> None:
    law = elementwise(good_cells)
    compiled = compile_kernel(law)
    check_choice(law, np.array([0.07]), compiled)
    with pytest.raises(PluginError, match="allowed: 0 to inf"):
        check_choice(law, np.array([-0.07]), compiled)


def test_missing_parameters_are_named() -> None:
    class Needed(BaseModel):
        exponent: float

    law = Law("asperity_load", "needy", good, Needed, role_api=3, reference="own work")
    assert "exponent: Field required" in check_model(law).faults[0]
    assert check_model(law, {"exponent": 2.0}).ok


def test_every_argument_of_every_role_has_a_range() -> None:
    generator = np.random.default_rng(0)
    for role in ROLES.values():
        drawn = draw(role, np.empty(0), 5, generator)
        assert len(drawn) == len(role.arguments)
        for argument, value in zip(role.arguments, drawn, strict=True):
            if not argument.output:
                assert np.all(np.isfinite(value)), argument.name
    used = {a.name for role in ROLES.values() for a in role.arguments if not a.output} - {"par"}
    assert used == set(RANGES)


class TestHelpersForTests:
    """Test the helpers for plugin authors.

    Each with a law that passes and one that fails.
    """

    GIVEN: ClassVar = {"p": 1e9, "u_mean": 1.0}

    def test_evaluate(self) -> None:
        found = evaluate(elementwise(good_cells), {"ratio": 0.1}, slip=[0.0, 0.01, 1e9], **self.GIVEN)
        np.testing.assert_allclose(found, [0.0, 0.05, 0.1])
        with pytest.raises(TypeError, match="needs p"):
            evaluate(elementwise(good_cells), slip=0.0)
        with pytest.raises(TypeError, match=r'"slp" is not a known argument.*slip'):
            evaluate(elementwise(good_cells), slip=0.0, slp=1.0, **self.GIVEN)
        with pytest.raises(AssertionError, match="returned 3: never"):
            evaluate(scalar(always_invalid, errors={3: "never"}), Lambda=1.0)

    def test_increasing(self) -> None:
        assert_increasing(elementwise(good_cells), "slip", [0.0, 0.1, 1.0], **self.GIVEN)
        with pytest.raises(AssertionError, match="falls with Lambda from Lambda = 0 on"):
            assert_increasing(scalar(good), "Lambda", [0.0, 1.0])

    def test_limit(self) -> None:
        assert_limit(scalar(good), "Lambda", 0.0, 1.0)
        with pytest.raises(AssertionError, match=r"is 1 at Lambda = 0; the limit is 0\.5"):
            assert_limit(scalar(good), "Lambda", 0.0, 0.5)

    def test_symmetry(self) -> None:
        def cube(v_orbit, omega_spin, azimuth, nu, rho, par, out):
            out[0] = v_orbit**3
            out[1] = 0.0
            return 1

        law = Law("fluid_drag", "cube", cube, role_api=3, reference="own work")
        given = {"omega_spin": 1.0, "azimuth": 0.0, "nu": 1e-5, "rho": 850.0}
        assert_symmetric(law, "v_orbit", [1.0, 2.0], odd=True, **given)
        with pytest.raises(AssertionError, match="is not even in v_orbit"):
            assert_symmetric(law, "v_orbit", [1.0, 2.0], **given)


def wavy(azimuth, contact_angle, par, out):
    out[0] = 1e-6 * math.cos(9.0 * azimuth) * math.cos(contact_angle)
    out[1] = -9e-6 * math.sin(9.0 * azimuth) * math.cos(contact_angle)
    out[2] = -1e-6 * math.cos(9.0 * azimuth) * math.sin(contact_angle)
    return 1


def wavy_with_a_slip_of_the_sign(azimuth, contact_angle, par, out):
    out[0] = 1e-6 * math.cos(9.0 * azimuth)
    out[1] = 9e-6 * math.sin(9.0 * azimuth)
    out[2] = 0.0
    return 1


def test_a_slope_that_is_not_the_derivative_is_told() -> None:
    """Report a raceway whose slopes contradict its height."""
    good, bad = (
        replace(Law("surface", "trial", kernel, role_api=3, reference="own work"), distribution="trials 0.3")
        for kernel in (wavy, wavy_with_a_slip_of_the_sign)
    )
    assert check_model(good).faults == ()
    (fault,) = check_model(bad).faults
    assert "its derivative by azimuth [m/rad] = " in fault
    assert "but by differences it is" in fault


@pytest.mark.full
def test_a4_a_law_that_compiles_for_long_is_said_to(monkeypatch: pytest.MonkeyPatch) -> None:
    """Announce a kernel of 400 branches during compilation."""
    monkeypatch.setattr(apart, "PATIENCE", 0.0)
    said: list[str] = []
    (card,) = apart.check_apart(registry(), ["contact_state/none"], announce=said.append)
    assert card.ok
    (sentence,) = said
    assert sentence.startswith("contact_state/none (lambda-bearing ")
    assert sentence.endswith("takes long: it compiles, or never ends")
