"""List the views of a subject and draw them."""

from __future__ import annotations

import re
from collections.abc import Container, Iterator, Sequence
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict

from lambda_core.discovery.api import Registry, data_of
from lambda_core.domain.errors import BearingNeededError, UsageError, unknown_name
from lambda_core.domain.files import check_target
from lambda_core.domain.plugin_errors import PluginError, blamed, went_on_without
from lambda_core.views.chart import ViewData
from lambda_core.views.method import NotApplicable
from lambda_core.views.view import Subject, View

FORMATS = ("svg", "png", "pdf")
_RESOLUTION = 160  # of PNG [dots per inch]


class OptionCard(BaseModel):
    """One option of a view."""

    model_config = ConfigDict(frozen=True)

    name: str
    default: str
    description: str


class ViewCard(BaseModel):
    """One installed view, as people read it."""

    model_config = ConfigDict(frozen=True)

    name: str
    title: str
    subject: Subject
    distribution: str
    reference: str
    options: list[OptionCard]


def cards(registry: Registry, subject: Subject | None = None) -> list[ViewCard]:
    """Return every installed view.

    It may be limited to one kind of subject.
    """
    return [
        ViewCard(
            name=view.name,
            title=view.title,
            subject=view.subject,
            distribution=view.distribution,
            reference=view.reference,
            options=[
                OptionCard(name=name, default=str(info.default), description=info.description or "")
                for name, info in view.options.model_fields.items()
            ],
        )
        for view in registry.views.values()
        if subject in (None, view.subject)
    ]


def every(
    registry: Registry, subject: Any, kind: Subject, without: Container[str] = ()
) -> Iterator[tuple[View, ViewData | NotApplicable]]:
    """Yield every view of a subject.

    Each has its data, or the reason why it shows nothing.

    Those named by `without` are left out.
    """
    for view in registry.views.values():
        if view.subject != kind or view.name in without:
            continue
        try:
            with blamed(f'the view "{view.name}" ({view.distribution})'):
                is_offered = view.offered is None or view.offered(subject)
            if is_offered:
                yield view, data_of(view, subject, {})
        except BearingNeededError:  # of a machine only its own views, unless a bearing is named
            continue
        except NotApplicable as reason:
            yield view, reason
        except PluginError as fault:  # of one package: the other views are drawn
            went_on_without(str(fault))
            yield view, NotApplicable(str(fault))


def write(registry: Registry, data: ViewData, folder: Path, stem: str, formats: Sequence[str]) -> list[Path]:
    """Draw a view into files of a folder.

    The names are ``stem-view.format``; returns their paths.

    Raises
    ------
    UsageError
        For a format that is not known, or a folder that cannot be written.
    """
    for name in formats:
        if name not in FORMATS:
            raise UsageError(unknown_name("format", name, FORMATS))
    ending = folder.suffix.removeprefix(".").lower()
    if (ending in FORMATS and not folder.is_dir()) or folder.is_file():
        example = f"{stem}-{data.view}.{ending if ending in FORMATS else formats[0]}"
        raise UsageError(f"{folder}: pictures go into a folder, which they name themselves there: {example}")
    view = registry.views.get(data.view)
    figure = registry.figure(view, data)
    whose = view.distribution if view is not None else "the house"
    written = []
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name in formats:
            path = check_target(folder / f"{stem}-{data.view.replace(':', '-')}.{name}")
            with blamed(f'the picture of the view "{data.view}" ({whose})', but=(OSError,)):
                figure.savefig(path, format=name, **({"dpi": _RESOLUTION} if name == "png" else {}))
            written.append(path)
    except OSError as error:
        raise UsageError(f"cannot write into {folder}: {error.strerror}") from None
    return written


def stem_of(paths: Sequence[Path]) -> str:
    """Return the stem of picture file names: "six-vs-heavy"."""
    words = [re.sub(r"[^A-Za-z0-9._-]+", "-", path.resolve().stem or path.name) for path in paths]
    if len(words) <= 1:
        return words[0]
    return f"{words[0]}-vs-{words[1] if len(words) == 2 else f'{len(words) - 1}-others'}"
