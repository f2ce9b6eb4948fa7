"""Draw random valid cases for the round trips."""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st

from lambda_core.domain.units import UNITS

_numbers = st.floats(min_value=-1e6, max_value=1e6, allow_nan=False).map(lambda x: x + 0.0)
_positive = st.floats(min_value=1e-6, max_value=1e6)
_names = st.from_regex(r"[A-Za-z0-9][A-Za-z0-9._-]{0,12}", fullmatch=True)
_text = st.text(st.characters(codec="utf-8", exclude_categories=["Cs", "Cc"]), max_size=30)


def quantity(name: str, positive: bool = False) -> st.SearchStrategy[str]:
    """Return unit strings of one quantity.

    In any of its units.
    """
    numbers = _positive if positive or name == "temperature" else _numbers
    units = ["K"] if name == "temperature" else list(UNITS[name])
    return st.builds(lambda value, unit: f"{value!r} {unit}", numbers, st.sampled_from(units))


def signal(name: str) -> st.SearchStrategy[Any]:
    """Return every kind of time function that needs no file."""
    value = quantity(name)
    times = st.lists(st.floats(min_value=0.0, max_value=100.0), min_size=2, max_size=5, unique=True).map(sorted)
    simple = st.one_of(
        value,
        st.fixed_dictionaries({"kind": st.just("constant"), "value": value}),
        st.fixed_dictionaries(
            {"kind": st.just("ramp"), "start": value, "end": value, "end_time": quantity("time", True)}
        ),
        st.fixed_dictionaries(
            {"kind": st.just("harmonic"), "amplitude": value, "frequency": quantity("frequency", True)},
            optional={"phase": quantity("angle")},
        ),
        times.flatmap(
            lambda t: st.lists(value, min_size=len(t), max_size=len(t)).map(
                lambda v: {"kind": "table", "points": [[f"{a!r} s", b] for a, b in zip(t, v, strict=True)]}
            )
        ).flatmap(
            lambda table: st.fixed_dictionaries(
                {name: st.just(part) for name, part in table.items()},
                optional={"interpolation": st.sampled_from(["monotone", "spline"])},
            )
        ),
    )
    return simple | st.fixed_dictionaries({"kind": st.just("sum"), "terms": st.lists(simple, min_size=1, max_size=3)})


def _translation() -> st.SearchStrategy[Any]:
    return st.one_of(
        st.sampled_from(["free", "locked"]),
        st.fixed_dictionaries({"mode": st.just("prescribed"), "motion": signal("length")}),
        st.fixed_dictionaries({"stiffness": quantity("stiffness", True), "damping": quantity("damping", True)}),
    )


_section = st.fixed_dictionaries


def cases() -> st.SearchStrategy[dict[str, Any]]:
    """Return plain tables of valid cases.

    As a TOML file would hold them.
    """
    body = _section({}, optional={"mass": quantity("mass", True), "x": _translation(), "z": _translation()})
    return _section(
        {
            "name": _names,
            "bearing": _section(
                {"designation": _text.filter(bool)},
                optional={
                    "clearance": st.sampled_from(["CN", "C3", "geometry"]) | quantity("small_length"),
                    "geometry": _section({}, optional={"ball_diameter": quantity("length", True)}),
                    "fits": _section({}, optional={"shaft": st.sampled_from(["k5", "m6"])}),
                },
            ),
            "lubricant": _section(
                {"name": _text.filter(bool), "temperature": quantity("temperature")},
                optional={"oil_level": quantity("length")},
            ),
            "operation": _section({"speed": signal("rotational_speed")}),
        },
        optional={
            "description": _text,
            "assumptions": st.lists(_text, max_size=3),
            "loads": _section(
                {},
                optional={
                    "radial": signal("force"),
                    "moment_y": signal("moment"),
                    "cage": _section({}, optional={"force_x": signal("force")}),
                },
            ),
            "bodies": _section({}, optional={"inner_ring": body, "outer_ring": body}),
            "markers": st.dictionaries(_names, _section({"body": st.just("cage")}, optional={"x": quantity("length")})),
            "models": _section({}, optional={"traction": _names, "rheology": st.just("auto")}),
            "parameters": st.dictionaries(
                _names,
                st.dictionaries(_names, st.one_of(quantity("pressure"), st.integers(-9, 9), st.booleans(), _numbers)),
                max_size=2,
            ),
            "depth": _section({}, optional={"cage": st.booleans(), "strips": st.integers(3, 201)}),
            "solver": _section({}, optional={"tolerance": st.floats(1e-9, 0.1), "max_wall": quantity("time", True)}),
        },
    )
