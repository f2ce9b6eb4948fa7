"""Generate the tables of errors and exit codes."""

from __future__ import annotations

import importlib
import pkgutil

import docstrings
import tables as md
from lambda_cli.main import INTERRUPTED

from lambda_core.domain.errors import LambdaError

PACKAGES = ("lambda_core", "lambda_plugins", "lambda_db", "lambda_cli", "lambda_gui")
# Codes that are not those of an error class alone.
MEANINGS = {
    0: "done",
    1: "a bug in the program: please report it",
    2: "the command line, the call or a file name is wrong",
    3: "a case, a catalogue row or a plugin is invalid",
    4: "the solver could not go on; the result file keeps what there is",
    5: "a result exists, but is partial or not converged; the reason is printed",
    INTERRUPTED: "interrupted by Ctrl+C; `resume` goes on",
}


def error_classes() -> list[type[LambdaError]]:
    """Return every error class of our packages.

    After importing all of their modules.
    """
    for name in PACKAGES:
        package = importlib.import_module(name)
        for module in pkgutil.walk_packages(package.__path__, f"{name}."):
            if not module.name.endswith("__main__"):
                importlib.import_module(module.name)
    found: list[type[LambdaError]] = []
    pending = [LambdaError]
    while pending:
        error = pending.pop(0)
        found.append(error)
        pending += sorted(error.__subclasses__(), key=lambda e: e.__name__)
    return [error for error in found if error.__module__.split(".")[0] in PACKAGES]


def exit_codes() -> list[str]:
    """Return the table of exit codes."""
    by_code: dict[int, list[str]] = {code: [] for code in MEANINGS}
    for error in error_classes():
        by_code[error.exit_code].append(md.code(error.__name__))
    rows = [[str(code), MEANINGS[code], ", ".join(names)] for code, names in by_code.items()]
    return md.table(("code", "meaning", "errors"), rows)


def errors() -> list[str]:
    """Return the table of error classes."""
    rows = [
        [
            md.code(error.__name__),
            md.code(error.__module__),
            str(error.exit_code),
            md.cell(" ".join(docstrings.parsed(error).text.split())),
        ]
        for error in error_classes()
    ]
    return md.table(("error", "module", "exit code", "meaning"), rows)
