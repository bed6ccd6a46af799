"""The figures of the paper with our bodies, in docs/images."""
import concurrent.futures
import shutil
import subprocess

from evaluation.runs import DEVEL, OUTPUT, ROOT, ToolFailed, object_of, tool, tool_of
from markdown_lines import paragraph, table
from paper_parts.methods import PAPER_FILE

IMAGES = ROOT / "docs/images"
FOLDER = OUTPUT / "paper_figures"
MOTIONS = ("bend", "push", "pull", "doll_bend", "doll_push", "doll_pull")
AS_WRITTEN = ("bend", "push", "doll_push")
BOARD, BOARD_TOOL = "cut_board", ("--tool", ROOT / "config/board.yaml")  # scene cut; the board itself is the blade
CUTS = ("doll_cut-partial", "cut-partial", "cut", BOARD)
SHOWN_IMAGES = (*MOTIONS, "cut", BOARD)
SHOWN = {1: "the bodies before the camera; below, what was tracked, with the low-resolution model",
         2: "overview: the nodes of the graph, and what flows between them",
         3: "the models of sponge and doll at three resolutions",
         4: "features where they were first seen (red) and where they are (blue), with their vectors",
         5: "the low-resolution model with its features, at first and bent",
         6: "features, and the low-resolution model that follows them alone (config/paper.yaml), or with the volume",
         7: "initial shape, shape from feature vectors alone, shape with the simulation",
         8: "mean value coordinates: the high-resolution model (red) in the low-resolution model (gray)",
         9: "bent and pushed bodies over the camera's image: features, vectors, both models",
         10: "(a) before a cut, (b) line of the cut, (c) without and (d) with the faces that fill it",
         11: "a marked board (config/board.yaml) cuts the sponge: images with mesh and blade, and the mesh alone"}


def track(scene):
    """Records one scene and tracks it."""
    recording, config = FOLDER / f"{scene}.bag", object_of(scene)
    played = ("cut", *BOARD_TOOL) if scene == BOARD else (scene,)
    knife = BOARD_TOOL if scene == BOARD else tool_of(scene)
    tool("virtual_camera", "--scene", *played, "--output", recording)
    tool("replay", recording, "--object", config, *knife, "--output", FOLDER / f"{scene}_result.bag")
    if scene in AS_WRITTEN:
        tool("replay", recording, "--object", config, "--parameters", PAPER_FILE, "--output",
             FOLDER / f"{scene}_as_written_result.bag")
    if scene not in SHOWN_IMAGES:
        recording.unlink()


def draw_figures(jobs):
    """Writes figure_1.webp to figure_11.webp, the sheet figures.webp and film.webp; the lines of their section."""
    FOLDER.mkdir(exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        list(pool.map(track, (*CUTS, *MOTIONS)))
    tool("draw_cut", FOLDER / "cut-partial_result.bag", FOLDER / "doll_cut-partial_result.bag",
         "--output", FOLDER / "figure_10.png")
    tool("draw_cut", FOLDER / f"{BOARD}_result.bag", "--recording", FOLDER / f"{BOARD}.bag",
         "--output", FOLDER / "figure_11.png")
    command = [DEVEL / "env.sh", "/usr/bin/python3", ROOT / "scripts/paper_figures/draw.py", FOLDER, IMAGES]
    answer = subprocess.run(command, stderr=subprocess.PIPE, text=True, check=False)
    if answer.returncode != 0:
        raise ToolFailed(f"draw.py\n{answer.stderr}")
    shutil.rmtree(FOLDER)
    return section()


def section():
    """The lines of the section in docs/paper.md."""
    words = paragraph("The paper's figures with our bodies. The virtual camera records scenes with noise, and `replay` "
                      "tracks them. Figures 10 and 11 are drawn by `draw_cut`. The slits of Figure 10 are open because "
                      "they are open in the camera images. No display is needed.")
    rows = [[f"[Figure {number}](images/figure_{number}.webp)", what] for number, what in SHOWN.items()]
    return ["### Figures", "", *words, "", "![Figures 1 to 11 of the paper, with our bodies](images/figures.webp)", "",
            *table(["figure", "what it shows"], rows)]
