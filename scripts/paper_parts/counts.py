#!/usr/bin/python3
"""What a bag of `replay` has of the body, as JSON: vertices and polygons of the three models, and the median numbers of
features that are bound to the body and matched in a frame. Runs in the environment of the workspace.

Usage: counts.py RESULT.bag
"""
import json
import statistics
import sys

import rosbag

TOPOLOGIES = ("/softbody/surface/topology", "/softbody/volume/topology")
STATUS = "/softbody/status"


def sizes(bag):
    """{model: [vertices, polygons]} of the uncut body."""
    surface, volume = (next(bag.read_messages(topics=topic)).message for topic in TOPOLOGIES)
    boundary = {vertex for triangle in volume.surface_triangles for vertex in triangle.vertex_indices}
    return {"High-resolution": [len(surface.rest_vertices), len(surface.triangles)],
            "Low-resolution": [len(boundary), len(volume.surface_triangles)],
            "Volumetric": [len(volume.rest_vertices), len(volume.tets)]}


def features(bag):
    status = [message for _, message, _ in bag.read_messages(topics=STATUS)]
    return {"bound": statistics.median(message.features_total for message in status),
            "matched": statistics.median(message.features_tracked for message in status)}


def main():
    with rosbag.Bag(sys.argv[1]) as bag:
        print(json.dumps({"sizes": sizes(bag), "features": features(bag)}))


if __name__ == "__main__":
    main()
