"""List plugin rows that replace rows of a case.

They are an assumption of every run that has them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from lambda_core.model.bearing_model import ChosenLaw
from lambda_core.model.ledger import Ledger

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.catalogue.protocol import Catalogue, Shadow

_CLEARANCE = "CN"  # what a case has that names none
_TEXTS = {
    "bearing": "the bearing {}",
    "lubricant": "the lubricant {}",
    "lubricant_property": "the property {1} of the lubricant {0}",
    "lubricant_parameter": "the data of the lubricant {0} for {1} {2}",
    "material": "the material {}",
    "cage": "the cage type {}",
    "clearance": "the clearance class {}",
    "alias": 'the {0} called "{1}"',
}


def tell_shadows(
    catalogue: Catalogue,
    registry: Any,
    used: tuple[Case, Iterable[str]],
    laws: Mapping[str, Mapping[str, ChosenLaw]],
    ledger: Ledger,
) -> None:
    """Record rows and sources that a plugin replaces.

    An assumption for each row in use, and each source of a value.

    The list also has omitted rows of a plugin and a catalogue that failed.

    Parameters
    ----------
    registry : Registry
        Knows which package brings which folder, and what failed.
    used : tuple of Case and names
        The case, and the names of its rows.
    laws : mapping
        Element -> role -> law.
    """
    case, rows = used
    failures: Mapping[str, list[str]] = getattr(registry, "set_aside", {})
    for failure in failures.get("lambda_catalogue", ()):
        ledger.assume(f"values are those of another catalogue: {failure}")
    for failure in failures.get("lambda_data", ()):
        ledger.assume(failure)
    folders = {str(folder): package for package, folder in getattr(registry, "data_folders", ())}
    names = {name.casefold() for name in (*rows, *_texts(case.written()), _CLEARANCE)}
    chosen = {(role, law.model.name) for roles in laws.values() for role, law in roles.items()}
    sources = " ".join(value.source for value in ledger.values)
    shadows: Any = getattr(catalogue, "shadows", tuple)  # a catalogue of others may have none
    for each in shadows():
        package = folders.get(each.folder, each.folder)
        behind = folders.get(each.over, each.over) or "the built-in catalogue"
        if each.table == "source":
            if each.title and each.title in sources:
                ledger.assume(
                    f'the source {each.key[0]} is "{each.title}" by {package}; in {behind} it is "{each.before}"'
                )
        elif _is_used(each, names, chosen):
            text = _TEXTS.get(each.table, f"{each.table} {{}}").format(*each.key)
            ledger.assume(f"{text}: from {package}, in place of that of {behind}")


def _is_used(shadow: Shadow, names: set[str], chosen: set[tuple[str, str]]) -> bool:
    """Tell whether a case uses the row."""
    if shadow.key[1 if shadow.table == "alias" else 0].casefold() not in names:
        return False
    return shadow.table != "lubricant_parameter" or (shadow.key[1], shadow.key[2]) in chosen


def _texts(written: Any) -> Iterator[str]:
    """Yield every text of a case.

    Names of rows are among them.
    """
    if isinstance(written, Mapping):
        for value in written.values():
            yield from _texts(value)
    elif isinstance(written, str):
        yield written
