"""Write stiffness and damping of every bearing.

It writes JSON and CSV.
"""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

from lambda_core.analysis.rotor.machine_modes import AXES, MachineModes
from lambda_core.domain.errors import UsageError
from lambda_core.domain.files import check_folder, check_target

_MATRICES = ("stiffness", "housed_stiffness", "damping", "housed_damping")
FORMAT = "lambda-bearing bearing stiffness 2"


def stiffness_text(found: MachineModes, kind: str) -> str:
    """Return the matrices as text.

    Parameters
    ----------
    kind : str
        ``json``: one object with a 6 x 6 matrix per bearing, SI; ``csv``: one row per entry.
    """
    if kind == "json":
        data = {
            "format": FORMAT,
            "case": found.case,
            "speed_rpm": found.speed_rpm,
            "axes": list(AXES),
            "units": "stiffness N/m, N/rad, N m/m, N m/rad; damping N s/m, N s/rad, N m s/m, N m s/rad; inner ring "
            "against outer ring, x along the shaft, z up; damping of vibrations with the shaft's speed",
            "bearings": [
                {
                    "name": b.name, "title": b.title, "position_mm": b.position_mm, "force_N": b.force_N,
                    "stiffness": b.stiffness, "housed_stiffness": b.housed_stiffness,
                    "damping": b.damping, "housed_damping": b.housed_damping,
                }
                for b in found.bearings.values()
            ],
        }  # fmt: skip
        return json.dumps(data, indent=2) + "\n"
    stream = io.StringIO()
    rows = csv.writer(stream, lineterminator="\n")
    rows.writerow(["bearing", "position_mm", "row", "column", *_MATRICES])
    for b in found.bearings.values():
        for i, first in enumerate(AXES):
            for j, second in enumerate(AXES):
                rows.writerow([b.name, b.position_mm, first, second, *(getattr(b, m)[i][j] for m in _MATRICES)])
    return stream.getvalue()


def write_stiffness(found: MachineModes, path: str | Path) -> Path:
    """Write stiffness and damping of every bearing to a file.

    Parameters
    ----------
    found : MachineModes
        From :func:`modes`.
    path : path-like
        Its name ends in .json or .csv.

    Returns
    -------
    pathlib.Path
        The file.

    Raises
    ------
    UsageError
        When it ends otherwise, or cannot be written.
    """
    target, kind = stiffness_target(path)
    try:
        target.write_text(stiffness_text(found, kind), encoding="utf-8")
    except OSError as error:
        raise UsageError(f'cannot write "{target}": {error.strerror}') from None
    return target


def stiffness_target(path: str | Path) -> tuple[Path, str]:
    """Return the place and format of a stiffness.

    The place is tested before the work whose result it is to hold.

    Parameters
    ----------
    path : path-like
        Its name ends in .json or .csv.

    Returns
    -------
    tuple of (pathlib.Path, str)
        The file, and "json" or "csv".

    Raises
    ------
    UsageError
        When its name ends otherwise, or nothing can be written there.
    """
    target = Path(path)
    kind = target.suffix.lstrip(".").lower()
    if kind not in ("json", "csv"):
        raise UsageError(f'"{path}": stiffness is written as .json or .csv')
    check_folder(target.absolute().parent, target)
    return check_target(target), kind
