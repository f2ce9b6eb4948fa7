"""Write references as BibTeX.

Any number of laws and values make one entry per publication.
"""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from lambda_core.results.titles import TITLES

if TYPE_CHECKING:
    from lambda_core.results.citation import Citation

# What stands before the authors says what their work was used for: "density: ", "constants in ", "(after ".
_USE = r"^(?:.*?(?::|\bas in|\bin|\bafter) )??"
_NAME = r"(?:van |von |de )?[A-Z][\w.'-]*"
_YEAR = r"(?P<year>1[89]\d\d|20\d\d)"
# "Hamrock and Dowson 1977, J. Lubr. Technol. 99, 264"
_BY_YEAR = re.compile(rf"{_USE}(?P<authors>{_NAME}(?:(?:, | and | ){_NAME})*(?: et al\.)?) {_YEAR}\b(?P<rest>.*)$")
# "Johnson, Contact Mechanics (1985), section 9.2"
_BOOK = re.compile(rf"{_USE}(?P<authors>{_NAME}), (?P<title>[^(;]+) \({_YEAR}\)")
_PLACE = re.compile(r",? *(?:eq\.|section|sections|table|Table|Tables|chapter|Fig\.).*$")
_JOURNAL = re.compile(
    r"^(?P<journal>[A-Z][\w. ]*?[a-z.A-Z]) (?P<volume>\d[\w ]*?(?:\(\d+\))?), (?P<pages>\d+)(?: and \d+)?$"
)
_SPECIAL = str.maketrans({"&": r"\&", "%": r"\%", "#": r"\#", "_": r"\_", "$": r"\$"})


@dataclass
class Entry:
    """One publication."""

    kind: str
    fields: dict[str, str]
    used_for: list[str] = field(default_factory=list)

    @property
    def work(self) -> tuple[str, ...]:
        """Key of the same publication."""
        return tuple(self.fields.get(name, "") for name in ("author", "year", "title", "journal", "howpublished"))

    def text(self, key: str) -> str:
        """Return the entry."""
        notes = {"note": f"lambda-bearing: {', '.join(dict.fromkeys(self.used_for))}"} if self.used_for else {}
        lines = [f"  {name} = {{{_escaped(value)}}}," for name, value in (self.fields | notes).items()]
        return "\n".join([f"@{self.kind}{{{key},", *lines, "}"])


def bibtex(citation: Citation) -> str:
    """Return the references of a result as BibTeX.

    They are the program, the method, and every publication behind its laws and data.

    A law that brings entries of its own is cited by these. What has no year, such as a handbook's value, is no
    publication and stands as a comment.
    """
    entries = [_program(citation.program), _method(citation.method)]
    loose: list[str] = []
    own = list(dict.fromkeys(law.bibtex.strip() for law in citation.laws if law.bibtex.strip()))
    uses = [(law.reference, law.law) for law in citation.laws if not law.bibtex.strip()]
    uses += [(data.source, "data") for data in citation.data]
    for reference, use in uses:
        for part in reference.split("; "):
            entry = read(part)
            if entry is None:
                loose.append(f"% {use}: {part}")
                continue
            same = next((other for other in entries if _same(other, entry)), None)
            if same is None:
                entries.append(entry)
            (same or entry).used_for.append(use)
    keys: list[str] = []
    for entry in entries:
        keys.append(_key(entry, keys))
    blocks = [entry.text(key) for key, entry in zip(keys, entries, strict=True)]
    return "\n\n".join(blocks + own + (["\n".join(dict.fromkeys(loose))] if loose else []))


def read(reference: str) -> Entry | None:
    """Read one reference.

    None where it has no author and year.
    """
    book = _BOOK.match(reference.strip())
    if book:
        return Entry("book", {"author": book["authors"], "title": book["title"], "year": book["year"]})
    found = _BY_YEAR.match(reference.strip())
    if found is None:
        return None
    fields = {"author": _authors(found["authors"]), "title": "", "year": found["year"]}
    rest = _PLACE.sub("", found["rest"]).strip(" ,:")
    rest = "" if rest.startswith(")") else rest  # "(after Larsson and Andersson 2000), about +-15 %"
    journal = _JOURNAL.match(rest)
    first = fields["author"].split(" and ")[0]
    fields["title"] = TITLES.get((first, fields["year"], journal["journal"] if journal else ""), "")
    fields = {name: value for name, value in fields.items() if value}
    if journal:
        return Entry("article", fields | journal.groupdict())
    thesis = re.fullmatch(r"\(thesis, (.+)\)", rest)
    if thesis:
        return Entry("phdthesis", fields | {"school": thesis[1]})
    return Entry("misc", fields | ({"howpublished": rest} if rest else {}))


def _authors(text: str) -> str:
    """Join names the way BibTeX wants them."""
    names = re.split(r", | and ", text.removesuffix(" et al."))
    return " and ".join([*names, "others"] if text.endswith(" et al.") else names)


def _program(text: str) -> Entry:
    title, version, licence = (part.strip() for part in text.rsplit(",", 2))
    return Entry("software", {"title": title, "version": version.removeprefix("version "), "license": licence})


def _method(text: str) -> Entry:
    """Read the publication of the complete model.

    The text names authors, year, title, journal and DOI.
    """
    found = re.fullmatch(
        r"(?P<authors>.+?) (?P<year>\d{4}), (?P<title>.+), (?P<journal>\w+) (?P<volume>\d+)\((?P<number>\d+)\), "
        r"(?P<pages>\d+), https://doi\.org/(?P<doi>\S+)",
        text,
    )
    assert found is not None, text
    fields = found.groupdict()
    return Entry("article", {"author": _authors(fields.pop("authors")), **fields})


def _same(one: Entry, other: Entry) -> bool:
    """Tell whether two references are of one work.

    A reference such as "Syla et al. 2026, eq. 31" names no journal.
    """
    if (one.fields.get("author"), one.fields.get("year")) != (other.fields.get("author"), other.fields.get("year")):
        return False
    journals = one.fields.get("journal"), other.fields.get("journal")
    bare = "misc" in (one.kind, other.kind) and not (one.fields.get("howpublished") or other.fields.get("howpublished"))
    return one.work == other.work or (None not in journals and journals[0] == journals[1]) or bare


def _key(entry: Entry, taken: list[str]) -> str:
    author = entry.fields.get("author", "lambda-bearing").split(" and ")[0].split(" ")[-1]
    plain = unicodedata.normalize("NFKD", author).encode("ascii", "ignore").decode().lower()
    key = f"{re.sub('[^a-z-]', '', plain)}{entry.fields.get('year', '')}"
    return next(name for name in (key, *(f"{key}{letter}" for letter in "bcdefghij")) if name not in taken)


def _escaped(text: str) -> str:
    return text.translate(_SPECIAL)
