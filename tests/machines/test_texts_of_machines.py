"""Test texts of machines.

Lives in one form, units, assumptions of the circuit, options that stand elsewhere.
"""

from __future__ import annotations

import re
import tomllib
from typing import Any

import pytest

from lambda_core import api
from lambda_core.domain.unit_systems import US
from lambda_core.model.machine_templates import geared_shaft
from lambda_core.results.model_band import Band, ModelBand


def box() -> dict[str, Any]:
    return tomllib.loads(geared_shaft("box"))


def test_hold_and_motion_of_a_bearing_name_its_support() -> None:
    tables = box()
    tables["bearings"]["left"] |= {"hold_x": "locked", "motion_tilt_y": {"start": "0 mrad"}}
    with pytest.raises(api.CaseError) as caught:
        api.check(tables)
    assert 'bearings.left.hold_x   is not an option: write support.x = "locked"' in str(caught.value)
    assert "write support.tilt_y = { motion = ... }" in str(caught.value)


def test_both_ends_of_a_band_have_the_chosen_unit() -> None:
    """Convert the low end, too, which has no unit."""
    found = api.quasistatic(box())
    torque = Band(quantity="friction torque", unit="N mm", value=100.0, low=90.4, high=113.0, contributors=[])
    bands = {one.name: ModelBand(case="box", coverage=0.9, bands=[torque], left_out=[]) for one in found.bearings}
    text = found.with_bands(bands).text(units=US)
    low, high = re.findall(r"^model band +([\d.]+) \.\. ([\d.]+) lbf in of all bearings", text, re.MULTILINE)[0]
    assert float(high) / float(low) == pytest.approx(113.0 / 90.4, rel=0.05)


def test_lives_are_written_in_one_form() -> None:
    """Write lives in one form everywhere.

    Two digits, groups of three, "above" beyond a million hours: in the table, in its sum, in the duty cycle.
    """
    found = api.quasistatic(box())
    text = found.text()
    cells = re.findall(r"^L_10rh h +(.*)$", text, re.MULTILINE)[0]
    assert re.fullmatch(r"(?:(?:above )?\d{1,3}(?: \d{3})*\s*)+", cells)
    assert re.search(r"^system life +(?:above )?\d{1,3}(?: \d{3})* h \(L_10rh", text, re.MULTILINE)
    assert ">" not in cells


def test_damping_is_shown_in_other_units_too() -> None:
    assert US.sentence("with 200 N s/m to the ground") == "with 1.14 lbf s/in to the ground"
    assert US.unit("N m s/rad") == "lbf in s/rad"
    assert US.value(175.1268, "N s/m") == pytest.approx(1.0, rel=1e-6)  # lbf s/in = 175.1268 N s/m


def test_a_circuit_without_a_source_names_the_one_that_it_takes() -> None:
    from lambda_core.analysis.electric.circuit_bearing import electric_model
    from lambda_core.analysis.electric.outcome import assumptions
    from lambda_core.case.electric import Electric, Sine

    class Bearing:
        contexts: tuple[Any, ...] = ()

        def __init__(self, options: Electric) -> None:
            film = options.film.model_copy(update={"ball_permittivity": 8.0})
            self.options = options.model_copy(update={"film": film})
            self.laws = electric_model(options, "case").laws

    def told(options: Electric) -> str:
        bearing: Any = Bearing(options)
        return " ".join(assumptions(bearing))

    words = "the case names no source: two-level inverter, dc link 800 V"
    assert words in told(Electric())
    assert words not in told(Electric(sine=Sine.model_validate({"amplitude": "1 V", "frequency": "1 kHz"})))
