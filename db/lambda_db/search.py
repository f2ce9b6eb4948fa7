"""Search the catalogue by words and comparisons.

Words match designation, maker, series or a dimension; ``d=40 C>30`` compares numbers.
"""

from __future__ import annotations

import re
from typing import Any

from sqlalchemy import ColumnElement, Select, and_, case, or_, select

from lambda_core.domain.errors import CatalogueError, Problem, unknown_name
from lambda_db.models import Alias, Bearing, Lubricant

# Words before a comparison; case tells bore (d) from outside diameter (D).
KEYS: dict[str, Any] = {
    "d": Bearing.bore_diameter_mm,
    "bore": Bearing.bore_diameter_mm,
    "D": Bearing.outside_diameter_mm,
    "outside": Bearing.outside_diameter_mm,
    "B": Bearing.width_mm,
    "width": Bearing.width_mm,
    "C": Bearing.dynamic_rating_kN,
    "C0": Bearing.static_rating_kN,
    "Z": Bearing.ball_count,
    "Dw": Bearing.ball_diameter_mm,
    "alpha": Bearing.contact_angle_deg,
    "series": Bearing.series,
    "maker": Bearing.maker,
    "grade": Bearing.geometry_grade,
}
COMPARISON = re.compile(r"^(\w+)(<=|>=|=|<|>)(.*)$")
_NUMBER = re.compile(r"^(\d+(?:\.\d+)?)(?:mm|kN|deg)?$")


def _compare(word: str, key: str, operator: str, text: str) -> ColumnElement[bool]:
    if key not in KEYS:
        raise CatalogueError("search", [Problem(word, unknown_name("search key", key, KEYS))])
    column = KEYS[key]
    if key in ("series", "maker", "grade"):
        if operator != "=":
            raise CatalogueError("search", [Problem(word, f'"{key}" is a name: compare it with =')])
        return column.collate("NOCASE") == text  # type: ignore[no-any-return]
    match = _NUMBER.match(text)
    if not match:
        raise CatalogueError(
            "search", [Problem(word, f'"{text}" is not a number: write for example {key}{operator}40')]
        )
    number = float(match[1])
    compared = {"=": column == number, "<": column < number, ">": column > number}
    compared |= {"<=": column <= number, ">=": column >= number}
    return compared[operator]  # type: ignore[no-any-return]


def _word(word: str) -> tuple[ColumnElement[bool], ColumnElement[int]]:
    """Return the condition and rank of one word.

    0 is the best rank of a row.
    """
    exact = Bearing.designation.collate("NOCASE") == word
    starts = Bearing.designation.startswith(word, autoescape=True)
    ranks: list[tuple[ColumnElement[bool], int]] = [(exact, 0)]
    ranks.append((Bearing.maker.collate("NOCASE") == word, 1))
    ranks.append((Bearing.series == word, 1))
    if _NUMBER.match(word):
        number = float(_NUMBER.match(word)[1])  # type: ignore[index]
        ranks.append((Bearing.bore_diameter_mm == number, 1))
        ranks.append((starts, 2))
        ranks.append((Bearing.outside_diameter_mm == number, 3))
        ranks.append((Bearing.width_mm == number, 4))
    ranks.append((starts, 2))
    ranks.append((Bearing.kind.startswith(word, autoescape=True), 3))
    ranks.append((Bearing.designation.contains(word, autoescape=True), 5))
    ranks.append((Bearing.maker.startswith(word, autoescape=True), 5))
    return or_(*(condition for condition, _ in ranks)), case(*ranks, else_=9)


def bearing_query(text: str, limit: int) -> Select[Any]:
    """Return the query for `text`, best rows first.

    Every word has to match.

    Raises
    ------
    CatalogueError
        For a comparison with an unknown key or without a number.
    """
    conditions: list[ColumnElement[bool]] = []
    order: list[Any] = []
    for word in text.split():
        comparison = COMPARISON.match(word)
        if comparison:
            conditions.append(_compare(word, *comparison.groups()))
        else:
            condition, rank = _word(word)
            conditions.append(condition)
            order.append(rank)
    query = select(Bearing).where(and_(True, *conditions))
    if order:
        query = query.order_by(sum(order[1:], start=order[0]))
    deep_groove_first = Bearing.kind.is_not(None)
    return query.order_by(Bearing.bore_diameter_mm, deep_groove_first, Bearing.designation, Bearing.maker).limit(limit)


def lubricant_query(text: str, limit: int) -> Select[Any]:
    """Return the query for lubricants that match `text`.

    Their name, alias, base stock or note holds every word.
    """
    query = select(Lubricant).order_by(Lubricant.name)
    for word in text.split():
        aliases = select(Alias.name).where(Alias.kind == "lubricant", Alias.alias.contains(word, autoescape=True))
        query = query.where(
            Lubricant.name.contains(word, autoescape=True)
            | Lubricant.base_type.contains(word, autoescape=True)
            | Lubricant.note.contains(word, autoescape=True)
            | Lubricant.name.in_(aliases)
        )
    return query.limit(limit)
