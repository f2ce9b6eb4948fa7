"""Make foreign text harmless in terminals and spreadsheets."""

from __future__ import annotations

# C0 and C1 controls drive a terminal, marks of direction reorder what is read; tab and line feed stay.
_CONTROLS = {code: f"\\x{code:02x}" for code in (*range(0x20), *range(0x7F, 0xA0)) if chr(code) not in "\t\n"}
_CONTROLS |= {code: f"\\u{code:04x}" for code in (*range(0x202A, 0x202F), *range(0x2066, 0x206A))}
_CONTROLS |= {
    code: f"\\u{code:04x}" for code in range(0xD800, 0xE000)
}  # bytes that were no UTF-8: nothing encodes them
_FORMULA = ("=", "+", "-", "@", "\t", "\r")  # how a cell begins that a spreadsheet computes


def printable(text: str) -> str:
    """Return a text with its control characters escaped.

    Bytes that are no text are escaped, too.
    """
    return text.translate(_CONTROLS)


def cell_text(text: str) -> str:
    """Return a text that a spreadsheet does not compute.

    It gets an apostrophe where a spreadsheet would compute it.
    """
    return f"'{text}" if text.startswith(_FORMULA) and not _is_number(text) else text


def from_cell(text: str) -> str:
    """Return what :func:`cell_text` was given."""
    return text[1:] if text.startswith("'") and text[1:].startswith(_FORMULA) else text


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
