#!/usr/bin/env python3
"""Draws the centre and the curvature of a body over time. Usage: centre_and_curvature.py RESULT.bag PICTURE.png"""
import sys

import matplotlib.pyplot as plt
import numpy as np
import softbody

rows = []
for state in softbody.read(sys.argv[1]):
    corners = state.volume.vertices[state.volume.tets].astype(float)          # T x 4 x 3
    centre = np.average(corners.mean(axis=1), axis=0, weights=abs(np.linalg.det(corners[:, 1:] - corners[:, :1])))
    x = state.rest_vertices[:, np.ptp(state.rest_vertices, axis=0).argmax()]  # along the longest axis at rest
    a, b, c = (state.vertices[abs(x - place) < 0.1 * np.ptp(x)].mean(axis=0)  # three points of the centre line
               for place in (x.min(), (x.min() + x.max()) / 2, x.max()))
    twice_area, sides = np.linalg.norm(np.cross(b - a, c - a)), [np.linalg.norm(s) for s in (b - a, c - b, a - c)]
    rows.append([state.time, *centre, 2 * twice_area / np.prod(sides)])       # 1 / radius of the circle through them
time, *centre, curvature = np.array(rows).T
_, (above, below) = plt.subplots(2)
above.plot(time - time[0], 1000 * (np.transpose(centre) - rows[0][1:4]), label=["x", "y", "z"])
above.set(ylabel="motion of the centre [mm]")
above.legend()
below.plot(time - time[0], curvature)
below.set(ylabel="curvature [1/m]", xlabel="time [s]")
plt.savefig(sys.argv[2])
