"""Apply the suffixes of a designation to a case.

Suffixes fill what the case leaves open; the program names those that it ignores.
"""

from __future__ import annotations

from typing import Any

from lambda_core.case.case import Case
from lambda_core.case.parts import CLEARANCE_CLASSES
from lambda_core.catalogue.designation import Designation, designated
from lambda_core.catalogue.protocol import BearingRow, Catalogue
from lambda_core.catalogue.suffixes import Suffix
from lambda_core.model.ledger import Ledger

WHERE = "bearing.designation"


def resolve_designation(case: Case, catalogue: Catalogue, ledger: Ledger) -> tuple[BearingRow | None, str, Case]:
    """Return the bearing's row and designation.

    The designation is as written; also return the case with what the suffixes decide.

    Where the case says something itself, it counts and the suffix does not. The row is None when the bearing is
    written inline or unknown (then a problem is noted).
    """
    bearing = case.bearing
    if bearing.designation is None:
        if bearing.geometry is None:
            ledger.problem(WHERE, f"is required, or write the geometry in [{ledger.place('bearing.geometry')}]")
        return None, "", case
    text, maker = bearing.designation, bearing.maker
    found = ledger.ask("bearing.", lambda: designated(catalogue, text, maker))
    if found is None:
        return None, text, case
    row, read = found
    ledger.given(WHERE, read.text)
    ledger.record("bearing.maker", row.maker, "", "case" if maker or read.maker else "only maker", "given")
    return row, read.text, _with_suffixes(case, read, ledger)


def _with_suffixes(case: Case, read: Designation, ledger: Ledger) -> Case:
    """Return the case with what the suffixes decide.

    Their other meanings are noted.
    """
    taken: dict[str, str] = {}
    for written, suffix in read.suffixes:
        if suffix.kind == "note":
            ledger.assume(f"{written} of the designation: {suffix.meaning}")
            continue
        if suffix.kind in taken:
            ledger.problem(WHERE, f'"{taken[suffix.kind]}" and "{written}" contradict each other: keep one')
            continue
        taken[suffix.kind] = written
        case = _DECIDES[suffix.kind](case, written, suffix, ledger)
    return case


def _clearance(case: Case, written: str, suffix: Suffix, ledger: Ledger) -> Case:
    """Take the clearance class.

    It does so only where the case has neither a clearance nor both raceway diameters.
    """
    name = {"C0": "CN"}.get(written, f"C{written[2]}" if written.startswith("P") else written)
    inline = case.bearing.geometry
    if case.bearing.clearance:
        if case.bearing.clearance[:2] in CLEARANCE_CLASSES and case.bearing.clearance != name:
            ledger.contradict(
                f"{written} of the designation and bearing.clearance = {case.bearing.clearance} contradict each other: "
                f"{case.bearing.clearance} counts"
            )
        return _left(case, written, suffix, f"bearing.clearance = {case.bearing.clearance}", ledger)
    if inline and inline.race_diameter_inner and inline.race_diameter_outer:
        return _left(case, written, suffix, "the raceway diameters", ledger)
    if suffix.value == "none":
        ledger.problem(
            "bearing.clearance", f"is required: {written} ({suffix.meaning}) is not in the catalogue; write its value"
        )
        return case
    if written.startswith("P"):
        ledger.assume(f"{written} of the designation: precision class {written[:2]}: the model's rings run true")
    return _filled(case, "bearing", {"clearance": name}, name, written, suffix, ledger)


def _cage(case: Case, written: str, suffix: Suffix, ledger: Ledger) -> Case:
    cage = case.bodies.cage
    if "type" in cage.model_fields_set:
        return _left(case, written, suffix, f"bodies.cage.type = {cage.type}", ledger)
    if not case.depth.cage:
        return case
    if not suffix.value:
        ledger.problem(
            "bodies.cage.type", f"is required: {written} ({suffix.meaning}) is not in the catalogue; choose a near type"
        )
        return case
    body = cage.model_copy(update={"type": suffix.value})
    return _filled(case, "bodies", {"cage": body}, suffix.value, written, suffix, ledger)


def _balls(case: Case, written: str, suffix: Suffix, ledger: Ledger) -> Case:
    if "balls" in case.materials.model_fields_set:
        return _left(case, written, suffix, "materials.balls of the case", ledger)
    return _filled(case, "materials", {"balls": suffix.value}, suffix.value, written, suffix, ledger)


def _design(case: Case, written: str, suffix: Suffix, ledger: Ledger) -> Case:
    inline = case.bearing.geometry
    if inline and inline.ball_count and inline.ball_diameter:
        return case
    ledger.problem(
        WHERE,
        f'"{written}" is a {suffix.meaning}, the catalogue has the plain one: write ball_count and ball_diameter '
        f"in [{ledger.place('bearing.geometry')}]",
    )
    return case


_DECIDES = {"clearance": _clearance, "cage": _cage, "balls": _balls, "design": _design}


def _left(case: Case, written: str, suffix: Suffix, other: str, ledger: Ledger) -> Case:
    ledger.assume(f"{written} of the designation ({suffix.meaning}) is ignored: the case gives {other}")
    return case


def _filled(
    case: Case, section: str, update: dict[str, Any], value: str, written: str, suffix: Suffix, ledger: Ledger
) -> Case:
    """Return the case with the options that a suffix decides."""
    ledger.record(f"{WHERE}: {written}", value, "", suffix.meaning, "given")
    return case.model_copy(update={section: getattr(case, section).model_copy(update=update)})
