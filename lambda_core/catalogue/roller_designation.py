"""Parse designations of roller bearings ("SKF NU 208 ECP/C3")."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from lambda_core.catalogue.protocol import Catalogue, RollerRow
from lambda_core.domain.errors import CatalogueError, Problem, nearest

_NSK_PREFIX = re.compile(r"^HR(?=\d)")  # of its tapered bearings of high capacity: HR 30206 J
# Suffixes of cages and designs that change no number of the quasi-static answer, and classes of the radial clearance,
# which a tapered bearing has not (SKF, Rolling bearings, 2018).
_CLEARANCES = ("CN", "C2", "C3", "C4", "C5")
_OF_TAPERED = ("J", "J2", "X", "Q", "QA", "QCL7C", "TN9")
_OF_OTHERS = ("EC", "ECP", "ECJ", "ECM", "ECML", "ECPH", "E", "J", "JA", "V", "CV", "M", "TVP2", "TN9", *_CLEARANCES)


@dataclass(frozen=True)
class RollerDesignation:
    """Roller bearing of the catalogue with its suffixes.

    It also has what the suffixes decide.
    """

    row: RollerRow
    text: str
    clearance: str | None  # class of the radial clearance, where a suffix names one


def roller_designation(catalogue: Catalogue, text: str, maker: str | None = None) -> RollerDesignation | None:
    """Return the roller bearing of a designation.

    None where there is none.

    Raises
    ------
    CatalogueError
        For an unknown suffix, a maker that has no such bearing, or several makers and none given.
    """
    rows = sorted(catalogue.rollers(), key=lambda row: -len(row.designation))
    makers = {row.maker.upper() for row in rows}
    words = text.upper().split()
    named = [word for word in words if word in makers]
    squeezed = _NSK_PREFIX.sub("", "".join(word for word in words if word not in named))
    found = [row for row in rows if _begins(squeezed, row.designation)]
    if not found:
        return None
    same = [row for row in found if row.designation == found[0].designation]
    asked = maker.strip() if maker is not None else next(iter(named), None)
    own = [row for row in same if asked is None or row.maker.upper() == asked.upper()]
    if not own:
        known = ", ".join(row.maker for row in same)
        sentence = f'"{asked}" is not a maker of {same[0].designation} in the catalogue; makers: {known}'
        raise CatalogueError("catalogue", [Problem("maker", sentence)])
    if len(own) > 1:
        known = ", ".join(row.maker for row in own)
        sentence = f'"{own[0].designation}" is in the catalogue from several makers; choose one: {known}'
        example = f'{sentence} (as in "{own[0].maker} {own[0].designation}")'
        raise CatalogueError("catalogue", [Problem("maker", example)])
    base = own[0].designation.replace(" ", "")
    return RollerDesignation(own[0], text, _clearance(squeezed[len(base) :], own[0]))


def _begins(squeezed: str, designation: str) -> bool:
    """Return whether a text begins with a designation.

    Another digit behind it would make it another bearing.
    """
    base = designation.upper().replace(" ", "")
    return squeezed.startswith(base) and not squeezed[len(base) :][:1].isdigit()


def _clearance(behind: str, row: RollerRow) -> str | None:
    """Return the clearance class among the suffixes.

    Refuse a suffix that is unknown.
    """
    found, known = None, _OF_OTHERS if row.contact_angle is None else _OF_TAPERED
    for part in filter(None, re.split(r"[-/., ]+", behind)):
        taken = _taken(part, known)
        if taken is None:
            close = nearest(part, known)
            then = f"nearest: {', '.join(close)}" if close else f"known are: {', '.join(known)}"
            sentence = f'"{part}" is not a known suffix of {row.designation}; {then}'
            raise CatalogueError("catalogue", [Problem("designation", sentence)])
        found = next((suffix for suffix in taken if suffix in _CLEARANCES), found)
    return found


def _taken(part: str, known: Sequence[str]) -> list[str] | None:
    """Return suffixes that are written together.

    The longest comes first; the result is None if something is left over.
    """
    if not part:
        return []
    for end in range(len(part), 0, -1):
        if part[:end] in known:
            rest = _taken(part[end:], known)
            if rest is not None:
                return [part[:end], *rest]
    return None
