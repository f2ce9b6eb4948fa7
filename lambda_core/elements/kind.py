"""Declare kinds of rolling elements, contacts and bearings."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Generic, TypeVar


@dataclass(frozen=True)
class ContactKind:
    """Contact of an element with a ring.

    Attributes
    ----------
    name : str
    number : int
        By which compiled code chooses, records.RACEWAY.kind.
    """

    name: str
    number: int


POINT, LINE, RIB = CONTACTS = (ContactKind("point", 0), ContactKind("line", 1), ContactKind("rib", 2))


@dataclass(frozen=True)
class BearingKind:
    """A kind of rolling bearing.

    Attributes
    ----------
    name : str
        As rows of the catalogue have it.
    title : str
        What a new case begins with.
    """

    name: str
    title: str


Kind = TypeVar("Kind", bound=BearingKind)


@dataclass(frozen=True)
class ElementKind(Generic[Kind]):
    """A kind of rolling element.

    Attributes
    ----------
    name, plural : str
    contacts : tuple of ContactKind
        What its raceways may be.
    states : int
        In the state vector: of balls place, velocity and spin, of rollers also tilt and skew.
    kinds : callable
        Returns the kinds of bearings that have it, by name.
    """

    name: str
    plural: str
    contacts: tuple[ContactKind, ...]
    states: int
    kinds: Callable[[], Mapping[str, Kind]]
