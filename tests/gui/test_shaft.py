"""Test shafts in the builder.

From nothing by keys alone, files with comments, mistakes, what the shaft does.
"""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest
from driving import LARGE, SMALL, builder, checked, focused_place, go_to, move_to, screen_text, wait_for, write
from lambda_gui.app import BuilderApp
from lambda_gui.builder import BuilderScreen
from lambda_gui.derived import Derived
from lambda_gui.entries import rename
from lambda_gui.helper import Estimator
from lambda_gui.machine_drawing import drawn_machine
from lambda_gui.nodes import Node
from lambda_gui.outline import outline, section_names
from lambda_gui.tree import ModelTree
from textual.pilot import Pilot

from lambda_core import api
from lambda_core.case.draft import draft_of
from lambda_core.case.machine import MachineCase
from lambda_core.domain.option_tree import option_paths
from lambda_core.domain.roles import ROLES
from lambda_core.model.machine_templates import shaft_text
from lambda_core.results.rating import Rating
from lambda_core.results.verdict import Verdict

NAMES = {
    "shaft.sections": ("0",),
    "bearings": ("b",),
    "gears": ("g",),
    "discs": ("d",),
    "loads": ("l",),
    "connections": ("s",),
    "bodies": ("k",),
    "markers": ("m",),
}


def bearing_on_shaft(name: str, position: float) -> api.BearingEquilibrium:
    """Return a possible answer for a bearing.

    Solving it would take compiled code.
    """
    return api.BearingEquilibrium(
        name=name, title="6208", position_mm=position, force_N=[213.0, 416.0, 286.0], moment_Nm=[0.0, 0.0],
        radial_load_N=505.0, axial_load_N=-213.0, displacement_um=[1.0, 2.0, 3.0], misalignment_mrad=[0.1, 0.2],
        outer_ring_um=[0.0, 0.0, 0.0], clearance_um=13.0, loaded_elements=9, max_load_N=236.0, max_load_ring="inner",
        max_pressure_GPa=1.1, contact_angle_deg=[10.0, 13.0], friction_breakdown_Nmm={}, orbit_speed_ratio=0.4,
        rating=Rating(equivalent_load_N=600.0, basic_life_h=4e5, reference_life_h=2e6, viscosity_ratio=2.0,
                      static_safety=30.0), shoulders=[], film_parameter=[2.0, 3.0], friction_torque_Nmm=61.0,
        power_loss_W=19.0, film_um=[0.4, 0.6], stiffness=[[1e7] * 6] * 6,
        contacts=[], warnings=[], verdict=Verdict(met=True, sentence="all limits are met", margins=[]),
    )  # fmt: skip


def report() -> api.Estimate:
    """Return a possible answer for a shaft.

    It is the one that `init --template geared-shaft` writes.
    """
    mode = {"frequency_Hz": 600.0, "direction": 1.0, "kind": "bending", "bodies_share": 0.0, "damping_ratio": 0.0}
    equilibrium = api.MachineEquilibrium(
        case="box", speed_rpm=3000.0,
        bearings={name: bearing_on_shaft(name, at) for name, at in (("left", 21.0), ("right", 148.0))},
        gears={"wheel": [796.0, 300.0, 213.0]}, system_life_h=4e5, friction_torque_Nmm=122.0, drive_torque_Nm=-47.8,
        shaft_mass_kg=4.4, positions_mm=[0.0, 85.0, 170.0], deflection_um=[[0.0, 0.0, -1.0]] * 2 + [[0.0, -15.0, -2.0]],
        slope_mrad=[[0.0, 0.0]] * 3, cut_positions_mm=[0.0, 85.0, 170.0], shear_N=[[0.0, 0.0]] * 3,
        bending_moment_Nm=[[0.0, 0.0], [28.0, 3.0], [0.0, 0.0]], torque_Nm=[0.0] * 3,
        iterations=5, residual=0.0, assumptions=[],
    )  # fmt: skip
    modes = api.MachineModes(
        case="box", speed_rpm=3000.0, bearings={},
        critical_speeds=[{"speed_rpm": 40012.0, "direction": 0.0, "kind": "bending", "bodies_share": 0.0}],
        modes=[mode], campbell=[{"speed_rpm": speed, "modes": [mode]} for speed in (0.0, 6000.0)], assumptions=[],
    )  # fmt: skip
    return api.Estimate(equilibrium=equilibrium, modes=modes, simulated_s=0.25, processor_s=0.3, basis="a trial")


