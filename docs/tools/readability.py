"""Measure the reading ease of pages: ``python docs/tools/readability.py FILE_OR_FOLDER ...``.

Prints words, words per sentence, syllables per word and Flesch's reading ease of each page, then the medians. Without
arguments it measures the Start and How-to pages. The same rules hold for Markdown, notebooks, reStructuredText and the
HTML sources of SQLite: code, tables, headings, formulas and numbers do not count, and code within a sentence counts as
one word of one syllable.
"""

from __future__ import annotations

import json
import re
import statistics
import sys
from dataclasses import dataclass
from pathlib import Path

DOCS = Path(__file__).parents[1]
LEAST = 100  # words of a page that is measured
SUFFIXES = (".md", ".rst", ".ipynb", ".in")
_WORD = re.compile(r"[A-Za-z][A-Za-z'’-]*")
_END = re.compile(r"[.!?]+(?=[\s\"')]|$)")
_BLOCK = re.compile(r"\n\s*\n|\n\s*(?:[-*+]|\d+\.)\s+")  # a paragraph or an item of a list
_ABBREVIATIONS = re.compile(r"\b(e\.g|i\.e|etc|vs|cf|Fig|eq|No)\.", re.IGNORECASE)
_SILENT = re.compile(
    r"(?<![aeiouy])(?<![^aeiouy]l)e$"  # file, but table
    r"|(?<![aeiouysxzcg])(?<![cs]h)(?<![^aeiouy]l)es$"  # files, but places, tables
    r"|(?<![aeiouytd])ed$|[gq]ue$"  # measured, but loaded; fatigue
)
_APART = re.compile(r"(?<![tcsg])i(?:a|o(?!n)|u)|(?<!p)eo|ea$|creat|scien|fluid")  # radial, geometry, area
_INLINE = "name"  # stands for code in a sentence


@dataclass(frozen=True)
class Ease:
    """Hold the counts of a text."""

    words: int
    sentences: int
    syllables: int

    @property
    def flesch(self) -> float:
        """Reading ease after Flesch.

        Flesch 1948, J. Appl. Psychol. 32, 221, doi 10.1037/h0057532 (0 to 100).
        """
        return 206.835 - 1.015 * self.words / self.sentences - 84.6 * self.syllables / self.words


def syllables(word: str) -> int:
    """Count the syllables of an English word.

    Groups of vowels, less a silent e, plus vowels that are apart.
    """
    word = re.sub("[^a-z]", "", word.lower())
    count = len(re.findall("[aeiouy]+", word)) + len(_APART.findall(word)) - bool(_SILENT.search(word))
    return max(count, 1)


def ease(text: str) -> Ease:
    """Count words, sentences and syllables of plain text."""
    words = sentences = spoken = 0
    for block in _BLOCK.split(_ABBREVIATIONS.sub(lambda m: m[1].replace(".", ""), text)):
        for sentence in _END.split(block):
            found = _WORD.findall(sentence)
            if len(found) >= 3:
                words, sentences = words + len(found), sentences + 1
                spoken += sum(map(syllables, found))
    return Ease(words, sentences, spoken)


def prose(path: Path) -> str:
    """Return the sentences of a page as plain text."""
    text = path.read_text(encoding="utf-8", errors="replace")
    if path.suffix == ".ipynb":
        cells = json.loads(text)["cells"]
        text = "\n\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")
    if path.suffix == ".in":
        return _html(text)
    text = re.sub(r"<!--.*?-->|^---\n.*?\n---\n", "", text, flags=re.S)
    text = re.sub(r"^([`~]{3,}).*?^\1[`~]*$", "\n", text, flags=re.S | re.M)  # code
    text = re.sub(r"^\.\. .*(?:\n(?:[ \t]+.*)?)*", "\n", text, flags=re.M)  # a directive of reStructuredText
    text = re.sub(r"^ {4,}(?![-*+\d ]).*$", "", text, flags=re.M) if path.suffix == ".md" else text
    text = re.sub(r"\$\$.*?\$\$|\\begin\{.*?\\end\{\w+\*?\}", " ", text, flags=re.S)
    text = re.sub(r"^\s*(?:#|\||!!!|\?\?\?|=+$|-+$|~+$|:{3}|>>>).*$", "\n", text, flags=re.M)
    text = re.sub(r"!\[[^\]]*\]\([^)]*\)|<[^>]+>", " ", text)
    text = re.sub(r"\$[^$\n]+\$|``[^`]+``|`[^`\n]+`_?_?", _INLINE, text)
    text = re.sub(r"\[([^\]]+)\](?:\([^)]*\)|\[[^\]]*\])", r"\1", text)
    return re.sub(r"https?://\S+|[*_]{1,3}", " ", text)


def _html(text: str) -> str:
    for name in ("tcl", "pre", "codeblock", "table", "script", "style", "title", "h[1-6]", "svg", "yyterm", "verbatim"):
        text = re.sub(rf"<({name})\b.*?</\1>", "\n\n", text, flags=re.S | re.I)
    text = re.sub(r"^(?:hd_\w+|CODE|PURE|\}|\{).*$", "", text, flags=re.M)
    text = re.sub(r"<(?:tt|code|yynonterm)\b[^>]*>.*?</(?:tt|code|yynonterm)>", _INLINE, text, flags=re.S | re.I)
    text = re.sub(r"</?(?:p|li|ul|ol|dl|dt|dd|br|div|blockquote|center)\b[^>]*>", "\n\n", text, flags=re.I)
    text = re.sub(r"\[[^\]|]*\|\s*([^\]]*)\]|\[([^\]]*)\]", lambda m: m[1] or m[2] or "", text)
    text = re.sub(r"<[^>]+>|&\w+;|https?://\S+", " ", text)
    return re.sub(r"\b\w+\(\)|\bsqlite3?_\w+|\b[A-Z]+_[A-Z_]+\b", _INLINE, text)


def start_and_how_to() -> list[Path]:
    """Return the pages of the parts Start and How-to."""
    text = (DOCS.parent / "mkdocs.yml").read_text(encoding="utf-8")
    part = text.partition("  - Start:\n")[2].partition("  - Theory:\n")[0]
    return [DOCS / name for name in re.findall(r"- (\S+\.md)$", part, re.M)]


def measured(paths: list[Path]) -> dict[str, Ease]:
    """Return the counts of every page.

    Of `LEAST` words or more.
    """
    found = {str(path): ease(prose(path)) for path in paths}
    return {name: one for name, one in found.items() if one.words >= LEAST}


def main(arguments: list[str]) -> int:
    """Print a line for each page and the medians."""
    paths = [Path(name) for name in arguments] or start_and_how_to()
    files = [
        each
        for path in paths
        for each in (sorted(p for p in path.rglob("*") if p.suffix in SUFFIXES) if path.is_dir() else [path])
    ]
    rows = [
        (one.flesch, one.words, one.words / one.sentences, one.syllables / one.words, name)
        for name, one in measured(files).items()
    ]
    for score, words, long, spoken, name in sorted(rows):
        print(f"{score:6.1f}  {words:6d} words  {long:5.1f} per sentence  {spoken:.2f} syllables  {name}")
    score, long, spoken = (statistics.median(row[i] for row in rows) for i in (0, 2, 3))
    print(f"median of {len(rows)} pages: {score:.1f}; {long:.1f} words per sentence, {spoken:.2f} syllables per word")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
