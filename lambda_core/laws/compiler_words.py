"""Explain why a law cannot be compiled."""

from __future__ import annotations

import re

from lambda_core.laws.jit import binding

# What Numba says where memory would have to be managed, which machine code of kernels does not do.
_ALLOCATES = ("NRT required", "Only accept returning of array passed into the function")
_LOWERED = re.compile(r" at (\S+\.py) \((\d+)\)")
_COLOUR = re.compile(r"\x1b\[[0-9;]*m")


def gist(error: Exception) -> str:
    """Return a Numba error's report on plugin code.

    It has the innermost function's fault and its place.
    """
    lines = [line.strip() for line in _COLOUR.sub("", str(error)).splitlines()]
    start = max((n for n, line in enumerate(lines) if line.startswith("Rejected as")), default=-1)
    places = [line for line in lines[start + 1 :] + lines[start::-1] if line.startswith("File ")]
    places += [f'File "{path}", line {n}' for path, n in _LOWERED.findall(" ".join(lines))]
    place = next((line.strip(" :") for line in places if "numba/" not in line and binding.FILE not in line), "")
    if any(words in str(error) for words in _ALLOCATES):
        return f"it makes an array or a list: a kernel works in the arrays that it is given {place}".rstrip()
    noise = ("Failed in", "TypingError: Failed in", "File ", "File:", "During:", "raised from", "<source", "^", "-")
    idle = (*noise, "There are", "With argument", "Overload ")
    said = [line.removeprefix(">>> ") for line in lines[start + 1 :] if line and not line.startswith(idle)]
    return f"{' '.join(said[: 3 if start < 0 else 1])} {place}".rstrip()
