"""Open, summarise and cite stored results."""

from __future__ import annotations

from os import PathLike
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from lambda_core.results.citation import Citation
    from lambda_core.results.reader import Result
    from lambda_core.results.side_by_side import SideBySide
    from lambda_core.results.summary import Summary


def result(path: str | PathLike[str], bearing: str | None = None) -> Result:
    """Open a result file: finished, growing, or left behind.

    Parameters
    ----------
    path : path-like
        The file, or a result.
    bearing : str, optional
        Look at this bearing of a machine; default: at the only one, or at the machine.

    Returns
    -------
    Result
        Reads from the file what it is asked for.

    Raises
    ------
    UsageError
        When the file does not exist, is not a result, or is damaged.
    """
    from lambda_core.results.reader import Result

    if isinstance(path, Result):
        return path if bearing is None else path.of_bearing(bearing)
    from lambda_core.runs.rerun import rerun

    return Result(path, bearing).rerun_by(rerun)


def side_by_side(paths: Sequence[str | PathLike[str]]) -> SideBySide:
    """Compare several results: differing options and numbers.

    Parameters
    ----------
    paths : sequence of path-like
        Two or more results or their files.

    Returns
    -------
    SideBySide
        Differing options as written, key numbers with units.

    Raises
    ------
    UsageError
        For fewer than two, or a file that is no result or holds no samples yet.
    """
    from lambda_core.results.side_by_side import side_by_side as put

    return put([result(path) for path in paths])


def summary(path: str | PathLike[str]) -> Summary:
    """Return the averages and the end state of a result.

    Parameters
    ----------
    path : path-like
        Result file, or a result.

    Returns
    -------
    Summary
        Numbers in the units of their names.

    Raises
    ------
    UsageError
        When the file is no result or holds no samples yet.
    """
    return result(path).summary()


def cite(path: str | PathLike[str]) -> Citation:
    """Return the references of laws, data and program used.

    Parameters
    ----------
    path : path-like
        Result file, or a result.

    Returns
    -------
    Citation
        Read from the file: it does not need the plugins that were used.

    Raises
    ------
    UsageError
        When the file does not exist, is not a result, or is damaged.
    """
    from lambda_core.results.citation import citation

    return citation(result(path))
