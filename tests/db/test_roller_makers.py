"""Test which maker's roller bearing a designation names."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from lambda_db.catalogue import SqlCatalogue

from lambda_core.catalogue.roller_designation import roller_designation
from lambda_core.domain.errors import CatalogueError


@pytest.mark.parametrize(("text", "maker"), [("SKF LM12749", None), ("LM12749", "SKF")])
def test_a_maker_without_this_roller_bearing_is_named(catalogue: SqlCatalogue, text: str, maker: str | None) -> None:
    with pytest.raises(CatalogueError, match=r'"SKF" is not a maker of LM12749 in the catalogue; makers: Timken'):
        roller_designation(catalogue, text, maker)


def test_the_named_maker_decides_between_equal_designations(catalogue: SqlCatalogue) -> None:
    (row,) = (row for row in catalogue.rollers() if row.designation == "32216")
    both: Any = SimpleNamespace(rollers=lambda: [row, row.model_copy(update={"maker": "FAG"})])
    for text, maker in (("FAG 32216", None), ("32216", "fag")):
        found = roller_designation(both, text, maker)
        assert found is not None
        assert found.row.maker == "FAG"


def test_one_of_several_makers_must_be_named(catalogue: SqlCatalogue) -> None:
    """Refuse to choose a maker, as for ball bearings."""
    said = r'"30206" is in the catalogue from several makers; choose one: NSK, SKF \(as in "NSK 30206"\)'
    with pytest.raises(CatalogueError, match=said):
        roller_designation(catalogue, "30206")


@pytest.mark.parametrize("text", ["NSK HR30206J", "HR 30206 J NSK", "NSK 30206"])
def test_the_prefix_of_nsk_is_read(catalogue: SqlCatalogue, text: str) -> None:
    found = roller_designation(catalogue, text)
    assert found is not None
    assert (found.row.designation, found.row.maker) == ("30206", "NSK")
