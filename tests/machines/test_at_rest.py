"""Test that answers give reasons for missing numbers."""

from __future__ import annotations

import tomllib
from typing import Any

from lambda_core import api
from lambda_core.analysis.rotor.machine_equilibrium import MachineEquilibrium
from lambda_core.model.machine_templates import shaft_text

DASH = (" - ", " -\n", "0.00..0.00 um")


def test_a_machine_at_rest_has_no_torque_of_all_bearings() -> None:
    """Print no torque for a machine at rest.

    It printed "friction torque  - N mm of all bearings".
    """
    case: dict[str, Any] = tomllib.loads(shaft_text("geared-shaft", "box"))
    case["operation"]["speed"] = "0 rpm"
    del case["gears"]["wheel"]["power"]
    case["gears"]["wheel"]["torque"] = "40 N m"
    found = api.quasistatic(case)
    assert isinstance(found, MachineEquilibrium)
    rest = found.text()[found.text().index("deflection") :]
    assert not [dash for dash in DASH if dash in rest], rest
    assert "friction torque  none: nothing turns" in " ".join(rest.split("\n")).replace("   ", "  ")
    unknown = found.bearings["left"].model_copy(update={"friction_torque_Nmm": None})
    changed = {"bearings": found.bearings | {"left": unknown}, "friction_torque_Nmm": None, "speed_rpm": 3000.0}
    assert "unknown: no steady motion was found in left" in found.model_copy(update=changed).text()


def test_a_bearing_at_rest_has_no_torque_and_no_rolled_up_film() -> None:
    found = api.quasistatic("6208-axial-1300", ["operation.speed=0 rpm", "bodies.inner_ring.spin=locked"])
    head = found.text()[: found.text().index("azimuth")]
    assert not [dash for dash in DASH if dash in head], head
    assert "none: nothing turns" in head


def test_a_bearing_at_rest_has_no_film_in_its_contacts_and_no_band_of_one() -> None:
    """Leave out films and losses of slow motion.

    The contacts had 0.002 um, and the model band parts of "minimum film" and "power loss".
    """
    found = api.quasistatic("6208-axial-1300", ["operation.speed=0 rpm", "bodies.inner_ring.spin=locked"], band=True)
    assert (found.film_um, found.film_parameter) == ([], [])
    assert {contact.film_um for contact in found.contacts} == {None}
    assert found.model_band is not None
    assert {band.quantity for band in found.model_band.bands} == {"maximum pressure"}
