"""Draw the packages and their layers: ``python docs/tools/package_diagram.py``.

The layers are those that import-linter checks, from pyproject.toml. The picture is ``docs/images/packages.svg``.
"""

from __future__ import annotations

import tomllib
from pathlib import Path
from xml.sax.saxutils import escape

ROOT = Path(__file__).parents[2]
TARGET = ROOT / "docs" / "images" / "packages.svg"
TITLE = "Packages of lambda-bearing: each uses only packages below it"
MEANINGS = {
    "lambda_syla2026": "a paper as a plugin",
    "lambda_cli": "commands",
    "lambda_gui": "terminal program",
    "lambda_db": "catalogue",
    "lambda_plugins": "laws, methods, views",
}
WIDTH, HEIGHT, GAP, EDGE = 900, 40, 14, 20  # [px]: of the picture, of a box, between boxes, around all
PER_ROW = 6  # packages of the core
_STYLE = """<style>
text{font:14px Helvetica,Arial,sans-serif;fill:#222;text-anchor:middle} .name{font-weight:bold} .left{text-anchor:start}
.box{fill:#e4e7ec;stroke:#5a6472} .core{fill:#f6f7f9;stroke:#1b5e9c} .inner{fill:#dfeaf6;stroke:#1b5e9c}
.use{stroke:#222;stroke-width:1.5}
</style>
<defs><marker id="end" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" markerHeight="7" orient="auto">
<path d="M0 0L10 5L0 10z" fill="#222"/></marker></defs>"""


def layers() -> tuple[list[list[str]], list[str]]:
    """Return the rows of packages and the core's order.

    Both are from the top; packages of one row do not use each other.
    """
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"][
        "contracts"
    ]
    outer, core = [contract["layers"] for contract in contracts if contract["type"] == "layers"][:2]
    return [row.split(" | ") for row in outer], core


def drawn() -> str:
    """Return the picture as SVG."""
    outer, core = layers()
    lines, top = [], EDGE
    for row in outer[:-1]:
        wide = (WIDTH - 2 * EDGE - GAP * (len(row) - 1)) / len(row)
        for i, name in enumerate(row):
            text = f'<tspan class="name">{name}</tspan>: {escape(MEANINGS[name])}'
            lines.append(_box("box", EDGE + i * (wide + GAP), top, wide, text))
        lines.append(_arrow(top + HEIGHT))
        top += HEIGHT + 2 * GAP
    rows = [core[i : i + PER_ROW] for i in range(0, len(core), PER_ROW)]
    high = HEIGHT + len(rows) * (HEIGHT + GAP)
    lines.append(f'<rect class="core" x="{EDGE}" y="{top}" width="{WIDTH - 2 * EDGE}" height="{high}"/>')
    words = f'<tspan class="name">{outer[-1][0]}</tspan>: each uses only packages to its right and in the rows below'
    lines.append(f'<text class="left" x="{EDGE + GAP}" y="{top + 25}">{words}</text>')
    wide = (WIDTH - 2 * EDGE - GAP * (PER_ROW + 1)) / PER_ROW
    for j, row in enumerate(rows):
        for i, name in enumerate(row):
            below = top + HEIGHT + j * (HEIGHT + GAP)
            lines.append(_box("inner", EDGE + GAP + i * (wide + GAP), below, wide, escape(name.replace(" | ", ", "))))
    height = top + high + EDGE
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" height="{height}" '
        f'role="img" aria-label="{TITLE}">'
    )
    ground = f'<rect width="{WIDTH}" height="{height}" fill="#ffffff"/>'
    return "\n".join([head, f"<title>{TITLE}</title>", _STYLE, ground, *lines, "</svg>", ""])


def _box(kind: str, x: float, y: float, wide: float, text: str) -> str:
    rectangle = f'<rect class="{kind}" x="{x:.1f}" y="{y}" width="{wide:.1f}" height="{HEIGHT}" rx="4"/>'
    return f'{rectangle}<text x="{x + wide / 2.0:.1f}" y="{y + 25}">{text}</text>'


def _arrow(y: int) -> str:
    return f'<path class="use" d="M{WIDTH / 2:.0f} {y}V{y + 2 * GAP - 2}" marker-end="url(#end)"/>'


if __name__ == "__main__":
    TARGET.write_text(drawn(), encoding="utf-8")
