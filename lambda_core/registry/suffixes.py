"""Suffixes of deep-groove ball bearings: what makers write behind a designation, and what a model takes from it.

Clearance classes are those of ISO 5753-1 and read alike everywhere; seals, cages and the rest follow the makers'
own conventions, which agree where two makers use the same letters.
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


_NO_FRICTION = "seal friction is not in the model"
_NO_TOUCH = "they do not touch, and nothing of them is in the model"
_GREASE = "the model has the oil that the case names"


def _both_sides(single: str, double: str, makers: str, seal: str, why: str) -> tuple[Suffix, Suffix]:
    return (
        Suffix(single, makers, "note", f"{seal} on one side: {why}"),
        Suffix(double, makers, "note", f"{seal} on both sides: {why}"),
    )


_SEALS = (
    *_both_sides("Z", "2Z", "", "shield", _NO_TOUCH),
    Suffix("ZZ", "NSK, NTN", "note", f"shields on both sides: {_NO_TOUCH}"),
    Suffix("ZZS", "NSK", "note", f"shields on both sides: {_NO_TOUCH}"),
    *_both_sides("ZR", "2ZR", "FAG", "shield", _NO_TOUCH),
    *_both_sides("RS", "2RS", "", "contact seal", _NO_FRICTION),
    *_both_sides("RS1", "2RS1", "SKF", "contact seal (NBR)", _NO_FRICTION),
    *_both_sides("RS2", "2RS2", "SKF", "contact seal (FKM)", _NO_FRICTION),
    *_both_sides("RSH", "2RSH", "SKF", "contact seal (NBR)", _NO_FRICTION),
    *_both_sides("RSH2", "2RSH2", "SKF", "contact seal (FKM)", _NO_FRICTION),
    *_both_sides("RSL", "2RSL", "SKF", "low-friction seal", _NO_FRICTION),
    *_both_sides("RST", "2RST", "SKF", "low-friction seal", _NO_FRICTION),
    *_both_sides("RZ", "2RZ", "SKF", "non-contact seal", _NO_TOUCH),
    *_both_sides("RSR", "2RSR", "FAG", "contact seal (lip)", _NO_FRICTION),
    *_both_sides("HRS", "2HRS", "FAG", "contact seal (lip)", _NO_FRICTION),
    *_both_sides("ELS", "2ELS", "FAG", "contact seal (lip)", _NO_FRICTION),
    *_both_sides("BRS", "2BRS", "FAG", "labyrinth seal", _NO_TOUCH),
    *_both_sides("RSD", "2RSD", "FAG", "non-contact seal", _NO_TOUCH),
    *_both_sides("DU", "DDU", "NSK", "contact seal (NBR)", _NO_FRICTION),
    *_both_sides("V", "VV", "NSK", "non-contact seal", _NO_TOUCH),
    *_both_sides("LU", "LLU", "NTN", "contact seal (NBR)", _NO_FRICTION),
    *_both_sides("LB", "LLB", "NTN", "non-contact seal", _NO_TOUCH),
    *_both_sides("LH", "LLH", "NTN", "low-torque seal", _NO_FRICTION),
)
_CAGES = (
    Suffix("J", "", "cage", "pressed steel cage, ball-guided", "steel-ribbon"),
    Suffix("JN", "FAG", "cage", "pressed steel cage, riveted", "steel-ribbon"),
    Suffix("W", "NSK", "cage", "pressed steel cage", "steel-ribbon"),
    Suffix("M", "", "cage", "machined brass cage, ball-guided", "brass-machined"),
    Suffix("MA", "SKF, FAG", "cage", "machined brass cage, guided by the outer ring", "brass-outer-ring"),
    Suffix("MAS", "SKF", "cage", "machined brass cage, guided by the outer ring, with grooves", "brass-outer-ring"),
    Suffix("MB", "SKF, FAG", "cage", "machined brass cage, guided by the inner ring", "brass-inner-ring"),
    Suffix("MBS", "SKF", "cage", "machined brass cage, guided by the inner ring, with grooves", "brass-inner-ring"),
    Suffix("TN", "SKF", "cage", "moulded polyamide cage", "pa66"),
    Suffix("TN9", "SKF", "cage", "moulded PA66 cage with glass fibre", "pa66"),
    Suffix("TNH", "SKF", "cage", "moulded PEEK cage with glass fibre", "peek"),
    Suffix("TVH", "FAG", "cage", "moulded polyamide cage with glass fibre, ball-guided", "pa66"),
    Suffix("TVP", "FAG", "cage", "moulded polyamide cage with glass fibre, ball-guided", "pa66"),
    Suffix("T1X", "NSK", "cage", "moulded polyamide cage", "pa66"),
    Suffix("T2", "NTN", "cage", "moulded polyamide cage", "pa66"),
    Suffix("T", "NSK, FAG", "cage", "machined phenolic cage", "phenolic"),
    Suffix("TB", "FAG", "cage", "machined phenolic cage", "phenolic"),
    Suffix("Y", "", "cage", "pressed brass cage"),
    Suffix("F", "", "cage", "machined steel cage, ball-guided"),
    Suffix("FA", "", "cage", "machined steel cage, guided by the outer ring"),
)
_CLEARANCES = (
    Suffix("C3", "", "clearance", "radial clearance class of ISO 5753-1", pattern="C[2-5]"),
    Suffix("CN", "", "clearance", "normal radial clearance", pattern="CN|C0"),
    Suffix("C3H", "SKF", "clearance", "part of a class: its upper half H, lower half L, middle M, displaced up P",
           pattern="C[N2-5][HLMP]"),
    Suffix("C1", "", "clearance", "radial clearance below C2", "none"),
    Suffix("CM", "NSK, NTN", "clearance", "radial clearance for electric motors", "none"),
    Suffix("P63", "SKF", "clearance", "precision and clearance class in one: P6 and C3", pattern="P[456][2-5]"),
)  # fmt: skip
_REST = (
    Suffix("HC5", "SKF", "balls", "balls of silicon nitride", "Si3N4"),
    Suffix("E", "SKF", "design", "reinforced ball set"),
    Suffix("C", "FAG", "note", "internal design of generation C: the catalogue's balls and pitch are taken"),
    Suffix("P6", "", "note", "precision class of ISO 492: the model's rings and balls run true", pattern="P[02456]|PN"),
    Suffix("C02", "SKF", "note", "reduced run-out: the model's rings and balls run true", pattern="C0[248]"),
    Suffix("Q6", "SKF", "note", "quiet running: the model's rings and balls run true", pattern="QE?0?[56]"),
    Suffix("S0", "", "note", "rings heat-stabilised: no property in the model depends on it", pattern="S[0-4]|SN"),
    Suffix("X28", "NSK", "note", "rings heat-stabilised: no property in the model depends on it", pattern="X2[689]"),
    Suffix("N", "", "note", "snap-ring groove: the outer ring's mass is estimated without it", pattern="N|N1|N2"),
    Suffix("NR", "", "note", "snap ring: the outer ring's mass is estimated without it"),
    Suffix("VL0241", "SKF", "note", "insulating coating: its capacitance is not in the model", pattern=r"VL\d{4}"),
    Suffix("J20AA", "FAG", "note", "insulating coating: its capacitance is not in the model", pattern="J20[A-Z]{0,2}"),
    Suffix("WT", "SKF", "note", f"grease filling: {_GREASE}", pattern=r"WT|GJN|HT|LT|GE2|MT\d{2}|LHT\d{2}|VT\d{3}"),
    Suffix("L138", "FAG", "note", f"grease filling: {_GREASE}", pattern=r"L\d{3}"),
)
SUFFIXES: tuple[Suffix, ...] = (*_SEALS, *_CAGES, *_CLEARANCES, *_REST)
