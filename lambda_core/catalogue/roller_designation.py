"""Parse designations of roller bearings ("SKF NU 208 ECP/C3")."""

from __future__ import annotations

import re
from dataclasses import dataclass

from lambda_core.catalogue.protocol import Catalogue, RollerRow
from lambda_core.domain.errors import CatalogueError, Problem

# Suffixes of cages and designs that change no number of the quasi-static answer (SKF, Rolling bearings, 2018).
_SUFFIX = re.compile(r"(EC|ECP|ECJ|ECM|ECML|ECPH|E|J|J2|JA|X|Q|QA|QCL7C|V|CV|M|TVP2|TN9|CN|C[2-5])")
_CLEARANCE = re.compile(r"C[N2-5]")


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
        For an unknown suffix, or a maker that has no such bearing.
    """
    rows = sorted(catalogue.rollers(), key=lambda row: -len(row.designation))
    makers = {row.maker.upper() for row in rows}
    words = text.upper().split()
    named = [word for word in words if word in makers]
    squeezed = "".join(word for word in words if word not in named)
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
    found = None
    for part in filter(None, re.split(r"[-/., ]+", behind)):
        taken = _taken(part)
        if taken is None:
            raise CatalogueError(
                "catalogue",
                [Problem("designation", f'"{part}" is not a known suffix of {row.designation}: leave it out')],
            )
        found = next((suffix for suffix in taken if _CLEARANCE.fullmatch(suffix)), found)
    return found


def _taken(part: str) -> list[str] | None:
    """Return suffixes that are written together.

    The longest comes first; the result is None if something is left over.
    """
    if not part:
        return []
    for end in range(len(part), 0, -1):
        if _SUFFIX.fullmatch(part[:end]):
            rest = _taken(part[end:])
            if rest is not None:
                return [part[:end], *rest]
    return None
