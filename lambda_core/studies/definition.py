"""Define the study file."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

from pydantic import ValidationError, field_validator, model_validator

from lambda_core.case.option import NAME_PATTERN, Section, option
from lambda_core.case.problems import problems
from lambda_core.domain.errors import CaseError, Problem, UsageError
from lambda_core.domain.files import read_text
from lambda_core.domain.inline_laws import named

Mode = Literal["quasi-static", "dynamic"]
Kind = Literal["crossed", "zipped", "latin-hypercube", "sobol", "saltelli", "optimise"]
MAX_POINTS, MOST_POINTS = 100_000, 1_000_000  # by default; at all
SAMPLED = ("latin-hypercube", "sobol", "saltelli", "optimise")


class Parameter(Section):
    """Option of the case that varies.

    It has a list of values, or a range.
    """

    path: str = option(description="path of the option in the case, as --set takes it", min_length=1)
    values: list[bool | int | float | str] | None = option(None, "the values, written as in a case")
    range: list[int | float | str] | None = option(
        None, "first and last value, ends included", min_length=2, max_length=2
    )
    points: int | None = option(None, "number of values in the range, for crossed and zipped designs", ge=1)
    spacing: Literal["linear", "log"] = option("linear", "even steps, or even factors")
    label: str = option("", "what people read; default: the path")

    @field_validator("path", mode="before")
    @classmethod
    def _without_blanks(cls, path: Any) -> Any:
        return path.strip() if isinstance(path, str) else path

    @field_validator("values", "range", mode="before")
    @classmethod
    def _finite(cls, values: Any) -> Any:
        odd = [v for v in values if isinstance(v, float) and not math.isfinite(v)] if isinstance(values, list) else []
        if odd:
            raise ValueError(f"{odd[0]} is not a finite number")
        return values

    @model_validator(mode="after")
    def _one_of(self) -> Parameter:
        if (self.values is None) == (self.range is None):
            raise ValueError("give either values or a range")
        if self.values is not None and not self.values:
            raise ValueError("values is an empty list: nothing to study")
        if self.values is not None and self.points is not None:
            raise ValueError("`points` needs a range, not a list of values")
        return self


class Design(Section):
    """Choice of the study's points."""

    kind: Kind = option("crossed", "every combination; in step; or samples of the ranges")
    samples: int | None = option(None, "number of samples; of saltelli: base samples", ge=2)
    seed: int = option(1, "seed of the samples: the same seed gives the same points", ge=0)

    @model_validator(mode="after")
    def _has_samples(self) -> Design:
        if self.kind in SAMPLED and self.kind != "optimise" and self.samples is None:
            raise ValueError(f"the number of samples is required for {self.kind}")
        if self.kind not in SAMPLED and self.samples is not None:
            raise ValueError(f"`samples` is not allowed for a {self.kind} design")
        if self.kind in ("sobol", "saltelli") and self.samples is not None and self.samples & (self.samples - 1):
            lower = 1 << (self.samples.bit_length() - 1)
            raise ValueError(f"Sobol' points are balanced for powers of two only: {lower} or {2 * lower} samples")
        return self


class Constraint(Section):
    """A limit that the best point has to keep."""

    response: str = option(description="name of a response")
    at_least: float | None = option(None, "smallest allowed value, in the unit of the response")
    at_most: float | None = option(None, "largest allowed value, in the unit of the response")

    @model_validator(mode="after")
    def _has_limit(self) -> Constraint:
        if self.at_least is None and self.at_most is None:
            raise ValueError("give at_least or at_most")
        if self.at_least is not None and self.at_most is not None and self.at_least > self.at_most:
            raise ValueError(f"no value is at least {self.at_least:g} and at most {self.at_most:g}")
        return self


