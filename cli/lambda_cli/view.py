"""Define the command view."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Annotated

import typer

from lambda_cli.options import BearingOption, JsonOption, OverlayOption, Units, UnitsOption
from lambda_cli.pictures import picture_kind, print_picture
from lambda_core.domain.files import check_folder

if TYPE_CHECKING:
    from lambda_core.views.chart import ViewData


def view(
    words: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="RESULT... [NAME]", help="Result file, several of them, or the folder of a study; then one view."
        ),
    ] = None,
    out: Annotated[Path, typer.Option("--out", metavar="DIR", help="Folder for the pictures.")] = Path(),
    formats: Annotated[
        list[str] | None, typer.Option("--format", metavar="FORMAT", help="svg, png or pdf; default: svg and png.")
    ] = None,
    options: Annotated[
        list[str] | None, typer.Option("--set", metavar="OPTION=VALUE", help="Option of the view (see --list).")
    ] = None,
    measured: OverlayOption = None,
    bearing: BearingOption = None,
    shown: Annotated[
        bool, typer.Option("--show", help="Print the pictures in a terminal with kitty's graphics or sixel; no files.")
    ] = False,
    show_list: Annotated[bool, typer.Option("--list", help="List the views and their options.")] = False,
    as_json: JsonOption = False,
    units: UnitsOption = Units.SI,
) -> None:
    """Draw one view, or all views that apply.

    The command writes RESULT-NAME.svg and .png and prints their names; with --json the data with units instead.
    """
    from lambda_core import api

    if show_list:
        _list(as_json)
        return
    sources, name = _sorted_out(words or [])
    chosen = dict(_pairs(options or []))
    name = name or ("vibration" if measured is not None and _is_vibration(measured) else "")
    if name == "vibration" and measured is not None:
        chosen, measured = {**chosen, "measured": str(measured)}, None
    kind = picture_kind() if shown and not as_json else None
    if not (as_json or kind or out.is_file()):  # of a file the drawing says what it would write instead
        check_folder(out, made=True)
    found = _all(sources, bearing, with_reasons=measured is None)
    if name:
        found = [api.view(sources, name, chosen, bearing=bearing)]
    if measured is not None:
        run = sources[0] if not name and len(sources) == 1 and Path(sources[0]).suffix == ".h5" else None
        found = api.with_measured(found, measured, result=run, bearing=bearing)
    data = list(found)
    if as_json:
        plain = [one.as_dict() for one in data]
        typer.echo(json.dumps(plain[0] if name else {"version": 1, "views": plain}, indent=2, allow_nan=False))
        return
    from lambda_core.views.other_units import in_units

    stem = api.view_stem(sources, bearing)
    with TemporaryDirectory(prefix="lambda-bearing-") as unseen:
        target, chosen_formats = (Path(unseen), ("png",)) if kind else (out, tuple(formats or ("svg", "png")))
        for one in data:
            for path in _drawn(in_units(one, units.system), target, stem, chosen_formats, bool(name)):
                if kind:
                    print_picture(path, kind)
                else:
                    typer.echo(str(path))


def _is_vibration(measured: Path) -> bool:
    """Tell whether a file holds a vibration signal.

    Its first line with columns tells.
    """
    if not measured.is_file():
        return False
    lines = measured.read_text(encoding="utf-8", errors="replace").splitlines()
    head = next((line.casefold() for line in lines if line.strip() and not line.lstrip().startswith("#")), "")
    return "time" in head and any(word in head for word in ("acceleration", "velocity", "displacement"))


def _drawn(data: ViewData, out: Path, stem: str, formats: tuple[str, ...], alone: bool) -> list[Path]:
    """Draw a view; report a plugin's failing view.

    Draw the others.
    """
    from lambda_core import api
    from lambda_core.domain.plugin_errors import PluginError, went_on_without

    try:
        return api.draw(data, out, stem, formats)
    except PluginError as fault:
        if alone:
            raise
        went_on_without(str(fault))
        typer.echo(f"{data.view}: {fault}", err=True)
        return []


def _all(sources: list[str], bearing: str | None, with_reasons: bool) -> Iterable[ViewData]:
    """Yield the data of every view that applies.

    Print why others do not, where that is asked for.
    """
    from lambda_core import api
    from lambda_core.domain.plugin_errors import failures_so_far

    for name, data in api.view_all(sources, bearing=bearing):
        if not isinstance(data, api.LambdaError):
            yield data
        elif with_reasons or str(data) in failures_so_far():
            typer.echo(f"{name}: {data}", err=True)


def _sorted_out(words: list[str]) -> tuple[list[str], str]:
    """Split the arguments into results and a view.

    The view is a name.
    """
    from lambda_core import api

    sources = [word for word in words if Path(word).exists()]
    names = [word for word in words if not Path(word).exists()]
    known = [card.name for card in api.views()]
    missing = [word for word in names if word not in known]
    if missing:
        kind = "result" if "." in missing[0] or "/" in missing[0] or not sources else "view"
        if kind == "result":
            raise api.UsageError(f"{missing[0]} does not exist: name a file that lambda-bearing run has written")
        from lambda_core.domain.errors import unknown_name

        raise api.UsageError(unknown_name("view", missing[0], known))
    if not sources:
        raise api.UsageError("name a result file or the folder of a study, for example: lambda-bearing view RESULT.h5")
    if len(names) > 1:
        raise api.UsageError(f"give one view, or none to draw all: {', '.join(names)}")
    return sources, names[0] if names else ""


def _pairs(texts: list[str]) -> Iterable[tuple[str, str]]:
    from lambda_core.domain.errors import UsageError

    for text in texts:
        name, equals, value = text.partition("=")
        if not equals or not name.strip():
            raise UsageError(f'"{text}": write OPTION=VALUE, for example --set ring=outer')
        yield name.strip(), value.strip()


_HEADINGS = {
    "of a result": "result",
    "of several results": "results",
    "of a study": "study",
    "of an operating point, drawn by quasistatic and modes with --draw, in Python by plot()": "machine",
}


def _list(as_json: bool) -> None:
    from lambda_core import api

    cards = api.views()
    if as_json:
        typer.echo(json.dumps({"version": 1, "views": [card.model_dump(mode="json") for card in cards]}, indent=2))
        return
    for heading, subject in _HEADINGS.items():
        typer.echo(f"{heading}:")
        for card in cards:
            if card.subject == subject:
                typer.echo(f"  {card.name:<20} {card.title}")
                for option in card.options:
                    default = f" [{option.default}]" if option.default else ""
                    typer.echo(f"    {option.name + '=':<18} {option.description}{default}")
