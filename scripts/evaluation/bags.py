"""What the evaluation reads from bags itself."""
import itertools

import numpy
import rosbag
from scipy.spatial.transform import Rotation

SETTLED_S = 0.5
NAMES = ["initializing", "tracking", "degraded", "lost", "recovering"]


def messages(path, topic):
    """The messages of a topic in a bag."""
    with rosbag.Bag(str(path)) as bag:
        for _, message, _ in bag.read_messages(topics=[topic]):
            yield message


def places(points):
    return numpy.array([(p.x, p.y, p.z) for p in points])


def spread(*paths):
    """How far apart the surfaces of several results are: the mean distance of the vertices, between the two results of
    each frame that are farthest apart."""
    results = [{message.header.stamp.to_sec(): 1e3 * places(message.vertices)  # [mm]
                for message in messages(path, "/softbody/surface/state")} for path in paths]
    common = sorted(set.intersection(*map(set, results)))
    worst = [max(numpy.linalg.norm(a[stamp] - b[stamp], axis=1).mean() for a, b in itertools.combinations(results, 2))
             for stamp in common if stamp >= common[0] + SETTLED_S]
    return {"starts": len(paths), "frames": len(worst), "mean_mm": float(numpy.mean(worst)) if worst else None,
            "max_mm": float(max(worst)) if worst else None}


def states(path):
    """(time since the first state [s], name of the state) of every frame."""
    found = [(message.header.stamp.to_sec(), NAMES[message.state]) for message in messages(path, "/softbody/status")]
    return [(round(stamp - found[0][0], 3), name) for stamp, name in found]


def pose(path, frame="ground_truth_softbody"):
    """True pose of a body in the first frame of a recording."""
    found = next(each.transform for message in messages(path, "/tf") for each in message.transforms
                 if each.child_frame_id == frame)
    place, turn = found.translation, found.rotation
    return [place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w]


def start(path):
    """The same from the true surface, which is at rest there: the rotation of least squares."""
    rest = places(next(messages(path, "/ground_truth/surface/topology")).rest_vertices)
    now = places(next(messages(path, "/ground_truth/surface/state")).vertices)
    rotation, _ = Rotation.align_vectors(now - now.mean(axis=0), rest - rest.mean(axis=0))
    return [*(now.mean(axis=0) - rotation.apply(rest.mean(axis=0))).tolist(), *rotation.as_quat().tolist()]
