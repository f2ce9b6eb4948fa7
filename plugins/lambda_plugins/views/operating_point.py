"""Draw a machine at its operating point.

It shows deflection and bending moment of its shaft, and natural frequencies over speed.
"""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from lambda_core.plugins import Arrows, Axis, MachineData, Mark, NotApplicable, Options, Panel, Series, View, ViewData
from lambda_plugins.views.bearing_section import Sizes, against_the_shaft, box, enlarged, from_the_side, outline

_ROLES = {"bending": "inner", "lateral": "inner", "axial": "reference", "torsion": "cage", "body": "outer"}


def _source(found: Any) -> str:
    return f"{found.case}   {found.speed_rpm:.5g} 1/min   " + ", ".join(
        f"{bearing.name} {bearing.title.split(' (')[0]}" for bearing in found.bearings.values()
    )


def deflection(machine: MachineData, options: Options) -> ViewData:
    """Return deflection and bending moment of the shaft.

    They share one axis.
    """
    model, report = machine.model, _solved(machine)
    if not _has_shaft(report):
        raise NotApplicable("this view shows a shaft, and this case has one bearing without a shaft")
    along = Axis("position", "mm", low=min(0.0, 1e3 * model.outline[0][0]), high=1e3 * model.outline[-1][1])
    places, cuts = np.array(report.positions_mm), np.array(report.cut_positions_mm)
    moved, moments = np.array(report.deflection_um), np.array(report.bending_moment_Nm)
    supports = tuple(Mark(bearing.name, bearing.position_mm, "x") for bearing in report.bearings.values())
    bare = tuple(Mark("", mark.value, "x") for mark in supports)
    drawn: Literal["line", "points"] = "line" if cuts.size else "points"
    panels = [
        _drawing(model, report),
        Panel(
            "deflection", along, Axis("deflection", "um"),
            (Series("y (horizontal)", places, moved[:, 1], drawn, "outer"),
             Series("z (vertical)", places, moved[:, 2], drawn, "inner")), bare,
        ),
    ]  # fmt: skip
    notes = ["arrows: forces of the bearings on the shaft in the vertical plane"]
    if cuts.size:  # a rigid shaft has none
        panels.append(
            Panel(
                "bending moment", along, Axis("moment", "N m"),
                (Series("about y (bends vertically)", cuts, moments[:, 0], "line", "inner"),
                 Series("about z (bends horizontally)", cuts, moments[:, 1], "line", "outer")), bare,
            )
        )  # fmt: skip
        notes.append("bending moment: moment of the right part on the left part at each cut")
    return ViewData("shaft", "A shaft in its bearings", _source(report), tuple(panels), 1, tuple(notes))


def _drawing(model: Any, report: Any) -> Panel:
    """Draw the shaft from the side.

    It shows its bearings and discs, and the reactions as arrows.
    """
    series = [outline("shaft", [box(1e3 * a, 1e3 * b, -500.0 * d, 500.0 * d) for a, b, d, _ in model.outline], "total")]
    bores = [box(1e3 * a, 1e3 * b, -500.0 * bore, 500.0 * bore) for a, b, _, bore in model.outline if bore > 0.0]
    if bores:
        series.append(outline("bore", bores, "reference"))
    rings = []
    for bearing in model.bearings:
        g, middle = bearing.model.geometry, 1e3 * bearing.position
        for sign in (1.0, -1.0):
            low, high = sorted((sign * 500.0 * g.bore_diameter, sign * 500.0 * g.outside_diameter))
            rings.append(box(middle - 500.0 * g.width, middle + 500.0 * g.width, low, high))
    series.append(outline("bearings", rings, "outer"))
    tall = max(d for _, _, d, _ in model.outline)
    if model.discs:
        series.append(outline("discs", [box(1e3 * x - 1.0, 1e3 * x + 1.0, -800.0 * tall, 800.0 * tall)
                                      for _, x in model.discs], "cage"))  # fmt: skip
    if model.wheels:
        series.append(outline("gears", [box(1e3 * x - 0.05 * pitch * 1e3, 1e3 * x + 0.05 * pitch * 1e3, -500.0 * pitch,
                                           500.0 * pitch) for _, x, pitch in model.wheels], "reference"))  # fmt: skip
    if model.load_places:
        spots = np.array([1e3 * x for _, x in model.load_places])
        series.append(Series("loads", spots, np.zeros(spots.size), "points", "ball"))
    x = np.array([bearing.position_mm for bearing in report.bearings.values()])
    forces = np.array([bearing.force_N for bearing in report.bearings.values()])
    arrows = Arrows("reactions", "N", x, np.zeros(x.size), forces[:, 0], forces[:, 2])
    marks = tuple(Mark(bearing.name, bearing.position_mm, "x") for bearing in report.bearings.values())
    return Panel(
        "shaft and bearings", Axis("position", "mm"), Axis("radius", "mm"), tuple(series), marks,
        arrows=arrows, shape="plane",
    )  # fmt: skip


