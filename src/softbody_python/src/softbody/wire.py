"""Messages of softbody_msgs, from their bytes to numpy arrays.

rospy makes one Python object of each point. For a mesh of 20,000 vertices this takes longer than a frame lasts. Here an
array is a view of the bytes of the message.
"""
import dataclasses
import struct
from typing import Optional

import genpy
import numpy as np
from softbody_msgs.msg import MeshState, MeshTopology, TetTopology

from softbody.state import SurfaceTopology, VolumeTopology


class WrongMessage(ValueError):
    """A message that contradicts itself, or is of another version of softbody_msgs."""


@dataclasses.dataclass(frozen=True, eq=False)
class Positions:
    """A MeshState: positions without their topology."""

    stamp: genpy.Time
    observed: genpy.Time
    frame: str
    revision: int
    vertices: np.ndarray
    confidence: Optional[np.ndarray]
    standard_deviation: Optional[np.ndarray]


class _Reader:
    def __init__(self, data):
        self.data, self.place = data, 0

    def values(self, layout):
        """Single values. @param layout as of struct, without byte order."""
        values = struct.unpack_from("<" + layout, self.data, self.place)
        self.place += struct.calcsize("<" + layout)
        return values

    def time(self):
        return genpy.Time(*self.values("II"))

    def header(self):
        """(stamp, frame_id)."""
        self.values("I")
        stamp, length = self.time(), self.values("I")[0]
        frame = bytes(self.data[self.place:self.place + length])
        self.place += length
        return stamp, frame.decode()

    def rows(self, kind, columns=1):
        """An array of the message: n, or n x columns if there are several."""
        kind, count = np.dtype(kind), self.values("I")[0]
        array = np.frombuffer(self.data, kind, count * columns, self.place)
        self.place += array.nbytes
        return array if columns == 1 else array.reshape(count, columns)


def _demand(condition, what):
    if not condition:
        raise WrongMessage(what)


LARGEST_COORDINATE_M = 1e4  # as the nodes: single precision is coarse beyond


def _check_range(values, low, high, name):
    wrong = np.flatnonzero(~((values >= low) & (values <= high)))
    if len(wrong):
        raise WrongMessage(f"{name}[{wrong[0]}] is {values[wrong[0]]:g}; allowed: {low:g} to {high:g}")


def _check_points(points, name):
    wrong = np.flatnonzero(~(np.abs(points) <= LARGEST_COORDINATE_M).all(axis=1))
    if len(wrong):
        place = ", ".join(f"{value:g}" for value in points[wrong[0]])
        raise WrongMessage(f"{name}[{wrong[0]}] is ({place}); allowed: finite, within {LARGEST_COORDINATE_M:g} m of the origin")


def _check_elements(elements, pieces, count, name):
    """Elements are triangles or tets. @param count of the vertices."""
    _demand(len(elements) == 0 or elements.max() < count, f"{name} names a vertex that does not exist; {count} do")
    _demand(pieces is None or len(pieces) == len(elements), f"{name} and their pieces differ in number")


def _vertex_pieces(elements, pieces, count):
    result = np.full(count, -1, np.int32)
    result[elements.ravel()] = np.repeat(pieces, elements.shape[1])
    result.flags.writeable = False
    return result


def _texture_coordinates(rows, triangle_count):
    if len(rows) == 0:
        return None
    _demand(len(rows) == 3 * triangle_count, "texture_coordinates are not three per triangle")
    return rows.reshape(triangle_count, 3, 3)[:, :, :2]


def _surface_topology(reader):
    stamp, frame = reader.header()
    revision = reader.values("I")[0]
    rest, triangles = reader.rows("<f4", 3), reader.rows("<u4", 3)
    parents, pieces, cut = reader.rows("<i4"), reader.rows("<u4"), reader.rows("?")
    texture = _texture_coordinates(reader.rows("<f4", 3), len(triangles))
    _check_points(rest, "rest_vertices")
    _check_elements(triangles, pieces, len(rest), "triangles")
    _demand(len(parents) == len(rest), "vertex_parents and rest_vertices differ in number")
    _demand(len(cut) == len(triangles), "cut_triangles and triangles differ in number")
    return SurfaceTopology(stamp, frame, revision, rest, triangles, parents, pieces, cut, texture,
                           _vertex_pieces(triangles, pieces, len(rest)))


def _volume_topology(reader):
    stamp, frame = reader.header()
    revision = reader.values("I")[0]
    rest, tets, surface = reader.rows("<f4", 3), reader.rows("<u4", 4), reader.rows("<u4", 3)
    parents, pieces = reader.rows("<i4"), reader.rows("<u4")
    pose = np.array(reader.values("7d"))
    _check_points(rest, "rest_vertices")
    _check_elements(tets, pieces, len(rest), "tets")
    _check_elements(surface, None, len(rest), "surface_triangles")
    _demand(len(parents) == len(rest), "vertex_parents and rest_vertices differ in number")
    return VolumeTopology(stamp, frame, revision, rest, tets, surface, parents, pieces,
                          _vertex_pieces(tets, pieces, len(rest)), pose)


def _positions(reader):
    stamp, frame = reader.header()
    observed, revision = reader.time(), reader.values("I")[0]
    vertices, *estimates = reader.rows("<f4", 3), reader.rows("<f4"), reader.rows("<f4")
    _check_points(vertices, "vertices")
    _demand(len(vertices) < 2 or (vertices != vertices[0]).any(), "all vertices are at one place")
    for values, name in zip(estimates, ("confidence", "standard_deviation")):
        _demand(len(values) in (0, len(vertices)), f"{name} and vertices differ in number")
    _check_range(estimates[0], 0.0, 1.0, "confidence")
    _check_range(estimates[1], 0.0, LARGEST_COORDINATE_M, "standard_deviation")
    return Positions(stamp, observed, frame, revision, vertices,
                     *(values if len(values) else None for values in estimates))


_DECODERS = {MeshTopology._type: (MeshTopology._md5sum, _surface_topology),
             TetTopology._type: (TetTopology._md5sum, _volume_topology),
             MeshState._type: (MeshState._md5sum, _positions)}


def decode(kind, md5sum, data):
    """SurfaceTopology, VolumeTopology or Positions of the bytes of a message.

    @param kind e.g. "softbody_msgs/MeshState". @param md5sum of the sender's or the bag's definition.
    @throw WrongMessage, with the reason.
    """
    _demand(kind in _DECODERS, f"the type is {kind}; known are {', '.join(_DECODERS)}")
    own_md5sum, decoder = _DECODERS[kind]
    _demand(md5sum == own_md5sum, f"it is of another version of {kind}; record it again with this version")
    reader = _Reader(data)
    try:
        result = decoder(reader)
    except WrongMessage:
        raise
    except (struct.error, ValueError) as error:
        raise WrongMessage(f"{kind}: the message is cut off or damaged ({error})") from error
    _demand(reader.place == len(data), f"{kind}: {len(data) - reader.place} bytes too many")
    return result
