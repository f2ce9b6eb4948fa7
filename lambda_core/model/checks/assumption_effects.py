"""Order assumptions by what they affect and leave open."""

from __future__ import annotations

import re
from collections.abc import Sequence

# Effect -> words that an assumption about it begins with or contains; the first match counts.
_EFFECTS: tuple[tuple[str, str], ...] = (
    ("motion", r"^damping\b"),
    ("neighbours", r"^cage_contact roller-roller\b|^no cage: neighbouring"),
    ("cage", r"^(cage|cage_contact|bodies\.cage)\b|pocket"),
    ("electric", r"^(permittivity|capacitance|breakdown|discharge|electric)"),
    (
        "friction",
        r"^(traction|rolling_resistance|elastic_hysteresis|asperity_load|boundary_friction|mixing|fluid_drag)\b|drag"
        r"|friction|oil level",
    ),
    (
        "film",
        r"^(film_thickness|supply|thermal_correction|rheology|contact_temperature|surface|lubricant)\b|film|roughness"
        r"|viscosity",
    ),
    (
        "load and life",
        r"^(bearing|normal_contact|materials)\b|clearance|shoulder|rolling elements|contact angle|preload|e_C |C_0|fit",
    ),
    ("temperature", r"temperature|heat|thermal"),
    ("motion", r"mass|inertia|tilt|gravity"),
)
_OTHER = "other"
_NAMES = re.compile(r"^[^:(]*[^:(\s]: (?=\S)")  # of the bearings of a machine that share an assumption
_OPTION = re.compile(r"^(bearings\.[\w-]+\.)?parameters\.")  # begins the path of a fitted parameter of a law
# A parameter of a law: law, parameter with value, source
_PARAMETER = re.compile(r"^(?P<law>(?:[^(]*: )?\w+ [\w-]+): (?P<value>[^,(]+)(?:, (?:default|lubricant \S+))? \(")
_PUBLISHED, _NUMERICAL = re.compile(r"published\)$"), re.compile(r"numerical\)$")
_GRADED = re.compile(
    r"^((?:[\w-]+(?:, [\w-]+)*: (?=\w+\.))?.*?): .* \(grade (\w)\)$"
)  # a value, where it comes from, its grade
_OPEN, _KNOWN, _SMALL = range(3)


def weight(assumption: str) -> int:
    """Return the weight of an assumption.

    It is 0 for unknown values, 1 for published values, 2 for numerical settings.
    """
    return _SMALL if _NUMERICAL.search(assumption) else _KNOWN if _PUBLISHED.search(assumption) else _OPEN


def effect(assumption: str) -> str:
    """Return what an assumption affects most."""
    bare = _NAMES.sub("", assumption) if re.match(r"^[\w-]+(, [\w-]+)*: (?!\w+ \d)", assumption) else assumption
    bare = _OPTION.sub("", bare)
    found = (name for text in (bare, assumption) for name, words in _EFFECTS if re.search(words, text))
    return next(found, _OTHER)


def by_effect(assumptions: Sequence[str], *, everything: bool = False) -> list[tuple[str, list[str]]]:
    """Group assumptions by what they affect.

    Load and life come first, then friction, film and the rest.

    Parameters
    ----------
    assumptions : sequence of str
        Sentences of a resolved model.
    everything : bool
        Each sentence with its source; otherwise published values and numerical settings are left out, and the
        parameters of a law are joined.
    """
    names = ("load and life", "friction", "film", "temperature", "cage", "neighbours", "motion", "electric", _OTHER)
    found: dict[str, list[str]] = {name: [] for name in names}
    for sentence in assumptions:
        if everything or weight(sentence) == _OPEN:
            found[effect(sentence)].append(sentence)
    ordered = {name: sorted(sentences, key=weight) for name, sentences in found.items() if sentences}
    return [(name, some if everything else _joined(some)) for name, some in ordered.items()]


def _joined(sentences: Sequence[str]) -> list[str]:
    """Join parameters of one law without sources."""
    found: dict[str, list[str]] = {}
    for sentence in sentences:
        parameter, graded = _PARAMETER.match(sentence), _GRADED.match(sentence)
        if parameter:
            found.setdefault(parameter["law"], []).append(parameter["value"].strip())
        else:
            found.setdefault(f"{graded[1]} (grade {graded[2]})" if graded else sentence, [])
    return [f"{law}: {', '.join(values)}" if values else law for law, values in found.items()]
