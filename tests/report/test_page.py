"""Test the pages of reports."""

from __future__ import annotations

import re
from concurrent.futures import Executor, Future
from html.parser import HTMLParser
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import pytest

from lambda_core import api
from lambda_core.analysis.rotor.machine_equilibrium import MachineEquilibrium
from lambda_core.discovery.manager import registry
from lambda_core.domain.errors import UsageError
from lambda_core.domain.number_text import percent, plus_minus
from lambda_core.domain.unit_systems import SI
from lambda_core.export.report import chapters, pdf
from lambda_core.export.report.gallery import stem_of
from lambda_core.export.report.page import APPENDICES
from lambda_core.model.machine_templates import shaft_text

if TYPE_CHECKING:
    from lambda_core.results.reader import Result

_VOID = {"meta", "link", "br", "hr", "img", "input"}


class Page(HTMLParser):
    """Text, tags and addresses of a page.

    Fails on tags that do not close.
    """

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.open: list[str] = []
        self.words: list[str] = []
        self.addresses: list[str] = []
        self.tags: list[str] = []
        self.feed(text.replace("<wbr>", ""))
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.addresses += [value for name, value in attrs if name in ("src", "href", "xlink:href") and value]
        if tag not in _VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.addresses += [value for name, value in attrs if name in ("src", "href", "xlink:href") and value]

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open and self.open[-1] not in ("style", "script"):
            self.words.append(data)

    @property
    def text(self) -> str:
        return " ".join(" ".join(self.words).split())


@pytest.fixture(scope="module")
def page(radial_run: Result, tmp_path_factory: pytest.TempPathFactory) -> Page:
    path = api.report(radial_run.path, tmp_path_factory.mktemp("report") / "page.html", appendices=["all"])
    return Page(path.read_text(encoding="utf-8"))


def test_the_page_needs_nothing_from_outside(page: Page) -> None:
    assert all(address.startswith(("#", "data:")) for address in page.addresses)
    assert "script" not in page.tags
    assert "link" not in page.tags
    targets = {address[1:] for address in page.addresses if address.startswith("#")}
    assert {"results", "views", "inputs", "assumptions", "laws", "references", "origin"} <= targets


def test_the_page_says_what_was_found(page: Page, radial_run: Result) -> None:
    summary = radial_run.summary()
    assert f"{plus_minus(summary.friction_torque_Nmm, summary.friction_torque_ci_Nmm)} N mm" in page.text
    first = page.text[: page.text.index("friction torque by mechanism")]  # what an engineer looks for stands first
    for words in (
        "within all limits", "of 4.2 GPa", "power loss", "90 % model band", "Lnmh, ISO 281", "L10rh, ISO/TS 16281",
        "static safety", "kappa", "SKF's catalogue", "smallest film",
    ):  # fmt: skip
        assert words in first
    assert page.tags.index("svg") < page.tags.index("table")
    assert "not converged" not in page.text
    for contact in summary.contacts:
        if contact.load_N < 0.011 * max(one.load_N for one in summary.contacts):
            continue
        assert f"{contact.load_N:.1f}" in page.text


def test_every_view_is_on_the_page(page: Page) -> None:
    views = sum(view.subject == "result" and view.offered is None for view in registry().views.values())
    assert page.tags.count("svg") == views + 2  # section of the bearing, loads of its balls
    assert "Not shown" not in page.text


def test_every_input_has_its_source_and_every_assumption_is_there(page: Page, radial_run: Result) -> None:
    for assumption in radial_run.assumptions:
        assert " ".join(assumption.split()) in page.text
    for value in radial_run.values:
        section, _, name = value.path.partition(".")
        name = name.partition(".")[2] if section in ("materials", "forces", "bodies") else name
        assert name in page.text
        assert " ".join(value.source.split()) in page.text


def test_exactly_the_laws_used_are_cited(page: Page, radial_run: Result) -> None:
    cited = api.cite(radial_run.path)
    for law in cited.laws:
        assert " ".join(law.reference.split()) in page.text
    used = {row["model"] for row in radial_run.laws}
    assert "newtonian" not in used
    assert "newtonian" not in page.text


def test_the_head_and_the_appendices_are_chosen(radial_run: Result, tmp_path: Path) -> None:
    path = api.report(
        radial_run, tmp_path / "short.html", project="Fan", author="E. Engineer", appendices=["assumptions"]
    )
    short = Page(path.read_text(encoding="utf-8"))
    assert "Fan E. Engineer 20" in short.text
    assert short.tags.count("svg") == 2  # section of the bearing, loads of its balls
    chapters = {f"#{name}" for name in ("results", *APPENDICES)}
    assert chapters.intersection(short.addresses) == {"#results", "#assumptions"}
    assert radial_run.assumptions[0].split()[0] in short.text
    assert "References" not in short.words
    with pytest.raises(UsageError, match='"view" is not a known appendix; nearest: views'):
        api.report(radial_run, tmp_path / "x.html", appendices=["view"])


