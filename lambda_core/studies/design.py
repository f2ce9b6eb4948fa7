"""Design the points of a study.

They are counted before any is made, and the same in every process.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import CaseError, Problem
from lambda_core.domain.written_values import Scale, Value, scale_of, written
from lambda_core.studies.definition import SAMPLED, Parameter, Study

FIRST_SAMPLES = 4  # per parameter, before an optimisation searches from the best


@dataclass(frozen=True)
class Coordinate:
    """One parameter with its values.

    Each value is stored as text and as an entry of the table.
    """

    parameter: Parameter
    scale: Scale | None  # None for names
    numbers: tuple[float, ...]  # of a list, or the two ends of a range

    @property
    def is_range(self) -> bool:
        """True for a continuous range."""
        return self.parameter.range is not None

    @property
    def count(self) -> int:
        """Number of values; 0 for a range without points."""
        return len(self.parameter.values) if self.parameter.values is not None else self.parameter.points or 0

    def value(self, index: int) -> tuple[str, float | str]:
        """Return the value number `index`.

        Return it as text for the case and as an entry of the table.
        """
        if self.parameter.values is None:
            return self.at(index / (self.count - 1) if self.count > 1 else 0.0)
        text = written(self.parameter.values[index])
        return text, self.numbers[index] if self.scale is not None else text

    def at(self, share: float) -> tuple[str, float | str]:
        """Return the value at a share 0..1.

        The share is of the range, or of the entries of a list.
        """
        if not self.is_range or self.scale is None:
            return self.value(min(int(share * self.count), self.count - 1))
        first, last = self.numbers
        if share in (0.0, 1.0):  # ends exactly as they are written
            number = last if share else first
        elif self.parameter.spacing == "log":
            number = math.exp(math.log(first) + share * (math.log(last) - math.log(first)))
        else:
            number = first + share * (last - first)
        text = self.scale.text(number)
        return text, float(text.split()[0])

    def label(self) -> str:
        """Return what people read."""
        return self.parameter.label or self.parameter.path.rpartition(".")[2].replace("_", " ")


@dataclass(frozen=True)
class Point:
    """One point.

    It has its changes of the case and its entries of the table.
    """

    changes: tuple[str, ...]  # path=value
    coordinates: tuple[float | str, ...]


class Plan:
    """Every point of a study, by number from 0.

    Raises
    ------
    CaseError
        With every parameter that makes no sense.
    """

    def __init__(self, study: Study) -> None:
        self.study = study
        found, wrong = [], []
        for index, parameter in enumerate(study.parameters):
            where = f"parameters.{index}"
            try:
                found.append(_coordinate(parameter, study.design.kind))
            except ValueError as error:
                wrong.append(Problem(f"{where} ({parameter.path})", str(error)))
        if not wrong and study.design.kind == "zipped":
            counts = {c.parameter.path: c.count for c in found}
            if len(set(counts.values())) > 1:
                each = ", ".join(f"{path} {count}" for path, count in counts.items())
                wrong.append(Problem("parameters", f"zipped parameters have different numbers of values: {each}"))
        if wrong:
            raise CaseError(study.name, wrong)
        self.coordinates = tuple(found)

    @property
    def count(self) -> int:
        """Number of points.

        An optimisation gives the largest possible number.
        """
        design, dimensions = self.study.design, len(self.coordinates)
        if design.kind == "crossed":
            return math.prod(c.count for c in self.coordinates)
        if design.kind == "zipped":
            return self.coordinates[0].count
        if design.kind == "optimise":
            assert self.study.optimise is not None
            return self.first_samples + self.study.optimise.evaluations
        samples = design.samples or 0
        return samples * (dimensions + 2) if design.kind == "saltelli" else samples

    @property
    def first_samples(self) -> int:
        """Points of an optimisation that are chosen beforehand."""
        return self.study.design.samples or FIRST_SAMPLES * len(self.coordinates)

    @property
    def fixed_count(self) -> int:
        """Number of points known at the start.

        They are known before the first is evaluated.
        """
        return self.first_samples if self.study.design.kind == "optimise" else self.count

    def point(self, number: int) -> Point:
        """Return one point of those known beforehand."""
        if self.study.design.kind in SAMPLED:
            return self.at(self.shares[number])
        if self.study.design.kind == "zipped":
            pairs = [c.value(number) for c in self.coordinates]
        else:
            pairs = []
            for c in reversed(self.coordinates):
                number, index = divmod(number, c.count)
                pairs.append(c.value(index))
            pairs.reverse()
        return self._point(pairs)

    def points(self) -> Iterator[Point]:
        """Yield every point that is known beforehand."""
        return (self.point(number) for number in range(self.fixed_count))

    def at(self, shares: FloatArray) -> Point:
        """Return the point at shares of ranges.

        Shares 0..1 of every range, shape (parameters,).
        """
        return self._point([c.at(float(share)) for c, share in zip(self.coordinates, shares, strict=True)])

    def _point(self, pairs: list[tuple[str, float | str]]) -> Point:
        paths = (c.parameter.path for c in self.coordinates)
        changes = tuple(f"{path}={text}" for path, (text, _) in zip(paths, pairs, strict=True))
        return Point(changes, tuple(entry for _, entry in pairs))

    @cached_property
    def shares(self) -> FloatArray:
        """Shares of the ranges, shape (points, parameters)."""
        from scipy.stats import qmc

        design, dimensions = self.study.design, len(self.coordinates)
        if design.kind in ("latin-hypercube", "optimise"):
            return qmc.LatinHypercube(dimensions, rng=design.seed).random(self.fixed_count)
        if design.kind == "sobol":
            return qmc.Sobol(dimensions, rng=design.seed).random(design.samples or 0)
        return saltelli(design.samples or 0, dimensions, design.seed)


def saltelli(samples: int, dimensions: int, seed: int) -> FloatArray:
    """Return the shares of a Saltelli design.

    The shape is (samples (dimensions + 2), dimensions).

    Matrices A, B, then A with column i from B for each i (Saltelli et al. 2010, Comput. Phys. Commun. 181, 259).
    """
    from scipy.stats import qmc

    both = qmc.Sobol(2 * dimensions, rng=seed).random(samples)
    a, b = both[:, :dimensions], both[:, dimensions:]
    mixed = []
    for i in range(dimensions):
        one = a.copy()
        one[:, i] = b[:, i]
        mixed.append(one)
    return np.concatenate([a, b, *mixed])


def _coordinate(parameter: Parameter, kind: str) -> Coordinate:
    """Return one parameter with its values.

    ValueError explains a mistake.
    """
    values = parameter.values if parameter.values is not None else parameter.range
    assert values is not None
    found = scale_of(values)
    if parameter.range is None:
        if kind in ("saltelli", "optimise"):
            raise ValueError(f"{_a(kind)} design needs ranges, not lists of values")
        if kind == "crossed":
            _refuse_twins(values, found[1] if found is not None else [written(value) for value in values])
        return Coordinate(parameter, *(found or (None, ())))
    if found is None:
        raise ValueError(f"the ends {values[0]!r} and {values[1]!r} are not numbers")
    scale, (first, last) = found
    if not (math.isfinite(first) and math.isfinite(last)):
        raise ValueError("the ends of a range must be finite")
    if math.isclose(first, last, rel_tol=1e-12, abs_tol=0.0):
        raise ValueError(f"the range is empty: it begins and ends at {values[0]!r}")
    if parameter.spacing == "log" and min(first, last) <= 0.0:
        raise ValueError("a logarithmic range needs positive ends")
    if kind not in SAMPLED and parameter.points is None:
        raise ValueError("the number of points is missing: for example points = 10")
    if kind in SAMPLED and parameter.points is not None:
        raise ValueError(f"`points` is not allowed for {_a(kind)} design: its samples spread over the range")
    if parameter.points == 1:
        raise ValueError("a range needs at least two points; for one point give `values`")
    return Coordinate(parameter, scale, (first, last))


def _a(kind: str) -> str:
    return f"{'an' if kind[0] in 'aeiou' else 'a'} {kind}"


def _refuse_twins(values: Sequence[Value], same: Sequence[float | str]) -> None:
    """Refuse a value that stands twice.

    Refuse equal values in different units, too: both would be the same point.
    """
    for index, entry in enumerate(same):
        if entry in same[:index]:
            one, other = values[same.index(entry)], values[index]
            text = f"{written(one)} stands twice" if one == other else f"{written(one)} and {written(other)} are equal"
            raise ValueError(f"{text}: give every value once")
