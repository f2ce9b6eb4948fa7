"""Describe a resolved model as text and as data."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

from pydantic import BaseModel, Field

from lambda_core.domain.elements import DOFS
from lambda_core.domain.number_text import counted
from lambda_core.domain.units import from_si, show
from lambda_core.elements.roller.slices import SLICES
from lambda_core.model.bearing_model import BearingModel, Body, TableTerm, Term, TimeFunction
from lambda_core.model.checks.assumption_effects import by_effect
from lambda_core.model.checks.operating_limits import operating_warnings
from lambda_core.model.checks.placed_values import placed_values
from lambda_core.model.laws.law_packages import laws_line
from lambda_core.model.laws.time_functions import scaled
from lambda_core.model.resolve import model_hash

if TYPE_CHECKING:
    from lambda_core.model.machine_model import MachineModel

_BODY_NAMES = {"inner_ring": "inner ring", "outer_ring": "outer ring", "cage": "cage"}


class ValueReport(BaseModel):
    """One frozen value with its origin.

    `text` is the value with its unit.
    """

    path: str
    text: str
    source: str
    grade: str
    status: str


class ModelReport(BaseModel):
    """Report of ``check`` on any valid case.

    Its dump is the machine interface (version 1).
    """

    version: Literal[1] = 1
    valid: Literal[True] = Field(default=True, description="always true: an invalid case is an error")
    name: str
    title: str
    headline: list[str] = Field(description="lines that say what the model is")
    warnings: list[str] = Field(
        description="where the case leaves what bearing, oil and laws are made for, as far as that is known before "
        "solving"
    )
    assumptions: list[str]
    hash: str = Field(description="of all that decides the numbers of a run")
    values: list[ValueReport] = Field(
        description="every frozen value with its origin; what one bearing of a machine has of its own is at its place"
    )

    def text(self, everything: bool = False) -> str:
        """Return the lines of the report.

        They are the verdict, a summary of the case, warnings, and assumptions by effect.

        Parameters
        ----------
        everything : bool
            Also the laws, and every assumption with its source.
        """
        lines = [verdict_line(self.name, self.warnings, self.assumptions), "", *self.headline]
        lines += [*_block("WARNING", self.warnings), *self._parts(everything)]
        return "\n".join([*lines, *assumption_block(self.assumptions, everything=everything)])

    def _parts(self, everything: bool) -> list[str]:
        """Return the lines about the parts of the model."""
        raise NotImplementedError


class CaseReport(ModelReport):
    """Report of ``check`` on the case of one bearing.

    Attributes
    ----------
    bodies : dict of str to str
        Mass and boundary conditions of each body.
    models : dict of str to dict
        Force element to role to the name of the law.
    """

    bodies: dict[str, str]
    models: dict[str, dict[str, str]]

    def _parts(self, everything: bool) -> list[str]:
        lines = _block("bodies", [f"{_BODY_NAMES[name]}: {text}" for name, text in self.bodies.items()])
        return [*lines, *_block("models", _model_lines(self.models))] if everything else lines


class MachineReport(ModelReport):
    """Report of ``check`` on the case of a machine.

    Attributes
    ----------
    bearings : dict of str to str
        Name of each bearing to its title.
    parts : dict of str to str
        Name of each bearing, body and gear to its place and size.
    models : dict of str to dict
        Name of each bearing to force element to role to the name of the law.
    """

    bearings: dict[str, str]
    parts: dict[str, str]
    models: dict[str, dict[str, dict[str, str]]]

    def _parts(self, everything: bool) -> list[str]:
        lines = [line for name, text in self.parts.items() for line in _block(name, [text])]
        if not everything:
            return lines
        alike: dict[tuple[str, ...], list[str]] = {}
        for name, models in self.models.items():
            alike.setdefault(tuple(_model_lines(models)), []).append(name)
        for told, names in alike.items():
            lines += _block("models", [f"of {', '.join(names)}", *told])
        return lines


def verdict_line(name: str, warnings: Sequence[str], assumptions: Sequence[str]) -> str:
    """Return the verdict in one line.

    The case is valid; the line names what to look at.
    """
    counts = [(warnings, "warning"), (assumptions, "assumption")]
    told = (f"{len(some)} {word}{'s' * (len(some) != 1)}" for some, word in counts if some)
    return f"{name}: {', '.join(('no errors', *told))}"


def assumption_block(assumptions: Sequence[str], *, everything: bool = False) -> list[str]:
    """Return assumptions by what they affect.

    By default the block lists those that leave something open, without their sources.
    """
    if everything:
        return _block("assumed", [text for _, some in by_effect(assumptions, everything=True) for text in some])
    shown = by_effect(assumptions)
    lines = _block("assumed", [f"{effect}: {'; '.join(some)}" for effect, some in shown])
    return [*lines, *_block("", ["laws, published and numerical values, sources: --all"] if assumptions else [])]


def describe(model: BearingModel | MachineModel) -> CaseReport | MachineReport:
    """Return what a resolved model is and assumes."""
    return _bearing(model) if isinstance(model, BearingModel) else _machine(model)


def _bearing(model: BearingModel) -> CaseReport:
    return CaseReport(
        name=model.name,
        title=model.title,
        hash=model_hash(model),
        headline=headline(model),
        bodies=_bodies(model),
        models=_models(model),
        warnings=model_warnings(model),
        assumptions=list(model.assumptions),
        values=value_reports(model),
    )


def _machine(model: MachineModel) -> MachineReport:
    parts = {}
    for bearing in model.bearings:
        side = {1: ", takes +x", -1: ", takes -x", 0: ""}[bearing.takes]
        play = "" if _is_tapered(bearing.model) else f"clearance {1e6 * bearing.model.geometry.clearance:.4g} um, "
        parts[bearing.name] = (
            f"{bearing.model.title} at {1e3 * bearing.position:.6g} mm, {play}"
            f"C {1e-3 * bearing.dynamic_rating:.4g} kN, C_0 {1e-3 * bearing.static_rating:.4g} kN{side}"
        )
    parts |= {body.name: f"body of {body.mass:.4g} kg at {1e3 * body.centre[0]:.6g} mm" for body in model.bodies}
    for name, forces in model.gears.items():
        x, y, z = forces.force
        parts[f"gear {name}"] = f"force x {x:.4g} N, y {y:.4g} N, z {z:.4g} N"
    title, *_ = lines = machine_headline(model)
    return MachineReport(
        name=model.name,
        title=title,
        headline=lines,
        bearings={bearing.name: bearing.model.title for bearing in model.bearings},
        parts=parts,
        models={bearing.name: _models(bearing.model) for bearing in model.bearings},
        hash=model_hash(model),
        warnings=model_warnings(model),
        assumptions=list(model.assumptions),
        values=value_reports(model),
    )


def _models(model: BearingModel) -> dict[str, dict[str, str]]:
    """Return element to role to the name of the law."""
    return {element: {role: law.model.name for role, law in roles.items()} for element, roles in model.laws.items()}


def machine_headline(model: MachineModel) -> list[str]:
    """Return the lines that describe a machine.

    They name its bearings, then speed, shaft and mass.
    """
    names = " + ".join(bearing.model.title.split(" (")[0] for bearing in model.bearings)
    shaft = "rigid shaft" if model.body.is_rigid else f"shaft of {1e3 * model.outline[-1][1]:.6g} mm"
    facts = [f"{30.0 / math.pi * model.speed:.5g} 1/min", f"{shaft}, {model.body.total_mass:.4g} kg"]
    return [f"{model.name}: {names}", "   ".join([*facts, counted(len(model.bearings), "bearing")])]


def model_warnings(model: BearingModel | MachineModel) -> list[str]:
    """Return a model's warnings before a solution.

    Parts that do not fit on a shaft, and bearings beyond a limit.

    Parameters
    ----------
    model : BearingModel or MachineModel
        From :func:`check`.

    Returns
    -------
    list of str
        Sentences; those of a bearing on a shaft begin with its name.
    """
    beyond = [(name, operating_warnings(one, on_shaft=bool(name))) for name, one in model.bearing_models.items()]
    return [*model.warnings, *(f"{name}: {text}" if name else text for name, told in beyond for text in told)]


def value_reports(model: BearingModel | MachineModel) -> list[ValueReport]:
    """Return every value with its unit and origin."""
    return [
        ValueReport(
            path=value.path,
            text=_value_text(value.value, value.quantity),
            source=value.source,
            grade=value.grade,
            status=value.status,
        )
        for value in placed_values({name: one.values for name, one in model.bearing_models.items()})
    ]


def headline(model: BearingModel) -> list[str]:
    """Return the lines that describe the model.

    They list bearing and oil, then loads, speed and depth, then laws of plugins.
    """
    g = model.geometry
    temperature = f"{from_si(model.oil.temperature, 'temperature'):.4g} degC"
    first = [
        model.title,
        f"{'2 x ' if g.rows == 2 else ''}{g.ball_count} x {_size(model)}",
        f"pitch {g.pitch_diameter * 1e3:.6g} mm",
        _clearance(model),
        f"{model.oil.name} at {temperature}",
    ]
    speed = model.inner_ring.dofs["spin"]
    turning = f"inner ring {function_text(speed.motion, 'rotational_speed')}"
    if speed.mode == "free":
        turning += " at the start, driven by a torque"
    depth = f"{SLICES} slices" if model.rollers is not None else f"strips {model.depth.rows}x{model.depth.strips}"
    second = [*_loads(model.inner_ring), turning, depth, f"cage {'on' if model.depth.cage else 'off'}"]
    return ["  ".join(first), "   ".join(second), *filter(None, [laws_line(model)])]


def _size(model: BearingModel) -> str:
    """Write diameter and, of rollers, length of the rolling elements."""
    diameter, rollers = f"{1e3 * model.geometry.ball_diameter:.3f}", model.rollers
    return f"{diameter} mm" if rollers is None else f"{diameter} x {1e3 * rollers.length:.5g} mm"


def _is_tapered(model: BearingModel) -> bool:
    return model.rollers is not None and model.rollers.is_conical


def _clearance(model: BearingModel) -> str:
    """Write the clearance in operation, and where it started from.

    Tapered rollers have none of their own: their load closes it.
    """
    if _is_tapered(model):
        return "clearance closed by the load"
    angle, g = model.geometry.contact_angle, model.geometry
    free = f"contact angle {show(angle, 'angle', 3)}, " if angle else ""
    text = f"{g.kind.words(g, free)}clearance {show(model.geometry.clearance, 'small_length', 4)}"
    bought = next((v for v in model.values if v.path == "bearing.clearance"), None)
    if bought is None:
        return text
    origin = f"{bought.source.split(':')[0]}, assumed" if bought.status == "assumed" else ""
    if bought.value != model.geometry.clearance:
        unmounted = show(float(bought.value), "small_length", 4)
        return f"{text} mounted ({unmounted} before: {origin or bought.source})"
    return f"{text} ({origin})" if origin else text


def function_text(function: TimeFunction, quantity: str) -> str:
    """Write a time function in a few words.

    An example is "harmonic 0.1 mm at 100 Hz".
    """
    if not function.terms:
        return _value_text(0.0, quantity)
    return " + ".join(_term_text(term, quantity) for term in function.terms)


def _term_text(term: Term, quantity: str) -> str:
    kind, values = term.kind, term.values
    if kind == "law":
        return f"{_value_text(values[0], quantity)} times a law's course, up to {_value_text(values[3], 'frequency')}"
    if kind == "ramp":
        start, end = (_value_text(value, quantity) for value in values[:2])
        return f"ramp {start} to {end} in {_value_text(values[3] - values[2], 'time')}"
    if kind == "harmonic":
        return f"harmonic {_value_text(values[0], quantity)} at {_value_text(values[1], 'frequency')}"
    if isinstance(term, TableTerm):
        return f"{'spline' if term.interpolation == 'spline' else 'table'} of {len(values) // 2} points"
    return _value_text(values[0], quantity)


def _loads(body: Body) -> list[str]:
    x, y, z = body.force
    found = []
    if _constant(y) and _constant(z):
        radial = math.hypot(_level(y), _level(z))
        if radial:
            # down is the direction of gravity and of a positive radial load
            direction = " upwards" if _level(z) > 0.0 and not _level(y) else ""
            found.append(f"radial {_value_text(radial, 'force')}{direction}")
    else:
        down = TimeFunction(tuple(term for term in z.terms if not y.terms and _acts_downwards(term)))
        rest = TimeFunction(tuple(term for term in z.terms if term not in down.terms))
        if down.terms:
            found.append(f"radial {function_text(scaled(down, -1.0), 'force')}")
        found += [f"force {axis} {function_text(f, 'force')}" for axis, f in (("y", y), ("z", rest)) if f.terms]
    if x.terms:
        found.append(f"axial {function_text(x, 'force')}")
    names = ("torque", "moment y", "moment z")
    found += [f"{name} {function_text(m, 'moment')}" for name, m in zip(names, body.moment, strict=True) if m.terms]
    return found or ["no load"]


def _acts_downwards(term: Term) -> bool:
    """Tell whether a force along z acts downwards.

    It is then a radial load as cases write it: positive downwards.
    """
    numbers = {"ramp": term.values[:2], "table": term.values[1::2]}.get(term.kind, term.values[:1])
    return math.fsum(numbers) < 0.0


def _constant(function: TimeFunction) -> bool:
    return all(term.kind == "constant" for term in function.terms)


def _level(function: TimeFunction) -> float:
    return math.fsum(term.values[0] for term in function.terms)


def _bodies(model: BearingModel) -> dict[str, str]:
    bodies = {"inner_ring": model.inner_ring, "outer_ring": model.outer_ring}
    if model.depth.cage:
        bodies["cage"] = model.cage_body
    return {name: _body_text(body) + _bending_text(model, name) for name, body in bodies.items()}


def _bending_text(model: BearingModel, name: str) -> str:
    """Describe the waves of a ring.

    The text names their numbers and frequencies; it is empty for a rigid body.
    """
    waves = next((waves for body, waves in model.elastic.items() if body == name), None)
    if waves is None:
        return ""
    lowest = show(waves.ring.frequency(waves.counts[0]) / (2.0 * math.pi), "frequency", 4)
    return f"; bends with 2 to {waves.orders} waves, two of them at {lowest}"


def _body_text(body: Body) -> str:
    by_mode: dict[str, list[str]] = {}
    for dof in DOFS:
        state = body.dofs[dof]
        quantity = {"spin": "rotational_speed", "tilt_y": "angle", "tilt_z": "angle"}.get(dof, "length")
        text = dof.replace("_", " ")
        if state.mode == "prescribed":
            text += f" {function_text(state.motion, quantity)}"
        if state.stiffness or state.damping:
            text += " on a support"
        by_mode.setdefault(state.mode, []).append(text)
    parts = [f"{mode} {', '.join(texts)}" for mode, texts in by_mode.items()]
    return f"{show(body.mass, 'mass', 4)}; {'; '.join(parts)}"


def _value_text(value: float | str, quantity: str) -> str:
    if isinstance(value, str):
        return value
    return f"{value:.6g}" if not quantity or math.isnan(value) else show(value, quantity, 6)


def _model_lines(models: dict[str, dict[str, str]]) -> list[str]:
    """Return one line per role.

    Elements that share a model are not repeated.
    """
    by_role: dict[str, dict[str, list[str]]] = {}
    for element, roles in models.items():
        for role, name in roles.items():
            by_role.setdefault(role, {}).setdefault(name, []).append(element)
    lines = []
    for role, names in by_role.items():
        if len(names) == 1:
            lines.append(f"{role:<20} {next(iter(names))}")
        else:
            shown = "; ".join(f"{name} ({', '.join(elements)})" for name, elements in names.items())
            lines.append(f"{role:<20} {shown}")
    return lines


def _block(head: str, lines: list[str]) -> list[str]:
    return [f"{head if index == 0 else '':<9} {line}" for index, line in enumerate(lines)]