def test_the_page_is_in_units_of_the_united_states(radial_run: Result, tmp_path: Path) -> None:
    path = api.report(radial_run, tmp_path / "us.html", appendices=["tables", "inputs"], units="us")
    found = Page(path.read_text(encoding="utf-8"))
    torque = radial_run.summary().friction_torque_Nmm
    assert torque is not None
    assert f"{torque / 112.985:.1f}" in found.text  # 1 lbf in = 112.985 N mm
    assert "lbf in" in found.text
    assert "load lbf" in found.text
    assert "degF" in found.text
    results = found.text[: found.text.index("bearing.designation")]
    assert not re.search(r"\d (N mm|kN|um|degC|W|GPa)\b", results)
    with pytest.raises(UsageError, match='"uk" is not a known system of units'):
        api.report(radial_run, tmp_path / "uk.html", units="uk")


def test_without_a_printer_a_pdf_is_refused_before_the_work(
    radial_run: Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pdf, "_browser", lambda: None)
    monkeypatch.setattr(pdf, "find_spec", lambda name: None)
    with pytest.raises(UsageError, match=r"browser on PATH \(chromium, .*neither is here: .*lambda-bearing\[pdf\]"):
        api.report(radial_run, tmp_path / "x.pdf")
    assert not (tmp_path / "x.pdf").exists()


@pytest.mark.skipif(pdf._browser() is None, reason="needs a browser on PATH")
def test_a_browser_prints_the_page(radial_run: Result, tmp_path: Path) -> None:
    path = api.report(radial_run, tmp_path / "page.pdf", project="Fan", appendices=[])
    assert path.read_bytes().startswith(b"%PDF-")
    assert b"/Type /Page" in path.read_bytes()
    assert sorted(tmp_path.iterdir()) == [path]


def test_a_page_is_not_overwritten_unasked(radial_run: Result, tmp_path: Path) -> None:
    path = tmp_path / "page.html"
    path.write_text("mine")
    with pytest.raises(UsageError, match="exists"):
        api.report(radial_run.path, path)
    assert path.read_text() == "mine"
    with pytest.raises(UsageError, match="does not exist"):
        api.report(tmp_path / "nothing.h5", tmp_path / "other.html")
    with pytest.raises(UsageError, match="cannot write"):
        api.report(radial_run.path, tmp_path / "no" / "folder.html")


