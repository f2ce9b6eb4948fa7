"""Define the commands `lambda-bearing plugins`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer

from lambda_cli.options import JsonOption
from lambda_cli.plugin_option import named_plugin

if TYPE_CHECKING:
    from rich.table import Table

    from lambda_core.api import CheckCard, ModelCard, PartCard

_PARTS: Final = ("method", "view", "observer", "event", "section", "profile")

app = typer.Typer(no_args_is_help=True, add_completion=False, help="List, show, check and create plugins.")


def _table(*columns: str) -> Table:
    from rich.table import Table

    table = Table(box=None, pad_edge=False, header_style="bold")
    for column in columns:
        table.add_column(column, overflow="fold")
    return table


def _print(item: object) -> None:
    """Write to stdout; a pipe gets whole lines, however long."""
    import sys

    from rich.console import Console

    width = None if sys.stdout.isatty() else 400
    Console(width=width, highlight=False, markup=False, emoji=False).print(item)


@app.command("list")
def list_plugins(
    role: Annotated[str, typer.Option(help="Only the models of one role.")] = "",
    as_json: JsonOption = False,
) -> None:
    """List plugins, and the reasons for unused ones.

    Each line names the distribution.
    """
    from lambda_cli.commands import renamed
    from lambda_core import api
    from lambda_core.api import NoteCard
    from lambda_core.domain.errors import UsageError, unknown_name
    from lambda_core.domain.roles import ROLES

    if role and role not in ROLES:
        raise UsageError(unknown_name("role", role, ROLES))
    found = api.plugins()
    found.notes += [NoteCard(distribution=package, message=message) for package, message in renamed()]
    if role:
        found.items = [item for item in found.items if item.role == role]
    if as_json:
        typer.echo(found.model_dump_json(indent=2))
        return
    table = _table("kind", "role", "name", "distribution", "reference")
    for item in found.items:
        table.add_row(item.kind, item.role, item.name, item.distribution, item.reference)
    _print(table)
    for fault in found.faults:
        _print(f"not in use: {fault.distribution} ({fault.entry_point}): {fault.message}")
    for note in found.notes:
        _print(f"note: {note.distribution}: {note.message}")


@app.command()
def show(
    model: Annotated[
        str,
        typer.Argument(
            metavar="ROLE/NAME",
            help="For example traction/ree-eyring; ree-eyring is enough if only one role has it. Or FILE.py, or a "
            "package: all that it brings. Or KIND/NAME, for example profile/barrel.",
        ),
    ],
    as_json: JsonOption = False,
) -> None:
    """Show one model, or all that a plugin brings.

    The plugin is a file or a package. The command prints parameters with units, limits and sources, the validity and
    the reference; of methods, views, profiles and other parts title, parameters and reference.
    """
    from lambda_core import api

    name = named_plugin(model)
    models, parts, is_plugin = _asked(name)
    if as_json:
        data = [json.loads(card.model_dump_json()) for card in (*models, *parts)]
        told = {"version": 1, "models": data[: len(models)], "parts": data[len(models) :]}
        typer.echo(json.dumps(told if is_plugin else data[0], indent=2))
        return
    if not (models or parts):
        _print(f"{name} brings no law, method, view or other part; lambda-bearing plugins list has what it brings")
    cards: list[ModelCard | PartCard] = [*models, *parts]
    for number, card in enumerate(cards):
        if number:
            _print("")
        if isinstance(card, api.PartCard):
            _show_part(card)
        else:
            _show_card(card)


def _asked(name: str) -> tuple[list[ModelCard], list[PartCard], bool]:
    """Return the cards of laws and of other parts.

    They are those of a plugin, as the last tells, or one card.
    """
    from lambda_core import api

    listed = api.plugins().items
    own = [item for item in listed if item.distribution.split(" ")[0] == name]
    is_plugin = bool(own)
    if not is_plugin and not any(item.role and name in (item.name, f"{item.role}/{item.name}") for item in listed):
        own = [item for item in listed if name in (item.name, f"{item.kind}/{item.name}")]
    brought = {(item.kind, item.name) for item in own if not item.role}
    parts = [card for kind in _PARTS for card in api.plugin_parts(kind) if (kind, card.name) in brought]
    if is_plugin or parts:
        models = [api.plugin_model(f"{item.role}/{item.name}") for item in own if item.role]
        return models, parts, is_plugin
    return [api.plugin_model(name)], [], False


def _show_card(card: ModelCard) -> None:
    default = "   default of its role" if card.default else ""
    _print(f"{card.role}/{card.name}   {card.distribution}{default}")
    lines = {
        "summary": card.summary,
        "reference": card.reference,
        "validity": card.validity,
        "returns": "; ".join(card.outputs),
        "keeps": "; ".join(card.states),
        "reads": ", ".join(card.reads),
        "used by": ", ".join(card.elements),
    }
    for title, text in lines.items():
        if text:
            _print(f"{title:<12} {text}")
    for status, sentence in card.errors.items():
        _print(f"{f'status {status}':<12} {sentence}")
    if not card.parameters:
        _print(f"{'parameters':<12} none")
        return
    table = _table("parameter", "default", "limits", "published", "meaning", "source")
    for parameter in card.parameters:
        table.add_row(
            parameter.name,
            "required" if parameter.required else parameter.default,
            ", ".join(parameter.limits),
            " to ".join(parameter.published_range),
            parameter.description,
            " ".join(filter(None, (parameter.source, f"[{parameter.status}]" if parameter.status else ""))),
        )
    _print("")
    _print(table)


def _show_part(card: PartCard) -> None:
    _print(f"{card.kind}/{card.name}   {card.distribution}")
    for title, text in (("title", card.title), ("reference", card.reference)):
        if text:
            _print(f"{title:<12} {text}")
    if not card.parameters:
        _print(f"{'parameters':<12} none")
        return
    table = _table("parameter", "default", "limits", "meaning")
    for parameter in card.parameters:
        default = "required" if parameter.required else parameter.default
        table.add_row(parameter.name, default, ", ".join(parameter.limits), parameter.description)
    _print("")
    _print(table)


@app.command()
def new(
    name: Annotated[str, typer.Argument(metavar="NAME", help="Lower case and hyphens, for example my-traction.")],
    folder: Annotated[
        Path, typer.Option("--in", metavar="FOLDER", help="Folder in which to create the package.")
    ] = Path(),
    as_json: JsonOption = False,
) -> None:
    """Create a small plugin package with examples.

    It has a law, a method, a view, rows, a command and tests.
    """
    from lambda_core import api

    files = api.new_plugin(name, folder)
    if as_json:
        typer.echo(json.dumps({"version": 1, "folder": str(folder / name), "files": [str(file) for file in files]}))
        return
    for file in files:
        typer.echo(str(file))
    typer.echo(f"next: pip install -e {folder / name}; lambda-bearing plugins check {name}", err=True)


@app.command()
def check(
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="[NAME]...", help="Packages, roles, ROLE/NAME or FILE.py; default: everything."),
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Test models against the rules of their role.

    The exit code is 3 if one fails.
    """
    from lambda_core import api
    from lambda_core.api import Verdict
    from lambda_core.domain.plugin_errors import PluginError

    cards = []
    try:
        names = [named_plugin(name) for name in names or ()]
    except PluginError:
        if not as_json:
            raise
        typer.echo(
            Verdict(models=[], faults=api.plugin_faults([_plain_name(name) for name in names or ()])).model_dump_json(
                indent=2
            )
        )
        raise typer.Exit(3) from None
    for card in api.check_plugins(names, announce=lambda text: typer.echo(text, err=True)):
        cards.append(card)
        if not as_json:
            _print(_verdict(card))
    faults = api.plugin_faults(names)
    if as_json:
        typer.echo(Verdict(models=cards, faults=faults).model_dump_json(indent=2))
    else:
        for fault in faults:
            _print(f"not in use: {fault.distribution} ({fault.entry_point}): {fault.message}")
    if faults or not all(card.ok for card in cards):
        raise typer.Exit(3)


def _plain_name(name: str) -> str:
    """Return the plain name of a plugin.

    A file by its name without the folder.
    """
    return Path(name).name if name.endswith(".py") else name


def _verdict(card: CheckCard) -> str:
    label = f"{card.role}/{card.name} ({card.distribution})"
    if card.not_tried:
        return f"--  {label} {card.not_tried}: not tried"
    if not card.ok:
        return "\n".join(f"bad {fault}" for fault in card.faults)
    timing = f"  {card.nanoseconds:.0f} ns" if card.nanoseconds is not None else ""
    return "\n".join([f"ok  {label}{timing}", *(f"    {warning}" for warning in card.warnings)])
