"""Compare derived inner geometries with published ones.

The result is a table in docs/catalogue.md.
"""

from __future__ import annotations

from dataclasses import dataclass

from lambda_db.catalogue import SqlCatalogue
from lambda_db.derive import RankedDesign, candidates
from lambda_db.estimate import printed_of
from lambda_db.records import Row
from lambda_db.standards import PublishedDesign, published_designs
from lambda_db.transfer import rows_of


@dataclass(frozen=True)
class Trial:
    """Published design against the candidates for it.

    The candidates come from one maker's ratings of the same designation.
    """

    published: PublishedDesign
    ratings: str  # whose
    same_maker: bool
    rank: int | None  # of the published design (Z equal, ball within 0.5 %), 1 is best; None beyond the kept ones
    best: RankedDesign

    @property
    def found(self) -> bool:
        """True if the best candidate is the published design."""
        return self.rank == 1


def _is(design: RankedDesign, published: PublishedDesign) -> bool:
    ratio = design.ball_diameter / published.ball_diameter
    return design.ball_count == published.ball_count and abs(ratio - 1.0) <= 0.005


def trials(catalogue: SqlCatalogue) -> list[Trial]:
    """Derive every published design anew.

    They use dimensions and printed ratings alone, without pitch or geometry.
    """
    found = []
    for published in published_designs():
        for row in rows_of(catalogue, "bearing"):
            same_bore = row["bore_diameter_mm"] == published.bore_diameter
            if row["designation"] != published.designation or not same_bore:
                continue
            printed = printed_of(_blind(row))
            if printed.static_rating is None and printed.dynamic_rating is None:
                continue
            if row["rating_type"].startswith("as printed"):
                continue  # the source itself says that this rating is not one of its geometry
            ranked = candidates(printed, kept=10)
            rank = next((i for i, design in enumerate(ranked, start=1) if _is(design, published)), None)
            same = row["maker"] == published.maker
            found.append(Trial(published, row["maker"], same, rank, ranked[0]))
    return found


def _blind(row: Row) -> Row:
    return row | {"pitch_diameter_mm": None, "shoulder_diameter_inner_mm": None, "shoulder_diameter_outer_mm": None}


def table(catalogue: SqlCatalogue) -> str:
    """Return the trials as a Markdown table."""
    lines = [
        "| bearing | design by | published | ratings of | best candidate | score | rank of published |",
        "|---|---|---|---|---|---|---|",
    ]
    for trial in trials(catalogue):
        p, best = trial.published, trial.best
        rank = str(trial.rank) if trial.rank else "not among ten"
        mark = "" if trial.same_maker else " (another maker)"
        lines.append(
            f"| {p.designation} | {p.maker} | {p.ball_count} x {p.ball_diameter:g} on {p.pitch_diameter:g} "
            f"| {trial.ratings}{mark} | {best.ball_count} x {best.ball_diameter:g} on {best.pitch_diameter:g} "
            f"| {best.score:.1f} | {rank} |"
        )
    return "\n".join(lines)