class Inline(Executor):
    """Does every task at once, in this process."""

    def submit(self, function: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        future.set_result(function(*args, **kwargs))
        return future


@pytest.mark.full
def test_a_study_has_a_page_too(tmp_path: Path) -> None:
    study = {
        "name": "two-by-two",
        "title": "Torque <over> speed & load",
        "case": "6319-cp10-1500",
        "parameters": [
            {"path": "operation.speed", "values": ["500 rpm", "3000 rpm"]},
            {"path": "loads.radial", "values": ["16 kN", "24.6 kN"]},
        ],
    }
    api.study_run(study, tmp_path / "study", executor=Inline())
    with pytest.raises(api.UsageError, match='is a study, whose numbers name their bearing: leave out bearing "left"'):
        api.report(tmp_path / "study", bearing="left")
    text = api.report(tmp_path / "study", tmp_path / "study.html").read_text(encoding="utf-8")
    found = Page(text)
    assert "Torque <over> speed & load" in found.text  # escaped in the file
    assert "complete" in found.text
    for row in api.study_table(tmp_path / "study").rows():
        assert f"{row['friction_torque_Nmm']:.4g}" in found.text.replace("\N{NARROW NO-BREAK SPACE}", "").replace(
            " ", ""
        )
    assert re.search(r"kind|operation\.speed", found.text)
    assert found.tags.count("svg") >= 3


def test_a_report_of_one_bearing_has_four_pages(radial_run: Result, tmp_path: Path) -> None:
    page = api.report(radial_run, tmp_path / "four.html").read_text(encoding="utf-8")
    assert page.count('<section class="sheet">') + 1 == 4
    for words in ("Loads, lives, losses", "<h2>Inputs", "<h2>Limits", "What was assumed"):
        assert words in page
    assert "code of" not in page  # hashes stand in the appendix


@pytest.mark.full
@pytest.mark.skipif(pdf._browser() is None, reason="needs a browser on PATH")
def test_a_report_of_two_bearings_prints_on_four_pages(tmp_path: Path) -> None:
    case = tmp_path / "box.toml"
    case.write_text(shaft_text("geared-shaft", "box"), encoding="utf-8")
    run = api.run(case, ["solver.duration=0.2 ms"], out=tmp_path / "box.h5")
    printed = api.report(run, tmp_path / "box.pdf").read_bytes()
    assert len(re.findall(rb"/Type /Page\b", printed)) == 4


@pytest.mark.parametrize(
    ("bearing", "words"),
    [("SKF NU 208 ECP", "cylindrical NU roller bearing"), ("SKF 32208", "tapered roller bearing")],
)
def test_the_report_of_rollers_draws_and_names_rollers(bearing: str, words: str, tmp_path: Path) -> None:
    """Name no balls in a report of rollers.

    The sketch showed a deep groove ball bearing with as many balls.
    """
    case = api.init_case("rollers", path=tmp_path / "rollers.toml", bearing=bearing, changes=["loads.radial=5 kN"])
    text = api.report(case, tmp_path / "rollers.html", appendices=[]).read_text(encoding="utf-8")
    sheets, _, inputs = text.partition("<body")[2].partition("<h2>Inputs")
    assert words in sheets
    assert "bearing.ball_diameter" not in inputs
    assert re.search(r"bearing.bore_diameter</td><td>40 mm</td><td>SKF general catalogue", inputs)  # not of the case
    assert not re.search(r"<dd>[–-] *<", sheets)  # nothing that no catalogue gives
    assert "load of every roller" in sheets
    assert not re.search(r"\bballs?\b|deep groove", sheets)


def test_several_results_stand_in_one_document(radial_run: Result, tmp_path: Path) -> None:
    page = Page(api.report([radial_run, radial_run.path], tmp_path / "two.html").read_text(encoding="utf-8"))
    assert page.text.count("Loads, lives, losses") == 2
    assert page.text.index("friction torque N mm") < page.text.index("Loads, lives, losses")


def test_each_bearing_of_a_run_is_reported_with_its_own_geometry(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(chapters, "_geometry", lambda model: model)
    monkeypatch.setattr(chapters, "_carried", lambda _: ())
    monkeypatch.setattr(chapters, "bearing_part", lambda found, geometry, *, name, **_: (found, geometry, name))
    machine: Any = SimpleNamespace(
        is_machine=True,
        bearing_names=["left", "right"],
        of_bearing=lambda name: SimpleNamespace(model=f"geometry of {name}"),
    )
    summary: Any = SimpleNamespace(bearings={"left": 1.0, "right": 2.0})
    parts: Any = chapters.run_bearings(machine, summary, SI)
    assert parts == ((1.0, "geometry of left", "left"), (2.0, "geometry of right", "right"))


def test_a_run_without_bands_has_them_in_its_report(tmp_path: Path) -> None:
    """Compute the bands of all bearings.

    Only those of a bearing alone were computed.
    """
    case = tmp_path / "box.toml"
    case.write_text(shaft_text("geared-shaft", "box"), encoding="utf-8")
    run = api.run(case, ["solver.duration=0.2 ms"], out=tmp_path / "box.h5")
    assert all(one.model_band is None for one in run.summary().bearings.values())
    text = api.report(run, tmp_path / "box.html").read_text(encoding="utf-8")
    (bands,) = re.findall(r"torque, 90 % model band</td>(.*?)</tr>", text, re.DOTALL)
    assert len(re.findall(r"\d+ *\.\. *\d+", bands)) == 3  # left, right, all bearings


def test_a_case_of_a_machine_has_a_report_with_its_shaft(tmp_path: Path) -> None:
    case = tmp_path / "box.toml"
    case.write_text(shaft_text("geared-shaft", "box"), encoding="utf-8")
    text = api.report(case, tmp_path / "box.html", appendices=["origin"]).read_text(encoding="utf-8")
    page, found = Page(text), api.quasistatic(case)
    assert isinstance(found, MachineEquilibrium)
    for words in ("Bearing left", "Bearing right", "gear wheel", "forces and moments of the bearings"):
        assert words in page.text
    assert text.count('<section class="sheet') == 3 + 1  # after the first page, and the appendix
    assert page.text.count("MET: L_nmrh") == 2
    assert page.text.count("minimum load") == 2
    assert page.text.count("load P, least") == 1  # the limits of both in one table
    assert page.tags.count("svg") == 1 + 1 + 2 * 2  # sketch, deflection and bending, section and loads of each
    one = Page(api.report(case, tmp_path / "left.html", bearing="left").read_text(encoding="utf-8"))
    assert "6208 (SKF), left of box" in one.text
    assert "6206" not in one.text.partition("Inputs")[0]
    with pytest.raises(UsageError, match='"lft" is not a known bearing; nearest: left'):
        api.report(case, tmp_path / "x.html", bearing="lft")


@pytest.mark.parametrize(
    ("names", "stem"),
    [(["six"], "six"), (["six", "heavy"], "six-vs-heavy"), (["six", "heavy", "light"], "six-vs-2-others")],
)
def test_pictures_of_several_results_are_named_after_them(names: list[str], stem: str) -> None:
    assert stem_of([Path(f"{name}.h5") for name in names]) == stem


@pytest.mark.parametrize(
    ("value", "text"), [(0.0456, "0.046 %"), (7.66, "7.7 %"), (86.2, "86 %"), (1049.0, "1 000 %"), (0.0, "0 %")]
)
def test_percentages_have_no_exponent(value: float, text: str) -> None:
    assert percent(value) == text
