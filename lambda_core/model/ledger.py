"""Keep values with their origins, assumptions and problems."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeVar

from lambda_core.catalogue.protocol import Value
from lambda_core.domain.errors import CaseError, LambdaError, Problem
from lambda_core.domain.units import show
from lambda_core.domain.value_status import ValueStatus
from lambda_core.model.bearing_model import ResolvedValue

T = TypeVar("T")


@dataclass
class Ledger:
    """Ledger of a resolution.

    It collects everything so that all errors come at once.
    """

    values: list[ResolvedValue] = field(default_factory=list)
    assumptions: list[str] = field(default_factory=list)
    contradictions: list[str] = field(default_factory=list)
    problems: list[Problem] = field(default_factory=list)
    place: Callable[[str], str] = str  # where in the file stands what the resolution calls so

    def record(
        self, path: str, value: float | str, quantity: str, source: str, status: ValueStatus, grade: str = ""
    ) -> None:
        """Freeze one value with its origin."""
        self.values.append(ResolvedValue(path, value, quantity, source, grade, status))

    def given(self, path: str, value: float | str, quantity: str = "") -> None:
        """Freeze a value that stands in the case."""
        self.record(path, value, quantity, "case", "given")

    def row(self, path: str, value: Value, quantity: str = "", *, silent: bool = False) -> float:
        """Freeze a catalogue value.

        A value that the catalogue assumed becomes an assumption of the run.
        """
        self.record(path, value.value, quantity, value.source, value.status, value.grade)
        if value.status == "assumed" and not silent:
            shown = show(value.value, quantity, 4) if quantity else f"{value.value:.4g}"
            self.assume(f"{path} {shown}: {value.source} (grade {value.grade})")
        return value.value

    def assume(self, sentence: str) -> None:
        """Add one assumption in plain words, once."""
        if sentence not in self.assumptions:
            self.assumptions.append(sentence)

    def contradict(self, sentence: str) -> None:
        """Note a contradiction in the case.

        The note says which value counts. It is a warning of `check` and of every result.
        """
        self.contradictions.append(sentence)

    def problem(self, where: str, message: str) -> None:
        """Note one problem.

        The resolution goes on to find the others.
        """
        entry = Problem(where, message)
        if entry not in self.problems:
            self.problems.append(entry)

    def ask(self, where: str, question: Callable[[], T]) -> T | None:
        """Ask the catalogue or registry.

        An error becomes a problem at `where`, and the answer is None.

        A `where` that ends in a dot is a section: the option in it is the one that the error names.
        """
        try:
            return question()
        except CaseError as error:
            for problem in error.problems:
                self.problem(f"{where}{problem.where}" if where.endswith(".") else where, problem.message)
        except LambdaError as error:
            self.problem(where, str(error))
        return None

    def check(self, source: str) -> None:
        """Raise one CaseError with all problems, if any."""
        if self.problems:
            raise CaseError(source, [Problem(self.place(one.where), one.message) for one in self.problems])
