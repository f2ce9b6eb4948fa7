"""The one door: everything that a face, a script or a plugin may ask of the program.

Heavy libraries are loaded inside the functions that need them.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.errors import CaseError, LambdaError, Problem, UsageError, unknown_name

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
    from concurrent.futures import Executor

    from lambda_core.physics.describe import CaseReport
    from lambda_core.physics.model import BearingModel
    from lambda_core.registry.catalogue import Catalogue
    from lambda_core.registry.chart import ViewData
    from lambda_core.registry.survey import CheckCard, FaultCard, Inventory, ModelCard
    from lambda_core.registry.table import StudyTable
    from lambda_core.registry.view import Subject
    from lambda_core.report.gallery import ViewCard
    from lambda_core.reproduce.session import Reproduction
    from lambda_core.schema.case import Case
    from lambda_core.schema.draft import Draft
    from lambda_core.simulate.citation import Citation
    from lambda_core.simulate.comparison import Comparison
    from lambda_core.simulate.estimate import Estimate
    from lambda_core.simulate.progress import Progress
    from lambda_core.simulate.quasistatic import QuasiStatic
    from lambda_core.simulate.results import Result
    from lambda_core.simulate.summary import Summary
    from lambda_core.simulate.warmup import Warmup
    from lambda_core.study.check import StudyEstimate
    from lambda_core.study.definition import Study
    from lambda_core.study.director import StudyProgress
    from lambda_core.study.session import StudyStatus

__all__ = [
    "CaseError",
    "LambdaError",
    "UsageError",
    "builtin_cases",
    "case",
    "catalogue",
    "check",
    "check_plugins",
    "cite",
    "compare",
    "describe",
    "draft",
    "draw",
    "estimate",
    "init_case",
    "new_plugin",
    "plugin_faults",
    "plugin_model",
    "plugins",
    "problems",
    "quasistatic",
    "report",
    "reproduce",
    "resolve",
    "result",
    "resume",
    "run",
    "save",
    "schema",
    "study_check",
    "study_resume",
    "study_run",
    "study_schema",
    "study_status",
    "study_table",
    "summary",
    "view",
    "view_all",
    "view_stem",
    "views",
    "warmup",
]


def case(source: str | Path, overrides: Iterable[str] = ()) -> Case:
    """Read a case from a TOML file or by the name of a built-in one.

    Parameters
    ----------
    source : str or Path
        File, or built-in name such as "6319-cp10-1500".
    overrides : iterable of str
        Changes ``path=value``, as ``--set`` takes them.

    Returns
    -------
    Case
        Values in SI; what the file leaves open has its default.

    Raises
    ------
    UsageError
        When there is no such file or name, or an override has no ``=``.
    CaseError
        With every problem of the case.
    """
    from lambda_core.schema.case_io import apply_overrides, load_case

    loaded, changes = load_case(source), list(overrides)
    return apply_overrides(loaded, changes) if changes else loaded


def builtin_cases() -> dict[str, str]:
    """Return the names of the built-in cases and what each is.

    Returns
    -------
    dict of str to str
    """
    from lambda_core.schema.case_io import builtin_cases

    return builtin_cases()


def save(case: Case, path: str | Path) -> None:
    """Write a case as TOML; comments of the file that stands there are kept.

    Parameters
    ----------
    case : Case
        What to write: options at their default are left out.
    path : path-like
        The file.

    Raises
    ------
    UsageError
        When the file cannot be written; what stood there is untouched.
    """
    from lambda_core.schema.case_writer import save_case

    save_case(case, path)


def init_case(
    name: str, start: str = "6319-cp10-1500", path: str | Path | None = None, overwrite: bool = False
) -> Path:
    """Write a commented case called `name` that starts from another.

    Parameters
    ----------
    name : str
        Letters, digits, dot, dash and underscore.
    start : str
        Built-in case or case file to start from.
    path : path-like, optional
        Default: NAME.toml in the working directory.
    overwrite : bool
        Replace a file that stands there.

    Returns
    -------
    pathlib.Path
        The file.

    Raises
    ------
    UsageError
        When the file exists, cannot be written, or there is no such case to start from.
    CaseError
        When `name` cannot be a case's name.
    """
    from lambda_core.schema.case_writer import new_case

    return new_case(name, start, Path(path) if path is not None else Path(f"{name}.toml"), overwrite)


def schema() -> dict[str, Any]:
    """Return the JSON schema of a case file.

    Returns
    -------
    dict
        JSON Schema, draft 2020-12.
    """
    from lambda_core.schema.case_io import case_json_schema

    return case_json_schema()


def resolve(case: Case, catalogue: Catalogue | None = None) -> BearingModel:
    """Freeze a case into the model of a run: every value in SI with its origin.

    Parameters
    ----------
    case : Case
        What the engineer wrote.
    catalogue : Catalogue, optional
        An open catalogue to look things up in; default: one is opened for this call.

    Returns
    -------
    BearingModel
        Immutable: values, laws, assumptions.

    Raises
    ------
    CaseError
        With everything that is unknown, missing, contradictory or impossible.
    """
    from contextlib import closing

    from lambda_core.physics.resolve import resolve as freeze
    from lambda_core.registry.manager import registry

    models = registry()
    if catalogue is not None:
        return freeze(case, models, catalogue)
    with closing(models.catalogue()) as opened:
        return freeze(case, models, opened)


def check(
    source: str | Path | Mapping[str, Any] | Case,
    overrides: Iterable[str] = (),
    *,
    folder: Path | None = None,
    catalogue: Catalogue | None = None,
) -> BearingModel:
    """Read and resolve a case without running it.

    Parameters
    ----------
    source : str, Path, mapping or Case
        File, built-in name, plain tables as they stand in a file, or a case.
    overrides : iterable of str
        Changes ``path=value``.
    folder : pathlib.Path, optional
        Where file names in plain tables are looked up; default: the working directory.
    catalogue : Catalogue, optional
        An open catalogue to look things up in; default: one is opened for this call.

    Returns
    -------
    BearingModel
        With its assumptions and the origin of every value.

    Raises
    ------
    CaseError
        With every mistake at once: those of the file itself and those that only the catalogue, the
        registry and the geometry can show.
    """
    from collections.abc import Mapping

    from lambda_core.schema.case import Case
    from lambda_core.schema.case_io import apply_overrides, validate_case
    from lambda_core.schema.salvage import InvalidCase

    changes = list(overrides)
    try:
        if isinstance(source, Mapping):
            loaded = validate_case(source, str(source.get("name", "case")), folder)
        else:
            loaded = source if isinstance(source, Case) else case(source)
        return resolve(apply_overrides(loaded, changes) if changes else loaded, catalogue)
    except InvalidCase as error:
        if error.remainder is None:
            raise
        try:
            resolve(error.remainder, catalogue)
        except CaseError as more:
            raise error.joined(more.problems) from None
        raise


def problems(source: Mapping[str, Any] | Case) -> tuple[Problem, ...]:
    """Return every mistake of a case or of plain tables; for forms that check while one types.

    Parameters
    ----------
    source : mapping or Case
        Plain tables as they stand in a file, or a case.

    Returns
    -------
    tuple of Problem
        Place and sentence of each; empty when the case is fine.
    """
    try:
        check(source)
    except CaseError as error:
        return error.problems
    return ()


def draft(source: str | Path | None = None) -> Draft:
    """Open a case for editing: a file, a copy of a built-in case, or one that says nothing yet.

    Parameters
    ----------
    source : str or Path, optional
        File or built-in name; None for an empty draft.

    Returns
    -------
    Draft
        Plain tables that may be wrong, with undo.

    Raises
    ------
    UsageError
        When there is no such file or built-in case.
    CaseError
        When the file is not TOML; any other mistake may stand in a draft.
    """
    from lambda_core.schema.draft import new_draft, open_draft

    return new_draft() if source is None else open_draft(source)


def describe(model: BearingModel) -> CaseReport:
    """Say what a resolved model is: headline, bodies, models, assumptions, every value with its origin.

    Parameters
    ----------
    model : BearingModel
        From :func:`check` or :func:`resolve`.

    Returns
    -------
    CaseReport
        ``text()`` are the lines for people.
    """
    from lambda_core.physics.describe import describe as report

    return report(model)


def catalogue() -> Catalogue:
    """Open the catalogue of bearings, lubricants, materials and cages.

    Returns
    -------
    Catalogue
        The caller closes it.

    Raises
    ------
    PluginError
        When no installed plugin provides one.
    """
    from lambda_core.registry.manager import registry

    return registry().catalogue()


def plugins() -> Inventory:
    """Return everything that is installed, and the plugins that are not in use.

    Returns
    -------
    Inventory
        Models, methods, views and data folders with their distributions; faults with the reason.
    """
    from lambda_core.registry.manager import registry
    from lambda_core.registry.survey import inventory

    return inventory(registry())


def plugin_model(label: str) -> ModelCard:
    """Return everything about one model: parameters with units, limits and sources, validity, reference.

    Parameters
    ----------
    label : str
        "role/name", for example "traction/ree-eyring".

    Returns
    -------
    ModelCard

    Raises
    ------
    UsageError
        When `label` is not of that form or there is no such role.
    PluginError
        When the role has no such model, or it cannot be imported.
    """
    from lambda_core.registry.manager import registry
    from lambda_core.registry.survey import model_card

    return model_card(registry(), label)


def check_plugins(names: Sequence[str] = ()) -> Iterator[CheckCard]:
    """Try models against the contract of their role, one after the other.

    Parameters
    ----------
    names : sequence of str
        Distributions, roles or "role/name"; everything when empty.

    Yields
    ------
    CheckCard
        One per model, in the order of the pipeline.

    Raises
    ------
    UsageError
        When a name is none of these.
    """
    from lambda_core.registry.manager import registry
    from lambda_core.registry.survey import check_installed

    return check_installed(registry(), names)


def plugin_faults(names: Sequence[str] = ()) -> list[FaultCard]:
    """Return the plugins that could not be taken into use.

    Parameters
    ----------
    names : sequence of str
        Distributions; all when empty.

    Returns
    -------
    list of FaultCard
        With the reason of each.
    """
    from lambda_core.registry.manager import registry
    from lambda_core.registry.survey import broken

    return broken(registry(), names)


def new_plugin(name: str, folder: str | Path = ".") -> list[Path]:
    """Write the sources of a small plugin package.

    Parameters
    ----------
    name : str
        Lower case and hyphens, for example "my-traction".
    folder : path-like
        Where the package's folder `name` is made.

    Returns
    -------
    list of pathlib.Path
        The files that were written.

    Raises
    ------
    UsageError
        When the name is taken or not of that form, or the folder exists or cannot be written.
    """
    from lambda_core.registry.scaffold import new_plugin as write

    return write(name, Path(folder))


def quasistatic(
    source: str | Path | Mapping[str, Any] | Case | BearingModel,
    overrides: Iterable[str] = (),
    *,
    announce: Callable[[str], None] | None = None,
) -> QuasiStatic:
    """Solve the quasi-static equilibrium of a case at t = 0: loads, angles, films, friction; no time, no cage.

    Parameters
    ----------
    source, overrides
        As for :func:`check`, or a resolved model.
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    QuasiStatic
        Numbers in the units of their names.

    Raises
    ------
    CaseError, SolverError
        With a sentence about the case, or about why there is no equilibrium.
    """
    from lambda_core.physics.equilibrium import solve
    from lambda_core.simulate.quasistatic import quasistatic_of

    return quasistatic_of(solve(_model(source, overrides), announce=announce))


def estimate(
    source: str | Path | Mapping[str, Any] | Case | BearingModel, *, announce: Callable[[str], None] | None = None
) -> Estimate:
    """Say what can be said of a case before it is run: equilibrium, rating life, wall time.

    Parameters
    ----------
    source
        As for :func:`check`, or a resolved model.
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    Estimate
        Numbers that there are none of are None.

    Raises
    ------
    CaseError, SolverError
        With a sentence about the case, or about why there is no equilibrium.
    """
    from lambda_core.registry.manager import registry
    from lambda_core.simulate.estimate import estimate as ask

    return ask(_model(source), registry().methods, announce)


def run(
    source: str | Path | Mapping[str, Any] | Case | BearingModel,
    overrides: Iterable[str] = (),
    *,
    out: str | Path | None = None,
    force: bool = False,
    progress: Callable[[Progress], None] | None = None,
    announce: Callable[[str], None] | None = None,
) -> Result:
    """Simulate a case into a result file.

    Parameters
    ----------
    source, overrides
        As for :func:`check`, or a resolved model.
    out : path-like, optional
        The result file; by default the case's name with ``.h5``, numbered where that is taken.
    force : bool
        Overwrite `out`.
    progress : callable, optional
        Called some ten times a second.
    announce : callable, optional
        Called with a sentence before something is compiled, and with the equilibrium found.

    Returns
    -------
    Result
        Also of a run that ended early or is not converged: its summary says so and why.

    Raises
    ------
    CaseError, SolverError, PartialResultError
        With a sentence about the case, the solver (the file keeps what there is) or the disk.
    """
    from lambda_core.simulate.launch import launch

    path = None if out is None else Path(out)
    return launch(_model(source, overrides), path, force=force, report=progress, announce=announce)


def resume(
    path: str | Path,
    overrides: Iterable[str] = (),
    *,
    progress: Callable[[Progress], None] | None = None,
    announce: Callable[[str], None] | None = None,
) -> Result:
    """Go on with an interrupted run, bit for bit as if it had not been.

    Parameters
    ----------
    path : path-like
        Result file of a run that was interrupted, killed, or is to be longer.
    overrides : iterable of str
        ``solver.duration=...``, ``solver.max_duration=...`` or ``solver.max_wall=...``; anything else
        would be another run.
    progress, announce
        As for :func:`run`.

    Returns
    -------
    Result
        As from :func:`run`.

    Raises
    ------
    UsageError
        When the file is no result, nothing is left to do, or the case or the code has changed.
    """
    from lambda_core.schema.case_io import apply_overrides, parse_case
    from lambda_core.simulate.launch import relaunch

    text = result(path).case_toml
    model = resolve(apply_overrides(parse_case(text, str(path)), overrides))
    return relaunch(Path(path), model, report=progress, announce=announce)


def result(path: str | Path) -> Result:
    """Open a result file: finished, still growing, or left behind by a killed process.

    Parameters
    ----------
    path : path-like
        The file.

    Returns
    -------
    Result
        Reads from the file what it is asked for.

    Raises
    ------
    UsageError
        When the file does not exist, is not a result, or is damaged.
    """
    from lambda_core.simulate.results import Result

    return Result(path)


def summary(path: str | Path) -> Summary:
    """Return the averages and the end state of a result (the machine interface).

    Parameters
    ----------
    path : path-like
        Result file.

    Returns
    -------
    Summary
        Numbers in the units of their names.

    Raises
    ------
    UsageError
        When the file is no result or holds no samples yet.
    """
    return result(path).summary()


def cite(path: str | Path) -> Citation:
    """Return the references of exactly the laws and data that a result used, and of the program.

    Parameters
    ----------
    path : path-like
        Result file.

    Returns
    -------
    Citation
        Read from the file: it does not need the plugins that were used.

    Raises
    ------
    UsageError
        When the file does not exist, is not a result, or is damaged.
    """
    from lambda_core.simulate.citation import citation

    return citation(result(path))


def warmup(*, announce: Callable[[str], None] | None = None) -> Warmup:
    """Compile the solver and every installed law ahead of the first run.

    Parameters
    ----------
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    Warmup
        What was compiled now, what was there, and the laws that cannot be compiled.
    """
    from lambda_core.registry.manager import registry
    from lambda_core.simulate.warmup import warmup as compile_all

    return compile_all(registry(), announce)


def compare(
    source: str | Path | Mapping[str, Any] | Case | BearingModel,
    overrides: Iterable[str] = (),
    *,
    methods: Sequence[str] = (),
    result: str | Path | None = None,
    contamination: float | None = None,
    announce: Callable[[str], None] | None = None,
) -> Comparison:
    """Put every comparison method beside the others on one case, at its start.

    Parameters
    ----------
    source, overrides
        As for :func:`check`, or a resolved model.
    methods : sequence of str
        Names of methods; every installed one when empty.
    result : path-like, optional
        Result file of the same case: its simulation becomes the first column.
    contamination : float, optional
        e_C of ISO 281, for modified lives.
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    Comparison
        One column per method, rows with units; methods that do not apply with the reason.

    Raises
    ------
    UsageError
        For an unknown method, or a result of another case.
    CaseError, SolverError
        With a sentence about the case, or about why there is no equilibrium.
    """
    from lambda_core.physics.comparison import compare as ask
    from lambda_core.registry.manager import registry
    from lambda_core.simulate.comparison import comparison_of
    from lambda_core.simulate.results import Result

    model, known = _model(source, overrides), registry().methods
    unknown = next((name for name in methods if name not in known), None)
    if unknown is not None:
        raise UsageError(unknown_name("comparison method", unknown, known))
    simulated = None if result is None else Result(result)
    chosen = [known[name] for name in methods or known]
    return comparison_of(model, ask(model, chosen, contamination=contamination, announce=announce), simulated)


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
        ``table4``, ``fig5``, ``fig7`` (of Syla et al. 2026, Lubricants 14, 154) or ``all``.
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
        Numbers, the bars that are met or missed, and the files written.

    Raises
    ------
    UsageError
        For an unknown experiment, or a folder that cannot be written.
    SolverError
        When a point that everything else depends on has no solution.
    """
    from lambda_core.registry.manager import registry
    from lambda_core.reproduce.session import reproduce as repeat

    return repeat(registry(), what, Path(out), workers=workers, quick=quick, progress=progress, announce=announce)


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
    from lambda_core.registry.manager import registry
    from lambda_core.report.gallery import cards

    return cards(registry(), subject)


