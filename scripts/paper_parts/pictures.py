"""The figures of the paper with our bodies, in docs/images."""
import shutil
import subprocess

from evaluation.runs import DEVEL, ROOT, ToolFailed, tool
from markdown_lines import paragraph, table
from paper_parts.methods import PAPER_FILE, TEAR
from paper_parts.runs import BOARD, FOLDER, Run

IMAGES = ROOT / "docs/images"
PICTURES = FOLDER / "pictures"
TRACKED = ("bend", "push", "pull", "doll_bend", "doll_push", "doll_pull", "doll_cut-partial", "cut-partial", "cut",
           BOARD, TEAR)
AS_WRITTEN, WRITTEN = ("bend", "push", "doll_push"), "_as_written"
FILMED, TEXTURE_OF_FILM = ("touch", "doll_touch", "cut", "tear"), "sponge"
NEEDED = {**{scene: Run(scene) for scene in TRACKED},
          **{scene + WRITTEN: Run(scene, PAPER_FILE.read_text()) for scene in AS_WRITTEN},
          **{f"film_{scene}": Run(scene, texture=TEXTURE_OF_FILM) for scene in FILMED}}
RUNS = list(NEEDED.values())
SHOWN = {1: "the bodies before the camera; below, what was tracked, with the low-resolution model",
         2: "overview: the nodes of the graph, and what flows between them",
         3: "the models of sponge and doll at three resolutions",
         4: "features where they were first seen (red) and where they are (blue), with their vectors",
         5: "the low-resolution model with its features, at first and bent",
         6: "features, and the low-resolution model that follows them alone (config/paper.yaml), or with the volume",
         7: "initial shape, shape from feature vectors alone, shape with the simulation",
         8: "mean value coordinates: the high-resolution model (red) in the low-resolution model (gray)",
         9: "bent and pushed bodies over the camera's image: features, vectors, both models",
         10: "(a) before a cut, (b) line of the cut, (c) without and (d) with the faces that fill it; (e) a sponge is "
             "pulled until it tears",
         11: "a marked board (config/board.yaml) cuts the sponge: images with mesh and blade, and the mesh alone"}


def lay_out(reports):
    """The bags that draw.py needs, under its names."""
    shutil.rmtree(PICTURES, ignore_errors=True)
    PICTURES.mkdir()
    for name, run in NEEDED.items():
        (PICTURES / f"{name}_result.bag").symlink_to(reports[run]["result"])
        if not name.endswith(WRITTEN):
            (PICTURES / f"{name}.bag").symlink_to(reports[run]["recording"])


def draw_figures(reports):
    """Writes figure_1.webp to figure_11.webp, the sheet figures.webp and film.webp; the lines of their section."""
    lay_out(reports)
    tool("draw_cut", PICTURES / "cut-partial_result.bag", PICTURES / "doll_cut-partial_result.bag",
         "--output", PICTURES / "figure_10.png")
    tool("draw_cut", PICTURES / f"{BOARD}_result.bag", "--recording", PICTURES / f"{BOARD}.bag",
         "--output", PICTURES / "figure_11.png")
    command = [DEVEL / "env.sh", "/usr/bin/python3", ROOT / "scripts/paper_figures/draw.py", PICTURES, IMAGES]
    answer = subprocess.run(command, stderr=subprocess.PIPE, text=True, check=False)
    if answer.returncode != 0:
        raise ToolFailed(f"draw.py\n{answer.stderr}")
    shutil.rmtree(PICTURES)
    return section()


def section():
    """The lines of the section in docs/paper.md."""
    words = paragraph("The paper's figures with our bodies. The virtual camera records scenes with noise, and `replay` "
                      "tracks them. Figures 10 (a) to (d) and 11 are drawn by `draw_cut`. The slits of Figure 10 are "
                      "open because they are open in the camera images. No display is needed.")
    rows = [[f"[Figure {number}](images/figure_{number}.webp)", what] for number, what in SHOWN.items()]
    return ["### Figures", "", *words, "", "![Figures 1 to 11 of the paper, with our bodies](images/figures.webp)", "",
            *table(["figure", "what it shows"], rows)]
