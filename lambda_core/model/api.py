"""Check, describe and begin cases."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from lambda_core.domain.errors import CaseError, Problem, UsageError, unknown_name
from lambda_core.domain.lists import listed

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from lambda_core.case.case import Case
    from lambda_core.case.case_io import Source
    from lambda_core.case.draft import Draft
    from lambda_core.case.machine import MachineCase
    from lambda_core.catalogue.protocol import Catalogue
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.checks.describe import CaseReport, MachineReport
    from lambda_core.model.machine_model import MachineModel


def check(
    source: Source,
    overrides: Iterable[str] = (),
    *,
    folder: Path | None = None,
    catalogue: Catalogue | None = None,
    is_static: bool = False,
) -> BearingModel | MachineModel:
    """Read and resolve a case without running it.

    Parameters
    ----------
    source : str, Path, mapping or case
        File, built-in name, plain tables as they stand in a file, or a case.
    overrides : iterable of str
        Changes ``path=value``.
    folder : pathlib.Path, optional
        Where file names in plain tables are looked up; default: the working directory.
    catalogue : Catalogue, optional
        An open catalogue to look things up in; default: one is opened for this call.
    is_static : bool
        Whether only an equilibrium is wanted: a case in which nothing turns then needs no duration.

    Returns
    -------
    BearingModel or MachineModel
        Of one bearing, or of a machine; with its assumptions and the origin of every value.

    Raises
    ------
    CaseError
        With every mistake at once: those of the file itself and those that only the catalogue, the
        registry and the geometry can show.
    """
    from lambda_core.case.case_io import is_machine

    if is_machine(source):
        from lambda_core.model.resolve_machine import resolve_machine

        return resolve_machine(source, overrides, folder=folder, catalogue=catalogue)
    from lambda_core.model.checking import check_bearing

    return check_bearing(source, overrides, folder=folder, catalogue=catalogue, is_static=is_static)


def problems(source: Source) -> tuple[Problem, ...]:
    """Return every mistake of a case or of tables.

    Parameters
    ----------
    source : mapping or case
        Plain tables as they stand in a file, or a case; of one bearing or of a machine.

    Returns
    -------
    tuple of Problem
        Place and sentence of each; empty when the case is fine.
    """
    try:
        check(source)
    except CaseError as error:
        return error.problems
    return ()


def describe(model: BearingModel | MachineModel) -> CaseReport | MachineReport:
    """Describe a resolved model.

    The report of a bearing has all its values.

    Parameters
    ----------
    model : BearingModel or MachineModel
        From :func:`check`.

    Returns
    -------
    CaseReport or MachineReport
        ``text()`` are the lines for people.
    """
    from lambda_core.model.checks.describe import describe as report

    return report(model)


def init_case(
    name: str,
    start: str | None = None,
    path: str | Path | None = None,
    overwrite: bool = False,
    *,
    bearing: str | None = None,
    template: str | None = None,
    changes: Sequence[str] = (),
    as_machine: bool = False,
) -> Path:
    """Write a new case from another, a bearing or template.

    Parameters
    ----------
    name : str
        Letters, digits, dot, dash and underscore.
    start : str, optional
        Built-in case or case file to start from; default: 6319-cp10-1500.
    path : path-like, optional
        Default: NAME.toml in the working directory.
    overwrite : bool
        Replace a file that stands there.
    bearing : str, optional
        Instead of `start`: a bearing of the catalogue, "6319", "SKF 6208" or "SKF 6208-2RS1/C3".
    template : str, optional
        Instead of `start`: one of :func:`templates`. Three are shafts in two bearings: geared-shaft, motor-shaft and
        tapered-shaft; the others are one bearing with what is usual in such a machine, with `bearing` for another one.
    changes : sequence of str
        ``path=value``: what the new case has otherwise, with `bearing` or a `template` of one bearing.
    as_machine : bool
        Write the case of one bearing as a machine, see :func:`long_form`: it can have gears, discs, connections and a
        shaft of its own. Comments of the case are lost.

    Returns
    -------
    pathlib.Path
        The file.

    Raises
    ------
    UsageError
        When the file exists, cannot be written, there is no such case or template to start from, it is a machine
        already, or both a case and a bearing are given.
    CatalogueError
        When the bearing is unknown, or several makers have one of that name.
    CaseError
        When `name` cannot be a case's name.
    """
    from lambda_core.case.case_io import read_case
    from lambda_core.case.case_writer import new_case, write_new
    from lambda_core.model.machine_templates import SHAFTS

    target = Path(path) if path is not None else Path(f"{name}.toml")
    changes = listed(changes, "changes")
    if changes and ((bearing is None and template is None) or template in SHAFTS):
        raise UsageError(
            "load, speed, oil and temperature of a new case need a bearing: add --bearing or a template of one bearing"
        )
    if bearing is None and template is None:
        begin = start or "6319-cp10-1500"
        return (
            _new_machine(read_case(begin), name, target, overwrite)
            if as_machine
            else new_case(name, begin, target, overwrite)
        )
    if start is not None:
        other = "a bearing" if template is None else "a template"
        raise UsageError(f"a new case starts from a case or from {other}, not from both")
    if as_machine and template in SHAFTS:
        raise UsageError(_IS_MACHINE)
    text = _template_text(name, template, bearing, _given_radial(changes))
    if template in SHAFTS:
        import tomllib

        from lambda_core.case.case_writer import save_text
        from lambda_core.case.machine import MachineCase
        from lambda_core.case.written import validate
        from lambda_core.domain.files import check_new

        validate(MachineCase, tomllib.loads(text), f'new machine "{name}"')
        save_text(text, check_new(target, overwrite))
        return target
    from lambda_core.case.case_io import apply_overrides, bearing_case, toml_tables

    changed = apply_overrides(bearing_case(toml_tables(text, name)), changes)
    if any(change.partition("=")[0].strip() == "lubricant.name" for change in changes):
        _lubricant_known(changed)
    return _new_machine(changed, name, target, overwrite) if as_machine else write_new(changed, text, target, overwrite)


def _lubricant_known(changed: Case | MachineCase) -> None:
    """Refuse a new case whose lubricant no catalogue has."""
    from contextlib import closing

    name = changed.lubricant.name
    if name is not None:
        with closing(catalogue()) as opened:
            opened.lubricant(name)


_IS_MACHINE = "the case to start from is a machine already: leave out the option to write it as one"


def _new_machine(case: Case | MachineCase, name: str, target: Path, overwrite: bool) -> Path:
    """Write the case of one bearing as a machine.

    It is called `name`, with a comment about what to add.
    """
    from lambda_core.case.case import Case
    from lambda_core.case.case_writer import in_folder, save_text, tables_toml
    from lambda_core.domain.files import check_new
    from lambda_core.model.long_form import long_form

    if not isinstance(case, Case):
        raise UsageError(_IS_MACHINE)
    check_new(target, overwrite)
    form = long_form(in_folder(case.with_(name=name), target.resolve().parent))
    lines = [
        "A bearing on a rigid shaft. Add [gears.NAME], [discs.NAME], [loads.NAME] or [connections.NAME] with "
        'at = "bearing".',
        "Sections in [shaft] make the shaft elastic; places then count from its left end.",
        *(f"Not the same as in the case of one bearing: {difference}" for difference in form.differences),
    ]
    comments = "".join(f"# {line}\n" for line in lines)
    save_text(f"{comments}\n{tables_toml(form.tables)}", target)
    return target


def _given_radial(changes: Sequence[str]) -> float | None:
    """Return the radial load [N] among changes.

    None where there is none, or no load, which is refused later.
    """
    from lambda_core.domain.units import parse

    given = dict(change.partition("=")[::2] for change in changes)
    try:
        return parse(given["loads.radial"].strip(' "'), "force")
    except (KeyError, ValueError):
        return None


def _template_text(name: str, template: str | None, bearing: str | None, radial: float | None = None) -> str:
    """Return the commented case of a template.

    The case may be of one bearing or of a bearing in any machine, under a radial load [N].
    """
    from contextlib import closing

    from lambda_core.catalogue.designation import designated
    from lambda_core.catalogue.roller_designation import roller_designation
    from lambda_core.model.fresh_case import fresh_balls, fresh_case, fresh_rollers
    from lambda_core.model.machine_templates import GENERAL, MACHINES, SHAFTS, shaft_text

    if template in SHAFTS:
        if bearing is not None:
            raise UsageError(f"{template} has two bearings: leave out --bearing and change them in its file")
        return shaft_text(template, name)
    if template is not None and template not in MACHINES:
        raise UsageError(unknown_name("template", template, [*MACHINES, *SHAFTS]))
    kind = GENERAL if template is None else MACHINES[template]
    with closing(catalogue()) as opened:
        rollers = roller_designation(opened, bearing) if bearing is not None else None
        if rollers is not None:
            if template is not None:
                raise UsageError(f"templates of machines are for balls: leave out --template with {bearing}")
            return fresh_case(name, fresh_rollers(rollers), radial)
        return fresh_case(name, fresh_balls(*designated(opened, bearing or kind.bearing), kind), radial)


def templates() -> dict[str, str]:
    """Return the templates of cases with a few words each.

    Returns
    -------
    dict of str to str
        Names for :func:`init_case` and :func:`draft`.
    """
    from lambda_core.model.machine_templates import MACHINES, SHAFTS

    found = {name: f"{kind.words}: {kind.bearing} {kind.clearance}" for name, kind in MACHINES.items()}
    return found | SHAFTS


def draft(source: str | Path | None = None, *, template: str | None = None, is_machine: bool = False) -> Draft:
    """Open a case for editing, or begin a new one.

    Parameters
    ----------
    source : str or Path, optional
        File or built-in name; None for an empty draft.
    template : str, optional
        Instead of `source`: one of :func:`templates`.
    is_machine : bool
        An empty draft is that of a machine of several bearings; what a file holds decides for itself.

    Returns
    -------
    Draft
        Plain tables that may be wrong, with undo.

    Raises
    ------
    UsageError
        When there is no such file or built-in case.
    CaseError
        When the file is not TOML; any other mistake may stand in a draft.
    """
    from lambda_core.case.draft import draft_of, new_draft, open_draft

    if template is not None:
        return draft_of(_template_text(template, template, None), None)
    return new_draft(is_machine=is_machine) if source is None else open_draft(source)


def catalogue() -> Catalogue:
    """Open the catalogue of bearings, lubricants, materials and cages.

    Returns
    -------
    Catalogue
        The caller closes it.

    Raises
    ------
    PluginError
        When no installed plugin provides one.
    """
    from lambda_core.discovery.api import registry

    return registry().catalogue()
