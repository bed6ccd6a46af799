"""Figures 1 to 9 of Kang et al. 2022, with our bodies."""
import numpy as np
from matplotlib import pyplot
from matplotlib.patches import FancyArrowPatch

from paper_figures.drawing import (BLUE, DPI, GRAY, GREEN, RED, SKIN, frame, panels, pixels, show_body, show_edges,
                                   show_pale_image, show_points, show_tets, show_vectors)

MOTIONS = ("bend", "push", "doll_bend", "doll_push")
SEEN = {"bend": "bent sponge", "push": "pushed sponge", "doll_bend": "bent soft toy", "doll_push": "pushed soft toy"}
LARGE = 4.5  # width of a panel with many features [inches]
DARK_GREEN = (0.0, 0.4, 0.1)
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


def show_features(axis, moment, title):
    """The image, with the features' motion on it."""
    frame(axis, moment.camera, [moment.surface[0], moment.origins], title)
    show_pale_image(axis, moment.image)
    show_vectors(axis, moment.camera, moment)


def figure_1(scenes):
    """Observed bodies and what was tracked."""
    figure, axes = panels(2, len(MOTIONS))
    for column, name in zip(axes.T, MOTIONS):
        moment = scenes[name][1]
        for axis in column:
            frame(axis, moment.camera, [moment.surface[0]])
        column[0].set_title(SEEN[name], fontsize=9)
        column[0].imshow(moment.image, interpolation="bicubic")
        show_body(column[1], moment.camera, *moment.surface)
        show_edges(column[1], moment.camera, *moment.cage, BLUE, 0.4)
    return figure


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


def figure_2(scenes):
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
    for names in FLOWS:
        # An arrow between two boxes, from side to side, or from above to below.
        start, end = (axes[name].get_position() for name in names[:2])
        middle = (start.y0 + start.y1) / 2, (end.y0 + end.y1) / 2
        if start.x0 == end.x0:
            places = [(start.x0 + WIDTH / 2, start.y0), (end.x0 + WIDTH / 2, end.y1 + 0.09)]
        elif start.x0 < end.x0:
            places = [(start.x1, middle[0]), (end.x0, middle[1])]
        else:
            places = [(start.x0, middle[0]), (end.x0 + WIDTH / 2, end.y0)]
        figure.add_artist(FancyArrowPatch(*places, arrowstyle="-|>", mutation_scale=12, color=(0.3, 0.3, 0.3)))
        figure.text((places[0][0] + places[1][0]) / 2, (places[0][1] + places[1][1]) / 2 + 0.015, names[2], fontsize=8,
                    horizontalalignment="center")
    return figure


def figure_3(scenes):
    """The three models of each body."""
    figure, axes = panels(2, 3)
    for row, name in zip(axes, ("bend", "doll_bend")):
        moment = scenes[name][0]
        volume = moment.state.volume
        counts = [f"low-resolution: {len(np.unique(moment.cage[1]))} vertices", f"volumetric: {len(volume.tets)} tets",
                  f"high-resolution: {len(moment.surface[0])} vertices"]
        for axis, words in zip(row, counts):
            frame(axis, moment.camera, [volume.vertices], words)
        show_body(row[0], moment.camera, *moment.cage, GRAY, edges=[(0.2, 0.2, 0.2)])
        show_tets(row[1], moment.camera, volume.vertices, volume.tets)
        show_body(row[2], moment.camera, *moment.surface)
    return figure


def figure_4(scenes):
    """Features at the beginning (red) and now (blue)."""
    figure, axes = panels(1, 2, LARGE)
    for axis, name in zip(axes[0], ("bend", "doll_bend")):
        show_features(axis, scenes[name][1], SEEN[name])
    return figure


def figure_5(scenes):
    """Features on the low-resolution model, in the first and in a later frame."""
    figure, axes = panels(2, 2)
    for row, name in zip(axes, ("bend", "doll_bend")):
        for axis, moment, words in zip(row, scenes[name], ("(a) initial", "(b) updated")):
            frame(axis, moment.camera, [later.cage[0] for later in scenes[name]], f"{words}, {SEEN[name]}")
            show_body(axis, moment.camera, *moment.cage, (1.0, 1.0, 1.0), edges=[BLUE])
            show_points(axis, moment.camera, moment.features, BLUE, 4.0)
    return figure


def figure_6(scenes):
    """The low-resolution model that follows its features alone. A circle marks where it is worst."""
    figure, axes = panels(1, 3, 3.6)
    rough, smooth = scenes["bend as written"][-1], scenes["bend"][1]
    for axis, words in zip(axes[0], ("(a) features", "(b) surface from features alone", "(c) with the volume")):
        frame(axis, rough.camera, [rough.cage[0], smooth.cage[0]], words)
    show_pale_image(axes[0][0], rough.image)
    show_vectors(axes[0][0], rough.camera, rough)
    for axis, moment in zip(axes[0][1:], (rough, smooth)):
        show_body(axis, moment.camera, *moment.cage, GRAY, edges=[(0.3, 0.3, 0.3)])
    worst = np.linalg.norm(rough.cage[0] - smooth.cage[0], axis=1).argmax()
    place = pixels(rough.camera, rough.cage[0][[worst]])
    axes[0][1].scatter(*place.T, s=1200, facecolors="none", edgecolors=[RED])
    return figure


def figure_7(scenes):
    """Initial shape, shape from feature vectors, shape from the simulation."""
    figure, axes = panels(2, 3)
    for row, name in zip(axes, ("push", "doll_push")):
        shapes = [scenes[name][0], scenes[f"{name} as written"][-1], scenes[name][1]]
        for axis, moment, words in zip(row, shapes, ("(a) initial", "(b) from feature vectors", "(c) simulated")):
            frame(axis, moment.camera, [shape.surface[0] for shape in shapes], f"{words}, {SEEN[name]}")
            show_body(axis, moment.camera, *moment.surface)
    return figure


def figure_8(scenes):
    """Mean value coordinates: the high-resolution model (red) in the low-resolution model (gray)."""
    figure, axes = panels(2, 3)
    for row, body in zip(axes, ("", "doll_")):
        shapes = [scenes[body + "push"][0], scenes[body + "push"][1], scenes[body + "pull"][1]]
        for axis, moment, words in zip(row, shapes, ("(a) initial", "(b) pushed", "(c) pulled")):
            frame(axis, moment.camera, [shape.cage[0] for shape in shapes], words)
            show_body(axis, moment.camera, *moment.surface, (0.9, 0.3, 0.25))
            show_body(axis, moment.camera, *moment.cage, GRAY, 0.25, edges=[(0.4, 0.4, 0.4)])
    return figure


def figure_9(scenes):
    """Bodies bent and pushed, with features, vectors and model over the image."""
    figure, axes = panels(2, 2, LARGE)
    for axis, name in zip(axes.flat, MOTIONS):
        moment = scenes[name][1]
        show_body(axis, moment.camera, *moment.surface, GREEN, 0.3)
        show_edges(axis, moment.camera, *moment.cage, DARK_GREEN, 0.4)
        show_features(axis, moment, SEEN[name])
    return figure


DRAWN = {1: figure_1, 2: figure_2, 3: figure_3, 4: figure_4, 5: figure_5, 6: figure_6, 7: figure_7, 8: figure_8,
         9: figure_9}
