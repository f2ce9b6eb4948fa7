"""Write roles and quantities into pages.

The command is `python -m lambda_core.discovery.reference FILE.md ...`.
"""

from __future__ import annotations

import sys
from pathlib import Path

from lambda_core.domain.role import Role
from lambda_core.domain.roles import ROLES
from lambda_core.domain.units import UNITS


def roles_markdown() -> str:
    """Return every role with its arguments as Markdown."""
    return "\n".join(_role(role) for role in ROLES.values())


def _role(role: Role) -> str:
    lines = [
        f"### {role.name}",
        "",
        f"{role.summary[0].upper()}{role.summary[1:]}{'; elementwise' if role.elementwise else ''}. "
        f"Force elements: {', '.join(role.elements)}.",
        "",
        f"`{role.name}({', '.join(argument.name for argument in role.arguments)})`",
        "",
        "| argument | kind | meaning |",
        "|---|---|---|",
    ]
    for argument in role.arguments:
        kind = {"f": "float", "a": "array"}[argument.kind] + (", output" if argument.output else "")
        kind += ", optional" if argument.optional else ""
        meaning = "; ".join(role.outputs) if argument.meaning == "results" else argument.meaning
        lines.append(f"| `{argument.name}` | {kind} | {meaning} |")
    return "\n".join([*lines, ""])


def quantities_markdown() -> str:
    """Return the names and units of all quantities.

    :class:`lambda_core.plugins.Quantity` takes these names.
    """
    lines = [f"| `{name}` | {', '.join(units)} |" for name, units in UNITS.items()]
    return "\n".join(["| quantity | units |", "|---|---|", *lines, ""])


def renewed(page: str) -> str:
    """Return a page with renewed generated parts.

    They are between its marks.
    """
    for mark, made in (("roles", roles_markdown), ("quantities", quantities_markdown)):
        begin, end = f"<!-- {mark}:begin -->\n", f"<!-- {mark}:end -->\n"
        if begin in page:
            head, rest = page.split(begin)
            _, tail = rest.split(end)
            page = f"{head}{begin}\n{made()}\n{end}{tail}"
    return page


if __name__ == "__main__":
    for name in sys.argv[1:]:
        path = Path(name)
        path.write_text(renewed(path.read_text(encoding="utf-8")), encoding="utf-8")
