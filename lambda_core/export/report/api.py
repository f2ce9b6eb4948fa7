"""Produce views, figures, and pages about runs and studies."""

from __future__ import annotations

import logging
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.domain.errors import LambdaError, UsageError, unknown_name
from lambda_core.domain.files import check_folder, check_new, check_target
from lambda_core.model.api import check
from lambda_core.runs.stored import result
from lambda_core.studies.api import study_status

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from lambda_core.analysis.rotor.machine_modes import MachineModes
    from lambda_core.export.report.chapters import Chapter
    from lambda_core.export.report.gallery import ViewCard
    from lambda_core.export.report.key_tables import Table
    from lambda_core.export.report.page import Cover
    from lambda_core.fitting.report import FitReport
    from lambda_core.results.quasistatic import StaticAnswer
    from lambda_core.results.reader import Result
    from lambda_core.views.chart import ViewData
    from lambda_core.views.view import Subject

log = logging.getLogger("lambda_core")
_PAGES = (".html", ".htm")


def views(subject: Subject | None = None) -> list[ViewCard]:
    """Return the installed views with their options.

    Parameters
    ----------
    subject : str, optional
        Only those of ``result``, ``results`` (two or more) or ``study``.

    Returns
    -------
    list of ViewCard
    """
    from lambda_core.discovery.api import registry
    from lambda_core.export.report.gallery import cards

    return cards(registry(), subject)


def view(
    source: str | PathLike[str] | Sequence[str | PathLike[str]],
    name: str,
    options: Mapping[str, Any] | None = None,
    *,
    bearing: str | None = None,
) -> ViewData:
    """Return what one view shows, as data with units.

    Parameters
    ----------
    source : path-like or sequence of them
        A result or its file, the folder of a study, or several results.
    name : str
        View (:func:`views`).
    options : mapping, optional
        Options of the view by name.
    bearing : str, optional
        Which bearing of a machine; may be left out where there is one, and for views of the machine.

    Returns
    -------
    ViewData
        Panels of series and fields; ``as_dict()`` is ready for JSON.

    Raises
    ------
    UsageError
        For a file, view or option that does not exist.
    NotApplicable
        When there is nothing to show; the sentence says why.
    """
    from lambda_core.discovery.api import data_of, registry, view_of

    subject, kind = subject_of(source, bearing)
    return data_of(view_of(registry(), name, kind), subject, options or {})


def view_all(
    source: str | PathLike[str] | Sequence[str | PathLike[str]],
    *,
    bearing: str | None = None,
) -> Iterator[tuple[str, ViewData | LambdaError]]:
    """Show every view of a source, one after the other.

    Parameters
    ----------
    source, bearing
        As for :func:`view`; of a machine without `bearing` only the views of the machine.

    Yields
    ------
    tuple of str and (ViewData or LambdaError)
        Name of the view; its data, or the reason why it shows nothing.

    Raises
    ------
    UsageError
        For a file that does not exist or is no result.
    """
    from lambda_core.discovery.api import registry
    from lambda_core.export.report.gallery import every

    subject, kind = subject_of(source, bearing)
    for found, data in every(registry(), subject, kind):
        yield found.name, data


def machine_pictures(equilibrium: StaticAnswer | None = None, modes: MachineModes | None = None) -> list[ViewData]:
    """Draw a bearing or a machine at its operating point.

    One bearing under its load; deflection and bending moment of a shaft, its natural frequencies over speed.

    Parameters
    ----------
    equilibrium : QuasiStatic or MachineEquilibrium, optional
        From :func:`quasistatic`.
    modes : MachineModes, optional
        From :func:`modes`.

    Returns
    -------
    list of ViewData
        For :func:`draw`: every installed view of a machine that has something to show. A warning names one that fails.

    Raises
    ------
    UsageError
        For an equilibrium that was read from data.
    """
    from lambda_core.discovery.api import registry
    from lambda_core.domain.plugin_errors import failures_so_far
    from lambda_core.export.report.gallery import every
    from lambda_core.views.chart import ViewData
    from lambda_core.views.view import MachineData

    model = equilibrium.solved() if equilibrium is not None else None
    shown = [data for _, data in every(registry(), MachineData(model, equilibrium, modes), "machine")]
    for reason in shown:
        if str(reason) in failures_so_far():
            log.warning("%s", reason)
    return [data for data in shown if isinstance(data, ViewData)]


def draw(data: ViewData, folder: str | Path, stem: str, formats: Sequence[str] = ("svg", "png")) -> list[Path]:
    """Draw a view into files ``stem-view.format`` of a folder.

    Parameters
    ----------
    data : ViewData
        From :func:`view`.
    folder : path-like
        Where the files go; made if it does not exist.
    stem : str
        Beginning of their names (:func:`view_stem`).
    formats : sequence of str
        What matplotlib can write: ``svg``, ``png``, ``pdf``.

    Returns
    -------
    list of pathlib.Path
        One per format.

    Raises
    ------
    UsageError
        When a file cannot be written or the format is unknown.
    """
    from lambda_core.discovery.api import registry
    from lambda_core.export.report.gallery import write

    return write(registry(), data, Path(folder), stem, formats)


