"""What bags have of the body."""
import statistics

from evaluation.bags import messages


def counts(result):
    """Vertices and polygons of the three models of the uncut body, and the median numbers of features that are bound to
    the body and matched in a frame."""
    surface, volume = (next(messages(result, f"/softbody/{body}/topology")) for body in ("surface", "volume"))
    status = list(messages(result, "/softbody/status"))
    boundary = {vertex for triangle in volume.surface_triangles for vertex in triangle.vertex_indices}
    return {"sizes": {"High-resolution": [len(surface.rest_vertices), len(surface.triangles)],
                      "Low-resolution": [len(boundary), len(volume.surface_triangles)],
                      "Volumetric": [len(volume.rest_vertices), len(volume.tets)]},
            "features": {"bound": statistics.median(message.features_total for message in status),
                         "matched": statistics.median(message.features_tracked for message in status)}}


def tear_times(result, recording):
    """Times at which a body tears [s from the first frame]: in the truth, and each tear in the result."""
    bodies = list(messages(recording, "/ground_truth/surface/topology"))
    start = bodies[0].header.stamp
    truth = next(body.header.stamp for body in bodies if body.revision == 1)
    tears = [message.header.stamp for message in messages(result, "/softbody/cut")]
    return {"truth_s": (truth - start).to_sec(), "tears_s": [(tear - start).to_sec() for tear in tears]}
