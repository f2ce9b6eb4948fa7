"""Offer every public function of the program.

What stands behind a name is imported when the name is first asked for. The imports below are for type checkers and
readers, and they are the list of the names: see :func:`~lambda_core.domain.lazy_names.lazy_names`.
"""

from __future__ import annotations

from importlib import import_module
from inspect import isfunction
from typing import TYPE_CHECKING, Any

from lambda_core.domain.lazy_names import lazy_names
from lambda_core.domain.public_call import public

if TYPE_CHECKING:  # what one calls, and what it raises
    from lambda_core.analysis.band.model_band import model_band
    from lambda_core.analysis.electric.bearing_currents import electric, film_from_capacitance
    from lambda_core.analysis.rotor.api import modes
    from lambda_core.analysis.thermal.api import thermal, warm_up
    from lambda_core.case.api import builtin_cases, case, save, schema
    from lambda_core.discovery.api import plugins, use_plugin
    from lambda_core.domain.errors import CaseError, LambdaError, UsageError
    from lambda_core.export.fmu.unit_file import export_fmu
    from lambda_core.export.report.api import animate, draw, report, view, views
    from lambda_core.export.ross import ross_rotor
    from lambda_core.export.stiffness import write_stiffness
    from lambda_core.fitting.api import compare_measured, fit, traction
    from lambda_core.model.api import catalogue, check, describe, init_case
    from lambda_core.runs.api import cross_check, estimate, iterate, quasistatic, resume, run, warmup
    from lambda_core.runs.compare import compare
    from lambda_core.runs.stored import cite, result, side_by_side, summary
    from lambda_core.studies.api import study_check, study_resume, study_run, study_status, study_table
    from lambda_core.studies.choose import Choice, choose
    from lambda_core.studies.current_map import electric_map
    from lambda_core.studies.duty_cycle import duty
    from lambda_core.studies.in_python import study
    from lambda_core.studies.speed_curve import stribeck
if TYPE_CHECKING:  # what the faces build on, and the classes that calls take and return
    from lambda_core.analysis.electric.api import check_discharges_file, write_discharges
    from lambda_core.analysis.rotor.machine_equilibrium import BearingEquilibrium, MachineEquilibrium
    from lambda_core.analysis.rotor.machine_modes import MachineModes
    from lambda_core.analysis.thermal.api import thermal_pictures
    from lambda_core.case.cards import FieldCard, Kind, field_card
    from lambda_core.case.case import Case
    from lambda_core.case.case_io import is_machine
    from lambda_core.case.case_writer import save_text
    from lambda_core.case.draft import Draft
    from lambda_core.case.machine import MachineCase
    from lambda_core.case.modelling import Models
    from lambda_core.case.parts import InlineMaterial
    from lambda_core.case.rollers import PROFILE_OPTIONS, SHARED_GEOMETRY
    from lambda_core.case.signals import SIGNAL_KINDS
    from lambda_core.catalogue.designation import Designation, read_designation
    from lambda_core.catalogue.protocol import BearingRow, CageRow, Catalogue, LubricantRow, MaterialRow, RollerRow
    from lambda_core.discovery.api import (
        CheckCard,
        ModelCard,
        NoteCard,
        PartCard,
        Registry,
        Verdict,
        new_plugin,
        plugin_faults,
        plugin_model,
        plugin_parts,
        registry,
        switch_off,
    )
    from lambda_core.elements.ball.geometry import Geometry
    from lambda_core.export.report.api import check_page, machine_pictures, view_all, view_stem
    from lambda_core.export.stiffness import stiffness_target
    from lambda_core.fitting.api import add_measured, fitted_case, measured_series, with_measured
    from lambda_core.fitting.report import FitReport
    from lambda_core.fitting.rows import FitProgress
    from lambda_core.model.api import draft, problems, templates
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.checks.describe import ValueReport, model_warnings, value_reports
    from lambda_core.model.checks.oil_table import oil_table
    from lambda_core.model.laws.law_trials import law_problems
    from lambda_core.model.long_form import long_form
    from lambda_core.model.machine_model import MachineModel, MountedBearing
    from lambda_core.model.roller_case import RollerModel, roller_model
    from lambda_core.results.bearing_summary import BearingSummary
    from lambda_core.results.quantity import shown, shown_numbers
    from lambda_core.results.reader import Result
    from lambda_core.results.run_status import Status, process_identity, this_process
    from lambda_core.results.side_by_side import SideBySide
    from lambda_core.results.summary import Summary
    from lambda_core.runs.estimate import Estimate
    from lambda_core.runs.plugin_trials import check_plugins, watch_problems
    from lambda_core.runs.progress import Progress
    from lambda_core.studies.api import study_schema
    from lambda_core.studies.duty_cycle import DutyCycle
    from lambda_core.studies.folders import StudyStatus
    from lambda_core.studies.machine_duty import MachineDutyCycle
    from lambda_core.studies.run_queue import QueuedRun, RunKind, RunQueue
    from lambda_core.studies.scheduler import StudyProgress
    from lambda_core.studies.speed_curve import stribeck_picture
    from lambda_core.studies.study_files import init_study, study_examples


_CALLS, _PARTS = lazy_names(__file__)
_HOME = _CALLS | _PARTS
__all__ = sorted(_CALLS)


def __getattr__(name: str) -> Any:
    """Import what is asked for, once."""
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    found = getattr(import_module(_HOME[name]), name)
    if isfunction(found):
        found = public(found, __name__)
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    return sorted(_HOME)
