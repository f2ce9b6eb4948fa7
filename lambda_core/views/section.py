"""Define sections of a report.

The hook is ``lambda_sections``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from lambda_core.domain.plugin_errors import PluginError, blamed
from lambda_core.views.view import RunData

SECTION_API = 1


@dataclass(frozen=True)
class ReportTable:
    """One table of a section.

    Attributes
    ----------
    caption : str
        What stands above it.
    head, rows : tuples of str
        Headings of the columns; as many texts per row.
    """

    caption: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


Content = Sequence[str | ReportTable]


@dataclass(frozen=True)
class Section:
    """Section of a plugin in a run's report.

    Attributes
    ----------
    name : str
        Short and unique: "noise-class".
    title : str
        Its heading.
    content : callable
        ``content(run)`` returns paragraphs (str) and tables (ReportTable) about a
        :class:`~lambda_core.views.view.RunData`; raises :class:`~lambda_core.views.method.NotApplicable` where it has
        nothing to say of a run.
    reference : str
        Publication and equation numbers, "own work" where there is none.
    section_api : int
        Version of this interface that it is written for, as a number: 1.
    """

    name: str
    title: str
    content: Callable[[RunData], Content] = field(repr=False)
    reference: str
    section_api: int = 0
    distribution: str = ""  # filled by the registry


def section_fault(item: object) -> str:
    """Say what keeps a section from being registered, or nothing."""
    if not isinstance(item, Section):
        return f"lambda_sections registers a {type(item).__name__}: wrap the function in Section(name, title, ...)"
    label = f"the section {item.name}"
    if item.section_api != SECTION_API:
        if not item.section_api:
            return (
                f"{label} does not say which version of the interface it is written for: add section_api={SECTION_API}"
            )
        return f"{label} is written for version {item.section_api} of the interface; this is {SECTION_API}"
    if not callable(item.content):
        return f"{label} calls a {type(item.content).__name__}, not a function"
    return "" if item.reference.strip() else f'{label} has no reference: name its source ("own work" is one)'


def content_of(section: Section, run: RunData) -> tuple[str | ReportTable, ...]:
    """Return what a section says of a run.

    Raises
    ------
    PluginError
        When it fails, or returns something else; NotApplicable passes.
    """
    what = f'the section "{section.name}" ({section.distribution})'
    with blamed(what):
        found = tuple(section.content(run))
        for part in found:
            if isinstance(part, ReportTable):
                if any(len(row) != len(part.head) for row in part.rows):
                    raise PluginError(f'{what}: a row of the table "{part.caption}" is not as long as its head')
            elif not isinstance(part, str):
                raise PluginError(f"{what} returns a {type(part).__name__}, not a text or a ReportTable")
    return found
