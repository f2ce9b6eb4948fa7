"""Test references as BibTeX.

Every law's source becomes an entry, one per publication, that a parser takes.
"""

from __future__ import annotations

import re

import pytest

from lambda_core.discovery.manager import registry
from lambda_core.domain.roles import ROLES
from lambda_core.results.bibtex import bibtex, read
from lambda_core.results.citation import METHOD, PROGRAM, TITLE, Citation, DataReference, LawReference
from lambda_core.results.titles import TITLES

LAWS = [
    LawReference(law=f"{role}/{name}", elements=["ball_inner"], distribution=PROGRAM, reference=model.reference)
    for role in ROLES
    for name in registry().names(role)
    for model in [registry().model(role, name)]
    if model.reference != "-"
]
# What is no publication: a standard, a law that everybody knows, a catalogue without a year.
WITHOUT_YEAR = {
    "form of the viscosity inferred",
    "ASTM D341",
    "ISO 16281:2025",
    "Reynolds' equation of a cylinder",
    "Newton's law of viscosity",
    "Coulomb's law with a smooth start",
    "Schaeffler, Rolling bearings (catalogue)",
    "geometry of a circle on an edge",
    "Ohm's law",
    "linear spring and damper along and about each axis (Kelvin-Voigt)",
    "linear swept sine sin(2 pi integral of f dt), f rising evenly (ISO 7626-2, swept sinusoidal excitation)",
    "constant arc voltage and Ohm's law",
    "Poisson statistics of particles",
}

OF_1977 = {
    "title": "Isothermal Elastohydrodynamic Lubrication of Point Contacts: Part III - Fully Flooded Results",
    "journal": "J. Lubr. Technol.",
    "volume": "99",
    "pages": "264",
}
THESIS = "Die Schmierfilmbildung in fettgeschmierten schnellaufenden Spindellagern"


def citation(laws: list[LawReference], sources: tuple[str, ...] = ()) -> Citation:
    return Citation(
        file="x.h5",
        program=f"{TITLE}, version 0.1.0, BSD-3-Clause",
        method=METHOD,
        laws=laws,
        data=[DataReference(source=source, values=["bearing.x"]) for source in sources],
        without_reference=[],
    )


def entries(text: str) -> dict[str, tuple[str, dict[str, str]]]:
    """Parse BibTeX strictly: key -> kind, fields."""
    found: dict[str, tuple[str, dict[str, str]]] = {}
    for block in text.split("\n\n"):
        if block.startswith("%"):
            continue
        head, *lines, end = block.split("\n")
        start = re.fullmatch(r"@(\w+)\{([a-z0-9-]+),", head)
        assert start is not None, head
        assert end == "}"
        fields = {}
        for line in lines:
            match = re.fullmatch(r"  (\w+) = \{(.+)\},", line)
            assert match is not None, line
            assert match[2].count("{") == match[2].count("}")
            assert not re.search(r"(?<!\\)[&%#_$]", match[2]), line
            fields[match[1]] = match[2]
        assert start[2] not in found, "a key stands for one work"
        found[start[2]] = (start[1], fields)
    return found


def test_every_reference_of_every_law_is_an_entry_or_no_publication() -> None:
    parts = {part for law in LAWS for part in law.reference.split("; ")}
    assert {part for part in parts if read(part) is None} == WITHOUT_YEAR


@pytest.mark.parametrize(
    ("reference", "kind", "fields"),
    [
        (
            "Hamrock and Dowson 1977, J. Lubr. Technol. 99, 264",
            "article",
            {"author": "Hamrock and Dowson", "year": "1977"} | OF_1977,
        ),
        (
            "plates: Syla et al. 2026, Lubricants 14, 154, eq. 31-32",
            "article",
            {"author": "Syla and others", "year": "2026", "journal": "Lubricants", "volume": "14", "pages": "154"},
        ),
        (
            "gap: Johnson, Contact Mechanics (1985), section 3.5 and 4.2",
            "book",
            {"author": "Johnson", "title": "Contact Mechanics", "year": "1985"},
        ),
        (
            "Barz 1996 (thesis, Hannover)",
            "phdthesis",
            {"author": "Barz", "title": THESIS, "year": "1996", "school": "Hannover"},
        ),
        (
            "class value of the base stock (after Larsson and Andersson 2000), about +-15 %",
            "misc",
            {"author": "Larsson and Andersson", "year": "2000"},
        ),
        (
            "Houpert 2002, Tribol. Int. 35 (as commonly quoted)",
            "misc",
            {"author": "Houpert", "year": "2002", "howpublished": "Tribol. Int. 35 (as commonly quoted)"},
        ),
    ],
)  # fmt: skip
def test_a_reference_is_taken_apart(reference: str, kind: str, fields: dict[str, str]) -> None:
    found = read(reference)
    assert found is not None
    assert (found.kind, found.fields) == (kind, fields)


