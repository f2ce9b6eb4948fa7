"""Test one definition behind each word.

The same case says the same in every command.
"""

from __future__ import annotations

import pytest

from lambda_core import api
from lambda_core.formulas.loading import largest_contact, loaded_elements
from lambda_core.results.quasistatic import QuasiStatic

CASE = "6319-cp10-1500"


def test_loaded_elements_are_those_that_the_inner_ring_loads() -> None:
    assert loaded_elements([100.0, 1.1, 0.9, 0.0]) == 2  # above 1 % of the largest
    assert loaded_elements([0.0, 0.0]) == 0


def test_the_largest_contact_load_says_at_which_ring() -> None:
    assert largest_contact([[5.0, 6.0], [7.0, 2.0]]) == (7.0, "inner")
    assert largest_contact([[5.0, 8.0], [7.0, 2.0]]) == (8.0, "outer")


@pytest.fixture(scope="module")
def found() -> QuasiStatic:
    return api.quasistatic(api.case(CASE))


def test_quasistatic_and_compare_count_alike(found: QuasiStatic) -> None:
    compared = api.compare(CASE, methods=["quasi-static"])
    (method,) = (method for method in compared.methods if method.name == "quasi-static")
    numbers = {row.name: row.value for row in method.numbers if row.group == "load"}
    assert numbers["loaded balls"] == found.loaded_elements
    assert numbers[f"largest contact load, {found.max_load_ring}"] == pytest.approx(found.max_load_N)
    # Centrifugal force adds to the load at the outer ring.
    assert found.max_load_ring == "outer"
    assert f"N ({found.max_load_ring} ring)" in found.text()


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ('loads.radial={kind="ramp",start="1 kN",end="2.5 kN",end_time="1 s"}', "radial ramp 1 kN to 2.5 kN in 1 s"),
        ('loads.radial={kind="harmonic",amplitude="1 kN",frequency="5 Hz"}', "radial harmonic 1 kN at 5 Hz"),
        (
            'loads.inner_ring={force_z={kind="harmonic",amplitude="10 N",frequency="5 Hz"}}',
            "force z harmonic 10 N at 5 Hz",
        ),
    ],
)
def test_a_radial_load_is_printed_as_it_is_written(change: str, says: str) -> None:
    assert says in api.describe(api.check(CASE, [change])).headline[1]


def test_only_what_the_case_says_is_called_given() -> None:
    values = {v.path: v for v in api.describe(api.check(CASE, ["models.traction=ree-eyring"])).values}
    assert values["forces.ball_inner.models.traction"].status == "given"
    assert values["forces.ball_inner.models.surface"].status == "default"
    weak = [v for v in values.values() if v.source.endswith(("grade C)", "grade D)"))]
    assert weak
    assert {v.status for v in weak} == {"assumed"}