@pytest.fixture
def answered(monkeypatch: pytest.MonkeyPatch) -> None:
    """Answer at once, in place of the helper process."""

    async def ask(self: Estimator, tables: dict[str, Any], folder: Path | None) -> None:
        self._tell(report(), "")

    monkeypatch.setattr(Estimator, "ask", ask)


def nodes() -> list[Node]:
    return [node for top in outline(MachineCase, NAMES) for node in top.walk()]


def test_every_option_of_a_shaft_has_exactly_one_place() -> None:
    fields = [keys for node in nodes() for group in node.groups for keys in group.fields]
    fields += [keys for node in nodes() if node.role for keys in node.law_places]
    assert len(fields) == len(set(fields))
    shown = {".".join(keys) for keys in fields}
    shown |= {".".join(keys) for node in nodes() for keys in node.in_file}
    shown |= {".".join(node.table) for node in nodes() if node.kind == "named"}
    named = {name for name in NAMES if "." not in name}
    for path in option_paths(MachineCase):
        if path in (*named, "parameters"):
            continue
        path = path.replace("sections.", "sections.0.")
        assert path in shown or path.rpartition(".")[0] in shown, path
    for section, (name,) in NAMES.items():
        table = MachineCase.model_fields[section].annotation.__args__[1] if section in named else None  # type: ignore
        for path in option_paths(table) if table is not None else ():
            if path.startswith("forces.") and (path.endswith("parameters") or not has_role(path)):
                continue  # parameters stand under their role
            place = f"{section}.{name}.{path}"  # a material is one option, its properties are none
            assert place in shown or place.rpartition(".")[0] in shown, path


def has_role(path: str) -> bool:
    """Tell whether a force element has a role."""
    _, element, _, *role = path.split(".")
    return not role or element in ROLES[role[0]].elements


def has_a_shaft(pilot: Pilot[None]) -> bool:
    """Tell whether the builder shows the case of a shaft."""
    screen = pilot.app.screen
    return isinstance(screen, BuilderScreen) and "shaft" in screen.draft.root.model_fields


async def from_tree(pilot: Pilot[None], key: str, place: tuple[str, ...]) -> None:
    """Add a table from the tree.

    Wait for its form.
    """
    await pilot.press("escape")
    await move_to(pilot, key)
    await pilot.press("plus")
    await wait_for(pilot, lambda: focused_place(pilot)[:-1] == place)


