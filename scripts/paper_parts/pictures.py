"""The figures of the paper with our bodies, in docs/images."""
from pages import ROOT
from paper_parts.methods import PAPER, TEAR
from paper_parts.runs import BOARD, FOLDER, Run
from tools import tool

TRACKED = ("bend", "push", "pull", "doll_bend", "doll_push", "doll_pull", "doll_cut-partial", "cut-partial", "cut",
           BOARD, TEAR)
AS_WRITTEN = ("bend", "push", "doll_push")
FILMED, TEXTURE_OF_FILM = ("touch", "doll_touch", "cut", "tear"), "sponge"
NEEDED = {**{scene: Run(scene) for scene in TRACKED},
          **{f"{scene} as written": Run(scene, PAPER) for scene in AS_WRITTEN},
          **{f"film of {scene}": Run(scene, texture=TEXTURE_OF_FILM) for scene in FILMED}}
RUNS = list(NEEDED.values())


def draw_figures(reports):
    """Writes figure_1.webp to figure_11.webp, the sheet figures.webp and film.webp."""
    from paper_figures.draw import draw  # needs the built workspace

    bags = {name: (reports[run]["recording"], reports[run]["result"]) for name, run in NEEDED.items()}
    cuts, board = FOLDER / "figure_10.png", FOLDER / "figure_11.png"
    tool("draw_cut", bags["cut-partial"][1], bags["doll_cut-partial"][1], "--output", cuts)
    tool("draw_cut", bags[BOARD][1], "--recording", bags[BOARD][0], "--output", board)
    draw(bags, cuts, board, ROOT / "docs/images")