def element_loads(machine: MachineData, options: Options) -> ViewData:
    """Return the ball loads over azimuth.

    It shows both rings, with a panel for each bearing.
    """
    found = _solved(machine)
    panels = tuple(_loads(name, one.contacts) for name, one in _named(found).items())
    return ViewData("element-loads", "Load of every rolling element", _titles(found), panels, 1)


def _solved(machine: MachineData) -> Any:
    """Return the equilibrium; NotApplicable without one."""
    if machine.equilibrium is None:
        raise NotApplicable("this view needs an equilibrium, and none was solved")
    return machine.equilibrium


def _named(found: Any) -> dict[str, Any]:
    """Return the bearings of an equilibrium.

    One that is alone needs no name in a picture.
    """
    return {name if _has_shaft(found) else "": one for name, one in found.bearings.items()}


def _has_shaft(found: Any) -> bool:
    """Tell whether an equilibrium or modes are of a shaft.

    Only those have matrices, with the axes of their rows.
    """
    return hasattr(found, "axes")


def _titles(found: Any) -> str:
    return _source(found) if _has_shaft(found) else f"{found.case}   {found.title}"


def bearing(machine: MachineData, options: Options) -> ViewData:
    """Return a sketch of every bearing with its load.

    It is seen from the side and against the shaft; the inner ring stands where the load moves it, enlarged.
    """
    found = _solved(machine)
    if machine.model is None:
        raise NotApplicable("this view needs the model, and this equilibrium was read from data: solve its case again")
    models = machine.model.bearing_models.values()
    panels, notes = [], ["arrows: load of the inner ring on its raceways, in sum and on every ball or roller"]
    for (name, one), model in zip(_named(found).items(), models, strict=True):
        sizes, label = Sizes.of(model), f"{name} " if name else ""
        moved, factor = enlarged(one.ring_displacement_um, 0.2 * sizes.element)
        panels += [from_the_side(f"{label}from the side", sizes, one, moved),
                   against_the_shaft(f"{label}against the shaft", sizes, one, moved)]  # fmt: skip
        text = "  ".join(
            f"{axis} {0.0 if abs(um) < 5e-4 else um:.3g}"
            for axis, um in zip("xyz", one.ring_displacement_um, strict=True)
        )
        notes.append(f"{label}inner ring moves {text} um, drawn {factor:g} times as far")
    return ViewData("bearing", "A bearing under its load", _titles(found), tuple(panels), 2, tuple(notes))


def _loads(name: str, contacts: Any) -> Panel:
    """Return the ball loads of one bearing by rings."""
    series = []
    for ring in ("inner", "outer"):
        own = sorted((contact.azimuth_deg, contact.load_N) for contact in contacts if contact.ring == ring)
        azimuths, loads = np.array(own).T
        series.append(Series(f"{ring} ring", azimuths, loads, "points", ring))
    axes = Axis("azimuth", "deg", low=0.0, high=360.0), Axis("load", "N", low=0.0)
    return Panel(f"load of every ball {name}".strip(), *axes, tuple(series))


def campbell(machine: MachineData, options: Options) -> ViewData:
    """Return natural frequencies over speed.

    It shows the line of one per revolution, too.
    """
    report = machine.modes
    if report is None or len(report.campbell) < 2:
        raise NotApplicable("this view needs modes at two speeds or more, and they were not computed")
    speeds = np.array([row.speed_rpm for row in report.campbell])
    series, seen = [], set()
    for i in range(min(len(row.modes) for row in report.campbell)):
        values = np.array([row.modes[i].frequency_Hz for row in report.campbell])
        kind = report.campbell[0].modes[i].kind
        series.append(Series(kind, speeds, values, "line", _ROLES[kind], unlisted=kind in seen))
        seen.add(kind)
    series.append(Series("once per revolution", speeds, speeds / 60.0, "line", "ball"))
    running = (Mark("running speed", abs(report.speed_rpm), "x"),)
    axes = Axis("speed", "1/min"), Axis("frequency", "Hz", low=0.0)
    panel = Panel("natural frequencies", *axes, tuple(series), running)
    return ViewData(
        "whirl", "Natural frequencies over speed", _source(report), (panel,), 1,
        ("bearings as stiff as at the operating point",),
    )  # fmt: skip


def _is_alone(machine: MachineData) -> bool:
    """Tell whether an equilibrium is of one bearing alone."""
    return machine.equilibrium is not None and not _has_shaft(machine.equilibrium)


def _is_on_shaft(machine: MachineData) -> bool:
    return not _is_alone(machine)


VIEWS = (
    View(
        "shaft",
        "Shaft in its bearings: deflection, bending moment",
        "machine",
        deflection,
        offered=_is_on_shaft,
        view_api=1,
    ),
    View("bearing", "Bearing under its load without time", "machine", bearing, offered=_is_alone, view_api=1),
    View(
        "element-loads",
        "Load of every rolling element without time",
        "machine",
        element_loads,
        offered=_is_alone,
        view_api=1,
    ),
    View("whirl", "Natural frequencies of a machine over speed", "machine", campbell, offered=_is_on_shaft, view_api=1),
)