@pytest.mark.full
async def test_a_shaft_from_nothing_by_keys(work_folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Build a shaft by keys on a slow machine.

    The cursor rests on the first node until the new one is reached.
    """
    at_once = ModelTree._move_to
    async with BuilderApp().run_test(size=SMALL) as pilot:
        await wait_for(pilot, lambda: "new machine" in screen_text(pilot.app))  # type: ignore[arg-type]
        await pilot.press(*"new", "enter")
        await wait_for(pilot, lambda: has_a_shaft(pilot))
        with monkeypatch.context() as slow:
            slow.setattr(ModelTree, "_move_to", lambda self, key: self.set_timer(0.3, lambda: at_once(self, key)))
            await from_tree(pilot, "shaft", ("shaft", "sections", "0"))
        assert builder(pilot).draft.get("shaft", "sections") == [{}]
        await pilot.press(*"170", "enter", *"40", "enter", "enter", "enter")  # the last one adds a piece
        await wait_for(pilot, lambda: focused_place(pilot)[:-1] == ("shaft", "sections", "1"))
        await pilot.press(*"30", "enter", *"35", "enter")
        for name, place in (("left", "20"), ("right", "150")):
            await from_tree(pilot, "bearings", ("bearings", name))
            await write(pilot, "6208")
            await pilot.press("enter", *place, "enter")
        draft = builder(pilot).draft
        await checked(pilot)
        assert {problem.where for problem in builder(pilot).check.problems} == {
            "operation.speed",
            "lubricant.name",
            "lubricant.temperature",
            "bearings.left.maker",
            "bearings.right.maker",
        }
        for path, text in {"bearings.left.maker": "SKF", "bearings.right.maker": "SKF", "operation.speed": "3000 rpm",
                           "lubricant.name": "FVA3", "lubricant.temperature": "70 degC"}.items():  # fmt: skip
            draft.set(*path.split("."), value=text)
        await checked(pilot)
        assert builder(pilot).check.machine is not None
        pilot.app.screen.query_one(ModelTree).focus()
        await move_to(pilot, "shaft.sections.1")
        await pilot.press("delete")
        assert len(draft.get("shaft", "sections")) == 1
        await pilot.press("ctrl+z")
        assert draft.get("shaft", "sections") == [
            {"length": "170 mm", "diameter": "40 mm"},
            {"length": "30 mm", "diameter": "35 mm"},
        ]
        draft.save(work_folder / "mine.toml")
    assert len(api.check(work_folder / "mine.toml").bearings) == 2


@pytest.mark.usefixtures("answered")
async def test_a_defect_of_one_bearing_and_the_number_of_warnings(work_folder: Path) -> None:
    """Show the defect of one contact of one bearing."""
    (node,) = (node for node in nodes() if node.key == "bearings.b.forces.ball_outer.surface")
    assert node.heading == "b · Outer raceway · surface"
    api.init_case("box", template="geared-shaft")
    laws = [item.name for item in api.plugins().items if item.kind == "model" and item.role == "surface"]
    async with BuilderApp("box.toml").run_test(size=LARGE) as pilot:
        await checked(pilot)
        await go_to(pilot, "bearings.right.forces.ball_outer.models.surface")
        await pilot.press("enter", *["down"] * (1 + laws.index("defect")), "enter")
        await checked(pilot)
        draft = builder(pilot).draft
        assert draft.get("bearings", "right", "forces") == {"ball_outer": {"models": {"surface": "defect"}}}
        assert draft.get("bearings", "left", "forces") is None
        assert not builder(pilot).check.problems
        # the head counts the warnings of the equilibrium, too
        screen = builder(pilot)
        screen.draft.set("bearings", "left", "designation", value="SKF 6209")  # a bore of 45 mm on 40 mm
        await checked(pilot)
        derived = pilot.app.screen.query_one(Derived)
        await wait_for(pilot, lambda: derived.is_current)
        before = len(derived.warnings())
        assert before > 0
        await wait_for(pilot, lambda: f"▲ {before} warning" in head(pilot))
        found = report()
        found.equilibrium.bearings["left"].warnings.extend(["too much", "far too much"])
        screen.show_estimate(found, "")
        assert len(derived.warnings()) == before + 2
        await wait_for(pilot, lambda: f"▲ {before + 2} warnings  F8" in head(pilot))
        await wait_for(pilot, lambda: "▲ left: far too much" in screen_text(pilot.app))  # type: ignore[arg-type]
        await pilot.resize_terminal(*SMALL)
        await wait_for(pilot, lambda: f"▲ {before + 2} warnings: F8" in screen_text(pilot.app))  # type: ignore[arg-type]
        assert len(str(derived.visual).splitlines()) <= derived.size.height


@pytest.mark.full
@pytest.mark.usefixtures("answered")
async def test_a_shaft_file_keeps_its_comments_and_says_what_it_does(work_folder: Path) -> None:
    path = api.init_case("box", template="geared-shaft")
    before = path.read_text(encoding="utf-8").splitlines()
    async with BuilderApp("box.toml").run_test(size=LARGE) as pilot:
        await checked(pilot)
        await wait_for(pilot, lambda: pilot.app.screen.query_one(Derived).is_current)
        shown = screen_text(pilot.app)  # type: ignore[arg-type]
        for words in ("⊢left⊣", "~right~", "wheel", "radial", "bends", "critical", "⌀ 48 mm · x 110 mm"):
            assert words in shown, words
        screen = builder(pilot)
        screen.go_to(("bearings", "right", "at"))
        await wait_for(pilot, lambda: focused_place(pilot) == ("bearings", "right", "at"))
        await pilot.press("ctrl+a", *"190", "enter")
        await checked(pilot)
        assert "is not on the shaft: 0 mm" in screen_text(pilot.app)  # type: ignore[arg-type]
        assert pilot.app.screen.query_one(ModelTree).wrong_nodes() == ["bearings.right"]
        screen.draft.set("bearings", "right", "at", value="149 mm")
        await checked(pilot)
        assert not screen.check.problems
        await pilot.press("ctrl+s")
        await wait_for(pilot, lambda: not screen.draft.is_changed())
    after = path.read_text(encoding="utf-8").splitlines()
    assert [line for line in after if line not in before] == ['at = "149 mm"']


def head(pilot: Pilot[None]) -> str:
    """Return the line over the model."""
    return screen_text(pilot.app).splitlines()[0]  # type: ignore[arg-type]


def test_pieces_of_a_list_come_and_go_with_their_comments() -> None:
    text = '[shaft]\n[[shaft.sections]]\nlength = "1 mm" # one\n\n[[shaft.sections]]\nlength = "2 mm" # two\n'
    from lambda_core.case.draft import draft_of

    draft = draft_of(text, None)
    assert draft.is_machine_case
    one, two = draft.get("shaft", "sections")
    draft.set("shaft", "sections", value=[one, {"length": "3 mm"}, two])
    draft.set("shaft", "sections", "2", "length", value="4 mm")
    assert "# one" in draft.text()
    assert "# two" in draft.text()
    assert tomllib.loads(draft.text()) == draft.tables
    draft.seal()
    draft.set("shaft", "sections", value=[two])
    assert tomllib.loads(draft.text()) == draft.tables
    while draft.undo():
        pass
    assert draft.text() == text


def test_the_schema_of_shafts_knows_every_table() -> None:
    assert set(api.schema()["$defs"]["MachineCase"]["properties"]) == set(MachineCase.model_fields)


HOUSED = """
[bodies.box]
x = "85 mm"
length = "160 mm"
width = "120 mm"
height = "80 mm"

[markers.foot]
body = "box"
x = "10 mm"

[connections.mount]
at = "foot"
z = "40 N/um"

[connections.seal]
at = "120 mm"
to = "box"
z = "1 N/um"
"""


def test_a_housing_is_drawn_with_its_springs() -> None:
    case = tomllib.loads(shaft_text("geared-shaft", "box") + HOUSED)
    case["bearings"]["left"]["outer"] = "box"
    names = [
        "primary",
        "success",
        "secondary",
        "accent",
        "background",
        "foreground",
        "border-blurred",
        "warning",
        "surface",
    ]
    drawn = drawn_machine(api.check(case), None, 100, 22, dict.fromkeys(names, "#808080")).plain
    for word in ("[box]", "⌇seal", "⌇mount", "⊢left⊣"):
        assert word in drawn


def test_a_new_name_goes_wherever_it_is_named(tmp_path: Path) -> None:
    """Rename bodies and markers wherever they are named.

    A body in markers, springs and bearings, a marker in springs; one undo each.
    """
    text = shaft_text("geared-shaft", "box").replace("# outer = ", "outer = ") + HOUSED
    draft = draft_of(text, tmp_path / "box.toml")
    found = [m for top in outline(draft.root, section_names(draft)) for m in top.walk()]
    (node,) = (n for n in found if n.key == "bodies.box")
    assert rename(node, draft, "case") == ("bodies", "case")
    assert (draft.get("markers", "foot", "body"), draft.get("connections", "seal", "to")) == ("case", "case")
    assert draft.get("bearings", "right", "outer") == "case"
    found = [m for top in outline(draft.root, section_names(draft)) for m in top.walk()]
    (node,) = (n for n in found if n.key == "markers.foot")
    rename(node, draft, "paw")
    assert draft.get("connections", "mount", "at") == "paw"
    assert "# A flexible-mounted housing" in draft.text()
    assert api.check(draft.tables).bodies[0].name == "case"


async def test_a_single_bearing_without_a_shaft_stands_on_a_rigid_one(work_folder: Path) -> None:
    Path("alone.toml").write_text(
        'name = "alone"\n[bearings.b]\ndesignation = "SKF 6208"\nat = "0 mm"\n[loads.l]\nat = "b"\nradial = "2 kN"\n'
        '[operation]\nspeed = "1300 rpm"\n[lubricant]\nname = "FVA3"\ntemperature = "60 degC"\n',
        encoding="utf-8",
    )
    async with BuilderApp("alone.toml").run_test(size=LARGE) as pilot:
        await checked(pilot)
        assert builder(pilot).check.problems == ()
        assert any(line.split()[:2] == ["Shaft", "rigid"] for line in screen_text(pilot.app).splitlines())  # type: ignore[arg-type]