def view(source: str | Path | Sequence[str | Path], name: str, options: Mapping[str, Any] | None = None) -> ViewData:
    """Return what one view shows, as data with units.

    Parameters
    ----------
    source : path-like or sequence of them
        A result file, the folder of a study, or several result files.
    name : str
        View (:func:`views`).
    options : mapping, optional
        Options of the view by name.

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
    from lambda_core.registry.manager import registry
    from lambda_core.report.gallery import data_of, view_of

    subject, kind = _subject(source)
    return data_of(view_of(registry(), name, kind), subject, options or {})


def view_all(source: str | Path | Sequence[str | Path]) -> Iterator[tuple[str, ViewData | LambdaError]]:
    """Show every view of a source, one after the other.

    Parameters
    ----------
    source : path-like or sequence of them
        As for :func:`view`.

    Yields
    ------
    tuple of str and (ViewData or LambdaError)
        Name of the view; its data, or the reason why it shows nothing.

    Raises
    ------
    UsageError
        For a file that does not exist or is no result.
    """
    from lambda_core.registry.manager import registry
    from lambda_core.report.gallery import every

    subject, kind = _subject(source)
    for found, data in every(registry(), subject, kind):
        yield found.name, data


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
    from lambda_core.registry.manager import registry
    from lambda_core.report.gallery import write

    return write(registry(), data, Path(folder), stem, formats)


def view_stem(source: Sequence[str | Path]) -> str:
    """Return the beginning of file names for pictures of these results.

    Parameters
    ----------
    source : sequence of path-like
        Result files, or the folder of one study.

    Returns
    -------
    str
    """
    from lambda_core.report.gallery import stem_of

    return stem_of([Path(path) for path in source])


def report(source: str | Path, out: str | Path | None = None, *, overwrite: bool = False) -> Path:
    """Write one self-contained, printable HTML page about a run or a study.

    Parameters
    ----------
    source : path-like
        A result file or the folder of a study.
    out : path-like, optional
        Default: the name of the source with ``.html`` in the working directory.
    overwrite : bool
        Replace a page that stands there.

    Returns
    -------
    pathlib.Path
        The page.

    Raises
    ------
    UsageError
        When the source is neither, or the page exists or cannot be written.
    """
    from lambda_core.registry.manager import registry
    from lambda_core.report.page import case_inputs, run_report, study_report, write_page

    path = Path(out) if out is not None else Path(f"{view_stem([source])}.html")
    if path.exists() and not overwrite:
        raise UsageError(f"{path} exists: choose another name with --out, or overwrite it with --force")
    subject, kind = _subject(source)
    if kind == "study":
        from lambda_core.schema.case_io import parse_case
        from lambda_core.study.session import files

        definition, case_toml = files(Path(source))
        inputs = case_inputs(resolve(parse_case(case_toml, str(source))))
        text = study_report(registry(), subject, study_status(source), inputs, definition)
    else:
        text = run_report(registry(), subject)
    return write_page(text, path)


def study_check(
    source: str | Path | Mapping[str, Any] | Study,
    *,
    workers: int | None = None,
    announce: Callable[[str], None] | None = None,
) -> StudyEstimate:
    """Check a study file without running it: its points, and about what they cost.

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
    from lambda_core.study.session import prepare

    return prepare(source, workers, announce).estimate


