"""Check the digits of a report's tables."""

from __future__ import annotations

from types import SimpleNamespace

from lambda_core.domain.unit_systems import SI
from lambda_core.export.report.key_tables import _band
from lambda_core.results.band_text import banded


def test_the_band_of_a_page_has_the_digits_of_the_summary() -> None:
    """Compare its ends with those of a run.

    A band of 122.6 to 140.5 N mm was 120..140 on the page.
    """
    found = SimpleNamespace(friction_torque_Nmm_band=[122.6149, 140.5321])
    ((_, shown, _),) = _band(found, "friction_torque_Nmm", "N mm", "band", SI)
    assert shown == "122.6 .. 140.5 N mm"
    assert shown.removesuffix(" N mm") in banded(130.14, found.friction_torque_Nmm_band, "N mm", "130")
