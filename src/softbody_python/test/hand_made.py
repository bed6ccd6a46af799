"""Messages of a body that is made by hand: random, but the same for the same seed."""
import io

import genpy
import numpy as np
import rosbag
from geometry_msgs.msg import Point32
from shape_msgs.msg import MeshTriangle
from softbody_msgs.msg import MeshState, MeshTopology, Tetrahedron, TetTopology

VERTICES, TRIANGLES, TETS = 12, 20, 6
START = genpy.Time(1600000000, 5)
PERIOD_NS = 33333333


def stamp_of(frame):
    return START + genpy.Duration(0, frame * PERIOD_NS)


def points(rows):
    return [Point32(*row) for row in rows]


def distinct_rows(random, count, limit, columns):
    return [random.choice(limit, columns, replace=False).tolist() for _ in range(count)]


def surface_topology(seed, revision=0, frame=0, has_texture=True):
    random = np.random.default_rng((seed, 1, revision))
    count, triangles = VERTICES + revision, TRIANGLES + 2 * revision
    message = MeshTopology(revision=revision, rest_vertices=points(random.normal(size=(count, 3))),
                           triangles=[MeshTriangle(row) for row in distinct_rows(random, triangles, count, 3)],
                           vertex_parents=random.integers(-1, 9, count).tolist(),
                           triangle_bodies=random.integers(0, 1 + revision, triangles).tolist(),
                           cut_triangles=(random.random(triangles) < (0.3 if revision else 0)).tolist())
    if has_texture:
        # Some corners of a vertex share their texture coordinates, others do not.
        message.texture_coordinates = points(np.c_[random.integers(0, 3, (3 * triangles, 2)) / 2, np.zeros(3 * triangles)])
    message.header.stamp, message.header.frame_id = stamp_of(frame), "softbody"
    return message


def volume_topology(seed, revision=0, frame=0):
    random = np.random.default_rng((seed, 2, revision))
    count = VERTICES + 2 * revision
    message = TetTopology(revision=revision, rest_vertices=points(random.normal(size=(count, 3))),
                          tets=[Tetrahedron(row) for row in distinct_rows(random, TETS, count, 4)],
                          surface_triangles=[MeshTriangle(row) for row in distinct_rows(random, 8, count, 3)],
                          vertex_parents=random.integers(-1, 9, count).tolist(),
                          tet_bodies=random.integers(0, 1 + revision, TETS).tolist())
    message.header.stamp, message.header.frame_id = stamp_of(frame), "softbody"
    message.initial_pose.position.x, message.initial_pose.orientation.w = 0.25, 1.0
    return message


def mesh_state(seed, frame, revision, count, has_estimates=True):
    random = np.random.default_rng((seed, 3, frame, count))
    message = MeshState(observed=stamp_of(frame - 1), revision=revision,
                        vertices=points(random.normal(size=(count, 3)) * 0.1 + [0, 0, 0.5]))
    if has_estimates:
        message.confidence, message.standard_deviation = random.random(count).tolist(), random.random(count).tolist()
    message.header.stamp, message.header.frame_id = stamp_of(frame), "camera_color_optical_frame"
    return message


def surface_state(seed, frame, revision):
    return mesh_state(seed, frame, revision, VERTICES + revision)


def volume_state(seed, frame, revision):
    return mesh_state(seed, frame, revision, VERTICES + 2 * revision)


def data_of(message):
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def array(points_of_message):
    return np.array([[p.x, p.y, p.z] for p in points_of_message], np.float32)


def write_bag(path, revisions, seed=1, has_texture=True):
    """A result with one frame per entry of `revisions`. Topologies come when the revision changes."""
    with rosbag.Bag(path, "w") as bag:
        for frame, revision in enumerate(revisions):
            stamp = stamp_of(frame)
            if frame == 0 or revision != revisions[frame - 1]:
                bag.write("/softbody/volume/topology", volume_topology(seed, revision, frame), stamp)
                bag.write("/softbody/surface/topology", surface_topology(seed, revision, frame, has_texture), stamp)
            bag.write("/softbody/volume/state", volume_state(seed, frame, revision), stamp)
            bag.write("/softbody/surface/state", surface_state(seed, frame, revision), stamp)