def study_run(
    source: str | Path | Mapping[str, Any] | Study,
    folder: str | Path | None = None,
    *,
    executor: str | Executor = "processes",
    workers: int | None = None,
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
        Default: the processors that this process may use.
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
    from lambda_core.study.session import prepare, start

    ready = prepare(source, workers, announce)
    if announce is not None:
        announce(ready.estimate.text())
    path = None if folder is None else Path(folder)
    return start(ready, path, where=executor, workers=workers, report=progress)


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
    from lambda_core.study.session import resume

    return resume(Path(folder), where=executor, workers=workers, retry=retry, report=progress)


def study_status(folder: str | Path) -> StudyStatus:
    """Return where a study stands, also while it is being worked on.

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
    from lambda_core.study.session import status

    return status(Path(folder))


def study_table(folder: str | Path) -> StudyTable:
    """Return the table of a study as far as it is known.

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
    from lambda_core.study.session import table

    return table(Path(folder))


def study_schema() -> dict[str, Any]:
    """Return the JSON schema of a study file.

    Returns
    -------
    dict
        JSON Schema, draft 2020-12.
    """
    from lambda_core.study.definition import study_json_schema

    return study_json_schema()


def _subject(source: str | Path | Sequence[str | Path]) -> tuple[Any, Subject]:
    """Return what a view looks at, and what kind of thing it is."""
    from lambda_core.study.session import is_study, table

    if not isinstance(source, str | Path):
        if len(source) != 1:
            return [result(path) for path in source], "results"
        source = source[0]
    path = Path(source)
    if is_study(path):
        return table(path), "study"
    return result(path), "result"


def _model(source: str | Path | Mapping[str, Any] | Case | BearingModel, overrides: Iterable[str] = ()) -> BearingModel:
    from lambda_core.physics.model import BearingModel

    if not isinstance(source, BearingModel):
        return check(source, overrides)
    if list(overrides):
        raise UsageError("a resolved model takes no overrides: change the case and resolve it")
    return source
