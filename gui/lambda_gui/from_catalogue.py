"""Copy a catalogue row into the case, keeping typed suffixes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from lambda_core.api import Designation, RollerRow, read_designation
from lambda_core.domain.errors import LambdaError

if TYPE_CHECKING:
    from lambda_db.presentation import AnyBearing

    from lambda_core.api import Catalogue

Kind = Literal["bearing", "lubricant"]


@dataclass(frozen=True)
class Taken:
    """Chosen bearing or lubricant.

    A bearing has its maker; `said` is the message about it.
    """

    kind: Kind
    name: str
    maker: str = ""
    said: str = ""


def bearing_taken(row: AnyBearing, typed: str, before: str, catalogue: Catalogue) -> Taken:
    """Return a catalogue row with its suffixes.

    They belong behind it.

    Suffixes typed in the filter count first. Those of the designation before stay where nothing was typed in their
    place: all of them on the same bearing, the clearance class alone on another, unless that has a contact angle.

    Parameters
    ----------
    typed : str
        The filter, for example "skf 6308 c3".
    before : str
        Designation in the case so far, "" without one.
    """
    if isinstance(row, RollerRow):
        return Taken("bearing", row.designation, row.maker)
    new, old = _read(typed, catalogue), _read(before, catalogue)
    added = list(new.suffixes) if new is not None and new.base == row.designation else []
    kinds = {suffix.kind for _, suffix in added}
    there = list(old.suffixes) if old is not None else []
    is_same = old is not None and old.base == row.designation
    stays_on = () if row.needs_thrust else ("clearance",)
    kept = [(w, s) for w, s in there if s.kind not in kinds and (is_same or s.kind in stays_on)]
    words = [word for word, _ in (*kept, *added)]
    stays = ", ".join(word for word, _ in kept)
    goes = ", ".join(word for word, _ in there if word not in words)
    said = [f"{those} of the designation before {verb}" for those, verb in ((stays, "stays"), (goes, "goes")) if those]
    return Taken("bearing", " ".join([row.designation, *words]), row.maker, "; ".join(said))


def _read(text: str, catalogue: Catalogue) -> Designation | None:
    try:
        return read_designation(text, catalogue.names("bearing"), catalogue.suffixes())
    except LambdaError:
        return None  # no suffix: another word of the filter, or a mistake that stands in the case already
