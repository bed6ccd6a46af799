"""What bags have of the body."""
import statistics

import rosbag


def counts(result):
    """Vertices and polygons of the three models of the uncut body, and the median numbers of features that are bound to
    the body and matched in a frame."""
    with rosbag.Bag(str(result)) as bag:
        surface, volume = (next(bag.read_messages(topics=f"/softbody/{body}/topology")).message
                           for body in ("surface", "volume"))
        status = [message for _, message, _ in bag.read_messages(topics="/softbody/status")]
    boundary = {vertex for triangle in volume.surface_triangles for vertex in triangle.vertex_indices}
    return {"sizes": {"High-resolution": [len(surface.rest_vertices), len(surface.triangles)],
                      "Low-resolution": [len(boundary), len(volume.surface_triangles)],
                      "Volumetric": [len(volume.rest_vertices), len(volume.tets)]},
            "features": {"bound": statistics.median(message.features_total for message in status),
                         "matched": statistics.median(message.features_tracked for message in status)}}


def tear_times(result, recording):
    """Times at which a body tears [s from the first frame]: in the truth, and each tear in the result."""
    with rosbag.Bag(str(recording)) as bag:
        bodies = [message for _, message, _ in bag.read_messages(topics="/ground_truth/surface/topology")]
    start = bodies[0].header.stamp
    truth = next(body.header.stamp for body in bodies if body.revision == 1)
    with rosbag.Bag(str(result)) as bag:
        tears = [message.header.stamp for _, message, _ in bag.read_messages(topics="/softbody/cut")]
    return {"truth_s": (truth - start).to_sec(), "tears_s": [(tear - start).to_sec() for tear in tears]}
