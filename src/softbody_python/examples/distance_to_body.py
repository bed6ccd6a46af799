#!/usr/bin/env python3
"""Prints the distance of a point to the tracked body, frame by frame. Usage: distance_to_body.py X Y Z [FRAMES]

X Y Z are in metres, in the frame of the states. The distance is that to the nearest vertex."""
import sys

import numpy as np
import rospy
import softbody
from scipy.spatial import cKDTree

if len(sys.argv) < 4:
    sys.exit(__doc__)
rospy.init_node("distance_to_body", anonymous=True)
point = np.array(sys.argv[1:4], float)
body, state = softbody.Body(), None
for _ in range(int(sys.argv[4]) if len(sys.argv) > 4 else 10**9):
    state = body.wait(after=state)
    distance, vertex = cKDTree(state.vertices).query(point)
    deviation = state.standard_deviation[vertex] if state.standard_deviation is not None else np.nan
    print(f"{state.time:.3f} s: {1000 * distance:.1f} mm to vertex {vertex} of piece {state.vertex_pieces[vertex]}, "
          f"standard deviation {1000 * deviation:.1f} mm", flush=True)
