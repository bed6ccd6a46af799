#!/usr/bin/python3
"""Vertices and polygons of the three models in a bag of `replay`, as JSON. Runs in the environment of the workspace.

Usage: sizes.py RESULT.bag
"""
import json
import sys

import rosbag

TOPICS = ("/softbody/surface/topology", "/softbody/volume/topology")

with rosbag.Bag(sys.argv[1]) as bag:
    first = {}
    for topic, message, _ in bag.read_messages(topics=TOPICS):
        first.setdefault(topic, message)
surface, volume = (first[topic] for topic in TOPICS)
boundary = {vertex for triangle in volume.surface_triangles for vertex in triangle.vertex_indices}
print(json.dumps({"High-resolution": [len(surface.rest_vertices), len(surface.triangles)],
                  "Low-resolution": [len(boundary), len(volume.surface_triangles)],
                  "Volumetric": [len(volume.rest_vertices), len(volume.tets)]}))
