"""Test shafts of very many sections.

Short pieces are merged, and what cannot be solved is refused before it is tried.
"""

from __future__ import annotations

import tomllib
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.formulas.elastic.body import shaft_body
from lambda_core.formulas.elastic.merged_sections import merged_sections
from lambda_core.formulas.elastic.sections import BodyMaterial, RoundSection
from lambda_core.model.machine_templates import shaft_text

STEEL = BodyMaterial(2.08e11, 0.3, 7850.0)


def cut(pieces: int, step: float) -> dict[str, Any]:
    """Return the shaft cut into pieces.

    Each section of the geared shaft, with diameters that alternate [mm].
    """
    tables = tomllib.loads(shaft_text("geared-shaft", "box"))
    found = []
    for section in tables["shaft"]["sections"]:
        length, diameter = (float(section[name].split()[0]) for name in ("length", "diameter"))
        for i in range(pieces):
            found.append({"length": f"{length / pieces:.12g} mm", "diameter": f"{diameter + step * (i % 2):.6g} mm"})
    tables["shaft"]["sections"] = found
    return tables


def test_a_thousand_short_sections_are_merged() -> None:
    """Merge 1 000 sections in `check`.

    They took 7.6 GiB before.
    """
    model = api.check(cut(333, 0.0))
    assert isinstance(model, api.MachineModel)
    assert model.body.positions.size < 400
    assert any("short pieces of the shaft are merged" in sentence for sentence in model.assumptions)
    assert model.body.total_mass == pytest.approx(api.check(cut(1, 0.0)).body.total_mass, rel=1e-9)


@pytest.mark.full
def test_merged_pieces_bend_and_weigh_like_their_parts() -> None:
    """Compare a cone of 120 slices with its compliance.

    A force at its end, against the closed form; its mass to 1e-4.
    """
    length, count, thick, thin = 0.12, 240, 0.05, 0.04
    middles = (np.arange(count) + 0.5) / count
    diameters = thick + (thin - thick) * middles
    slices = [(length / count, RoundSection(float(d), 0.01, STEEL)) for d in diameters]
    merged = merged_sections(slices)
    assert len(merged) < count / 3
    assert sum(part for part, _ in merged) == pytest.approx(length, rel=1e-12)

    def deflection(body: Any) -> float:
        load = np.zeros(body.stiffness.shape[0])
        load[-5] = 1.0  # y of the last node; the first is clamped
        return float(np.linalg.solve(body.stiffness[6:, 6:], load[6:])[-5])

    assert deflection(shaft_body(merged)) == pytest.approx(deflection(shaft_body(slices)), rel=1e-3)
    assert shaft_body(merged).total_mass == pytest.approx(shaft_body(slices).total_mass, rel=1e-4)


def test_long_pieces_are_left_as_they_are() -> None:
    pieces = [(0.001, RoundSection(0.04, 0.0, STEEL)), (0.02, RoundSection(0.045, 0.0, STEEL))]
    assert merged_sections(pieces) == pieces


def test_a_mesh_that_is_too_large_is_refused_before_it_is_made() -> None:
    tables = cut(100, 8.0)  # diameters too different to be merged
    with pytest.raises(api.CaseError, match=r"make [0-9]+ elements, 250 at most: leave out details"):
        api.check(tables)