def view_stem(source: Sequence[str | PathLike[str]], bearing: str | None = None) -> str:
    """Return the stem of file names for these pictures.

    Parameters
    ----------
    source : sequence of path-like
        Results or their files, or the folder of one study.
    bearing : str, optional
        Which bearing of machines.

    Returns
    -------
    str
    """
    from lambda_core.export.report.gallery import stem_of

    if not len(source):
        raise UsageError(_NO_SOURCE)
    stem = stem_of([Path(path) for path in source])
    return f"{stem}-{bearing}" if bearing else stem


def animate(
    source: str | PathLike[str],
    out: str | Path | None = None,
    *,
    bearing: str | None = None,
    turns: float = 1.0,
    start: float | None = None,
    frames: int = 120,
    fps: float = 25.0,
    overwrite: bool = False,
    progress: Callable[[int, int], None] | None = None,
) -> Path:
    """Animate a run as GIF, MP4 or binary glTF.

    Parameters
    ----------
    source : path-like
        A result or its file.
    out : path-like, optional
        File whose ending says the format: ``.gif``, ``.mp4`` (with the extra ``animation``) or ``.glb``; default: the
        name of the source with ``.gif`` in the working directory.
    bearing : str, optional
        Which bearing of a machine; may be left out where there is one.
    turns : float
        Revolutions of the cage to show.
    start : float, optional
        First moment [s]; default: the last `turns` of the run.
    frames : int
        Number of frames, evenly spaced in time.
    fps : float
        Frames per second when played.
    overwrite : bool
        Replace a file that stands there.
    progress : callable, optional
        Called with the number of frames drawn and of all.

    Returns
    -------
    pathlib.Path
        The file.

    Raises
    ------
    UsageError
        When the source is no result or has no such moment, the format is unknown or has no encoder, or the file exists
        or cannot be written.
    """
    from lambda_core.discovery.api import registry
    from lambda_core.export.report.animation import check_format, check_pace, write_animation
    from lambda_core.export.report.run_scene import scene_of

    path = Path(out) if out is not None else Path(f"{view_stem([source], bearing)}.gif")
    check_format(path)
    check_pace(turns, frames, fps)
    _refuse_existing(path, overwrite)
    scene = scene_of(result(source, bearing).of_bearing(), start=start, turns=turns, frames=frames)
    return write_animation(registry(), scene, path, fps, progress)


def report(
    source: str | PathLike[str] | FitReport | Sequence[str | PathLike[str] | FitReport],
    out: str | Path | None = None,
    *,
    overwrite: bool = False,
    project: str = "",
    author: str = "",
    appendices: Sequence[str] = (),
    units: str = "si",
    bearing: str | None = None,
) -> Path:
    """Write one document about results as HTML or PDF.

    Four pages about one bearing: verdict with margins, sketch and key numbers; loads, lives and losses; inputs;
    limits. A machine has its shaft first, then two bearings on a page.

    Parameters
    ----------
    source : path-like, FitReport, or sequence of them
        A result or its file, a case file (solved at t = 0, without time), the folder of a study, or a fit; several
        stand in one document after tables that compare the results.
    out : path-like, optional
        File whose ending says the format: ``.html``, or ``.pdf`` where a browser or WeasyPrint (extra ``pdf``) is
        installed; default: the name of the source with ``.html`` in the working directory.
    overwrite : bool
        Replace a page that stands there.
    project, author : str
        What the head of the page says, except for the day.
    appendices : sequence of str, optional
        What follows the standard pages: ``tables``, ``views``, ``trust``, ``inputs``, ``assumptions``, ``laws``,
        ``references``, ``origin``, or ``all``; default: nothing.
    units : str
        ``si`` or ``us``: in which numbers are shown; the case stands as it was written.
    bearing : str, optional
        Which bearing of a machine; may be left out where there is one.

    Returns
    -------
    pathlib.Path
        The page.

    Raises
    ------
    UsageError
        When the source is neither, an appendix is unknown, nothing can print a PDF, or the page exists or cannot be
        written.
    """
    from lambda_core.export.report.page import comparison_tables, document, write_page
    from lambda_core.export.report.pdf import write_pdf
    from lambda_core.fitting.report import FitReport
    from lambda_core.results.reader import Result

    sources = [source] if isinstance(source, str | PathLike | Result | FitReport) else list(source)
    if not sources:
        raise UsageError("a report needs a result, a case, a study or a fit")
    fits = [one for one in sources if isinstance(one, FitReport)]
    stored = [one for one in sources if not isinstance(one, FitReport)]
    stem = f"{fits[0].case}-fit" if fits else view_stem(stored, bearing)
    path = Path(out) if out is not None else Path(f"{stem}.html")
    cover = _cover(project, author, appendices, units)
    is_pdf = check_page(path, overwrite=overwrite)
    chapters = [_chapter(one, bearing, cover) for one in sources]
    runs = [
        one
        for one, chapter in zip(sources, chapters, strict=True)
        if chapter.kind == "run" and not isinstance(one, FitReport)
    ]
    compared: tuple[Table, ...] = ()
    if len(runs) > 1:
        from lambda_core.runs.stored import side_by_side

        compared = comparison_tables(side_by_side(runs), cover.units)
    text = document(chapters, cover, compared)
    return write_pdf(text, path) if is_pdf else write_page(text, path)


