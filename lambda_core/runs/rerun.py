"""Run a case again, with its temperatures and changes."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.domain.blas_threads import one_blas_thread

if TYPE_CHECKING:
    from lambda_core.results.reader import Result


@one_blas_thread()
def rerun(found: Result, changes: Mapping[str, Any], out: str | Path | None) -> Result:
    """Run the changed case of a result.

    The run writes `out` as :func:`lambda_core.api.run` does.
    """
    from lambda_core.analysis.thermal.temperatures import ready  # `show` starts without what runs need
    from lambda_core.case.case_io import read_case, toml_tables
    from lambda_core.runs.launch import launch

    case = read_case(toml_tables(found.case_toml, str(found.path))).with_(**changes)
    return launch(ready(case), None if out is None else Path(out)).rerun_by(rerun)
