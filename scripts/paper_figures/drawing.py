"""Panels of figures: bodies, features and images as the camera sees them. Free of ROS."""
import matplotlib
import numpy as np
from matplotlib import pyplot
from matplotlib.collections import LineCollection, PolyCollection

matplotlib.use("Agg")

RED, BLUE, GREEN, GRAY = (0.85, 0.1, 0.1), (0.1, 0.25, 0.9), (0.2, 0.75, 0.3), (0.6, 0.62, 0.65)
SKIN = (0.93, 0.8, 0.5)
LIGHT = np.array([-0.4, -0.6, -0.7]) / np.linalg.norm([0.4, 0.6, 0.7])  # towards the light, in the camera's frame
MOST_BYTES = 200_000
ASPECT = 0.7  # height of a panel by its width
DPI = 110
FEET = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])  # triangles of a tet


def pixels(camera, points):
    """#P by 2."""
    homogeneous = points @ camera.T
    return homogeneous[:, :2] / homogeneous[:, 2:]


def panels(rows, columns, width=3.0):
    """A figure and its axes, row by row, without frames. The width of a panel is in inches."""
    figure, axes = pyplot.subplots(rows, columns, dpi=DPI, squeeze=False, layout="constrained",
                                   figsize=(width * columns, (width * ASPECT + 0.2) * rows))
    for axis in axes.flat:
        axis.set_axis_off()
    return figure, axes


def frame(axis, camera, clouds, title="", margin=0.08):
    """Shows the part of the image that contains the points of all clouds."""
    places = np.vstack([pixels(camera, cloud) for cloud in clouds])
    low, high = places.min(axis=0), places.max(axis=0)
    middle, size = (low + high) / 2, (high - low) * (1 + 2 * margin)
    width = max(size[0], size[1] / ASPECT)
    axis.set_xlim(middle[0] - width / 2, middle[0] + width / 2)
    axis.set_ylim(middle[1] + width * ASPECT / 2, middle[1] - width * ASPECT / 2)
    axis.set_aspect("equal")
    axis.set_title(title, fontsize=9)


def show_pale_image(axis, image):
    """Gray and bright, so that colours on it are seen."""
    axis.imshow(image.mean(axis=2), interpolation="bicubic", cmap="gray", vmin=-150, vmax=230)


def shaded(camera, vertices, triangles):
    """Outlines [px] and brightness of the triangles that face the camera, the farthest first; and their numbers."""
    corners = vertices[triangles].astype(float)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    normals /= np.where(lengths > 0, lengths, 1)[:, None]
    faces = np.flatnonzero(np.einsum("ij,ij->i", normals, corners[:, 0]) < 0)
    faces = faces[np.argsort(-corners[faces].mean(axis=1)[:, 2])]
    outlines = pixels(camera, corners[faces].reshape(-1, 3)).reshape(-1, 3, 2)
    return outlines, 0.45 + 0.55 * np.clip(normals[faces] @ LIGHT, 0, 1), faces


def show_body(axis, camera, vertices, triangles, color=SKIN, opacity=1.0, edges=None):
    """Faces in one colour, or in one per triangle."""
    outlines, light, faces = shaded(camera, vertices, triangles)
    base = np.broadcast_to(np.asarray(color, float), (len(triangles), 3))[faces]
    fill = np.column_stack([np.clip(base * light[:, None], 0, 1), np.full(len(faces), opacity)])
    seams = fill if opacity == 1.0 else "none"  # without them, the background shines through between faces
    axis.add_collection(PolyCollection(outlines, facecolors=fill, edgecolors=seams if edges is None else edges,
                                       linewidths=0.4))


def blend_body(axis, camera, vertices, triangles, color, opacity, edges=None):
    """The body over what the axis shows already. Nothing that is hidden by the body itself shines through."""
    low, high = sorted(axis.get_xlim()), sorted(axis.get_ylim())
    size = axis.get_window_extent().size / DPI
    figure = pyplot.figure(figsize=size, dpi=2 * DPI)
    layer = figure.add_axes([0, 0, 1, 1])
    layer.set_axis_off()
    layer.set(xlim=axis.get_xlim(), ylim=axis.get_ylim())
    figure.patch.set_alpha(0.0)
    show_body(layer, camera, vertices, triangles, color, edges=edges)
    figure.canvas.draw()
    picture = np.array(figure.canvas.buffer_rgba())
    pyplot.close(figure)
    axis.imshow(picture, extent=(low[0], low[1], high[1], high[0]), alpha=opacity, interpolation="bilinear")


def show_edges(axis, camera, vertices, triangles, color=BLUE, width=0.5):
    """Edges of the triangles that face the camera."""
    outlines, _, _ = shaded(camera, vertices, triangles)
    axis.add_collection(PolyCollection(outlines, facecolors="none", edgecolors=[color], linewidths=width))


def show_tets(axis, camera, vertices, tets, shrink=0.8):
    """Every tet a little smaller, so that the inside shows."""
    corners = vertices[tets]
    middle = corners.mean(axis=1, keepdims=True)
    corners = (middle + shrink * (corners - middle))[:, FEET].reshape(-1, 3)
    show_body(axis, camera, corners, np.arange(len(corners)).reshape(-1, 3), (0.75, 0.8, 0.9), edges=[(0.25, 0.3, 0.5)])


def show_points(axis, camera, points, color, size=3.0):
    places = pixels(camera, points)
    axis.scatter(places[:, 0], places[:, 1], s=size, color=color, linewidths=0)


def show_vectors(axis, camera, moment, size=3.0):
    """Features where they were first seen (red) and where they are (blue), joined by lines."""
    ends = np.stack([pixels(camera, moment.origins), pixels(camera, moment.features)], axis=1)
    axis.add_collection(LineCollection(ends, colors=[BLUE], linewidths=0.5))
    show_points(axis, camera, moment.origins, RED, size)
    show_points(axis, camera, moment.features, BLUE, size)


def save(figure, path, most_bytes=MOST_BYTES):
    """Writes a picture, as sharp as its size allows."""
    for quality in (88, 80, 70, 60, 50):
        figure.savefig(path, pil_kwargs={"quality": quality, "method": 6})
        if path.stat().st_size <= most_bytes:
            break
    pyplot.close(figure)
