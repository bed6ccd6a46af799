"""Figure 2 of Kang et al. 2022: the data flow, with pictures of one frame."""
from matplotlib import pyplot
from matplotlib.patches import FancyArrowPatch

from paper_figures.drawing import DPI, GRAY, SKIN, frame, show_body, show_pale_image, show_tets, show_vectors

# Each step: its node, its stage in the paper, its column and row.
STEPS = {"camera": ("camera, camera_ingest", "RGB-D images", 0, 0),
         "features": ("feature_tracker", "feature-point tracking, model registration", 1, 0),
         "volume": ("simulator", "soft-body simulation", 2, 0),
         "surface": ("surface", "resolution enhancement, topological editing", 3, 0),
         "tool": ("tool_tracker", "cutting tool", 1, 1),
         "pieces": ("surface", "pieces of a cut body", 3, 1)}
FLOWS = (("camera", "features", "rgb, depth"), ("features", "volume", "targets"), ("volume", "surface", "volume/state"),
         ("camera", "tool", ""), ("tool", "pieces", "tool/blade"), ("pieces", "volume", "cut"),
         ("surface", "pieces", ""))
WIDTH, HEIGHT, GAP = 0.19, 0.36, 0.07  # of the figure


def show_step(axis, name, shown):
    """The picture of one step."""
    frame(axis, shown.camera, [shown.surface[0]], margin=0.4 if name == "tool" else 0.08)
    if name in ("camera", "tool"):
        axis.imshow(shown.image, interpolation="bicubic")
    if name == "features":
        show_pale_image(axis, shown.image)
        show_vectors(axis, shown.camera, shown, 0.8)
    if name == "volume":
        show_tets(axis, shown.camera, shown.state.volume.vertices, shown.state.volume.tets)
    if name in ("surface", "pieces"):
        triangles = shown.surface[1]
        colors = [GRAY if is_cut else SKIN for is_cut in shown.state.topology.cut_triangles]
        show_body(axis, shown.camera, shown.surface[0], triangles, colors)


def overview(scenes):
    """The graph: a picture for each step, and an arrow for each flow of data."""
    shown = dict(zip(("tool", "pieces"), scenes["cut"]))
    figure = pyplot.figure(figsize=(11, 4.6), dpi=DPI)
    axes = {}
    for name, (node, stage, column, row) in STEPS.items():
        axes[name] = figure.add_axes([0.01 + column * (WIDTH + GAP), 0.56 - 0.5 * row, WIDTH, HEIGHT])
        show_step(axes[name], name, shown.get(name, scenes["bend"][1]))
        axes[name].set_title(f"{node}\n{stage}", fontsize=8)
        axes[name].set_xticks([])
        axes[name].set_yticks([])
    for start, end, words in FLOWS:
        connect(figure, axes[start].get_position(), axes[end].get_position(), words)
    return figure


def connect(figure, start, end, words):
    """An arrow between two boxes, from side to side, or from above to below."""
    middle = (start.y0 + start.y1) / 2, (end.y0 + end.y1) / 2
    if start.x0 == end.x0:
        places = [(start.x0 + WIDTH / 2, start.y0), (end.x0 + WIDTH / 2, end.y1 + 0.09)]
    elif start.x0 < end.x0:
        places = [(start.x1, middle[0]), (end.x0, middle[1])]
    else:
        places = [(start.x0, middle[0]), (end.x0 + WIDTH / 2, end.y0)]
    figure.add_artist(FancyArrowPatch(*places, arrowstyle="-|>", mutation_scale=12, color=(0.3, 0.3, 0.3)))
    figure.text((places[0][0] + places[1][0]) / 2, (places[0][1] + places[1][1]) / 2 + 0.015, words, fontsize=8,
                horizontalalignment="center")
