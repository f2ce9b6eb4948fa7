"""Find an installed view and apply it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import ValidationError

from lambda_core.discovery.registry import Registry
from lambda_core.domain.errors import UsageError, unknown_name
from lambda_core.domain.plugin_errors import PluginError, blamed
from lambda_core.views.chart import ViewData
from lambda_core.views.view import Subject, View

_WORDS = {"result": "one result", "results": "several results", "study": "a study", "machine": "a machine without time"}


def view_of(registry: Registry, name: str, subject: Subject) -> View:
    """Return a view by name.

    Raises
    ------
    UsageError
        When there is no such view, or it looks at something else.
    """
    fitting = [view.name for view in registry.views.values() if view.subject == subject]
    if name not in registry.views:
        raise UsageError(unknown_name("view", name, fitting))
    view = registry.view(name)
    if view.subject != subject:
        raise UsageError(
            f'the view "{name}" looks at {_WORDS[view.subject]}, this is {_WORDS[subject]}; '
            f"for it there are: {', '.join(fitting)}"
        )
    return view


def data_of(view: View, subject: Any, options: Mapping[str, Any]) -> ViewData:
    """Return the data of a view.

    Parameters
    ----------
    subject : object
        What the view looks at: a run, a sequence of runs, or the table of a study.
    options : mapping
        Options by name; text is converted.

    Raises
    ------
    UsageError
        For an option that does not exist or takes no such value.
    NotApplicable
        When the view has nothing to show.
    PluginError
        When its code fails.
    """
    known = view.options.model_fields
    for name in options:
        if name not in known:
            raise UsageError(f"view {view.name}: {unknown_name('option', name, known)}")
    try:
        chosen = view.options.model_validate(dict(options))
    except ValidationError as error:
        first = error.errors()[0]
        name = ".".join(str(part) for part in first["loc"])
        raise UsageError(f'view {view.name}: {name} = "{first["input"]}": {first["msg"]}') from None
    what = f'the view "{view.name}" ({view.distribution})'
    with blamed(what):
        found = view.data(subject, chosen)
    if not isinstance(found, ViewData):
        raise PluginError(f"{what} returns a {type(found).__name__}, not a ViewData")
    return found
