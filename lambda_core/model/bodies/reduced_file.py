"""Read reduced models with errors that name file and matrix."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from lambda_core.domain.errors import CaseError
from lambda_core.formulas.elastic.body import ElasticBody
from lambda_core.formulas.elastic.reduced import read_reduced
from lambda_core.model.ledger import Ledger


@dataclass(frozen=True)
class ReducedFile:
    """A reduced model that an option of the case names."""

    where: str  # the option
    path: Path
    ledger: Ledger

    def read(self) -> ElasticBody | None:
        """Return the model; None after a problem."""
        try:
            return read_reduced(self.path)
        except CaseError as error:
            for problem in error.problems:
                self.problem(f"{problem.where}: {problem.message}" if problem.where else problem.message)
        return None

    def problem(self, message: str) -> None:
        """Note one thing that is wrong with the file."""
        self.ledger.problem(self.where, f"{self.path.name}: {message}")
