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
    words = text.upper().split()
    for row in sorted(catalogue.rollers(), key=lambda row: -len(row.designation)):
        named = [word for word in words if word == row.maker.upper()]
        squeezed = "".join(word for word in words if word not in named)
        base = row.designation.upper().replace(" ", "")
        behind = squeezed[len(base) :]
        if not squeezed.startswith(base) or behind[:1].isdigit():
            continue
        if maker is not None and maker.strip().upper() != row.maker.upper():
            raise CatalogueError(
                "catalogue", [Problem("maker", f'"{maker}" is not a maker of {row.designation}; maker: {row.maker}')]
            )
        return RollerDesignation(row, text, _clearance(behind, row))
    return None


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
