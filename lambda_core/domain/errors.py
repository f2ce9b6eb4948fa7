"""Define the errors that users see and their exit codes."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

_PRINTED = 20  # problems of a case; `problems` holds all
# A command to type matches first and stays as it is.
_OPTION = re.compile(r"lambda-bearing [^;,()]*|(?<![\w-])--([a-z][a-z-]*)")
_PARAMETERS = {"force": "overwrite=True", "set": "overrides", "duration": "solver.duration"}
_SHOWN = 24  # of the names that are there, where none is near


@dataclass(frozen=True)
class Problem:
    """One problem of an input.

    It has a place and a remedy.
    """

    where: str
    message: str

    def __str__(self) -> str:
        return f"{self.where:<22} {self.message}" if self.where else self.message


class LambdaError(Exception):
    """Base of every error with a message for people.

    Any other exception is a bug.

    Attributes
    ----------
    on_command_line : str
        The message with names of options, where :func:`name_parameters` has put those of Python into it; or "".
    """

    exit_code = 1
    on_command_line = ""


def name_parameters(error: LambdaError) -> None:
    """Replace options by the parameters of Python calls.

    Commands to type stay as they are.
    """
    text = error.args[0] if len(error.args) == 1 and isinstance(error, UsageError) else None
    if not isinstance(text, str) or error.on_command_line:
        return
    found = _OPTION.sub(lambda m: m[0] if m[1] is None else _PARAMETERS.get(m[1], m[1].replace("-", "_")), text)
    if found != text:
        error.on_command_line, error.args = text, (found,)


class UsageError(LambdaError):
    """A command or call asks for what does not exist."""

    exit_code = 2


class BearingNeededError(UsageError):
    """Question about a bearing without its name.

    It concerns one bearing of a machine, and none was named.
    """


class CaseError(LambdaError):
    """A case, catalogue row or plugin choice is invalid.

    Carries every problem at once, and prints the first ones.
    """

    exit_code = 3

    def __init__(self, source: str, problems: Sequence[Problem]) -> None:
        self.source = source
        self.problems = tuple(problems)
        count = len(self.problems)
        head = f"{source}: {count} error{'s' if count != 1 else ''}"
        rest = [f"  and {count - _PRINTED} more"] if count > _PRINTED else []
        super().__init__("\n".join([head, *(f"  {problem}" for problem in self.problems[:_PRINTED]), *rest]))

    def __reduce__(self) -> tuple[Any, ...]:
        """Return how another process makes it again."""
        return type(self), (self.source, self.problems)


class CatalogueError(CaseError):
    """Catalogue request that cannot be answered.

    It exits like an invalid case.
    """


class SolverError(LambdaError):
    """The integrator could not go on."""

    exit_code = 4


class EquilibriumError(SolverError):
    """Equilibrium not found within the allowed iterations.

    `step` is the last one over the states' scales.
    """

    def __init__(self, sentence: str, step: float) -> None:
        super().__init__(sentence)
        self.step = step

    def __reduce__(self) -> tuple[Any, ...]:
        """Return how another process makes it again."""
        return type(self), (str(self), self.step)


class PartialResultError(LambdaError):
    """Run that ended before it converged.

    The file is kept.
    """

    exit_code = 5


def nearest(name: str, choices: Iterable[str], count: int = 3) -> list[str]:
    """Return the `count` choices closest to `name`.

    Case is ignored; two swapped neighbours come first.
    """
    by_folded = {choice.casefold(): choice for choice in choices}
    text = name.casefold()
    swapped = [text[:i] + text[i + 1] + text[i] + text[i + 2 :] for i in range(len(text) - 1)]
    matches = difflib.get_close_matches(text, by_folded, n=count, cutoff=0.5)
    found = dict.fromkeys([*(word for word in swapped if word in by_folded and word != text), *matches])
    return [by_folded[match] for match in found][:count]


def unknown_name(kind: str, name: str, choices: Iterable[str]) -> str:
    """Report an unknown `name` of a `kind`.

    The text has the nearest valid names or the full list.
    """
    known = sorted(set(choices))
    close = nearest(name, known)
    if close:
        return f'"{name}" is not a known {kind}; nearest: {", ".join(close)}'
    shown = known if len(known) <= _SHOWN else [*known[:_SHOWN], f"... ({len(known)} in all)"]
    return f'"{name}" is not a known {kind}; available: {", ".join(shown) or "none"}'
