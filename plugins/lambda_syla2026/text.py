"""Make the tables of the reproduction, for terminal and page."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from lambda_core.export.report.key_tables import Table
from lambda_syla2026.anchored_table import UNUSED, AnchoredTable
from lambda_syla2026.calibration import Calibration
from lambda_syla2026.fig5 import Fig5
from lambda_syla2026.fig7 import STATED, Fig7
from lambda_syla2026.parameters import blind_set
from lambda_syla2026.published import POINTS
from lambda_syla2026.readings import TAU_GRID
from lambda_syla2026.table4 import Table4, rows_of

_NONE = "-"
_NAN = re.compile(r"[+-]?\bnan\b")
LOST = "failed"  # in place of a number that a point without a result would have


def number(value: float | None, digits: int = 1) -> str:
    """Write a number, a dash where there is none."""
    return _NONE if value is None else f"{value:.{digits}f}"


def marked(words: str) -> str:
    """Mark a point without a result."""
    return _NAN.sub(LOST, words)


def marked_tables(tables: Sequence[Table]) -> tuple[Table, ...]:
    """Return the tables, every cell marked."""
    return tuple(replace(table, rows=tuple(tuple(map(marked, row)) for row in table.rows)) for table in tables)


def _with_error(value: float, measured: float) -> str:
    return f"{value:.0f}" if value == measured else f"{value:.0f} ({100.0 * (value / measured - 1.0):+.0f} %)"


def _tau(fit: Calibration) -> str:
    return f"{fit.tau_e_MPa:.2f}{' (limit)' if fit.at_limit else ''}"


def _free(tau: float) -> str:
    """Write where a free fit of tau_e ends.

    The ends of its grid are no optimum.
    """
    low, *_, high = TAU_GRID
    if tau < low + 0.05:
        return f"below {low:g}"
    return f"above {high:g}" if tau > high - 0.05 else f"{tau:.1f}"


def table4_tables(found: Table4) -> tuple[Table, ...]:
    """Return torques, errors, details of each point, calibrations and sensitivities."""
    hot = tuple((f"{t['temperature_degC']:g}", number(t["error_pct"])) for t in found.temperatures)
    return (
        _torque(found),
        _behind(found),
        _fits(found),
        _fits_by_law(found),
        _effects(found),
        Table("mean error over the temperature of the oil", ("degC", "%"), hot),
        *_anchored(found.anchored),
    )


def _anchored(found: AnchoredTable) -> tuple[Table, ...]:
    """Return temperatures, bands, parts and calibrations of the anchored set."""
    points = tuple(
        (p.label, f"{heat:.1f}", f"{low:.0f} to {high:.0f}", number(difference, 2),
         *(f"{value:.0f}" for value in parts.values()))
        for p, heat, low, high, difference, parts in zip(
            POINTS, found.temperatures_degC, found.low_Nmm, found.high_Nmm, found.friction_difference_pct,
            found.parts_Nmm, strict=True)
    )  # fmt: skip
    residuals = tuple((r.temperatures, *(number(r.pct[name]) for name in UNUSED)) for r in found.residuals)
    fits = tuple(
        (c.fitted_on, _tau(c), _free(c.free_tau_e_MPa), number(c.fitted_row_pct), number(c.predicted_row_pct),
         number(c.six_points_pct))
        for c in found.calibrations
    )  # fmt: skip
    own = tuple((name, number(value)) for name, value in found.lambda_row_pct.items())
    return (
        Table(
            "the anchored runs: oil temperature from the printed SKF row, 90 % band, dynamic against quasi-static, "
            "parts [N mm]",
            ("", "degC", "band", "friction %", *found.parts_Nmm[0]),
            points,
        ),
        Table(
            "printed rows of other programs over the blind torque without drag: scatter about a plane in ln n and "
            "ln F [%]",
            ("temperatures", *UNUSED),
            residuals,
        ),
        Table(
            "anchored, tau_e alone fitted; errors [%], quasi-static plus the share of the runs",
            ("fitted on", "tau_e MPa", "free fit MPa", "own row", "predicted row", "six points"),
            fits,
        ),
        Table("mean deviation from LaMBDA's printed row, both without drag [%]", ("set", "%"), own),
    )


def _torque(found: Table4) -> Table:
    rows = tuple(
        (name, *(_with_error(value, p.measured) for value, p in zip(row, POINTS, strict=True)),
         f"{error:.1f}" if error else "")
        for name, row, error in rows_of(found)
    )  # fmt: skip
    return Table("friction torque [N mm]", ("", *(p.label for p in POINTS), "mean error %"), rows)


def _behind(found: Table4) -> Table:
    rows = tuple(
        (d.label, f"{d.low_Nmm:.0f} to {d.high_Nmm:.0f}", f"{d.confidence_Nmm:.1f}",
         number(d.friction_difference_pct, 2), number(d.load_difference_pct, 2),
         *(f"{value:.0f}" for value in d.parts_Nmm.values()))
        for d in found.details
    )  # fmt: skip
    return Table(
        "the blind runs: 90 % band, 95 % half-width, dynamic against quasi-static, parts [N mm]",
        ("", "band", "+-", "friction %", "load %", *found.details[0].parts_Nmm),
        rows,
    )


def _fits(found: Table4) -> Table:
    rows = tuple(
        (c.fitted_on, _tau(c), _free(c.free_tau_e_MPa), number(c.fitted_row_pct), number(c.predicted_row_pct),
         number(c.six_points_pct), "runs" if c.simulated else "quasi-static")
        for c in found.calibrations
    )  # fmt: skip
    return Table(
        "tau_e alone fitted; errors [%]",
        ("fitted on", "tau_e MPa", "free fit MPa", "own row", "predicted row", "six points", "by"),
        rows,
    )


def _fits_by_law(found: Table4) -> Table:
    rows = tuple(
        (c.elastic_hysteresis, c.rolling_resistance, number(c.unfitted_pct), c.fitted_on, _tau(c),
         _free(c.free_tau_e_MPa), number(c.fitted_row_pct), number(c.predicted_row_pct), number(c.six_points_pct))
        for c in found.calibrations_by_law
    )  # fmt: skip
    return Table(
        "tau_e alone fitted with every law of hysteresis and rolling resistance; errors [%], quasi-static",
        ("hysteresis", "rolling", "not fitted", "fitted on", "tau_e MPa", "free fit MPa", "own row", "predicted row",
         "six points"),
        rows,
    )  # fmt: skip


def _effects(found: Table4) -> Table:
    rows = tuple(
        (s.name, s.value, s.span, f"{s.low_change_pct:+.1f}", f"{s.high_change_pct:+.1f}",
         number(s.low_error_pct), number(s.high_error_pct), s.basis)
        for s in found.sensitivities
    )  # fmt: skip
    return Table(
        "sensitivities: change of the torque [%] and mean error [%] at the ends of each range",
        ("parameter", "blind", "range", "low", "high", "error low", "error high", "by"),
        rows,
    )


def blind_table() -> Table:
    """Return the parameter file: value, range, source."""
    rows = tuple((e.path, e.value, " to ".join(e.range) or ", ".join(e.alternatives), e.source) for e in blind_set())
    return Table("blind parameter set", ("option", "value", "range", "source"), rows)


def fig5_tables(found: Fig5) -> tuple[Table, ...]:
    """Return the tables of Fig. 5."""
    tables = [_resonances(found), _boundaries(found), _slopes(found), _rises(found)]
    if found.variations:
        rows = tuple((v.what, v.criterion, *(number(r, 2) for r in v.ratios)) for v in found.variations)
        tables.append(Table("boundary over that of the base case", ("change", "criterion", "first", "second"), rows))
    return (*tables, _parting(found)) if found.apart else tuple(tables)


def _resonances(found: Fig5) -> Table:
    rows = tuple(
        (f"{r.load_N / 1e3:g}", number(r.stiffness_N_per_um, 2), number(r.mass_kg, 2), number(r.frequency_Hz),
         number(r.cage_Hz), number(r.ball_Hz))
        for r in found.resonances
    )  # fmt: skip
    return Table("axial resonance", ("F_stat kN", "stiffness N/um", "mass kg", "rings Hz", "cage Hz", "ball Hz"), rows)


def _boundaries(found: Fig5) -> Table:
    rows = tuple(
        (p.variant, f"{p.load_N / 1e3:g}", p.criterion, f"{p.frequency_Hz:g}",
         LOST if p.failed else number(p.velocity_m_per_s, 4),
         f"{number(p.low_m_per_s, 4)} to {number(p.high_m_per_s, 4)}", number(p.acceleration_m_per_s2, 2),
         number(None if p.error is None else 100.0 * p.error), str(p.runs))
        for p in found.points
    )  # fmt: skip
    return Table(
        "boundary of altered running",
        ("variant", "F_stat kN", "criterion", "f Hz", "v_exc m/s", "bracket m/s", "acceleration m/s2",
         "standard error %", "runs"),
        rows,
    )  # fmt: skip


def _slopes(found: Fig5) -> Table:
    low, high = found.frequency_range_Hz
    rows = tuple(
        (line.variant, f"{line.load_N / 1e3:g}", line.criterion, number(line.slope, 2), number(line.slope_error, 2),
         number(line.slope_beyond, 2), "yes" if line.falls else "no")
        for line in found.lines
    )  # fmt: skip
    return Table(
        f"slope of log v_exc over log f, {low:g} to {high:g} Hz",
        ("variant", "F_stat kN", "criterion", "slope", "standard error", "above the range", "falls"),
        rows,
    )


def _rises(found: Fig5) -> Table:
    rows = tuple(
        (s.variant, s.criterion, f"{s.from_N / 1e3:g} to {s.to_N / 1e3:g}",
         f"{s.mean_from_m_per_s2:.1f} to {s.mean_to_m_per_s2:.1f}", f"{s.rise_pct:+.1f}", number(s.error_pct),
         f"{s.frequencies_up} of {s.frequencies}")
        for s in found.steps
    )  # fmt: skip
    return Table(
        "rise of the boundary with the load, geometric mean over the declared frequencies",
        ("variant", "criterion", "F_stat kN", "m/s2", "rise %", "standard error %", "frequencies that rise"),
        rows,
    )


def _parting(found: Fig5) -> Table:
    rows = tuple(
        (f"{a.acceleration_m_per_s2:g}", f"{a.friction_difference_pct:+.1f}", f"{a.load_difference_pct:+.1f}",
         number(a.cage_Nmm))
        for a in found.apart
    )  # fmt: skip
    return Table(
        "run against quasi-static solution: variant A, 5 kN, 8.9 Hz",
        ("acceleration m/s2", "friction without cage %", "largest load %", "cage N mm"),
        rows,
    )


def fig7_tables(found: Fig7) -> tuple[Table, ...]:
    """Return contacts and bearing, simulated and analytical."""
    contacts = tuple(
        (f"{c.load_N:g}", c.ring, number(c.ball_load_N), number(c.contact_angle_deg, 2), number(c.area_mm2, 4),
         number(c.film_um, 3), number(c.hertz_pF, 2), number(c.dynamic_hertz_pF, 2), number(c.analytical_pF, 2),
         f"{c.over_analytical_pct:+.1f}", number(c.k_c, 2), number(c.contact_pF))
        for c in found.contacts
    )  # fmt: skip
    bearing = tuple(
        (f"{b.load_N:g}", number(b.simulated_pF), number(b.dynamic_pF), number(b.analytical_pF)) for b in found.bearing
    )
    stated = tuple(
        (name, ", ".join(f"{value:+.1f}" for value in values), STATED.get(name, _NONE))
        for name, values in found.statements.items()
    )
    return (
        Table(
            "contacts",
            ("F_a N", "ring", "Q N", "angle deg", "area mm2", "film um", "C_Hertz pF", "run pF", "analytical pF", "%",
             "k_c", "C_Con pF"),
            contacts,
        ),
        Table("bearing", ("F_a N", "simulated pF", "run pF", "analytical pF"), bearing),
        Table("the paper's statements", ("", "found %", "paper %"), stated),
    )  # fmt: skip


def plain(title: str, bars: Sequence[str], tables: Sequence[Table], notes: Sequence[str]) -> str:
    """Return a chapter for a terminal."""
    lines = [title, "", *(f"  {bar}" for bar in bars)]
    for table in tables:
        cells = [table.head, *table.rows]
        widths = [max(len(row[i]) for row in cells) for i in range(len(table.head))]
        lines += ["", table.caption]
        lines += [
            "  "
            + "  ".join(c.ljust(w) if i == 0 else c.rjust(w) for i, (c, w) in enumerate(zip(row, widths, strict=True)))
            for row in cells
        ]
    return "\n".join([*(line.rstrip() for line in lines), "", *(f"note: {note}" for note in notes)])
