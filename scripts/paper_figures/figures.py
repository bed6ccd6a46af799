"""Figures 1 to 9 of Kang et al. 2022, with our bodies."""
import numpy as np

from paper_figures.drawing import (BLUE, GRAY, GREEN, RED, frame, panels, pixels, show_body, show_edges,
                                   show_pale_image, show_points, show_tets, show_vectors)
from paper_figures.overview import overview

MOTIONS = ("bend", "push", "doll_bend", "doll_push")
SEEN = {"bend": "bent sponge", "push": "pushed sponge", "doll_bend": "bent soft toy", "doll_push": "pushed soft toy"}
LARGE = 4.5  # width of a panel with many features [inches]
DARK_GREEN = (0.0, 0.4, 0.1)


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


DRAWN = {1: figure_1, 2: overview, 3: figure_3, 4: figure_4, 5: figure_5, 6: figure_6, 7: figure_7, 8: figure_8,
         9: figure_9}
