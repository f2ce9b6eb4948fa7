"""Install plugins that do what plugins should not do.

A package is put together from a few faults, installed for one process, and met by the commands that would load it.
Plugins are programs: they may do harm, but the program must name the faulty one.
"""

from __future__ import annotations

import os
import random
import sys
from collections.abc import Callable
from pathlib import Path

from tests.attacks.damage import CASE, Said, line, made_once, undisturbed_result
from tests.attacks.trial import attempt

_LIMIT = 120.0  # [s] of wall time
_HEAD = '"""A stranger."""\nimport numpy as np\nfrom lambda_core.plugins import Method, View, hookimpl, law\n\n'
_KERNEL = """
@law("damping", "guest", role_api=3, reference="none: made to misbehave")
def guest(delta, delta_dot, load, par, out):
{body}
    return {returned}
"""
_BODIES = (
    "    out[0] = 0.0",
    "    out[0] = np.nan",
    "    out[0] = -1e300",
    "    out[0] = 1.0 / (delta - delta)",
    "    out[7] = 1.0",
    "    out[0] = np.zeros(3)[0]",
    "    raise ValueError('no')",
    "    out[0] = par[12345]",
    "    print(delta)\n    out[0] = 0.0",
    "    out[0] = np.random.rand()",
    "    out[:] = delta_dot * 1e-3",
    "    assert delta < 0.0\n    out[0] = 0.0",
    "    out[0] = open('/etc/passwd').read()",
    "    out[0] = 1e-3 * delta_dot if delta < 1e-6 else np.nan",
    "    import os\n    out[0] = 0.0",
)
_RETURNED = ("1", "1", "1", "0", "17", "None", "delta", "'x'")
_METHOD = """
def evaluate(inputs):
    {body}


@hookimpl
def lambda_methods(register):
    register(Method("guest", "a guest", "none", evaluate, method_api=1))
"""
_VIEW = """
def data(subject, options):
    {body}


@hookimpl
def lambda_views(register):
    register(View("guest", "a guest", "result", data, view_api=1))
"""
_OTHERS = (
    "raise RuntimeError('at import')\n",
    "import sys\nsys.exit(3)\n",
    "import no_such_module\n",
    "print('words on stdout at import')\n",
    "def (:\n",
    "import os\nos.environ.clear()\n",
    "@hookimpl\ndef lambda_catalogue():\n    return 42\n",
    "@hookimpl\ndef lambda_catalogue(seed_folders):\n    return 42\n",
    "@hookimpl\ndef lambda_catalogue(seed_folders):\n    raise KeyError('rows')\n",
    "@hookimpl\ndef lambda_data(register):\n    register('/no/such/folder')\n",
    "@hookimpl\ndef lambda_data(register):\n    register(42)\n",
    "@hookimpl\ndef lambda_figure(data):\n    raise KeyError('figure')\n",
    "@hookimpl\ndef lambda_figure(data):\n    return object()\n",
    "@hookimpl\ndef lambda_no_such_hook():\n    return []\n",
    "@hookimpl\ndef lambda_methods(register, more):\n    register(1)\n",
    _METHOD.format(body="raise OSError('method')"),
    _METHOD.format(body="return 42"),
    _METHOD.format(body="raise SystemExit(9)"),
    _VIEW.format(body="return 42"),
    _VIEW.format(body="raise SystemExit(9)"),
    _VIEW.format(body="return subject['no-such-channel']"),
    "@hookimpl\ndef lambda_views(register):\n    register(View('film', 'twice', 'result', print, view_api=1))\n",
    '@law("no-such-role", "guest", role_api=3, reference="none")\ndef other(par, out):\n    return 1\n',
    '@law("damping", "cubic", role_api=3, reference="-")\ndef cubic(delta, delta_dot, load, par, out):\n    return 1\n',
    '@law("damping", "", role_api=3, reference="")\ndef nameless(delta, delta_dot, load, par, out):\n    return 1\n',
    "x = [0] * 10**7\n",
    "",
)
_COMMANDS: tuple[tuple[str, ...], ...] = (
    ("plugins", "list", "--json"),
    ("plugins", "check", "damping/guest"),
    ("check", CASE, "--set", "models.damping=guest"),
    ("quasistatic", CASE, "--set", "models.damping=guest"),
    ("run", CASE, "--set", "models.damping=guest", "--set", "solver.duration=0.2 ms", "--max-wall", "5 s", "--json"),
    ("quasistatic", CASE, "--json"),
    ("compare", CASE),
    ("view", "out.h5", "guest", "--out", "pictures"),
    ("db", "search", "6208"),
)


def plugin(seed: int, number: int, folder: Path) -> Said:
    """Load a faulty package in a command.

    It is installed for one process.
    """
    pick = random.Random(seed * 1_000_003 + number)
    name = f"guest_{number}"
    _install(folder / "site", name, _source(pick))
    arguments = pick.choice(_COMMANDS)
    if arguments[0] == "view":
        (folder / "out.h5").write_bytes(undisturbed_result(folder).read_bytes())
    path = os.pathsep.join([str(folder / "site"), *filter(None, [os.environ.get("PYTHONPATH")])])
    outcome = attempt(arguments, folder, _LIMIT, {"PYTHONPATH": path}, _seen(folder / "site"))
    innocent = arguments == ("quasistatic", CASE, "--json")
    if innocent and outcome.good and not (outcome.verdict == "refused" and name in outcome.said):
        before = made_once(folder, "said", lambda place: attempt(arguments, place, _LIMIT))
        if outcome.verdict != "fine" or (folder / "stdout").read_bytes() != (before / "stdout").read_bytes():
            outcome = outcome.but("different", "a case that has nothing to do with the plugin ends otherwise")
    return outcome, line(arguments), {}


def _source(pick: random.Random) -> str:
    """Return a module with a fault.

    One faulty law, something else that is faulty, or both.
    """
    kernel = _KERNEL.format(body=pick.choice(_BODIES), returned=pick.choice(_RETURNED))
    other = pick.choice(_OTHERS)
    return _HEAD + pick.choice((kernel, other + kernel, kernel + "\n\n" + other))


def _install(site: Path, name: str, source: str) -> None:
    record = site / f"{name}-1.0.dist-info"
    record.mkdir(parents=True)
    (site / f"{name}.py").write_text(source, encoding="utf-8")
    (record / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n", encoding="utf-8")
    (record / "entry_points.txt").write_text(f"[lambda_bearing.plugins]\nmain = {name}\n", encoding="utf-8")


def _seen(site: Path) -> Callable[[], None]:
    """Return a child's first function.

    It forgets what is installed, and sees one package more.
    """

    def before() -> None:
        import importlib

        from lambda_core.discovery.manager import registry

        sys.path.insert(0, str(site))
        importlib.invalidate_caches()
        registry.cache_clear()

    return before
