"""Reference from the code: `python -m lambda_core.registry.reference docs/kernels.md` renews the roles in a page."""

from __future__ import annotations

import sys
from pathlib import Path

from lambda_core.registry.roles import ROLES, Role

BEGIN, END = "<!-- roles:begin -->\n", "<!-- roles:end -->\n"


def roles_markdown() -> str:
    """Return every role with its arguments as Markdown."""
    return "\n".join(_role(role) for role in ROLES.values())


def _role(role: Role) -> str:
    lines = [
        f"### {role.name}",
        "",
        f"{role.summary[0].upper()}{role.summary[1:]}{'; elementwise' if role.elementwise else ''}. "
        f"Carried by {', '.join(role.elements)}.",
        "",
        f"`{role.name}({', '.join(argument.name for argument in role.arguments)})`",
        "",
        "| argument | kind | meaning |",
        "|---|---|---|",
    ]
    for argument in role.arguments:
        kind = {"f": "float", "a": "array"}[argument.kind] + (", output" if argument.output else "")
        meaning = "; ".join(role.outputs) if argument.meaning == "results" else argument.meaning
        lines.append(f"| `{argument.name}` | {kind} | {meaning} |")
    return "\n".join([*lines, ""])


def renewed(page: str) -> str:
    """Return a page with the part between its marks replaced by the roles of today."""
    head, rest = page.split(BEGIN)
    _, tail = rest.split(END)
    return f"{head}{BEGIN}\n{roles_markdown()}\n{END}{tail}"


if __name__ == "__main__":
    for name in sys.argv[1:]:
        path = Path(name)
        path.write_text(renewed(path.read_text(encoding="utf-8")), encoding="utf-8")
