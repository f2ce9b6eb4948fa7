"""Repeat the experiments of Syla et al. 2026.

The source is Syla, Brill, Paulus, Graf and Koch, Lubricants 14, 154.

Table 4 (torque of the 6319), Fig. 5 (altered running of the 6220), Fig. 7 (capacitance of the 6208). A plugin like
anyone's: cases and command come in by entry points.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from lambda_core.studies.scheduler import StudyProgress
    from lambda_syla2026.session import Reproduction


def reproduce(
    what: str,
    out: str | Path = "reproduction",
    *,
    workers: int | None = None,
    quick: bool = False,
    progress: Callable[[StudyProgress], None] | None = None,
    announce: Callable[[str], None] | None = None,
) -> Reproduction:
    """Repeat published experiments, write their figures and one HTML page.

    Parameters
    ----------
    what : str
        ``table4``, ``fig5``, ``fig7`` (of Syla et al. 2026, Lubricants 14, 154), ``anchors`` (SKF's catalogue model on
        other bearings) or ``all``.
    out : path-like
        Folder; what an earlier call has computed there is used again.
    workers : int, optional
        Processes; up to 4 when not given.
    quick : bool
        Fewer runs; the notes say what is left out.
    progress, announce : callable, optional
        Called with the number of points done; with a sentence.

    Returns
    -------
    Reproduction
        Numbers, the bars that are met or missed, the files written, and by experiment the points without a result.

    Raises
    ------
    UsageError
        For an unknown experiment, or a folder that cannot be written.
    """
    from lambda_core.discovery.api import registry
    from lambda_syla2026.session import reproduce as repeat

    return repeat(registry(), what, Path(out), workers=workers, quick=quick, progress=progress, announce=announce)
