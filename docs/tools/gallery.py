"""Draw the pictures of the gallery and the tutorial.

``python docs/tools/gallery.py [PICTURE ...]``.

Every picture has the commands that make it; the gallery page prints them (docs/tools/renew.py), this tool types them
in a temporary folder and keeps what they draw in docs/images/gallery, small. Pages as a browser shows them need
``chromium``; without one their pictures stay as they are.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import page_examples

DOCS = Path(__file__).parents[1]
TARGET = DOCS / "images" / "gallery"
WIDTH = 1000  # of a picture [px]
MOVING = 480  # of an animation [px]
COLOURS = 96
ALL_TOGETHER = 1_500_000  # bytes of all pictures, at most
_BROWSERS = ("chromium", "chromium-browser", "google-chrome")


@dataclass(frozen=True)
class Picture:
    """One picture with its command.

    Its caption, the command that draws it, the file that the command writes.
    """

    name: str
    title: str
    says: str
    command: str
    file: str
    run: str  # a key of RUNS: what there has to be before
    colours: int = COLOURS


@dataclass(frozen=True)
class Run:
    """Commands before the pictures.

    As on a page, under a heading.
    """

    title: str
    commands: tuple[str, ...]


RUNS: dict[str, Run] = {
    "motor": Run("A motor bearing under radial and axial load", ("lambda-bearing run motor.toml",)),
    "6319": Run("A 6319 under 16 kN", ("lambda-bearing run 6319-cp10-1500 --out radial.h5",)),
    "6208": Run("A 6208 under axial load", ("lambda-bearing run 6208-axial-1300 --out axial.h5",)),
    "two oils": Run(
        "Several results",
        (
            "lambda-bearing run motor.toml --set lubricant.name=mineral-vg32 --out thin.h5",
            "lambda-bearing run motor.toml --set lubricant.name=mineral-vg150 --out thick.h5",
        ),
    ),
    "map": Run("Studies", ("lambda-bearing study init friction-map", "lambda-bearing study run friction-map.toml")),
    "sensitivity": Run(
        "Sensitivities", ("lambda-bearing study init what-decides", "lambda-bearing study run what-decides.toml")
    ),
}

PICTURES = (
    Picture(
        "load-distribution",
        "Load of every ball",
        "The load that each ball of the tutorial's bearing carries.",
        "lambda-bearing view motor.h5 load-distribution",
        "motor-load-distribution.png",
        "motor",
    ),
    Picture(
        "friction-breakdown",
        "Where the friction arises",
        "Sliding, spin, rolling, hysteresis, cage and oil, ring by ring.",
        "lambda-bearing view motor.h5 friction-breakdown",
        "motor-friction-breakdown.png",
        "motor",
    ),
    Picture(
        "catalogues",
        "Comparison with catalogues",
        "The simulated torque by parts, and the models of SKF and Schaeffler for the same point.",
        "lambda-bearing view motor.h5 catalogues",
        "motor-catalogues.png",
        "motor",
    ),
    Picture(
        "film",
        "Oil film",
        "Film thickness and Lambda of every contact around the bearing.",
        "lambda-bearing view motor.h5 film",
        "motor-film.png",
        "motor",
    ),
    Picture(
        "contact-map",
        "Inside one contact",
        "Pressure, slip with its lines of pure rolling, shear, film, temperature under the most loaded ball.",
        "lambda-bearing view motor.h5 contact-map",
        "motor-contact-map.png",
        "motor",
        256,
    ),
    Picture(
        "pressure",
        "Contact pressure",
        "Largest Hertzian pressure of every ball on both rings.",
        "lambda-bearing view radial.h5 pressure",
        "radial-pressure.png",
        "6319",
    ),
    Picture(
        "element-speeds",
        "Speeds of the balls",
        "Orbital speed and spin over the kinematic ones; the unloaded balls skid.",
        "lambda-bearing view radial.h5 element-speeds",
        "radial-element-speeds.png",
        "6319",
    ),
    Picture(
        "pocket-forces",
        "Forces in the cage",
        "Forces of the balls on their pockets as they enter and leave the load zone.",
        "lambda-bearing view radial.h5 pocket-forces",
        "radial-pocket-forces.png",
        "6319",
    ),
    Picture(
        "convergence",
        "Is it converged?",
        "The friction torque over time, the means of single cage turns, the confidence of their mean.",
        "lambda-bearing view radial.h5 convergence",
        "radial-convergence.png",
        "6319",
    ),
    Picture(
        "capacitance",
        "Electrical capacitance",
        "Contacts as capacitors, the bearing over time and its spectrum.",
        "lambda-bearing view axial.h5 capacitance",
        "axial-capacitance.png",
        "6208",
    ),
    Picture(
        "comparison",
        "Two oils side by side",
        "Differences between two oils in the same bearing.",
        "lambda-bearing view thin.h5 thick.h5",
        "thin-and-1-more-comparison.png",
        "two oils",
    ),
    Picture(
        "study-map",
        "A map of 500 points",
        "Friction, pressure and film over speed and load, quasi-static.",
        "lambda-bearing view friction-map study-map",
        "friction-map-study-map.png",
        "map",
        256,
    ),
    Picture(
        "sensitivity",
        "What decides",
        "Sobol' indices: the effect of each input on friction and film, alone and with others.",
        "lambda-bearing view what-decides sensitivity",
        "what-decides-sensitivity.png",
        "sensitivity",
    ),
    Picture(
        "animation",
        "In motion",
        "Balls, cage and loads of one cage turn; as GIF, MP4, or glTF for viewers of three dimensions.",
        "lambda-bearing animate motor.h5 --frames 24 --fps 8",
        "motor.gif",
        "motor",
        80,
    ),
    Picture(
        "report",
        "The report",
        "One HTML file to print: verdict with margins, sketch, loads, lives, losses, inputs, limits on four pages.",
        "lambda-bearing report motor.h5",
        "motor.html",
        "motor",
    ),
)


def gallery() -> str:
    """Return the gallery as Markdown: every picture with its commands."""
    lines: list[str] = []
    for run in dict.fromkeys(picture.run for picture in PICTURES):
        typed = [f"$ {command}\n..." for command in RUNS[run].commands]
        lines += [f"## {RUNS[run].title}", "", "<!-- slow -->", "```console", *typed, "```", ""]
        for picture in (each for each in PICTURES if each.run == run):
            lines += [
                f"### {picture.title}",
                "",
                picture.says,
                "",
                f"![{picture.title}](images/gallery/{target(picture).name})",
                "",
                "```console",
                f"$ {picture.command}",
                "...",
                "```",
                "",
            ]
    return "\n".join(lines)


def target(picture: Picture) -> Path:
    """Return the file of a picture among the pages."""
    return TARGET / f"{picture.name}{'.gif' if picture.file.endswith('.gif') else '.png'}"


def motor_case() -> str:
    """Return the case file of the tutorial."""
    page = DOCS / "first-bearing.md"
    return next(
        str(step.text) for step in page_examples.steps(page) if step.kind == "file" and step.name == "motor.toml"
    )


def drawn(pictures: list[Picture], folder: Path) -> Iterator[Path]:
    """Type the commands and write the pictures.

    In a folder; yield the files that were written.
    """
    environment = os.environ | {"PATH": os.pathsep.join([str(page_examples.PROGRAMS), os.environ["PATH"]])}
    environment |= {"LAMBDA_BEARING_DATA": str(folder / ".data"), "NO_COLOR": "1", "MPLBACKEND": "Agg"}
    (folder / "motor.toml").write_text(motor_case(), encoding="utf-8")

    def typed(command: str) -> None:
        subprocess.run(["bash", "-c", command], cwd=folder, env=environment, check=True, capture_output=True)

    for run in dict.fromkeys(picture.run for picture in pictures):
        for command in RUNS[run].commands:
            typed(command)
        for picture in (each for each in pictures if each.run == run):
            typed(picture.command)
            made = folder / picture.file
            if made.suffix == ".html":
                page = photographed(made)
                if page is None:
                    continue
                made = page
            small(made, target(picture), picture.colours)
            yield target(picture)


def photographed(page: Path) -> Path | None:
    """Return a picture of the first screens.

    Of a page; None without a browser.
    """
    browser = next((found for name in _BROWSERS if (found := shutil.which(name))), None)
    if browser is None:
        return None
    made = page.with_suffix(".page.png")
    options = ["--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--window-size=1000,1330"]
    command = [browser, *options, f"--screenshot={made}", page.as_uri()]
    subprocess.run(command, check=True, capture_output=True)
    return made


def small(source: Path, to: Path, colours: int) -> None:
    """Write a small picture.

    As wide as a page and with few colours.
    """
    from PIL import Image, ImageSequence

    picture = Image.open(source)
    to.parent.mkdir(parents=True, exist_ok=True)
    if source.suffix == ".gif":
        size = (MOVING, round(MOVING * picture.height / picture.width))
        frames = [
            frame.convert("RGB").resize(size, Image.Resampling.LANCZOS) for frame in ImageSequence.Iterator(picture)
        ]
        palette = frames[0].quantize(colours, dither=Image.Dither.NONE)
        first, *rest = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
        first.save(
            to, save_all=True, append_images=rest, duration=picture.info.get("duration", 80), loop=0, optimize=True
        )
        return
    page = picture.convert("RGB")
    page = page.resize((WIDTH, round(WIDTH * page.height / page.width)), Image.Resampling.LANCZOS)
    page.quantize(colours, dither=Image.Dither.NONE).save(to, optimize=True)


def main(arguments: list[str]) -> int:
    """Draw the pictures named, or all.

    Fail when together they are too large.
    """
    known = {picture.name: picture for picture in PICTURES}
    unknown = [name for name in arguments if name not in known]
    if unknown:
        print(f"no picture {', '.join(unknown)}; there are: {', '.join(known)}")
        return 2
    with tempfile.TemporaryDirectory() as folder:
        for file in drawn([known[name] for name in arguments or known], Path(folder)):
            print(f"{file.relative_to(DOCS)}  {file.stat().st_size / 1e3:.0f} kB", flush=True)
    size = sum(file.stat().st_size for file in TARGET.iterdir())
    print(f"{size / 1e6:.2f} MB of {ALL_TOGETHER / 1e6:.1f}")
    return int(size > ALL_TOGETHER)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
