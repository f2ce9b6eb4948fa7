"""Remember laws that passed their trial.

The record is kept with the compiled code, so the next process skips the trial.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from lambda_core.domain import role, roles
from lambda_core.domain.arrays import FloatArray
from lambda_core.laws.check import check_choice
from lambda_core.laws.kernels import CompiledKernel, cache_folder, sources_key
from lambda_core.laws.law import Law


@dataclass(frozen=True)
class Choice:
    """A law as a run will call it."""

    model: Law
    par: FloatArray
    compiled: CompiledKernel


def try_out(choices: Sequence[Choice]) -> None:
    """Check chosen laws with the run's `par`.

    They are checked together, once for all processes.

    Trials are drawn alike every time, so what they found holds as long as code, parameters, the trials themselves and
    the machine are the same. Their hash names an empty folder; only laws without a fault leave one.

    Raises
    ------
    PluginError
        With the first fault of the first law that has one.
    """
    folder = _folder(choices)
    if folder.is_dir():
        with contextlib.suppress(OSError):
            os.utime(folder)  # folders that nobody has used for long are dropped
        return
    for choice in choices:
        check_choice(choice.model, choice.par, choice.compiled)
    with contextlib.suppress(OSError):  # a cache that cannot be written: tried again next time
        folder.mkdir(parents=True, exist_ok=True)


def _folder(choices: Sequence[Choice]) -> Path:
    """Return the cache entry of good laws.

    Its name has all that their trials depend on.
    """
    digest = hashlib.sha256(_trials_key().encode())
    for choice in choices:
        law = choice.model
        code = (choice.compiled.key, choice.compiled.made)
        declared = (law.label, sorted(law.errors.items()), len(law.states), *code, choice.par.size)
        digest.update(repr(declared).encode() + choice.par.tobytes())
    return cache_folder() / f"tried-{digest.hexdigest()[:24]}"


@cache
def _trials_key() -> str:
    """Return the hash of the trial code.

    It covers the code that tests laws, and the requirements of roles.
    """
    return sources_key(Path(__file__).parent, Path(role.__file__), Path(roles.__file__))