class Goal(Section):
    """Goal of an optimisation."""

    minimise: str | None = option(None, "response to make small")
    maximise: str | None = option(None, "response to make large")
    constraints: list[Constraint] = option([], "limits of other responses")
    evaluations: int = option(80, "most points to evaluate after the first samples", ge=5)
    tolerance: float = option(1e-4, "share of the ranges to which the best point is found", gt=0.0, lt=0.5)

    @model_validator(mode="after")
    def _one_goal(self) -> Goal:
        if (self.minimise is None) == (self.maximise is None):
            raise ValueError("give either minimise or maximise")
        return self

    @property
    def response(self) -> str:
        """Name of the response that is optimised."""
        return self.minimise or self.maximise or ""

    @property
    def sign(self) -> float:
        """1 where small is good, -1 where large is."""
        return 1.0 if self.minimise else -1.0


class Study(Section):
    """A study file (``study.toml``)."""

    name: str = option(description="short name, used for the folder", pattern=NAME_PATTERN)
    title: str = option("", "the question of the study; the title of its results")
    case: str = option(description="case file, relative to this one, or a built-in case")
    mode: Mode = option("quasi-static", "equilibrium only, or full runs")
    set: dict[str, bool | int | float | str] = option({}, "fixed changes to the case: path = value")
    responses: list[str] = option([], "names of responses; empty: the usual ones")
    parameters: list[Parameter] = option(description="what varies", min_length=1)
    design: Design = option({}, "how points are chosen")
    optimise: Goal | None = option(None, "what an optimisation is after")
    max_points: int = option(MAX_POINTS, "refuse more points than this", ge=1, le=MOST_POINTS)

    @field_validator("set", mode="before")
    @classmethod
    def _is_flat(cls, written: Any) -> Any:
        """Refuse tables in one sentence."""
        for key, value in written.items() if isinstance(written, dict) else ():
            if isinstance(value, dict | list):
                raise ValueError(f'{key} is no single value: write a line for each option, as "loads.radial" = "2 kN"')
        return written

    @model_validator(mode="after")
    def _fits(self) -> Study:
        paths = [parameter.path for parameter in self.parameters]
        double = next((path for path in paths if paths.count(path) > 1), None)
        if double is not None:
            raise ValueError(f"{double} is varied twice: give it once")
        fixed = next((path for path in paths if path in self.set), None)
        if fixed is not None:
            raise ValueError(f"{fixed} is both set and varied: remove one")
        if (self.design.kind == "optimise") != (self.optimise is not None):
            raise ValueError('an optimisation needs both design.kind = "optimise" and a table [optimise]')
        return self


def read_study(source: str | Path) -> tuple[Study, Path]:
    """Read a study file.

    Return the study and the folder that its case is relative to.

    Raises
    ------
    UsageError
        When the file cannot be read.
    CaseError
        With every mistake in it.
    """
    path = Path(source)
    try:
        text = read_text(path)
    except UnicodeDecodeError:
        raise CaseError(path.name, [Problem("", "is not a text file in UTF-8")]) from None
    except OSError as error:
        what = "it does not exist" if isinstance(error, FileNotFoundError) else error.strerror
        raise UsageError(
            f'cannot read the study "{path}": {what}; correct the path, or write a study with: '
            "lambda-bearing study init"
        ) from None
    return parse_study(text, path.name), path.resolve().parent


def parse_study(text: str, source: str = "study") -> Study:
    """Read a study from TOML text; CaseError with every mistake."""
    try:
        data = tomllib.loads(text)
    except RecursionError:
        raise CaseError(source, [Problem("", "is nested too deeply")]) from None
    except ValueError as error:
        raise CaseError(source, [Problem("", f"is not TOML: {error}")]) from None
    return validate_study(data, source)


def validate_study(data: Mapping[str, Any], source: str = "study") -> Study:
    """Check plain tables as a study; CaseError with every mistake."""
    if "bearing" in data and "case" not in data:
        words = f'is a case, not a study; a study names it: case = "{source}", and [[parameters]] that vary'
        raise CaseError(source, [Problem("", words)])
    data = {key: named(value) for key, value in data.items()}
    try:
        return Study.model_validate(data)
    except ValidationError as error:
        raise CaseError(source, problems(error, Study, data)) from None


def study_json_schema() -> dict[str, Any]:
    """Return the JSON schema of a study file, for editors."""
    schema = Study.model_json_schema(mode="validation")
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "lambda-bearing study", **schema}
