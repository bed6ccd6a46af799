"""The film of bodies that are bent, pushed and cut: image, features with the mesh over it, and the model."""
import subprocess
import tempfile

import numpy as np
from matplotlib import pyplot

from paper_figures.drawing import (ASPECT, GREEN, SKIN, frame, pixels, show_body, show_edges, show_image,
                                   show_pale_image, show_vectors)
from paper_figures.moments import moments, read_blades

SCENES = {"bend": "A sponge is bent", "push": "A sponge is pushed", "doll_bend": "A soft toy is bent",
          "doll_push": "A soft toy is pushed", "cut": "A knife with a marker cuts the sponge"}
EVERY, RATE_HZ = 4, 30  # recorded frames
PANEL_PX, TITLE_PX, QUALITY = 400, 22, 60
CUT_FACE = (0.85, 0.35, 0.3)


def every_few(states):
    return states[::EVERY]


def draw_frame(moment, clouds, words, blade):
    """One picture of the film."""
    total = ASPECT * PANEL_PX + TITLE_PX
    figure = pyplot.figure(figsize=(3 * PANEL_PX / 100, total / 100), dpi=100)
    height = 1 - TITLE_PX / total
    axes = [figure.add_axes([column / 3, 0, 0.995 / 3, height]) for column in range(3)]
    for axis, title in zip(axes, (words, "features and mesh", "model")):
        axis.set_axis_off()
        frame(axis, moment.camera, clouds, title, margin=0.15)
    show_image(axes[0], moment.image)
    show_pale_image(axes[1], moment.image)
    show_body(axes[1], moment.camera, *moment.surface, GREEN, 0.3)
    show_edges(axes[1], moment.camera, *moment.cage, (0.0, 0.4, 0.1), 0.3)
    show_vectors(axes[1], moment.camera, moment, 1.0)
    colors = [CUT_FACE if is_cut else SKIN for is_cut in moment.state.topology.cut_triangles]
    show_body(axes[2], moment.camera, *moment.surface, colors)
    if blade is not None:
        for axis in axes[1:]:
            axis.fill(*pixels(moment.camera, blade).T, facecolor=(1.0, 0.6, 0.0, 0.2), edgecolor=(1.0, 0.6, 0.0))
    return figure


def make_film(folder, path):
    """Writes the film as WebP, at the speed of the recordings."""
    with tempfile.TemporaryDirectory() as pictures:
        files = []
        for scene, words in SCENES.items():
            result = folder / f"{scene}_result.bag"
            shown, blades = moments(folder / f"{scene}.bag", result, every_few), read_blades(result)
            clouds = [np.vstack([moment.surface[0] for moment in shown])]
            for moment in shown:
                figure = draw_frame(moment, clouds, words, blades.get(moment.state.stamp))
                files.append(f"{pictures}/{len(files):04}.png")
                figure.savefig(files[-1])
                pyplot.close(figure)
        delay = str(1000 * EVERY // RATE_HZ)
        options = ["-loop", "0", "-d", delay, "-lossy", "-q", str(QUALITY), "-m", "4"]
        subprocess.run(["img2webp", *options, *files, "-o", path], check=True)
