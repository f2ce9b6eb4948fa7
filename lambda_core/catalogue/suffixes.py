"""Interpret suffixes of deep groove ball bearings.

Clearance classes are those of ISO 5753-1 and read alike everywhere; seals, cages and the rest follow the makers'
own conventions, which agree where two makers use the same letters. The suffixes themselves are rows of the catalogue.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

Kind = Literal["clearance", "cage", "balls", "design", "note"]


@dataclass(frozen=True)
class Suffix:
    """One suffix, or a family of them.

    Attributes
    ----------
    written : str
        As makers write it; of a family with a typical member, for example "VT143".
    makers : str
        Who uses it, "" for all.
    kind : str
        What it decides: the ``clearance`` class, the ``cage`` type, the material of the ``balls``, a ``design`` with
        other balls than the catalogue's; a ``note`` decides nothing in the model.
    meaning : str
        In a few words; a note ends in why nothing follows from it.
    value : str
        What a case would say: a class, a name of the catalogue; "" where the catalogue has none.
    pattern : str
        Regular expression of a family; "" where `written` is all.
    """

    written: str
    makers: str
    kind: Kind
    meaning: str
    value: str = ""
    pattern: str = ""

    def matches(self, text: str) -> bool:
        """Say whether `text`, in capitals, is this suffix."""
        return re.fullmatch(self.pattern, text) is not None if self.pattern else text == self.written
