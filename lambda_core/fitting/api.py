"""Fit cases to measurements, and compare measured series."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.domain.blas_threads import one_blas_thread

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from lambda_core.case.case_io import Source
    from lambda_core.fitting.measured import MeasuredComparison, MeasuredSeries
    from lambda_core.fitting.measurements import Measurements
    from lambda_core.fitting.report import FitReport
    from lambda_core.fitting.rows import FitProgress
    from lambda_core.fitting.traction_curve import TractionCurve
    from lambda_core.views.chart import ViewData


@one_blas_thread()
def fit(
    source: Source,
    measured: str | Path | Measurements,
    vary: Sequence[str],
    overrides: Iterable[str] = (),
    *,
    bearing: str | None = None,
    predict: str | Path | Measurements | None = None,
    suggest: bool = True,
    sample: int = 0,
    workers: int | None = 1,
    progress: Callable[[FitProgress], None] | None = None,
    announce: Callable[[str], None] | None = None,
) -> FitReport:
    """Fit parameters of a case to measured operating points.

    Parameters
    ----------
    source, overrides
        The case, as for :func:`check`. Columns of the measurements replace its speed, loads and temperatures.
    measured : path-like or Measurements
        CSV file: one operating point per line, columns with units such as ``speed [1/min]``, ``radial load [kN]``,
        ``oil temperature [degC]``, ``friction torque [N mm]`` and errors such as ``friction torque error [%]``. Of a
        machine also ``left friction torque [N mm]`` of the bearing "left", and options such as
        ``loads.belt.force_z [N]``.
    vary : sequence of str
        Parameters: the path or its end ("loss_factor"), with a range where none is published
        ("tau_eyring=3 MPa..10 MPa").
    bearing : str, optional
        One of a machine's: columns and parameters without a name are those of this one.
    predict : path-like or Measurements, optional
        Measured points that the fit does not see, to be compared with its predictions.
    suggest : bool
        Look for the operating point to measure next.
    sample : int
        Number of samples of the posterior to draw, with the extra ``lambda-bearing[sampling]``.
    workers : int, optional
        Processes that solve the operating points of more than 48 lines; None: one for every core.
    progress : callable, optional
        Called with points solved, error of the best values so far and time left, while the values are searched.
    announce : callable, optional
        Called with sentences about the progress.

    Returns
    -------
    FitReport
        ``text()`` for people, ``pictures()`` for :func:`draw`. After Ctrl+C it has the best values so far.

    Raises
    ------
    UsageError, CaseError, SolverError
        With a sentence about the parameters, a line of the file, or a point without an equilibrium.
    """
    from lambda_core.fitting.fit_case import fit_report

    return fit_report(
        source, measured, vary, overrides, bearing=bearing, predict=predict, suggest=suggest, sample=sample,
        workers=workers, progress=progress, announce=announce,
    )  # fmt: skip


def fitted_case(
    source: Source,
    report: FitReport,
    path: str | Path,
    overrides: Iterable[str] = (),
    *,
    overwrite: bool = False,
    rows: bool = False,
) -> Path:
    """Write a case file with fitted values and their origin.

    Parameters
    ----------
    source, overrides
        The case that was fitted; the comments of a file stay.
    report : FitReport
        From :func:`fit`.
    path : path-like
        The new file.
    overwrite : bool
        Replace a file that stands there.
    rows : bool
        Also store the measured values in it.

    Returns
    -------
    pathlib.Path
        The file.

    Raises
    ------
    UsageError
        When the file exists or cannot be written.
    """
    from lambda_core.fitting.fitted_case import write_fitted

    return write_fitted(source, report, path, overrides, overwrite=overwrite, rows=rows)


def measured_series() -> list[MeasuredSeries]:
    """Return the measured series of the program.

    Returns
    -------
    list of MeasuredSeries
        Those of the program, of plugins, and those that were added, each with its source, licence, reading and
        uncertainty. Of two with one name the first is taken.
    """
    from lambda_core.fitting.measured import all_series

    return all_series()


def add_measured(path: str | Path, *, overwrite: bool = False) -> MeasuredSeries:
    """Add a measured series to the catalogue of series.

    Parameters
    ----------
    path : path-like
        TOML file with the entries `title`, `case`, `source`, `licence`, `how_read` and `uncertainty`; the points are in
        the CSV file of the same name next to it. Both are copied into the user's data folder.
    overwrite : bool
        Replace a series of that name that was added before.

    Returns
    -------
    MeasuredSeries

    Raises
    ------
    UsageError, CaseError
        When a file is missing or has mistakes, or the name is taken.
    """
    from lambda_core.fitting.measured import add_series

    return add_series(path, overwrite=overwrite)


@one_blas_thread()
def compare_measured(
    names: Sequence[str] = (), *, band: bool = True, announce: Callable[[str], None] | None = None
) -> MeasuredComparison:
    """Compare measured series with quasi-static solutions; nothing is fitted.

    Parameters
    ----------
    names : sequence of str
        Names of :func:`measured_series`, or files of one's own: a TOML file with the same entries next to a CSV file of
        the same name. All of the program when empty.
    band : bool
        Compute the 90 % model band at every point of ball bearings.
    announce : callable, optional
        Called with a sentence for every series.

    Returns
    -------
    MeasuredComparison
        ``text()`` has a line per point. A series that cannot be computed has the reason.

    Raises
    ------
    UsageError, CaseError
        When there is no such series, or its files have mistakes.
    """
    from lambda_core.fitting.measured import compare

    return compare(names, band=band, announce=announce)


def traction(
    oil: str,
    pressure: str | float,
    temperature: str | float,
    speed: str | float,
    *,
    measured: str | Path | None = None,
    parameters: Mapping[str, Any] | None = None,
    announce: Callable[[str], None] | None = None,
) -> TractionCurve:
    """Compute traction over slide-roll ratio by every law.

    Film, heating and viscosity come from the same laws as in a bearing. The contact rolls and slides in one direction,
    without spin; both bodies have the temperature of the oil at the inlet.

    Parameters
    ----------
    oil : str
        Name in the catalogue.
    pressure, temperature, speed : str
        Largest Hertzian pressure, oil at the inlet, mean speed of both surfaces, with units: "1.25 GPa", "60 degC",
        "2 m/s".
    measured : path-like, optional
        CSV file with the columns ``slide-roll ratio [%]``, ``traction coefficient [-]`` and perhaps ``traction
        coefficient error [%]``.
    parameters : mapping, optional
        Parameters of traction laws by name, for every law that has them: ``{"tau_eyring": "6 MPa"}``.
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    TractionCurve
        ``text()`` is a table, ``picture()`` a picture for :func:`draw`.

    Raises
    ------
    UsageError, CaseError
        For values without units, an unknown oil, or mistakes in the file, with their line.
    SolverError
        When no law can be computed at these conditions.
    """
    from lambda_core.fitting.traction_curve import traction_of

    return traction_of(oil, pressure, temperature, speed, measured=measured, parameters=parameters, announce=announce)


def with_measured(
    pictures: Iterable[ViewData], measured: str | Path, *, result: str | Path | None = None, bearing: str | None = None
) -> list[ViewData]:
    """Add a measured series to pictures with its axes.

    Parameters
    ----------
    pictures : iterable of ViewData
        From :func:`view`, :func:`stribeck_picture`, :func:`thermal_pictures` and so on.
    measured : path-like
        CSV file: one column has the name of a horizontal axis, such as ``speed [1/min]`` or ``time [s]``; others have
        those of vertical axes, such as ``friction torque [N mm]``, or of a line and its axis, such as
        ``outer ring temperature [degC]``. Columns of errors are drawn as bars.
    result : path-like, optional
        A run, which is one point: for a torque over speed the picture is the Stribeck curve of its case, for
        temperatures over time the warm-up of its case.
    bearing : str, optional
        Which one of a machine.

    Returns
    -------
    list of ViewData
        Pictures with the series; those without axes for it are left out.

    Raises
    ------
    UsageError
        When no picture has axes for it, or the file cannot be read.
    CaseError
        With every mistake of the file and its line.
    """
    from lambda_core.fitting.overlay import overlaid, pictures_of_case

    more: list[ViewData] = []
    if result is not None:
        from lambda_core.results.reader import Result

        more = pictures_of_case(Result(Path(result)), measured, bearing)
    return overlaid(more or list(pictures), measured)
