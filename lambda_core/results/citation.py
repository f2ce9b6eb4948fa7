"""Cite the program and the sources that a result used."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from pydantic import Field

from lambda_core.results.record import INTERFACE, Record

if TYPE_CHECKING:
    from lambda_core.results.reader import Result

PROGRAM = "lambda-bearing"
TITLE = "lambda-bearing: open simulator of rolling-bearing dynamics"
# The complete model; the laws bring their own references.
METHOD = (
    "Syla et al. 2026, A Detailed Multibody Simulation Model for Ball Bearings to Predict Friction and Electrical "
    "Capacitance, Lubricants 14(4), 154, https://doi.org/10.3390/lubricants14040154"
)
_WITHOUT = ("", "-")


class LawReference(Record):
    """Source of one law."""

    law: str = Field(description='"role/name"')
    elements: list[str] = Field(description="force elements that used it")
    distribution: str = Field(description="package that brought it, with its version")
    reference: str
    bibtex: str = Field("", description="entries as its author wrote them, where there are any")


class DataReference(Record):
    """Source of values that came from the catalogue."""

    source: str
    values: list[str] = Field(description="paths of the values")


class Citation(Record):
    """References to cite with a result."""

    interface: int = INTERFACE
    file: str
    program: str = Field(description="name, version and licence of the program that ran")
    method: str = Field(description="publication of the complete model")
    laws: list[LawReference] = Field(description="in the order of the pipeline")
    data: list[DataReference] = Field(description="sources of the values from the catalogue")
    without_reference: list[str] = Field(description='laws that need none, "role/name"')

    def text(self) -> str:
        """Return the lines for people."""
        foreign = {law.law: f"  [{law.distribution}]" for law in self.laws if not law.distribution.startswith(PROGRAM)}
        width = max((len(law.law) for law in self.laws), default=0) + 2
        lines = ["program", f"  {self.program}", "method", f"  {self.method}", f"laws of {self.file}"]
        lines += [f"  {law.law:<{width}}{law.reference}{foreign.get(law.law, '')}" for law in self.laws]
        if self.data:
            lines += ["data", *(f"  {data.source}" for data in self.data)]
        if self.without_reference:
            lines.append(f"without a reference: {', '.join(self.without_reference)}")
        return "\n".join(lines)

    def bibtex(self) -> str:
        """Return the same as BibTeX, one entry per publication."""
        from lambda_core.results.bibtex import bibtex

        return bibtex(self)


def citation(result: Result) -> Citation:
    """Return the references to cite with a result.

    Parameters
    ----------
    result : Result
        Its laws, values and program version are read from the file.

    Returns
    -------
    Citation
        One entry per law that filled a role of some force element, and none for any other.
    """
    version = result.versions.get(PROGRAM, "")
    each = [result] if getattr(result, "bearing", True) else list(result.bearings.values())
    laws, without = _laws(row for one in each for row in one.laws)
    return Citation(
        file=str(result.path),
        program=f"{TITLE}, version {version}, BSD-3-Clause",
        method=METHOD,
        laws=laws,
        data=_data((value.source, value.path) for one in each for value in one.values if value.grade),
        without_reference=without,
    )


def _laws(rows: Iterable[dict[str, str]]) -> tuple[list[LawReference], list[str]]:
    """Return one entry per law, and unsourced laws.

    The force elements of a law are gathered.
    """
    found: dict[str, LawReference] = {}
    without: list[str] = []
    for row in rows:
        law = f"{row['role']}/{row['model']}"
        if row["reference"].strip() in _WITHOUT:
            without.append(law)
            continue
        entry = found.setdefault(
            law,
            LawReference(
                law=law,
                elements=[],
                distribution=row["distribution"],
                reference=row["reference"],
                bibtex=row.get("bibtex", ""),
            ),
        )
        if row["element"] not in entry.elements:
            entry.elements.append(row["element"])
    return list(found.values()), list(dict.fromkeys(without))


def _data(pairs: Iterable[tuple[str, str]]) -> list[DataReference]:
    found: dict[str, DataReference] = {}
    for source, path in pairs:
        values = found.setdefault(source, DataReference(source=source, values=[])).values
        if path not in values:
            values.append(path)
    return list(found.values())