def test_one_entry_per_publication_that_names_what_it_was_used_for() -> None:
    found = entries(bibtex(citation(LAWS, ("Syla et al. 2026, Lubricants 14, 154, Table 3", "handbook values"))))
    names = ("author", "year", "journal", "howpublished")  # two parts of a work are two publications
    works = [tuple(map(fields.get, names)) for _, fields in found.values()]
    assert len(works) == len(set(works))
    kind, paper = found["syla2026"]
    assert (kind, paper["doi"]) == ("article", "10.3390/lubricants14040154")
    for use in (r"damping/cubic", r"capacitance/schneider", "data"):
        assert use in paper["note"]
    assert found["lambda-bearing"] == (
        "software",
        {"title": TITLE, "version": "0.1.0", "license": "BSD-3-Clause"},
    )
    assert sum(key.startswith("johnson") for key in found) == 2  # the book and the paper with Tevaarwerk


def test_what_is_no_publication_stands_as_a_comment() -> None:
    text = bibtex(citation([], ("handbook values",)))
    assert text.splitlines()[-1] == "% data: handbook values"
    assert set(entries(text)) == {"lambda-bearing", "syla2026"}


@pytest.mark.parametrize(
    ("reference", "kind", "title"),
    [
        ("Hamrock and Brewe 1983, J. Lubr. Technol. 105, 171", "article", "Simplified Solution for Stresses and"),
        ("constants: Wingertszahn et al. 2023, Lubricants 11, 369, eq. 6", "article", "Predicting Friction of Tapered"),
        ("Teutsch 2005 (thesis, TU Kaiserslautern)", "phdthesis", "Kontaktmodelle und Strategien zur Simulation von"),
        ("thermal: Goksem and Hargreaves 1978", "misc", "The Effect of Viscous Shear Heating"),
        ("Hamrock and Brewe 1983, J. Tribol. 105, 171", "article", ""),  # another journal: another paper
        ("Somebody 1983, J. Lubr. Technol. 105, 171", "article", ""),
    ],
)
def test_a_title_stands_where_it_is_known_for_certain(reference: str, kind: str, title: str) -> None:
    entry = read(reference)
    assert entry is not None
    assert entry.kind == kind
    assert entry.fields.get("title", "").startswith(title)
    assert ("title" in entry.fields) == bool(title)


def test_every_title_is_of_a_reference_of_some_law() -> None:
    """Find a reference of a law for every title.

    A title is wrong if it is misspelt, or if no law names its source any more.
    """
    found = {TITLES.get(key) for law in LAWS for part in law.reference.split("; ") for key in _keys(part)}
    assert set(TITLES.values()) <= found


def _keys(reference: str) -> list[tuple[str, str, str]]:
    entry = read(reference)
    if entry is None or "author" not in entry.fields:
        return []
    author = entry.fields["author"].split(" and ")[0]
    return [(author, entry.fields["year"], entry.fields.get("journal", ""))]


def test_a_law_is_cited_by_the_entries_that_it_brings() -> None:
    own = "@article{carreau1972,\n  author = {P. J. Carreau},\n  doi = {10.1122/1.549276},\n}"
    law = LawReference(
        law="traction/carreau", elements=["ball_inner"], distribution="x 1", reference="Carreau (1972)", bibtex=own
    )
    written = bibtex(citation([law, law]))
    assert written.count(own) == 1
    assert "Carreau (1972)" not in written
