"""Run a study from Python."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from lambda_core.domain.errors import UsageError
from lambda_core.domain.lists import listed

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from lambda_core.case.case_io import Source
    from lambda_core.studies.scheduler import StudyProgress
    from lambda_core.views.table import StudyTable


def study(
    source: Source,
    varies: Mapping[str, Sequence[Any]],
    asks: Iterable[str] = (),
    *,
    mode: Literal["quasi-static", "dynamic"] = "quasi-static",
    folder: str | Path | None = None,
    executor: str | Executor = "processes",
    workers: int | None = None,
    band: bool = False,
    progress: Callable[[StudyProgress], None] | None = None,
    announce: Callable[[str], None] | None = None,
) -> StudyTable:
    """Vary options of a case and return a table.

    Parameters
    ----------
    source
        A case as for :func:`check`.
    varies : mapping of str to sequence
        Values of each option by its path: ``{"gears.wheel.power": ["5 kW", "15 kW"]}``.
    asks : iterable of str
        Names of responses; default: the usual ones.
    mode : "quasi-static" or "dynamic"
        Equilibria, or full runs.
    folder : path-like, optional
        Keep the study there, so that :func:`study_resume` goes on with it; default: it is gone afterwards.
    executor, workers, band, progress, announce
        As for :func:`study_run`.

    Returns
    -------
    StudyTable
        ``rows()`` has a mapping for each point.

    Raises
    ------
    CaseError, UsageError
        As :func:`study_check`.

    Examples
    --------
    ``api.study("6208-axial-1300", {"lubricant.temperature": ["40 degC", "70 degC"]}, asks=["power_loss_W"])``
    """
    from lambda_core.case.case_io import read_case
    from lambda_core.studies.definition import validate_study
    from lambda_core.studies.folders import prepare, start, table

    if not varies:
        raise UsageError('nothing varies: give options with values, {"lubricant.temperature": ["40 degC", "70 degC"]}')
    case = read_case(source)
    definition = validate_study(
        {
            "name": case.name,
            "case": "case.toml",
            "mode": mode,
            "responses": listed(asks, "asks"),
            "parameters": [
                {"path": path, "values": listed(values, f"values of {path}")} for path, values in varies.items()
            ],
        }
    )
    ready = prepare(definition, workers, announce, case)
    with ExitStack() as stack:
        place = folder or Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="lambda-bearing-"))) / "study"
        start(ready, Path(place), where=executor, workers=workers, report=progress, band=band)
        return table(Path(place))
