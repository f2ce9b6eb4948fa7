"""Watch the memory of a long run."""

from __future__ import annotations

import json
import random
from pathlib import Path
from typing import Any

import numpy as np

from tests.attacks.damage import Said, line
from tests.attacks.trial import Trial

SECONDS = 60.0  # of simulated time
ALLOWED = 0.1  # memory per simulated second, beyond the first quarter [MiB/s]
_CASE = "6208-axial-1300"
_SPEED = "300 rpm"
_LIMIT = 1800.0  # [s] of the trial's own time
_PAGE = 4096  # [byte]


def soak(seed: int, number: int, folder: Path) -> Said:
    """Run a bearing for long.

    Its memory over simulated time is the result.
    """
    load = random.Random(seed * 1_000_003 + number).choice(("1 kN", "1.3 kN", "1.6 kN"))
    changes = [f"operation.speed={_SPEED}", f"loads.axial={load}", f"solver.duration={SECONDS:g} s"]
    arguments = ["run", _CASE, "--out", "out.h5", "--progress", "json"]
    arguments += [word for change in changes for word in ("--set", change)]
    trial = Trial(arguments, folder, watched=folder / "out.h5")
    watched: list[tuple[float, float]] = []  # simulated time [s], resident memory [MiB]

    def look() -> None:
        now, resident = _simulated(folder), _resident(trial.process)
        if resident and now > (watched[-1][0] if watched else 0.0):
            watched.append((now, resident))

    outcome = trial.wait(_LIMIT, look)
    growth = _slope(watched[:-1])  # at the last time the averages of all samples may have begun: as large as the file
    if outcome.good and not growth <= ALLOWED:
        outcome = outcome.but("growing", f"{growth:.3f} MiB per simulated second, {ALLOWED:g} are allowed")
    return outcome, line(arguments), {"growth_MiB_per_s": growth, "simulated_s": SECONDS}


def _simulated(folder: Path) -> float:
    """Return the last progress's simulated time [s].

    0 without a line.
    """
    for text in reversed((folder / "stderr").read_text(encoding="utf-8", errors="replace").splitlines()[-3:]):
        try:
            said: dict[str, Any] = json.loads(text)
            return float(said["time_s"])
        except (ValueError, KeyError, TypeError):
            continue
    return 0.0


def _resident(process: int) -> float:
    try:
        return int(Path(f"/proc/{process}/statm").read_text(encoding="ascii").split()[1]) * _PAGE / 2**20
    except (OSError, ValueError, IndexError):
        return 0.0


def _slope(watched: list[tuple[float, float]]) -> float:
    """Return the slope of memory [MiB/s].

    Over simulated time behind the first quarter.
    """
    later = np.array([pair for pair in watched if pair[0] > 0.25 * SECONDS])
    return float(np.polyfit(later[:, 0], later[:, 1], 1)[0]) if len(later) > 2 else 0.0
