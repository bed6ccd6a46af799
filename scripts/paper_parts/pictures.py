"""The figures of the paper with our bodies, in docs/images."""
import shutil

from pages import ROOT
from paper_parts.methods import PAPER, TEAR
from paper_parts.runs import BOARD, FOLDER, Run
from tools import tool

IMAGES = ROOT / "docs/images"
PICTURES = FOLDER / "pictures"
TRACKED = ("bend", "push", "pull", "doll_bend", "doll_push", "doll_pull", "doll_cut-partial", "cut-partial", "cut",
           BOARD, TEAR)
AS_WRITTEN, WRITTEN = ("bend", "push", "doll_push"), "_as_written"
FILMED, TEXTURE_OF_FILM = ("touch", "doll_touch", "cut", "tear"), "sponge"
NEEDED = {**{scene: Run(scene) for scene in TRACKED},
          **{scene + WRITTEN: Run(scene, PAPER) for scene in AS_WRITTEN},
          **{f"film_{scene}": Run(scene, texture=TEXTURE_OF_FILM) for scene in FILMED}}
RUNS = list(NEEDED.values())


def lay_out(reports):
    """The bags that draw.py needs, under its names."""
    shutil.rmtree(PICTURES, ignore_errors=True)
    PICTURES.mkdir()
    for name, run in NEEDED.items():
        (PICTURES / f"{name}_result.bag").symlink_to(reports[run]["result"])
        if not name.endswith(WRITTEN):
            (PICTURES / f"{name}.bag").symlink_to(reports[run]["recording"])


def draw_figures(reports):
    """Writes figure_1.webp to figure_11.webp, the sheet figures.webp and film.webp."""
    from paper_figures.draw import draw  # needs the built workspace

    lay_out(reports)
    tool("draw_cut", PICTURES / "cut-partial_result.bag", PICTURES / "doll_cut-partial_result.bag",
         "--output", PICTURES / "figure_10.png")
    tool("draw_cut", PICTURES / f"{BOARD}_result.bag", "--recording", PICTURES / f"{BOARD}.bag",
         "--output", PICTURES / "figure_11.png")
    draw(PICTURES, IMAGES)
    shutil.rmtree(PICTURES)
