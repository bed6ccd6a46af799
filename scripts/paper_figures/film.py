"""The film of a sponge and a soft toy that are bent, cut and torn: image, mesh and features over it, and the model."""
import subprocess
import tempfile

import numpy as np
from matplotlib import pyplot

from paper_figures.drawing import (ASPECT, BLUE, GREEN, SKIN, blend_body, frame, pixels, show_body, show_pale_image,
                                   show_points)
from paper_figures.moments import moments, read_blades

# Each scene: its words, and the part that is shown [s].
SCENES = {"touch": ("A hand bends a sponge", 0.5, 5.0), "doll_touch": ("A hand bends a soft toy", 0.5, 5.0),
          "cut": ("A knife with a marker cuts the sponge", 1.0, 7.0),
          "tear": ("The sponge is pulled until it tears", 0.5, 4.5)}
EVERY, RATE_HZ = 2, 30  # recorded frames
PANEL_PX, TITLE_PX, QUALITY = 400, 22, 88
CUT_FACE, BLADE = (0.85, 0.35, 0.3), (1.0, 0.6, 0.0)
MOST_EDGES = 5000  # triangles; those of a finer mesh would cover everything
EDGE = (0.0, 0.3, 0.1)


def between(begin, end):
    """Every second state of a part of a recording [s]."""
    def chosen(states):
        first = states[0].stamp
        return [state for state in states if begin <= (state.stamp - first).to_sec() < end][::EVERY]
    return chosen


def draw_frame(moment, clouds, words, blade):
    """One picture of the film."""
    total = ASPECT * PANEL_PX + TITLE_PX
    figure = pyplot.figure(figsize=(3 * PANEL_PX / 100, total / 100), dpi=100)
    height = 1 - TITLE_PX / total
    axes = [figure.add_axes([column / 3, 0, 0.995 / 3, height]) for column in range(3)]
    for axis, title in zip(axes, (words, "mesh and features on the image", "model")):
        axis.set_axis_off()
        frame(axis, moment.camera, clouds, title, margin=0.15)
    axes[0].imshow(moment.image, interpolation="bicubic")
    show_pale_image(axes[1], moment.image)
    edges = [EDGE] if len(moment.surface[1]) < MOST_EDGES else None
    blend_body(axes[1], moment.camera, *moment.surface, GREEN, 0.45, edges)
    show_points(axes[1], moment.camera, moment.features, BLUE, 3.0)
    colors = [CUT_FACE if is_cut else SKIN for is_cut in moment.state.topology.cut_triangles]
    show_body(axes[2], moment.camera, *moment.surface, colors)
    if blade is not None:
        for axis in axes[1:]:
            axis.fill(*pixels(moment.camera, blade).T, facecolor=(*BLADE, 0.2), edgecolor=BLADE)
    return figure


def make_film(bags, path):
    """Writes the film as WebP, at the speed of the recordings."""
    with tempfile.TemporaryDirectory() as pictures:
        files = []
        for scene, (words, begin, end) in SCENES.items():
            bag, result = bags[f"film of {scene}"]
            shown, blades = moments(bag, result, between(begin, end)), read_blades(result)
            clouds = [np.vstack([moment.surface[0] for moment in shown])]
            for moment in shown:
                figure = draw_frame(moment, clouds, words, blades.get(moment.state.stamp))
                files.append(f"{pictures}/{len(files):04}.png")
                figure.savefig(files[-1])
                pyplot.close(figure)
        delay = str(1000 * EVERY // RATE_HZ)
        options = ["-loop", "0", "-d", delay, "-lossy", "-q", str(QUALITY), "-m", "4"]
        subprocess.run(["img2webp", *options, *files, "-o", path], check=True)
