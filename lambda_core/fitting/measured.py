"""List measured series and compare them with the program."""

from __future__ import annotations

import math
import shutil
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import ConfigDict, Field, ValidationError

from lambda_core.analysis.band.quantities import OPERATING_POINTS, Vocabulary
from lambda_core.domain.errors import CaseError, LambdaError, Problem, UsageError, unknown_name
from lambda_core.domain.files import user_data_folder
from lambda_core.domain.lists import listed
from lambda_core.fitting.measurements import Measurements, parse_measurements, read_measurements
from lambda_core.fitting.operating_points import condition_change
from lambda_core.fitting.scores import interval_score, relative
from lambda_core.fitting.subjects import Subject, subject_of
from lambda_core.results.record import INTERFACE, Record

_FOLDER = "measured_data"
_CASES = "cases"  # folder of the cases that were added with series


class MeasuredSeries(Record):
    """One measured series.

    It has its source and its comparison.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str = ""
    title: str
    case: str | dict[str, Any] = Field(
        default="", description="case that it is compared with, by name or as tables; empty where there is none"
    )
    bearing: str = Field(default="", description="what was measured and is missing, where there is no case")
    source: str = Field(description="who measured it and where it is published")
    licence: str = Field(description="of the numbers")
    how_read: str = Field(description="from a table, a picture, or a formula fitted by the source")
    uncertainty: str = Field(description="of the measured values, in words")


@dataclass(frozen=True)
class _Loaded:
    """A series with its points and with what predicts them.

    Without a case `refused` is None, too; otherwise it says what is wrong with the case. A series of the program
    without a case may have no points.
    """

    series: MeasuredSeries
    measurements: Measurements | None
    subject: Subject | None
    refused: LambdaError | None


class ComparedPoint(Record):
    """One measured value next to the prediction."""

    line: int
    quantity: str
    unit: str
    measured: float
    predicted: float
    band: list[float] = Field(description="90 % model band; empty unless requested")


class ComparedSeries(Record):
    """One series next to the predictions."""

    series: MeasuredSeries
    points: list[ComparedPoint]
    mean_error_pct: float | None = Field(description="mean of predicted over measured value less one")
    mean_absolute_error_pct: float | None
    inside: int | None = Field(description="measured values inside the band")
    interval_score: float | None = Field(description="mean of the score over the measured value; small is good")
    reason: str = Field(default="", description="why the series was not computed")
    is_fitted: bool = Field(default=False, description="whether the case was fitted to these points")


class MeasuredComparison(Record):
    """Every series next to the predictions; nothing is fitted."""

    interface: int = INTERFACE
    compared: list[ComparedSeries] = Field(description="in the requested order")

    def text(self) -> str:
        """Return the lines of the comparison.

        Each series has one, and so has each point of those computed.
        """
        lines: list[str] = []
        for one in self.compared:
            lines += [f"{one.series.name}: {one.series.title}", f"  {one.series.source}; {one.series.uncertainty}"]
            if one.reason:
                lines.append(f"  not computed: {one.reason}")
                continue
            lines += [f"  {_point(point)}" for point in one.points]
            lines.append(f"  {_errors(one)}")
            if one.is_fitted:
                lines.append("  the case was fitted to these points: they do not test it")
        return "\n".join(lines)


def _point(point: ComparedPoint) -> str:
    error = f" ({100.0 * (point.predicted / point.measured - 1.0):+.1f} %)" if point.measured else ""
    band = f", band {point.band[0]:.4g}..{point.band[1]:.4g}" if point.band else ""
    return (
        f"line {point.line}: {point.quantity} measured {point.measured:.4g} {point.unit}, "
        f"predicted {point.predicted:.4g} {point.unit}{error}{band}"
    )


def _errors(one: ComparedSeries) -> str:
    text = f"mean error {one.mean_error_pct:+.1f} %, mean absolute error {one.mean_absolute_error_pct:.1f} %"
    if one.inside is None:
        return text
    return f"{text}; {one.inside} of {len(one.points)} inside the 90 % band, interval score {one.interval_score:.2f}"


def all_series() -> list[MeasuredSeries]:
    """Return all measured series.

    They are those of the program, of plugins and of the user.
    """
    found: dict[str, MeasuredSeries] = {}
    for folder in _folders():
        entries = folder.iterdir() if folder.is_dir() else ()
        names = sorted(entry.name for entry in entries if entry.name.endswith(".toml"))
        read = [_read(folder, name) for name in names]
        found |= {series.name: series for series in read if series.name not in found}
    return list(found.values())


def _folders() -> list[Traversable]:
    """Return the folders of series.

    They are those of the program, of plugins, and that of the user.

    A plugin has them in the folder ``measured`` of the catalogue rows that it brings (hook `lambda_data`).
    """
    from lambda_core.discovery.api import registry

    brought = [folder / "measured" for _, folder in registry().data_folders]
    return [files(__package__).joinpath(_FOLDER), *brought, _own_folder()]


def _own_folder() -> Path:
    return user_data_folder() / "measured"


def add_series(path: str | Path, *, overwrite: bool = False) -> MeasuredSeries:
    """Copy a measured series into the user's data folder.

    A case that is no built-in one is stored with it, with the tables that it names: the series is compared anywhere.
    """
    from lambda_core.case.builtin import is_builtin
    from lambda_core.case.case_io import read_case
    from lambda_core.case.case_writer import standalone_toml

    source = Path(path)
    if source.suffix == ".toml" and not source.exists():
        raise UsageError(f"{source} does not exist: correct the path")
    if source.suffix != ".toml" or not source.is_file():
        raise UsageError(
            f"{source} is not a TOML file: write title, source, licence, how_read and uncertainty into one"
        )
    loaded, name = _load(str(source)), source.stem
    if loaded.refused is not None:
        raise loaded.refused
    target = _own_folder() / source.name
    known = {one.name for one in all_series()}
    if name in known and not (overwrite and target.is_file()):
        why = "--force replaces it" if target.is_file() else "it comes with the program: rename your files"
        raise UsageError(f'there is a measured series "{name}" already; {why}')
    (target.parent / _CASES).mkdir(parents=True, exist_ok=True)
    own, case = target.parent / _CASES / source.name, loaded.series.case
    if case and not (isinstance(case, str) and is_builtin(case)):
        own.write_text(standalone_toml(read_case(case, folder=source.parent)), encoding="utf-8")
    else:
        own.unlink(missing_ok=True)
    for ending in (".csv", ".toml"):  # a description without points is never seen
        shutil.copyfile(source.with_suffix(ending), target.with_suffix(ending))
    return loaded.series


def compare(
    names: Sequence[str] = (), *, band: bool = True, announce: Callable[[str], None] | None = None
) -> MeasuredComparison:
    """Compare measured series with quasi-static solutions."""
    loaded = [_load(name) for name in (listed(names, "names") or [series.name for series in all_series()])]
    found = []
    for one in loaded:
        if announce is not None and one.series.case:
            announce(f"computing {one.series.name}")
        found.append(_compared(one, band))
    return MeasuredComparison(compared=found)


def _read(folder: Traversable, name: str) -> MeasuredSeries:
    """Read the description of a series.

    A file of a case is named from the folder of the description, and one that was stored with it comes first.
    """
    from lambda_core.case.case_io import toml_tables

    tables: dict[str, Any] = toml_tables(folder.joinpath(name).read_text(encoding="utf-8"), name)
    try:
        found = MeasuredSeries(**{**tables, "name": name.removesuffix(".toml")})
    except ValidationError as error:
        mistakes = {str(one["loc"][0]): _mistake(one) for one in error.errors()}  # one of each entry
        raise CaseError(name, [Problem(*mistake) for mistake in mistakes.items()]) from None
    files_of_case: list[Traversable] = [folder.joinpath(_CASES).joinpath(name)] if folder == _own_folder() else []
    if found.case and isinstance(found.case, str):
        files_of_case.append(folder.joinpath(found.case))
    case = next((str(file) for file in files_of_case if file.is_file()), found.case)
    return found.model_copy(update={"case": case})


def _mistake(error: Mapping[str, Any]) -> str:
    """Return what is wrong with an entry of a description."""
    if error["type"] == "missing":
        return "is required: write a text"
    if error["type"] == "extra_forbidden":
        return unknown_name("entry", error["loc"][-1], MeasuredSeries.model_fields)
    return "must be the name of a case, or its tables" if error["loc"][0] == "case" else "must be a text"


def _load(name: str) -> _Loaded:
    """Return a series with its points."""
    path = Path(name)
    if path.suffix == ".toml" and path.is_file():
        series = _read(path.parent, path.name)
        subject, refused = _subject(series, path.parent)
        points = read_measurements(path.with_suffix(".csv"), _words(subject))
        return _Loaded(series, points, subject, refused)
    known = {series.name: series for series in all_series()}
    if name not in known and path.suffix:
        raise UsageError(
            f"{name} is not a TOML file that describes a series: correct the path, write NAME.toml next to NAME.csv, "
            "or name a series of: lambda-bearing measured list"
        )
    if name not in known:
        raise UsageError(unknown_name("measured series", name, known))
    folder = next(one for one in _folders() if one.joinpath(f"{name}.toml").is_file())
    file = folder.joinpath(f"{name}.csv")
    if not file.is_file() and not known[name].case:
        return _Loaded(known[name], None, None, None)
    if not file.is_file():
        raise UsageError(f"measured series {name}: {name}.csv with its points is missing next to {name}.toml")
    subject, refused = _subject(known[name], None)
    points = parse_measurements(file.read_text(encoding="utf-8"), f"{name}.csv", _words(subject))
    return _Loaded(known[name], points, subject, refused)


def _subject(series: MeasuredSeries, folder: Path | None) -> tuple[Subject | None, LambdaError | None]:
    """Return what predicts a series.

    Otherwise return what is wrong with its case. `folder` is where tables of a case look up their files.
    """
    from lambda_core.case.case_io import read_case

    try:
        return (subject_of(read_case(series.case, folder=folder)), None) if series.case else (None, None)
    except LambdaError as error:
        return None, error


def _words(subject: Subject | None) -> Vocabulary:
    return OPERATING_POINTS if subject is None else subject.words


def _compared(one: _Loaded, band: bool) -> ComparedSeries:
    series = one.series
    if not series.case:
        return _not_computed(series, f"there is no case for it: {series.bearing}")
    try:
        if one.refused is not None:
            raise one.refused
        points = _points(one, band)
    except LambdaError as error:
        return _not_computed(series, " ".join(str(error).split()))
    measured, predicted = (np.array([getattr(p, name) for p in points]) for name in ("measured", "predicted"))
    errors = 100.0 * relative(predicted - measured, measured)
    inside, score = None, None
    if all(point.band for point in points):
        low, high = (np.array([point.band[end] for point in points]) for end in (0, 1))
        inside = int(np.sum((low <= measured) & (measured <= high)))
        score = float(relative(interval_score(low, high, measured), np.abs(measured)).mean())
    return ComparedSeries(
        series=series,
        points=points,
        mean_error_pct=float(errors.mean()),
        mean_absolute_error_pct=float(np.abs(errors).mean()),
        inside=inside,
        interval_score=score,
        is_fitted=_is_fitted(one),
    )


def _is_fitted(one: _Loaded) -> bool:
    """Tell whether the case was fitted to the points."""
    from lambda_core.case.case_io import toml_tables

    if one.subject is None or one.measurements is None:
        return False
    origin = toml_tables(one.subject.case_toml, one.series.name).get("fit") or {}
    return bool(origin.get("sha256") == one.measurements.sha256)


def _not_computed(series: MeasuredSeries, reason: str) -> ComparedSeries:
    return ComparedSeries(
        series=series,
        points=[],
        mean_error_pct=None,
        mean_absolute_error_pct=None,
        inside=None,
        interval_score=None,
        reason=reason,
    )


def _points(one: _Loaded, band: bool) -> list[ComparedPoint]:
    data, subject, found = one.measurements, one.subject, []
    assert subject is not None  # the series has a case
    assert data is not None  # and points
    for row, line in enumerate(data.lines):
        changes = [condition_change(data.set_by[name], float(column[row])) for name, column in data.conditions.items()]
        names = [name for name, values in data.measured.items() if math.isfinite(values[row])]
        bands = subject.bands(changes, names) if band else {}
        predicted = subject.solved(changes, (), names, one=False).mean(axis=0)
        for name, value in zip(names, predicted.tolist(), strict=True):
            found.append(
                ComparedPoint(
                    line=line,
                    quantity=name,
                    unit=subject.words.measured[name].unit,
                    measured=float(data.measured[name][row]),
                    predicted=value,
                    band=bands.get(name, []),
                )
            )
    return found
