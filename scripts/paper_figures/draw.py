"""Draws the figures of Kang et al. 2022 with our bodies, a sheet with all of them, and a film."""
from matplotlib import pyplot

from paper_figures.drawing import ASPECT, BLUE, DPI, GREEN, RED, blend_body, frame, save, show_pale_image
from paper_figures.figures import DRAWN
from paper_figures.film import make_film
from paper_figures.moments import around_cut, around_tear, moments

MOVED = ("bend", "push", "pull", "doll_bend", "doll_push", "doll_pull")
AS_WRITTEN = ("bend", "push", "doll_push")
# The sheet: what is side by side, its width, the height of a title in widths, and its size.
ROWS = ((1, 3), (2,), (4, 6), (5, 7, 8), (9, 10), (11,))
SHEET_INCHES, TITLE, SHEET_BYTES = 14, 0.022, 500_000
TITLES = {1: "bodies, and what was tracked", 2: "data flow", 3: "models of three resolutions", 4: "features and their vectors",
          5: "features on the cage", 6: "shape from features alone, and with the volume",
          7: "shape from vectors, simulated shape", 8: "fine mesh in its cage", 9: "models and features over the image",
          10: "cuts, and a tear", 11: "a marked board cuts the sponge"}
PIECES = (GREEN, BLUE)
TORN = ("(e) pulled", "just torn", "apart")
TITLE_PX = 30


def read_scenes(bags):
    """The moments of each scene by its name."""
    scenes = {name: moments(*bags[name]) for name in MOVED}
    for name in AS_WRITTEN:
        stamps = {moment.state.stamp for moment in scenes[name]}
        scenes[f"{name} as written"] = moments(*bags[f"{name} as written"],
                                               lambda states: [state for state in states if state.stamp in stamps])
    return {**scenes, "cut": moments(*bags["cut"], around_cut), "tear": moments(*bags["tear"], around_tear)}


def full(picture, strip=0.0):
    """A figure that a picture fills, down to a strip at the bottom [px]."""
    rows, columns = picture.shape[:2]
    height = rows + strip
    figure = pyplot.figure(figsize=(columns / DPI, height / DPI), dpi=DPI)
    above = figure.add_axes([0, strip / height, 1, rows / height])
    above.imshow(picture)
    above.set_axis_off()
    return figure


def figure_10(picture, shown):
    """The picture of `draw_cut`, and a row with the torn body over the camera's images, each piece in its colour."""
    rows, columns = picture.shape[:2]
    strip = columns / len(shown) * ASPECT + TITLE_PX
    figure, height = full(picture, strip), rows + strip
    for column, (moment, words) in enumerate(zip(shown, TORN)):
        axis = figure.add_axes([column / len(shown), 0, 0.99 / len(shown), 1 - (rows + TITLE_PX) / height])
        axis.set_axis_off()
        frame(axis, moment.camera, [each.surface[0] for each in shown], words)
        show_pale_image(axis, moment.image)
        colors = [RED if is_cut else PIECES[piece % len(PIECES)]
                  for is_cut, piece in zip(moment.state.cut_triangles, moment.state.triangle_pieces)]
        blend_body(axis, moment.camera, *moment.surface, colors, 0.5)
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


def draw(bags, cuts, board, output):
    """@param bags: recording and result by scene. @param cuts, board: pictures of `draw_cut`, for figures 10 and 11.
    @param output gets figure_1.webp to figure_11.webp, the sheet figures.webp, and film.webp."""
    scenes = read_scenes(bags)
    figures = {number: figure(scenes) for number, figure in DRAWN.items()}
    figures |= {10: figure_10(pyplot.imread(cuts), scenes["tear"]), 11: full(pyplot.imread(board))}
    pictures = {number: output / f"figure_{number}.webp" for number in figures}
    for number, figure in figures.items():
        save(figure, pictures[number])
    save(sheet(pictures), output / "figures.webp", SHEET_BYTES)
    make_film(bags, output / "film.webp")
