"""Test the blind parameter set.

That of the first version, every value sourced and inside its published range.
"""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest
from lambda_syla2026 import parameters as P
from lambda_syla2026.published import METHODS, POINTS, TABLE_4, mean_absolute_error

from lambda_core import api
from lambda_core.domain.written_values import scale_of
from lambda_core.model.resolve import case_hash

# Syla et al. 2026, Table 4, recomputed from its six columns: as rounded in the project's goals.
PRINTED = {"SKF": 8.5, "LaMBDA": 12.0, "FVA-Workbench": 14.0, "Bearinx": 18.0}


def test_errors_of_the_printed_methods() -> None:
    assert {name: round(mean_absolute_error(TABLE_4[name]), 1) for name in METHODS} == PRINTED


CONSTANTS = Path(__file__).parents[2] / "benchmarks" / "endstates.toml"


def _flat(tables: dict[str, Any], path: str = "") -> list[str]:
    """Return nested tables as changes.

    Of a case: the leaves.
    """
    found = []
    for key, value in tables.items():
        where = f"{path}.{key}" if path else key
        found += _flat(value, where) if isinstance(value, dict) else [f"{where}={value}"]
    return found


@pytest.mark.parametrize("point", POINTS, ids=lambda point: point.case)
def test_the_set_is_the_first_one_whatever_the_defaults(point) -> None:  # type: ignore[no-untyped-def]
    """Resolve the set to laws of b7aec9b.

    The blind comparison was made with these laws and constants.
    """
    tables = tomllib.loads(CONSTANTS.read_text(encoding="utf-8"))
    first = _flat(tables["b7aec9b"]) + _flat(tables["newer"])
    assert case_hash(api.check(point.case, P.changes())) == case_hash(api.check(point.case, first))


def test_every_value_has_a_source_and_lies_in_its_range() -> None:
    for entry in P.blind_set():
        assert entry.source
        if entry.range:
            texts = [entry.value, *entry.range]
            found = scale_of(texts) or scale_of([float(text) for text in texts])
            assert found is not None
            value, low, high = found[1]
            assert low <= value <= high, entry.path
        if entry.alternatives:
            assert entry.value in entry.alternatives


def test_samples_stay_inside_the_ranges_and_are_the_same_every_time() -> None:
    first, again = P.samples(20), P.samples(20)
    assert first == again
    assert first != P.samples(20, seed=2)
    sampled = {entry.path for entry in P.blind_set() if entry.sampled and entry.ends}
    assert all(set(sample) == sampled for sample in first)
    taus = [float(str(sample["parameters.traction.tau_eyring"]).split()[0]) for sample in first]
    assert all(4.0 <= tau <= 8.0 for tau in taus)
    # A Latin hypercube has one sample in each twentieth of every range.
    assert sorted(int((tau - 4.0) / 0.2) for tau in taus) == list(range(20))
    laws = [sample["models.rolling_resistance"] for sample in first]
    assert laws.count("biboulet-houpert") == laws.count("goksem-hargreaves") == 10


def test_another_law_leaves_the_parameters_of_the_blind_one_out() -> None:
    model = api.check(POINTS[0].case, P.changes(P.with_law("elastic_hysteresis", "houpert")))
    assert model.laws["ball_inner"]["elastic_hysteresis"].model.name == "houpert"


@pytest.mark.parametrize("point", POINTS, ids=lambda point: point.case)
def test_the_anchored_set_is_what_any_case_gets(point) -> None:  # type: ignore[no-untyped-def]
    assert case_hash(api.check(point.case, P.changes(P.anchored()))) == case_hash(api.check(point.case))
