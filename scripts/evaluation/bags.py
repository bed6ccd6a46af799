#!/usr/bin/python3
"""What the evaluation reads from bags of `replay` itself, as JSON. Runs in the environment of the built workspace.

Usage: bags.py spread RESULT.bag...     how far apart the surfaces of several results are [mm]
       bags.py states RESULT.bag        (time since the first state [s], name of the state) of every frame
       bags.py pose RECORDING.bag [FRAME]  true pose of a body in the first frame: position [m] and quaternion
       bags.py start RECORDING.bag      the same from the true surface, which is at rest in the first frame
"""
import json
import sys

import numpy
import rosbag

SURFACE, STATUS = "/softbody/surface/state", "/softbody/status"
SETTLED_S = 0.5
NAMES = ["initializing", "tracking", "degraded", "lost", "recovering"]


def surfaces(path):
    """Vertices [mm] by stamp [s]."""
    with rosbag.Bag(path) as bag:
        return {message.header.stamp.to_sec(): 1e3 * numpy.array([(p.x, p.y, p.z) for p in message.vertices])
                for _, message, _ in bag.read_messages(topics=[SURFACE])}


def spread(paths):
    """The mean distance of the vertices, between the two results of each frame that are farthest apart."""
    results = [surfaces(path) for path in paths]
    common = sorted(set.intersection(*(set(result) for result in results)))
    worst = []
    for stamp in common:
        if stamp < common[0] + SETTLED_S:
            continue
        shapes = [result[stamp] for result in results]
        worst.append(max(numpy.linalg.norm(a - b, axis=1).mean() for i, a in enumerate(shapes) for b in shapes[:i]))
    return {"starts": len(paths), "frames": len(worst), "mean_mm": float(numpy.mean(worst)) if worst else None,
            "max_mm": float(max(worst)) if worst else None}


def states(path):
    with rosbag.Bag(path) as bag:
        found = [(message.header.stamp.to_sec(), NAMES[message.state])
                 for _, message, _ in bag.read_messages(topics=[STATUS])]
    return [(round(stamp - found[0][0], 3), name) for stamp, name in found]


def pose(path, frame="ground_truth_softbody"):
    with rosbag.Bag(path) as bag:
        for _, message, _ in bag.read_messages(topics=["/tf"]):
            for transform in message.transforms:
                if transform.child_frame_id == frame:
                    place, turn = transform.transform.translation, transform.transform.rotation
                    return [place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w]
    return None


def start(path):
    """The rotation of least squares (Kabsch 1976), as a quaternion by its eigenvector (Horn 1987)."""
    with rosbag.Bag(path) as bag:
        def first(topic, field):
            message = next(bag.read_messages(topics=["/ground_truth/surface/" + topic])).message
            return numpy.array([(p.x, p.y, p.z) for p in getattr(message, field)])

        rest, now = first("topology", "rest_vertices"), first("state", "vertices")
    center, place = rest.mean(axis=0), now.mean(axis=0)
    products = (rest - center).T @ (now - place)
    axis = [products[1, 2] - products[2, 1], products[2, 0] - products[0, 2], products[0, 1] - products[1, 0]]
    form = numpy.zeros((4, 4))  # for x y z w
    form[:3, :3] = products + products.T - numpy.trace(products) * numpy.eye(3)
    form[3, :3] = form[:3, 3] = axis
    form[3, 3] = numpy.trace(products)
    turn = numpy.linalg.eigh(form)[1][:, -1]
    x, y, z, w = turn
    rotation = numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    return [*(place - rotation @ center).tolist(), *turn.tolist()]


if __name__ == "__main__":
    command, *files = sys.argv[1:]
    of_one = {"states": states, "pose": pose, "start": start}
    print(json.dumps(spread(files) if command == "spread" else of_one[command](*files)))
