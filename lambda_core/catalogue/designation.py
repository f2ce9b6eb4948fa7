"""Parse designations of ball bearings ("SKF 6208-2Z/C3")."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from lambda_core.case.parts import CLEARANCE_CLASSES
from lambda_core.catalogue.protocol import BearingRow, Catalogue
from lambda_core.catalogue.suffixes import Suffix
from lambda_core.domain.errors import CatalogueError, Problem, nearest

_LONGEST = 6  # characters of a suffix
_SEPARATORS = re.compile(r"[-/.,+ ]+")


@dataclass(frozen=True)
class Designation:
    """A designation taken apart.

    Attributes
    ----------
    base : str
        Name in the catalogue.
    maker : str
        Word that follows it, "" without one.
    suffixes : tuple of (str, Suffix)
        As written, in capitals, and what each is.
    text : str
        Base and suffixes as written, without the maker.
    """

    base: str
    maker: str = ""
    suffixes: tuple[tuple[str, Suffix], ...] = ()
    text: str = ""


def read_designation(text: str, known: list[str], suffixes: Sequence[Suffix]) -> Designation | None:
    """Parse a designation.

    None when it contains no bearing of the catalogue.

    Parameters
    ----------
    text : str
        For example "6208", "SKF 6208-2Z/C3", "6319 M C3 SKF"; case does not matter.
    known : list of str
        Every designation of the catalogue. A row whose own designation has a suffix comes first.
    suffixes : sequence of Suffix
        Those of the catalogue.

    Raises
    ------
    CatalogueError
        When something behind the bearing is no known suffix.
    """
    names = {name.casefold(): name for name in known}
    words = _joined(text.split(), names)
    for index, word in enumerate(words):
        base = _base(word, names)
        if base is None:
            continue
        makers, behind = words[:index], [word[len(base) :]]
        for other in words[index + 1 :]:
            # A maker is letters alone; so are some suffixes, and then the suffix is meant.
            is_maker = other.isalpha() and len(other) > 1 and _split(other.upper(), suffixes) is None
            (makers if is_maker else behind).append(other)
        found = tuple(_suffixes(" ".join(behind), base, suffixes))
        name = names[base.casefold()]
        written = " ".join([name + behind[0], *behind[1:]]).upper()
        return Designation(name, " ".join(makers), found, written)
    return None


def designated(catalogue: Catalogue, text: str, maker: str | None = None) -> tuple[BearingRow, Designation]:
    """Return the catalogue's row of a designation.

    Also return the parsed designation.

    Raises
    ------
    CatalogueError
        When it is unknown, is in the catalogue from several makers, names a maker and another one, or has
        an unknown suffix.
    """
    read = read_designation(text, catalogue.names("bearing"), catalogue.suffixes())
    if read is None:
        return catalogue.bearing(text, maker), Designation(text, text=text)
    if maker and read.maker and maker.casefold() != read.maker.casefold():
        raise _error(f'names "{read.maker}", and the maker is "{maker}": write it once', "maker")
    return catalogue.bearing(read.base, read.maker or maker or None), read


def without_suffixes(text: str, known: list[str], suffixes: Sequence[Suffix]) -> str:
    """Return a search without suffixes of designations.

    All other words stay as they are.
    """
    names = {name.casefold(): name for name in known}
    kept: list[str] = []
    for word in text.split():
        base = _base(word, names)
        behind = word[len(base) :] if base else word
        parts = [_split(part, suffixes) for part in filter(None, _SEPARATORS.split(behind.upper()))]
        follows = any(_base(before, names) for before in kept)
        if base and all(parts):
            kept.append(base)
        # A suffix of letters alone ("M") may as well be the beginning of a maker's name.
        elif not (follows and parts and all(parts) and not word.isalpha()):
            kept.append(word)
    return " ".join(kept)


def _joined(words: list[str], names: dict[str, str]) -> list[str]:
    """Join the parts of a maker's designation.

    "7208 B" is 7208B, where the catalogue has that and no 7208.
    """
    for index in range(len(words) - 1):
        pair = words[index] + words[index + 1]
        base = _base(pair, names)
        if base is not None and len(base) > len(words[index]) and _base(words[index], names) is None:
            return [*words[:index], pair, *words[index + 2 :]]
    return words


def _base(word: str, names: dict[str, str]) -> str | None:
    """Return the longest designation that begins `word`.

    It is one of the catalogue; a digit behind it makes another.
    """
    for end in range(len(word), 0, -1):
        if word[:end].casefold() in names and not word[end : end + 1].isdigit():
            return word[:end]
    return None


def _suffixes(text: str, base: str, known: Sequence[Suffix]) -> Iterator[tuple[str, Suffix]]:
    for part in filter(None, _SEPARATORS.split(text.upper())):
        found = _split(part, known)
        if found is None:
            raise _error(f'"{part}" is not a known suffix of {base}; {_instead(part, known)}')
        yield from found


def _instead(part: str, known: Sequence[Suffix]) -> str:
    """Suggest a name for an unknown suffix.

    A number behind a C is a clearance class.
    """
    if re.fullmatch(r"C\d+", part):
        return f"classes of clearance: {', '.join(CLEARANCE_CLASSES)}"
    close = nearest(part, [suffix.written for suffix in known])
    return f"nearest: {', '.join(close)}" if close else "see the table of suffixes in docs/catalogue.md"


def _split(part: str, known: Sequence[Suffix]) -> list[tuple[str, Suffix]] | None:
    """Return suffixes that are written together.

    An example is "2RS1C3". Long ones come first; the result is None if something is left over.
    """
    for end in range(min(len(part), _LONGEST), 0, -1):
        suffix = next((s for s in known if s.matches(part[:end])), None)
        rest = _split(part[end:], known) if suffix and end < len(part) else []
        if suffix and rest is not None:
            return [(part[:end], suffix), *rest]
    return None


def _error(message: str, where: str = "designation") -> CatalogueError:
    return CatalogueError("catalogue", [Problem(where, message)])
