"""Convert view data to another system of units."""

from __future__ import annotations

from dataclasses import replace

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.unit_systems import UnitSystem
from lambda_core.views.chart import Arrows, Axis, Field, Mark, Panel, Series, ViewData


def in_units(data: ViewData, units: UnitSystem) -> ViewData:
    """Return a view's data in other units.

    It converts axes, fields, marks and notes.

    Parameters
    ----------
    data : ViewData
        In the units of the program.
    units : UnitSystem
        In which they are shown; those of the program leave everything as it is.
    """
    if not units.shown:
        return data
    return replace(
        data,
        source=units.sentence(data.source),
        panels=tuple(_panel(panel, units) for panel in data.panels),
        notes=tuple(units.sentence(note) for note in data.notes),
    )


def _panel(panel: Panel, units: UnitSystem) -> Panel:
    x, y = panel.x.unit, panel.y.unit
    return replace(
        panel,
        x=_axis(panel.x, units),
        y=_axis(panel.y, units),
        series=tuple(_series(series, x, y, units) for series in panel.series),
        marks=tuple(_mark(mark, x if mark.axis == "x" else y, units) for mark in panel.marks),
        field=_field(panel.field, x, y, units) if panel.field is not None else None,
        arrows=_arrows(panel.arrows, x, y, units) if panel.arrows is not None else None,
    )


def _axis(axis: Axis, units: UnitSystem) -> Axis:
    factor, _ = units.scale(axis.unit)
    return replace(
        axis,
        unit=units.unit(axis.unit),
        low=None if axis.low is None else units.value(axis.low, axis.unit),
        high=None if axis.high is None else units.value(axis.high, axis.unit),
        least=axis.least * factor,
        ticks=tuple(units.value(tick, axis.unit) for tick in axis.ticks),
    )


def _values(values: FloatArray, unit: str, units: UnitSystem) -> FloatArray:
    factor, offset = units.scale(unit)
    return values * factor + offset


def _series(series: Series, x: str, y: str, units: UnitSystem) -> Series:
    return replace(
        series,
        x=_values(series.x, x, units),
        y=_values(series.y, y, units),
        low=None if series.low is None else _values(series.low, y, units),
        high=None if series.high is None else _values(series.high, y, units),
        name=units.sentence(series.name),
    )


def _mark(mark: Mark, unit: str, units: UnitSystem) -> Mark:
    return replace(mark, value=units.value(mark.value, unit), label=units.sentence(mark.label))


def _field(field: Field, x: str, y: str, units: UnitSystem) -> Field:
    return replace(
        field,
        x=_values(field.x, x, units),
        y=_values(field.y, y, units),
        values=_values(field.values, field.unit, units),
        levels=tuple(units.value(level, field.unit) for level in field.levels),
        unit=units.unit(field.unit),
    )


def _arrows(arrows: Arrows, x: str, y: str, units: UnitSystem) -> Arrows:
    return replace(
        arrows,
        x=_values(arrows.x, x, units),
        y=_values(arrows.y, y, units),
        u=_values(arrows.u, arrows.unit, units),
        v=_values(arrows.v, arrows.unit, units),
        unit=units.unit(arrows.unit),
    )
