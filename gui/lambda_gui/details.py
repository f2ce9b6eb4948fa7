"""Show a catalogue row with its sources and grades."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

from rich.text import Text

from lambda_core.domain.value_status import ESTIMATED

if TYPE_CHECKING:
    from lambda_db.catalogue import SqlCatalogue
    from lambda_db.presentation import AnyBearing

    from lambda_core.api import Catalogue, LubricantRow


class Sources:
    """Numbered sources.

    They are numbered where they are used and written out at the end.
    """

    def __init__(self) -> None:
        self._numbers: dict[str, int] = {}

    def number(self, source: str) -> int:
        """Return the number of a source."""
        return self._numbers.setdefault(source, len(self._numbers) + 1)

    def write(self, text: Text) -> None:
        """Append the sources with their numbers."""
        for source, number in self._numbers.items():
            text.append(f"\n{number:>2} ", style="not bold").append(source, style="not bold dim")


def bearing_text(row: AnyBearing, catalogue: Catalogue) -> Text:
    """Return everything about a bearing."""
    from lambda_db.presentation import candidate_lines, clearance_lines, values_of

    sources = Sources()
    text = Text(f"{row.designation}  {row.maker}", style="bold")
    about = "  ".join(
        filter(None, (row.kind, f"series {row.series}" if row.series else "", getattr(row, "rating_type", "")))
    )
    text.append(f"  {about}\n", style="not bold dim")
    _values(text, values_of(row), sources)
    limits = clearance_lines(cast("SqlCatalogue", catalogue), row)
    if limits:
        text.append("\nradial internal clearance, um\n", style="not bold dim")
        shown = (f"{c['class']} {c['minimum_um']:g}..{c['maximum_um']:g}" for c in limits)
        text.append("  ".join(shown) + "\n", style="not bold")
    designs = candidate_lines(row)
    if designs:
        text.append("\ndesigns that fit the ratings\n", style="not bold dim")
        for d in designs[:5]:
            text.append(
                f"{d['ball_count']:>3} x {d['ball_diameter_mm']:<8g}pitch {d['pitch_diameter_mm']:<8g}"
                f"{100 * d['weight']:>3.0f} %\n",
                style="not bold",
            )
    sources.write(text)
    return text


def lubricant_text(row: LubricantRow) -> Text:
    """Return everything about a lubricant."""
    from lambda_db.presentation import parameters_of, values_of

    sources = Sources()
    text = Text(row.name, style="bold").append(f"   {row.base_type}   {row.note}\n", style="not bold dim")
    _values(text, values_of(row), sources, 25)
    heading = ""
    for parameter in parameters_of(row):
        law = f"{parameter['role']} {parameter['model']}"
        if law != heading:
            text.append(f"\n{law.replace('_', ' ')}\n", style="not bold dim")
            heading = law
        _values(text, [parameter], sources, 25)
    sources.write(text)
    return text


def _values(text: Text, values: list[dict[str, Any]], sources: Sources, name_width: int = 21) -> None:
    """Append values one per line.

    They have ≈ where estimated, the grade, and the number of the source.
    """
    for value in values:
        mark = "≈" if value["status"] in ESTIMATED else " "
        number = f"{value['value']:.6g} {value['unit']}".strip()
        text.append(f"{value['name'].replace('_', ' '):<{name_width}}", style="not bold dim")
        text.append(f"{mark}{number:<{name_width - 8}}", style="not bold")
        text.append(f"{value['grade']:<2} {sources.number(value['source'])}\n", style="not bold dim")
