"""The pictures of docs/scanning.md. Usage: scan.py WALK.bag MODEL FOLDER; MODEL is a folder that scan_model wrote."""
import pathlib
import sys

import numpy as np
import rosbag
from drawing import RED, frame, panels, save, show_body
from matplotlib import pyplot

COLOR = "/camera/color/image_raw"
SHOWN = 150  # number of the shown image
SIDES = {"from the left": (-0.5, -1.0, 0.7), "from the right": (1.0, 0.6, 0.7), "from below": (-0.9, -0.5, -1.0)}
CAMERA = np.eye(3)
PALE = (0.8, 0.82, 0.85)
BRIGHTER = 1.4  # the picture on the model has the shadows of the recording, and is shaded again


def read_image(bag):
    """One colour image of the recording, RGB."""
    with rosbag.Bag(str(bag)) as opened:
        for number, (_, message, _) in enumerate(opened.read_messages(topics=COLOR)):
            if number == SHOWN:
                return np.frombuffer(message.data, np.uint8).reshape(message.height, message.width, 3)
    raise ValueError(f"{bag}: has fewer than {SHOWN + 1} images")


def read_obj(path):
    """Vertices, triangles and the texture coordinates of their corners, F x 3 x 2."""
    lines = [line.split() for line in path.read_text(encoding="utf-8").splitlines()]
    rows = {key: np.array([line[1:] for line in lines if line[:1] == [key]]) for key in ("v", "vt", "f")}
    corners = np.array([corner.split("/")[:2] for corner in rows["f"].ravel()], int).reshape(-1, 3, 2) - 1
    return rows["v"].astype(float), corners[..., 0], rows["vt"].astype(float)[corners[..., 1]]


def read_scan(path):
    """Vertices, how far they were seen (0 to 1), and triangles of scan.ply."""
    header, body = path.read_bytes().split(b"end_header\n", 1)
    vertices, triangles = (int(line.split()[2]) for line in header.decode().splitlines() if line.startswith("element"))
    points = np.frombuffer(body, "<f4", 4 * vertices).reshape(-1, 4)
    faces = np.frombuffer(body, np.dtype([("count", "u1"), ("corners", "<i4", 3)]), triangles, points.nbytes)
    return points[:, :3].astype(float), points[:, 3], faces["corners"]


def looked_at(vertices, side):
    """The vertices in the frame of a camera that looks from a side (x, y, z up) at their middle."""
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    forward = -np.array(side) / np.linalg.norm(side)
    right = np.cross(forward, (0.0, 0.0, 1.0))
    right /= np.linalg.norm(right)
    axes = np.stack([right, np.cross(forward, right), forward])
    return (vertices - (low + high) / 2) @ axes.T + (0.0, 0.0, 4.0 * np.linalg.norm(high - low))


def divided(corners):
    """Each triangle F x 3 x D as four."""
    middles = (corners + np.roll(corners, -1, axis=1)) / 2
    outer = [np.stack([corners[:, k], middles[:, k], middles[:, k - 1]], axis=1) for k in range(3)]
    return np.concatenate([*outer, middles])


def textured(folder):
    """Vertices, triangles and a colour for each of the painted model."""
    vertices, triangles, coordinates = read_obj(folder / "visual.obj")
    picture = pyplot.imread(folder / "visual.png")[..., :3]
    corners, coordinates = divided(vertices[triangles]), divided(coordinates).mean(axis=1)
    rows, columns = picture.shape[:2]
    u = np.clip((coordinates[:, 0] * columns).astype(int), 0, columns - 1)
    v = np.clip(((1.0 - coordinates[:, 1]) * rows).astype(int), 0, rows - 1)
    return corners.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3), BRIGHTER * picture[v, u]


def seen_colors(folder):
    """Vertices, triangles and a colour for each: grey where the surface was seen, red where it was not."""
    vertices, seen, triangles = read_scan(folder / "scan.ply")
    share = seen[triangles].mean(axis=1)[:, None]
    return vertices, triangles, share * np.array(PALE) + (1.0 - share) * np.array(RED)


def sides(vertices, triangles, colors):
    """A figure of a body from all sides."""
    figure, axes = panels(1, len(SIDES))
    for axis, (words, side) in zip(axes[0], SIDES.items()):
        seen = looked_at(vertices, side)
        frame(axis, CAMERA, [seen], words, 0.01)
        show_body(axis, CAMERA, seen, triangles, colors)
    return figure


def main():
    bag, folder, output = map(pathlib.Path, sys.argv[1:])
    walk, axes = panels(1, 1, 4.6)
    axes[0][0].imshow(read_image(bag), interpolation="bicubic")
    save(walk, output / "scan_walk.webp")
    save(sides(*textured(folder)), output / "scan_model.webp")
    save(sides(*seen_colors(folder)), output / "scan_seen.webp")


main()
