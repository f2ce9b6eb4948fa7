"""Draw the fields inside one contact ellipse.

These are pressure, slip, shear, film, temperature and permittivity.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from pydantic import Field as Declared

from lambda_core.domain.errors import CaseError, SolverError, UsageError
from lambda_core.plugins import (
    Arrows,
    Axis,
    Field,
    FloatArray,
    NotApplicable,
    Options,
    Panel,
    RunData,
    Series,
    View,
    ViewData,
)
from lambda_plugins.views.common import has_rollers, source

if TYPE_CHECKING:
    from lambda_core.solver.drivers.contact_field import ContactField
    from lambda_core.solver.drivers.solver_context import SolverContext

_STRIPS, _ROWS = 61, 41
_ARROWS = (9, 5)  # across and along rolling
_REACH = 1.8  # semi-axes along rolling that the map of the film shows beyond the edge
# What a contact depends on besides its laws and the recorded state.
_INPUTS = ("geometry.", "ball_material.", "inner_material.", "outer_material.", "oil.", "roughness", "starvation")
_CHANNELS = (
    "time", "ball_axial", "ball_radius", "ball_azimuth", "ball_velocity", "ball_spin", "body_position",
    "body_velocity", "body_tilt", "body_tilt_velocity", "body_spin", "body_spin_angle", "load", "film_central",
)  # fmt: skip


class Choice(Options):
    """Contact and time to show."""

    ball: int = Declared(0, ge=0, description="number of the ball, from 1; 0: the one with the largest load")
    ring: Literal["inner", "outer"] = Declared("inner", description="inner or outer")
    time: float = Declared(-1.0, description="moment [s]; negative: the end of the run")


def contact_map(run: RunData, options: Choice) -> ViewData:
    """Show maps over one contact ellipse.

    The contact pipeline computes them from the recorded state.
    """
    if has_rollers(run):
        raise NotApplicable("rollers touch along lines: the view line-contact shows them")
    row, sample = _moment(run, options.time)
    index = 0 if options.ring == "inner" else 1
    balls = sample["load"].shape[0]
    if options.ball > balls:
        raise UsageError(f"ball {options.ball} does not exist: this bearing has {balls}")
    ball = options.ball - 1 if options.ball else int(np.argmax(sample["load"][:, index]))
    if sample["load"][ball, index] <= 0.0:
        raise NotApplicable(
            f"ball {ball + 1} does not touch the {options.ring} ring at t = {1e3 * float(sample['time']):.4g} ms"
        )
    found = _field(run, row, sample, ball, options.ring)
    notes = (
        f"ball {ball + 1}, {options.ring} ring, azimuth {math.degrees(sample['ball_azimuth'][ball]) % 360.0:.1f} deg, "
        f"t = {1e3 * float(sample['time']):.5g} ms (sample {row}): load {found.load:.5g} N, "
        f"{found.semi_axis_a * 2e3:.3g} x {found.semi_axis_b * 2e3:.3g} mm, loss {found.loss:.3g} W",
        f"not to one scale: the ellipse is {found.semi_axis_a / found.semi_axis_b:.2g} times as wide across rolling as "
        "along it",
        f"{_STRIPS} x {_ROWS} cells; arrows: velocity of the ball over the ring; dashed: no slip along rolling",
        "film: uniform under load, as the film laws give it; around it the gap of Hertz's surfaces above the film",
        "the speed at which the ring tilts is not recorded and left out",
        "permittivity: at the local pressure and the bulk temperature, as the capacitance uses it",
    )
    return ViewData("contact-map", "Inside one contact", source(run), _panels(found), 3, notes)


def _moment(run: RunData, time: float) -> tuple[int, dict[str, FloatArray]]:
    """Return the sample nearest to a time, and its row."""
    times = run["time"]
    if time > times[-1]:
        raise UsageError(f"t = {time:g} s is after the end of the run, {times[-1]:g} s")
    row = times.size - 1 if time < 0.0 else int(np.argmin(np.abs(times - time)))
    return row, run.sample(row, _CHANNELS)


def _field(run: Any, row: int, sample: dict[str, FloatArray], ball: int, ring: str) -> ContactField:
    """Evaluate the pipeline at the recorded state.

    The model of the run is assembled again.
    """
    from lambda_core.analysis.rotor.bearing_alone import bearing_of_run
    from lambda_core.elements.ball.raceways import raceways_of_a_ball
    from lambda_core.model.laws.state_channels import state_channels
    from lambda_core.solver.drivers.contact_field import contact_field, contact_state
    from lambda_core.solver.drivers.contact_memory import hand_over
    from lambda_core.solver.drivers.equilibrium import solve

    try:
        context = solve(bearing_of_run(run)).context
        _refuse_other_physics(run, context, ring)
        kept = run.sample(row, [channel.name for channel in state_channels(context.model)])
        place = _place(run, row, context, ball, ring)
        hand_over(context.model, context.bundle, kept, ball, place)
        first = ball // context.model.geometry.ball_count * len(raceways_of_a_ball(context.model.geometry))
        return contact_field(context, *contact_state(sample, ball, ring), first + place, _STRIPS, _ROWS)
    except (CaseError, SolverError) as error:
        raise NotApplicable(f"the contact cannot be computed again: {error}") from None


def _place(run: RunData, row: int, context: SolverContext, ball: int, ring: str) -> int:
    """Return a ball's contact with a ring.

    If there are two arcs, it is on the one that carries more.
    """
    from lambda_core.solver.drivers.ring_values import rings_of_contacts

    places = np.flatnonzero(rings_of_contacts(context.model.geometry) == ("inner", "outer").index(ring))
    if places.size == 1:
        return int(places[0])
    return int(places[np.argmax(run.sample(row, ("arc_load",))["arc_load"][ball, places])])


def _refuse_other_physics(run: RunData, context: SolverContext, ring: str) -> None:
    """Refuse a map of other physics than the run's.

    The catalogue or the laws of the contact may have changed since.
    """
    from lambda_core.results.provenance import differences, model_data

    element, keys = f"ball_{ring}", context.kernels.keys()
    changed = [
        path
        for path in differences(run.model, model_data(context.model))
        if path.startswith((f"laws.{element}.", *_INPUTS))
    ]
    then = run.kernel_keys
    changed += sorted(name for name in keys if name.startswith(f"{element}/") and then.get(name) != keys[name])
    if changed:
        raise NotApplicable(f"the catalogue or the laws have changed since this run: {', '.join(changed[:3])}")


def _panels(found: ContactField) -> tuple[Panel, ...]:
    x, y = 1e3 * found.across, 1e3 * found.along
    slip = np.hypot(found.slip_along, found.slip_across)

    def panel(title: str, field: Field, **more: Any) -> Panel:
        return Panel(
            title, Axis("across rolling", "mm"), Axis("along rolling", "mm"), (_edge(found),), (), field, **more
        )

    return (
        panel("pressure", Field("pressure", "GPa", x, y, 1e-9 * found.pressure)),
        panel(
            "slip",
            Field("slip velocity", "m/s", x, y, slip, found.slip_along, "no slip along rolling"),
            arrows=_slip_arrows(found),
        ),
        panel("shear", Field("shear stress", "MPa", x, y, 1e-6 * found.shear)),
        panel("film", _film(found)),
        panel("temperature", Field("mean film temperature", "degC", x, y, found.temperature - 273.15)),
        panel("permittivity", Field("relative permittivity", "", x, y, found.permittivity)),
    )


def _edge(found: ContactField) -> Series:
    angle = np.linspace(0.0, 2.0 * math.pi, 145)
    x, y = 1e3 * found.semi_axis_a * np.cos(angle), 1e3 * found.semi_axis_b * np.sin(angle)
    return Series("edge of the contact", x, y, "line", "total", unlisted=True)


def _slip_arrows(found: ContactField) -> Arrows:
    """Return slip vectors at some cells.

    The component u is along the major axis, v along rolling.
    """
    strips, rows = found.across.shape
    some = np.ix_(
        np.linspace(0, strips - 1, _ARROWS[0] + 2).round().astype(int)[1:-1],
        np.linspace(0, rows - 1, _ARROWS[1] + 2).round().astype(int)[1:-1],
    )
    parts = (1e3 * found.across, 1e3 * found.along, found.slip_across, found.slip_along)
    return Arrows("slip", "m/s", *(values[some].ravel() for values in parts))


def _film(found: ContactField) -> Field:
    """Return the film over the contact and around it.

    Confocal coordinates x = A cos phi, y = B sin phi, A^2 = a^2 + t^2, B^2 = b^2 + t^2, t = b sinh w. Outside the
    contact Hertz's surfaces stand apart by P (x^2 I_A + y^2 I_B - I_1) with the integrals of 1/A^3, 1/(B^2 A) and
    1/A over w from the edge (Johnson, Contact Mechanics (1985), section 3.5); P as in the capacitance of the gap.
    """
    a, b = found.semi_axis_a, found.semi_axis_b
    major, minor = max(a, b), min(a, b)
    from lambda_plugins.capacitance import gap_scale  # a law: not imported until this view is drawn

    scale = gap_scale(major, minor, found.radius_x, found.radius_y)
    phi = np.linspace(0.0, 2.0 * math.pi, 121)
    w = np.linspace(0.0, math.asinh(_REACH), 400)
    t = minor * np.sinh(w)
    big, small = np.sqrt(major**2 + t**2), np.sqrt(minor**2 + t**2)
    i_a, i_b, i_1 = (_running(values, w) for values in (big**-3, 1.0 / (small**2 * big), 1.0 / big))
    inside, outside = np.linspace(0.0, 1.0, 6)[:-1], slice(None, None, 21)
    radii_a, radii_b = np.append(inside * major, big[outside]), np.append(inside * minor, small[outside])
    x, y = np.outer(radii_a, np.cos(phi)), np.outer(radii_b, np.sin(phi))
    h = np.full(x.shape, found.film)
    n = inside.size
    i_a, i_b, i_1 = (values[outside, None] for values in (i_a, i_b, i_1))
    h[n:] += np.maximum(scale * (x[n:] ** 2 * i_a + y[n:] ** 2 * i_b - i_1), 0.0)
    if a < b:
        x, y = y, x
    return Field("film and gap", "um", 1e3 * x, 1e3 * y, 1e6 * h, levels=(1.0, 2.0, 4.0, 8.0, 16.0), log=True)


def _running(values: FloatArray, w: FloatArray) -> FloatArray:
    """Return the running integral of values over w.

    It follows the trapezoidal rule.
    """
    return np.concatenate([[0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(w))])


VIEWS = (
    View(
        "contact-map",
        "pressure, slip, shear, film, temperature and permittivity inside one contact",
        "result",
        contact_map,
        Choice,
        view_api=1,
    ),
)
