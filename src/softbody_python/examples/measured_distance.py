#!/usr/bin/env python3
"""Prints how far measured points are outside of the tracked surface. Usage: measured_distance.py [FRAMES]"""
import collections
import sys

import numpy as np
import rospy
import softbody
from scipy.spatial import cKDTree
from sensor_msgs.msg import PointCloud2

if "--help" in sys.argv:
    sys.exit(__doc__)
rospy.init_node("measured_distance", anonymous=True)
body, state, clouds = softbody.Body(), None, collections.deque(maxlen=10)
rospy.Subscriber("/softbody/points", PointCloud2, clouds.append)
for _ in range(int(sys.argv[1]) if len(sys.argv) > 1 else 10**9):
    state = body.wait(timeout_s=60, after=state)
    for cloud in [cloud for cloud in list(clouds) if cloud.header.stamp == state.stamp]:
        points = np.frombuffer(cloud.data, np.float32).reshape(-1, cloud.point_step // 4)[:, :3].astype(float)
        a, b, c = state.vertices[state.triangles].transpose(1, 0, 2)
        away, near = cKDTree((a + b + c) / 3).query(np.nan_to_num(points, nan=1e3))
        normals = np.cross(b - a, c - a)[near][away < 0.01]  # the others are not of the body
        heights = ((points - a[near])[away < 0.01] * normals).sum(axis=1) / np.linalg.norm(normals, axis=1)
        print(f"{state.time:.3f} s: {len(heights)} points, mean {1000 * heights.mean():+.2f} mm", flush=True)
