"""Define a role by its arguments, results and bounds."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Argument:
    """One argument of a kernel."""

    name: str
    kind: str  # "f": float64 scalar, "a": float64[:] contiguous
    meaning: str
    output: bool = False
    optional: bool = False  # a kernel that does not name it is not given it
    each: bool = False  # the contacts of a raceway differ in it: the solver hands over one number for each of them


@dataclass(frozen=True)
class Role:
    """Stage of the pipeline for one model.

    Exactly one model fills it per force element.
    """

    name: str
    summary: str
    arguments: tuple[Argument, ...]
    outputs: tuple[str, ...]  # meaning of out[0], out[1], ... or of the elementwise output
    elements: tuple[str, ...]  # force elements, or films of a circuit, that carry this role
    elementwise: bool = False
    # Of valid outputs; the solver relies on them (a dissipator never drives).
    bounds: tuple[tuple[float, float], ...] = ()
    sign_of: str = ""  # argument whose sign the first output has, or it is zero
    vanishes_with: str = ""  # argument of an elementwise law where whose zeros its output is zero
    # (output, of which output, by which argument) that must be derivatives: forces come from them, energy has to close
    slopes: tuple[tuple[int, int, str], ...] = ()
    # Section of the case where the law is chosen, for one that acts on a motion that is known; "": it makes the motion.
    section: str = ""
    # Its laws may read states of the contact. These change without work: what has a potential, or is worked out once
    # for the whole run, must not depend on them.
    reads_states: bool = False

    @property
    def batched(self) -> bool:
        """True for one call per raceway.

        One call of the compiled law is for all contacts of a raceway, its kernel called for each in turn.
        """
        return any(argument.each for argument in self.arguments)


def arguments_of(spec: str) -> tuple[Argument, ...]:
    """Read ``name kind meaning; ...``.

    The kinds are ``f`` a number, ``e`` a number of each contact, ``a`` an array, ``A`` an output array; with ``?`` it
    is optional.
    """
    result = []
    for part in spec.split(";"):
        name, kind, meaning = part.strip().split(" ", 2)
        plain = kind.rstrip("?")
        result.append(
            Argument(
                name,
                "f" if plain == "e" else plain.lower(),
                meaning,
                output=plain == "A",
                optional=kind != plain,
                each=plain == "e",
            )
        )
    return tuple(result)
