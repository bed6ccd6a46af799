"""What results have beside the reports of `evaluate`: counts, times of tears, and the quality of cuts.

That is the shape of the triangles at the cut, holes, change of the volume, and times in a bag of `replay --timing`.
"Before" are the triangles of the uncut surface that a plane through the cut splits. "After" are the triangles of the
skin that touch the cut. "Faces" are the triangles of the faces of the cut.
"""
import statistics

import numpy as np

from evaluation.bags import messages

SHARP_DEG = 10.0
NARROW_DEG = 20.0


def least_angles(corners):
    """The least angle of each triangle [degrees]. @param corners: F x 3 x 3."""
    edges = np.roll(corners, -1, axis=1) - corners
    units = edges / np.maximum(np.linalg.norm(edges, axis=2, keepdims=True), 1e-12)
    cosines = -np.einsum("fij,fij->fi", units, np.roll(units, 1, axis=1))
    return np.degrees(np.arccos(np.clip(cosines, -1, 1))).min(axis=1)


def split(corners, heights):
    """The triangles into which the plane of height 0 splits a triangle: one on one side, two on the other."""
    alone = np.flatnonzero(np.sign(heights) == -np.sign(np.sign(heights).sum()))[0]
    order = [alone, (alone + 1) % 3, (alone + 2) % 3]
    (a, b, c), (ha, hb, hc) = corners[order], heights[order]
    ab, ac = a + (b - a) * ha / (ha - hb), a + (c - a) * ha / (ha - hc)
    return [[a, ab, ac], [ab, b, c], [ab, c, ac]]


def before(uncut, cut):
    """Triangles that the plane through the faces of the cut makes from the uncut surface."""
    places = cut.rest_vertices[np.unique(cut.triangles[cut.cut_triangles])].astype(float)
    middle = places.mean(axis=0)
    normal = np.linalg.svd(places - middle)[2][2]
    corners = uncut.rest_vertices[uncut.triangles].astype(float)
    heights = (corners - middle) @ normal
    crossed = (heights.min(axis=1) < 0) & (heights.max(axis=1) > 0)
    return np.array([piece for triangle, height in zip(corners[crossed], heights[crossed])
                     for piece in split(triangle, height)])


def volume(surface):
    """[m^3]"""
    corners = surface.rest_vertices[surface.triangles].astype(float)
    return float(np.linalg.det(corners).sum() / 6)


def cut_times(result):
    """Times of the frames in which a cut was made [ms]."""
    stamps = {message.header.stamp for message in messages(result, "/softbody/cut")}
    return [row.milliseconds for message in messages(result, "/softbody/timing") for row in message.stages
            if message.header.stamp in stamps and row.stage == "Cutting"]


def of_triangles(corners):
    angles = least_angles(corners)
    return {"triangles": len(angles), "least_deg": angles.min(), "sharp_share": float((angles < SHARP_DEG).mean()),
            "narrow_share": float((angles < NARROW_DEG).mean())}


def cut_quality(result):
    import softbody  # in the built workspace

    topologies = [state.topology for state in softbody.read(str(result))]
    uncut, cut = topologies[0], topologies[-1]
    times = cut_times(result)
    corners, of_cut = cut.rest_vertices[cut.triangles].astype(float), cut.cut_triangles
    edges = np.sort(np.concatenate([cut.triangles[:, pair] for pair in ([0, 1], [1, 2], [2, 0])]), axis=1)
    holes = np.unique(edges, axis=0, return_counts=True)[1] != 2  # edges of not exactly two triangles
    touches = np.isin(cut.triangles, np.unique(cut.triangles[of_cut])).any(axis=1)
    return {"before": of_triangles(before(uncut, cut)), "after": of_triangles(corners[touches & ~of_cut]),
            "faces": of_triangles(corners[of_cut]), "holes": int(holes.sum()),
            "volume_change": volume(cut) / volume(uncut) - 1,
            "cuts": len(times), "median_ms": float(np.median(times)), "worst_ms": max(times)}


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