def check_page(path: Path, *, overwrite: bool) -> bool:
    """Refuse a page that cannot be written, before the work.

    Returns
    -------
    bool
        Whether it is a PDF.

    Raises
    ------
    UsageError
        When it exists, its folder takes no file, its ending is unknown, or nothing can print a PDF.
    """
    from lambda_core.export.report.pdf import check_printer

    _refuse_existing(path, overwrite)
    ending = path.suffix.lower()
    if ending == ".pdf":
        check_printer()
    elif ending not in _PAGES:
        raise UsageError(f"{path}: a report is written as {', '.join(_PAGES)} or .pdf")
    return ending == ".pdf"


def _chapter(source: str | PathLike[str] | FitReport, bearing: str | None, cover: Cover) -> Chapter:
    """Return the chapter about a subject.

    It is a result, a case, a study or a fit.
    """
    from lambda_core.discovery.api import registry
    from lambda_core.export.report.page import run_chapter, study_chapter
    from lambda_core.fitting.report import FitReport

    if isinstance(source, FitReport):
        from lambda_core.export.report.fit_chapter import fit_chapter

        return fit_chapter(registry(), source, cover)
    if _is_case(source):
        return _case_chapter(source, bearing, cover)
    subject, kind = subject_of(source, bearing)
    if kind == "result":
        return run_chapter(registry(), subject, cover)
    from lambda_core.case.case_io import toml_tables
    from lambda_core.export.report.chapters import model_inputs
    from lambda_core.studies.folders import files

    definition, case_toml = files(Path(source))
    model = check(toml_tables(case_toml, str(source)), is_static=True)
    inputs = model_inputs(model, cover.units)
    return study_chapter(registry(), subject, study_status(Path(source)), inputs, definition, cover)


def _is_case(source: str | PathLike[str]) -> bool:
    """Tell whether a source is a case file."""
    return isinstance(source, str | PathLike) and Path(source).suffix.lower() == ".toml" and Path(source).is_file()


def _case_chapter(source: str | PathLike[str], bearing: str | None, cover: Cover) -> Chapter:
    """Return the chapter about a case at its operating point."""
    from lambda_core.analysis.rotor.bearing_alone import bearing_number
    from lambda_core.analysis.thermal.temperatures import ready
    from lambda_core.discovery.api import registry
    from lambda_core.export.report.chapters import case_chapter
    from lambda_core.export.report.page import machine_drawings
    from lambda_core.runs.api import quasistatic

    model = ready(Path(source), is_static=True)
    if bearing is not None:
        bearing_number(model, bearing)  # refuses one that there is not
    found = quasistatic(model, band=True)
    return case_chapter(model, found, cover.units, machine_drawings(registry(), model, found, cover), bearing)


def _cover(project: str, author: str, appendices: Sequence[str], units: str) -> Cover:
    """Return the page's parts other than results.

    It has the day only where somebody signs.
    """
    from datetime import date

    from lambda_core.domain.unit_systems import unit_system
    from lambda_core.export.report.page import APPENDICES, Cover

    chosen = tuple(APPENDICES if "all" in appendices else appendices)
    for name in chosen:
        if name not in APPENDICES:
            raise UsageError(unknown_name("appendix", name, ("all", *APPENDICES)))
    return Cover(project, author, date.today().isoformat() if project or author else "", chosen, unit_system(units))


def _refuse_existing(path: Path, overwrite: bool) -> None:
    """Refuse existing files before the work."""
    if not check_target(check_new(path, overwrite)).exists():
        check_folder(path.absolute().parent, path)


_NO_SOURCE = "the list of results is empty: give at least one result, or the folder of a study"


def subject_of(
    source: str | PathLike[str] | Sequence[str | PathLike[str]], bearing: str | None = None
) -> tuple[Any, Subject]:
    """Return the subject of a view and its kind."""
    from lambda_core.studies.folders import is_study, table

    if not isinstance(source, str | PathLike):
        if not len(source):
            raise UsageError(_NO_SOURCE)
        if len(source) != 1:
            return [_begun(result(one, bearing)) for one in source], "results"
        source = source[0]
    if is_study(Path(source)):
        if bearing is not None:
            raise UsageError(f'{source} is a study, whose numbers name their bearing: leave out --bearing "{bearing}"')
        return table(Path(source)), "study"
    return _begun(result(source, bearing)), "result"


def _begun(found: Result) -> Result:
    """Return a result that has samples.

    A result without samples raises a UsageError.
    """
    if not found.status().rows.samples:
        raise UsageError(f"{found.path} holds no samples yet: wait for the first ones, or run the case again")
    return found
