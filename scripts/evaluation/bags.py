"""What the evaluation reads from bags itself."""
import itertools

import numpy
import rosbag
from scipy.spatial.transform import Rotation

SURFACE, STATUS = "/softbody/surface/state", "/softbody/status"
SETTLED_S = 0.5
NAMES = ["initializing", "tracking", "degraded", "lost", "recovering"]


def surfaces(path):
    """Vertices [mm] by stamp [s]."""
    with rosbag.Bag(str(path)) as bag:
        return {message.header.stamp.to_sec(): 1e3 * numpy.array([(p.x, p.y, p.z) for p in message.vertices])
                for _, message, _ in bag.read_messages(topics=[SURFACE])}


def spread(*paths):
    """How far apart the surfaces of several results are: the mean distance of the vertices, between the two results of
    each frame that are farthest apart."""
    results = [surfaces(path) for path in paths]
    common = sorted(set.intersection(*map(set, results)))
    worst = [max(numpy.linalg.norm(a[stamp] - b[stamp], axis=1).mean() for a, b in itertools.combinations(results, 2))
             for stamp in common if stamp >= common[0] + SETTLED_S]
    return {"starts": len(paths), "frames": len(worst), "mean_mm": float(numpy.mean(worst)) if worst else None,
            "max_mm": float(max(worst)) if worst else None}


def states(path):
    """(time since the first state [s], name of the state) of every frame."""
    with rosbag.Bag(str(path)) as bag:
        found = [(message.header.stamp.to_sec(), NAMES[message.state])
                 for _, message, _ in bag.read_messages(topics=[STATUS])]
    return [(round(stamp - found[0][0], 3), name) for stamp, name in found]


def pose(path, frame="ground_truth_softbody"):
    """True pose of a body in the first frame of a recording."""
    with rosbag.Bag(str(path)) as bag:
        found = next(each.transform for _, message, _ in bag.read_messages(topics=["/tf"])
                     for each in message.transforms if each.child_frame_id == frame)
    place, turn = found.translation, found.rotation
    return [place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w]


def start(path):
    """The same from the true surface, which is at rest there: the rotation of least squares."""
    with rosbag.Bag(str(path)) as bag:
        def first(topic, field):
            message = next(bag.read_messages(topics=["/ground_truth/surface/" + topic])).message
            return numpy.array([(p.x, p.y, p.z) for p in getattr(message, field)])

        rest, now = first("topology", "rest_vertices"), first("state", "vertices")
    rotation, _ = Rotation.align_vectors(now - now.mean(axis=0), rest - rest.mean(axis=0))
    return [*(now.mean(axis=0) - rotation.apply(rest.mean(axis=0))).tolist(), *rotation.as_quat().tolist()]
