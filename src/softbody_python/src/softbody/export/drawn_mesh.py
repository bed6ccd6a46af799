"""The surface as a graphics card draws it: one texture coordinate per vertex, one material per part."""
import dataclasses
from typing import Optional

import numpy as np

# Linear RGB of the pieces, repeated from the first.
PIECE_COLORS = np.array([[203, 131, 60], [52, 116, 168], [79, 143, 58], [164, 66, 74], [122, 88, 160], [180, 168, 52]], np.uint8)


@dataclasses.dataclass(frozen=True, eq=False)
class Part:
    """The triangles of one material."""

    material: str                     # "body" or "cut"
    vertices: np.ndarray              # per drawn vertex: the vertex of the mesh
    triangles: np.ndarray             # F x 3 drawn vertices
    texture: Optional[np.ndarray]     # per drawn vertex: u, v downwards as in glTF; None: no image
    colors: Optional[np.ndarray]      # per drawn vertex: RGBA, uint8; None: the image has the colours


def parts_of(topology, has_image):
    """The parts that have triangles. A vertex on a seam of the texture is drawn several times."""
    parts = []
    for material, chosen in (("body", ~topology.cut_triangles), ("cut", topology.cut_triangles)):
        triangles = topology.triangles[chosen]
        if len(triangles) == 0:
            continue
        if material == "body" and has_image and topology.texture_coordinates is not None:
            parts.append(_textured(triangles, topology.texture_coordinates[chosen]))
        else:
            vertices, drawn = np.unique(triangles, return_inverse=True)
            colors = _colors(topology.vertex_pieces[vertices]) if material == "body" else None
            parts.append(Part(material, vertices, drawn.reshape(-1, 3).astype(np.uint32), None, colors))
    return parts


def _textured(triangles, texture):
    corners = np.empty((triangles.size, 3), np.uint32)
    corners[:, 0] = triangles.ravel()
    corners[:, 1:] = np.ascontiguousarray(texture, np.float32).reshape(-1, 2).view(np.uint32)
    rows, drawn = np.unique(corners, axis=0, return_inverse=True)
    coordinates = np.ascontiguousarray(rows[:, 1:]).view(np.float32) * np.float32([1, -1]) + np.float32([0, 1])
    return Part("body", rows[:, 0], drawn.reshape(-1, 3).astype(np.uint32), coordinates, None)


def _colors(pieces):
    colors = np.full((len(pieces), 4), 255, np.uint8)
    colors[:, :3] = PIECE_COLORS[pieces % len(PIECE_COLORS)]
    return colors
