"""The one door: everything that a face, a script or a plugin may ask of the program.

Heavy libraries are loaded inside the functions that need them.
"""

from __future__ import annotations

from lambda_core.api.cases import (
    builtin_cases,
    case,
    catalogue,
    draft,
    init_case,
    save,
    schema,
)
from lambda_core.api.models import check, describe, problems, resolve
from lambda_core.api.packages import check_plugins, new_plugin, plugin_faults, plugin_model, plugins
from lambda_core.api.pictures import animate, draw, report, view, view_all, view_stem, views
from lambda_core.api.results import cite, compare, result, summary
from lambda_core.api.runs import (
    cross_check,
    estimate,
    iterate,
    quasistatic,
    resume,
    run,
    warmup,
)
from lambda_core.api.studies import (
    reproduce,
    study_check,
    study_resume,
    study_run,
    study_schema,
    study_status,
    study_table,
)
from lambda_core.errors import CaseError, LambdaError, UsageError

__all__ = [
    "CaseError",
    "LambdaError",
    "UsageError",
    "animate",
    "builtin_cases",
    "case",
    "catalogue",
    "check",
    "check_plugins",
    "cite",
    "compare",
    "cross_check",
    "describe",
    "draft",
    "draw",
    "estimate",
    "init_case",
    "iterate",
    "new_plugin",
    "plugin_faults",
    "plugin_model",
    "plugins",
    "problems",
    "quasistatic",
    "report",
    "reproduce",
    "resolve",
    "result",
    "resume",
    "run",
    "save",
    "schema",
    "study_check",
    "study_resume",
    "study_run",
    "study_schema",
    "study_status",
    "study_table",
    "summary",
    "view",
    "view_all",
    "view_stem",
    "views",
    "warmup",
]
