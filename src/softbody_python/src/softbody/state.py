"""States of the tracked body as numpy arrays.

Arrays that come from messages are read-only, because states share them. Copy an array before you change it. Positions
are float32, in metres.
"""
import dataclasses
from typing import Optional

import genpy
import numpy as np


@dataclasses.dataclass(frozen=True, eq=False)
class SurfaceTopology:
    """The visual mesh at rest, in one revision (MeshTopology)."""

    stamp: genpy.Time                            # of the first frame with this topology
    frame: str                                   # of rest_vertices
    revision: int                                # 0 as loaded; each edit adds 1
    rest_vertices: np.ndarray                    # N x 3 [m]
    triangles: np.ndarray                        # F x 3, counter-clockwise seen from outside
    vertex_parents: np.ndarray                   # N: index in the input file; -1: made by a cut
    triangle_pieces: np.ndarray                  # F: number of the piece, from 0
    cut_triangles: np.ndarray                    # F, bool: fills a cut
    texture_coordinates: Optional[np.ndarray]    # F x 3 x 2, v upwards; None: the mesh has none
    vertex_pieces: np.ndarray                    # N: number of the piece; -1: in no triangle


@dataclasses.dataclass(frozen=True, eq=False)
class VolumeTopology:
    """The tets at rest, in one revision (TetTopology)."""

    stamp: genpy.Time
    frame: str
    revision: int
    rest_vertices: np.ndarray                    # M x 3 [m]
    tets: np.ndarray                             # T x 4
    surface_triangles: np.ndarray                # B x 3: the boundary of the tets
    vertex_parents: np.ndarray                   # M: index in revision 0; -1: made by a cut
    tet_pieces: np.ndarray                       # T: number of the piece, from 0
    vertex_pieces: np.ndarray                    # M: number of the piece; -1: in no tet
    initial_pose: np.ndarray                     # x, y, z [m], quaternion x, y, z, w; all 0: unknown


@dataclasses.dataclass(frozen=True, eq=False)
class Volume:
    """The tets at one instant."""

    vertices: np.ndarray                         # M x 3 [m]
    confidence: Optional[np.ndarray]             # M, 0 to 1; None: not estimated
    standard_deviation: Optional[np.ndarray]     # M [m]; None: not estimated
    topology: VolumeTopology

    @property
    def tets(self):
        return self.topology.tets

    @property
    def tet_pieces(self):
        return self.topology.tet_pieces


@dataclasses.dataclass(frozen=True, eq=False)
class State:
    """The body at one instant. Positions and topologies always have the same revision."""

    stamp: genpy.Time                            # of the colour image, or the simulated instant
    observed: genpy.Time                         # stamp of the last image that was used
    frame: str                                   # of the vertices
    revision: int
    vertices: np.ndarray                         # N x 3 [m]
    confidence: Optional[np.ndarray]             # N, 0 to 1; None: not estimated
    standard_deviation: Optional[np.ndarray]     # N [m]; None: not estimated
    topology: SurfaceTopology
    volume: Optional[Volume]                     # None: no volume state of this stamp and revision is known

    @property
    def time(self):
        """The stamp in seconds."""
        return self.stamp.to_sec()

    @property
    def rest_vertices(self):
        return self.topology.rest_vertices

    @property
    def triangles(self):
        return self.topology.triangles

    @property
    def texture_coordinates(self):
        return self.topology.texture_coordinates

    @property
    def cut_triangles(self):
        return self.topology.cut_triangles

    @property
    def triangle_pieces(self):
        return self.topology.triangle_pieces

    @property
    def vertex_pieces(self):
        return self.topology.vertex_pieces
