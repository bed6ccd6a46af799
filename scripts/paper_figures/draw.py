"""Draws the figures of Kang et al. 2022 with our bodies, a sheet with all of them, and a film."""
from matplotlib import pyplot

from paper_figures.drawing import DPI, save
from paper_figures.figures import DRAWN
from paper_figures.film import make_film
from paper_figures.moments import around_cut, at, moments
from paper_figures.torn import around_tear, figure_10

MOVED = ("bend", "push", "pull", "doll_bend", "doll_push", "doll_pull")
AS_WRITTEN = ("bend", "push", "doll_push")
CUT, BOARD = 10, 11  # figures of draw_cut
# The sheet: what is side by side, its width, the height of a title in widths, and its size.
ROWS = ((1, 3), (2,), (4, 6), (5, 7, 8), (9, 10), (11,))
SHEET_INCHES, TITLE, SHEET_BYTES = 14, 0.022, 500_000
TITLES = {1: "bodies, and what was tracked", 2: "data flow", 3: "models of three resolutions", 4: "features and their vectors",
          5: "features on the cage", 6: "shape from features alone, and with the volume",
          7: "shape from vectors, simulated shape", 8: "fine mesh in its cage", 9: "models and features over the image",
          10: "cuts, and a tear", 11: "a marked board cuts the sponge"}


def read_scenes(folder):
    """The moments of each scene by its name."""
    scenes = {name: moments(folder / f"{name}.bag", folder / f"{name}_result.bag") for name in MOVED}
    for name in AS_WRITTEN:
        stamps = {moment.state.stamp for moment in scenes[name]}
        result = folder / f"{name}_as_written_result.bag"
        scenes[f"{name} as written"] = moments(folder / f"{name}.bag", result, at(stamps))
    scenes["cut"] = moments(folder / "cut.bag", folder / "cut_result.bag", around_cut)
    scenes["tear"] = moments(folder / "tear.bag", folder / "tear_result.bag", around_tear)
    return scenes


def full(picture):
    """A figure that a picture fills."""
    rows, columns = picture.shape[:2]
    figure = pyplot.figure(figsize=(columns / DPI, rows / DPI), dpi=DPI)
    figure.add_axes([0, 0, 1, 1]).imshow(picture)
    figure.axes[0].set_axis_off()
    return figure


def sheet(pictures):
    """All figures at a glance: those of a row have one height, and fill its width."""
    read = {number: pyplot.imread(path) for number, path in pictures.items()}
    shapes = {number: picture.shape[1] / picture.shape[0] for number, picture in read.items()}  # width by height
    heights = [1.0 / sum(shapes[number] for number in row) for row in ROWS]  # in widths of the sheet
    total = sum(heights) + TITLE * len(ROWS)
    figure = pyplot.figure(figsize=(SHEET_INCHES, SHEET_INCHES * total), dpi=DPI)
    top = total
    for row, height in zip(ROWS, heights):
        left, top = 0.0, top - TITLE - height
        for number in row:
            width = shapes[number] * height
            axis = figure.add_axes([left, top / total, 0.98 * width, height / total])
            axis.imshow(read[number])
            axis.set_axis_off()
            axis.set_title(f"Figure {number}: {TITLES[number]}", fontsize=11, loc="left")
            left += width
    return figure


def draw(folder, output):
    """@param folder with recordings (NAME.bag), results (NAME_result.bag), and figure_10.png, figure_11.png of `draw_cut`;
    @param output gets figure_1.webp to figure_11.webp, the sheet figures.webp, and film.webp."""
    pictures = {number: output / f"figure_{number}.webp" for number in (*DRAWN, CUT, BOARD)}
    scenes = read_scenes(folder)
    for number, figure in DRAWN.items():
        save(figure(scenes), pictures[number])
    save(figure_10(pyplot.imread(folder / f"figure_{CUT}.png"), scenes["tear"]), pictures[CUT])
    save(full(pyplot.imread(folder / f"figure_{BOARD}.png")), pictures[BOARD])
    save(sheet(pictures), output / "figures.webp", SHEET_BYTES)
    make_film(folder, output / "film.webp")
