"""Record the outcome of each attack in one line.

Lines are written as they come, so that a stopped campaign continues where it was.
"""

from __future__ import annotations

import json
import shutil
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from tests.attacks.trial import GOOD, Outcome


class Record:
    """Outcomes of one part of a campaign.

    Parameters
    ----------
    folder : Path
        Of the campaign; holds ``PART.jsonl`` and the folder ``failures``.
    part : str
        Name of the part.
    """

    def __init__(self, folder: Path, part: str) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self.part = part
        self._file = folder / f"{part}.jsonl"
        self._failures = folder / "failures"

    def entries(self) -> Iterator[dict[str, Any]]:
        """Yield the recorded trials.

        A last line that a kill has torn is passed over.
        """
        if not self._file.is_file():
            return
        for line in self._file.read_text(encoding="utf-8").splitlines():
            try:
                yield json.loads(line)
            except ValueError:
                continue

    def done(self) -> set[int]:
        """Return the numbers of the trials that are recorded."""
        return {int(entry["number"]) for entry in self.entries()}

    def forget_failed(self) -> None:
        """Forget the trials that failed.

        They are done again; their files stay until then.
        """
        kept = [entry for entry in self.entries() if entry["verdict"] in GOOD]
        if self._file.is_file():
            self._file.write_text("".join(json.dumps(entry) + "\n" for entry in kept), encoding="utf-8")

    def add(self, number: int, outcome: Outcome, command: str, evidence: Path | None = None, **more: Any) -> None:
        """Record a trial.

        The files of a failed one are kept, with the command that repeats it.
        """
        entry = {"number": number, "command": command, **outcome.data(), **more}
        kept = self._failures / f"{self.part}-{number}"
        shutil.rmtree(kept, ignore_errors=True)
        if outcome.good:
            entry["said"] = outcome.said[-300:]
        elif evidence is not None:
            shutil.copytree(evidence, kept, symlinks=True)
            (kept / "command").write_text(command + "\n", encoding="utf-8")
        with self._file.open("a", encoding="utf-8") as file:
            file.write(json.dumps(entry) + "\n")

    def counts(self) -> Counter[str]:
        """Return how many trials ended how."""
        return Counter(str(entry["verdict"]) for entry in self.entries())
