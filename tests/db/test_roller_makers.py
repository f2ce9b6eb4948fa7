"""Test which maker's roller bearing a designation names."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from lambda_db.catalogue import SqlCatalogue

from lambda_core.catalogue.roller_designation import roller_designation
from lambda_core.domain.errors import CatalogueError


@pytest.mark.parametrize(("text", "maker"), [("SKF 30306", None), ("30306", "SKF")])
def test_a_maker_without_this_roller_bearing_is_named(catalogue: SqlCatalogue, text: str, maker: str | None) -> None:
    with pytest.raises(CatalogueError, match=r'"SKF" is not a maker of 30306 in the catalogue; makers: NSK'):
        roller_designation(catalogue, text, maker)


def test_the_named_maker_decides_between_equal_designations(catalogue: SqlCatalogue) -> None:
    (row,) = (row for row in catalogue.rollers() if row.designation == "30306")
    both: Any = SimpleNamespace(rollers=lambda: [row, row.model_copy(update={"maker": "FAG"})])
    for text, maker in (("FAG 30306", None), ("30306", "fag")):
        found = roller_designation(both, text, maker)
        assert found is not None
        assert found.row.maker == "FAG"
