"""Check, run, resume and read studies."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.domain.blas_threads import one_blas_thread

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from concurrent.futures import Executor

    from lambda_core.studies.definition import Study
    from lambda_core.studies.folders import StudyStatus
    from lambda_core.studies.scheduler import StudyProgress
    from lambda_core.studies.study_check import StudyEstimate
    from lambda_core.views.table import StudyTable


@one_blas_thread()
def study_check(
    source: str | Path | Mapping[str, Any] | Study,
    *,
    workers: int | None = None,
    announce: Callable[[str], None] | None = None,
) -> StudyEstimate:
    """Check a study: its points and their cost.

    Parameters
    ----------
    source : path-like, mapping or Study
        Study file, the same as plain tables, or as an object.
    workers : int, optional
        Processes to reckon with; default: the processors that this process may use.
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    StudyEstimate
        Points, wall time, disk space.

    Raises
    ------
    CaseError
        With everything that is wrong: unknown paths, empty ranges, contradicting units, unknown responses.
    UsageError
        When it has too many points; with what they would cost.
    """
    from lambda_core.studies.folders import prepare

    return prepare(source, workers, announce).estimate


def study_run(
    source: str | Path | Mapping[str, Any] | Study,
    folder: str | Path | None = None,
    *,
    executor: str | Executor = "processes",
    workers: int | None = None,
    band: bool = False,
    progress: Callable[[StudyProgress], None] | None = None,
    announce: Callable[[str], None] | None = None,
) -> StudyStatus:
    """Run a study into a new folder.

    Parameters
    ----------
    source : path-like, mapping or Study
        Study file, the same as plain tables, or as an object.
    folder : path-like, optional
        Default: the study's name in the working directory.
    executor : str or concurrent.futures.Executor
        ``processes``, ``dask`` (a cluster on this machine), a dask scheduler's address or file, or an executor.
    workers : int, optional
        Default: the processors that this process may use; a study of a few seconds is done by this process alone.
    band : bool
        Also compute the 90 % model band of the case that is varied, see :func:`model_band`, and of every point: in full
        at up to 8 points that lie far apart, at the others as a mean of these, weighted by distance.
    progress, announce : callable, optional
        Called with where the study stands; with a sentence before something is compiled and with the estimate.

    Returns
    -------
    StudyStatus
        Also when points failed: they are counted, with reasons in the table.

    Raises
    ------
    CaseError, UsageError
        As :func:`study_check`, or when the folder holds a study already.
    """
    from lambda_core.domain.files import check_folder
    from lambda_core.studies.folders import prepare, start

    check_folder(Path(folder or "."), made=True)
    ready = prepare(source, workers, announce)
    if announce is not None:
        announce(ready.estimate.text())
    path = None if folder is None else Path(folder)
    return start(ready, path, where=executor, workers=workers, report=progress, band=band)


def study_resume(
    folder: str | Path,
    *,
    executor: str | Executor = "processes",
    workers: int | None = None,
    retry: bool = False,
    progress: Callable[[StudyProgress], None] | None = None,
) -> StudyStatus:
    """Go on with an interrupted study.

    Parameters
    ----------
    folder : path-like
        Of the study.
    executor, workers, progress
        As for :func:`study_run`.
    retry : bool
        Do failed points again.

    Returns
    -------
    StudyStatus

    Raises
    ------
    UsageError
        When the folder holds no study, another process works on it, or catalogue, laws or program have changed.
    """
    from lambda_core.studies.folders import resume

    return resume(Path(folder), where=executor, workers=workers, retry=retry, report=progress)


def study_status(folder: str | Path) -> StudyStatus:
    """Return the progress of a study, also while it runs.

    Parameters
    ----------
    folder : path-like
        Of the study.

    Returns
    -------
    StudyStatus

    Raises
    ------
    UsageError
        When the folder holds no study.
    """
    from lambda_core.studies.folders import status

    return status(Path(folder))


def study_table(folder: str | Path) -> StudyTable:
    """Return the table of a study as far as known.

    Parameters
    ----------
    folder : path-like
        Of the study.

    Returns
    -------
    StudyTable
        One row per point, parameters and responses with units.

    Raises
    ------
    UsageError
        When the folder holds no study.
    """
    from lambda_core.studies.folders import table

    return table(Path(folder))


def study_schema() -> dict[str, Any]:
    """Return the JSON schema of a study file.

    Returns
    -------
    dict
        JSON Schema, draft 2020-12.
    """
    from lambda_core.studies.definition import study_json_schema

    return study_json_schema()
