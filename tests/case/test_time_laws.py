"""Test loads and motions whose course a law gives."""

from __future__ import annotations

import math
import tomllib

import pytest

from lambda_core import api
from lambda_core.domain.errors import CaseError
from lambda_core.model.bearing_model import BearingModel, LawTerm
from lambda_core.model.laws.time_functions import highest_frequency, initial, peak, scaled
from lambda_core.solver.drivers.equilibrium import solve

CASE = "6208-axial-1300"
CHIRP = (
    '{kind = "law", law = "chirp", amplitude = "2 kN", '
    'parameters = {start = "20 Hz", end = "90 Hz", duration = "0.1 s"}}'
)


def test_a_law_next_to_a_constant_is_looked_at_before_the_run() -> None:
    model = api.check(CASE, [f'loads.axial={{kind = "sum", terms = ["1 kN", {CHIRP}]}}'])
    force = model.inner_ring.force[0]
    term = next(term for term in force.terms if isinstance(term, LawTerm))
    assert term.law == "time.loads.axial.terms.1"
    assert model.laws[term.law]["time_function"].parameters.end == 90.0
    assert initial(force) == pytest.approx(1000.0)
    assert peak(force) == pytest.approx(3000.0, rel=1e-3)
    assert highest_frequency(force) == pytest.approx(90.0, rel=1e-2)
    assert peak(scaled(force, -2.0)) == pytest.approx(6000.0, rel=1e-3)
    assert resolve_text(model.case_toml).inner_ring.force == model.inner_ring.force


def resolve_text(text: str) -> BearingModel:
    """Resolve a case that is written in a result."""
    return api.check(tomllib.loads(text))


@pytest.mark.parametrize(
    ("text", "where", "message"),
    [
        (
            CHIRP.replace('"chirp"', '"chrip"'),
            "loads.axial.law",
            '"chrip" is not a time_function model; nearest: chirp',
        ),
        (CHIRP.replace("start", "stert"), "loads.axial.parameters.stert", "nearest: start"),
        (CHIRP.replace("20 Hz", "-20 Hz"), "loads.axial.parameters.start", "time_function chirp: "),
        (CHIRP.replace("2 kN", "2 rpm"), "loads.axial.amplitude", "rpm"),
    ],
)
def test_mistakes_are_sentences(text: str, where: str, message: str) -> None:
    with pytest.raises(CaseError) as raised:
        api.check(CASE, [f"loads.axial={text}"])
    (problem,) = raised.value.problems
    assert problem.where == where
    assert message in problem.message


def test_a_prescribed_motion_takes_the_derivatives_of_the_law() -> None:
    """Multiply the law's derivatives by the amplitude.

    At the start the chirp is 0, its rate is 2 pi f_0, and its acceleration follows the sweep.
    """
    motion = CHIRP.replace("2 kN", "1 um")
    model = api.check(CASE, [f'bodies.outer_ring.x={{mode = "prescribed", motion = {motion}}}'])
    bundle = solve(model).context.bundle
    motion_x = bundle.inputs[1]["motion"][0]
    assert motion_x["value"] == 0.0
    assert motion_x["rate"] == pytest.approx(1e-6 * 2.0 * math.pi * 20.0)
    assert motion_x["acceleration"] == pytest.approx(1e-6 * 2.0 * math.pi * 700.0)
