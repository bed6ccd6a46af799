#!/usr/bin/env python3
"""Presses a ball into the simulated body, frame by frame. Usage: press_with_ball.py RADIUS DEPTH [SECONDS]

RADIUS and DEPTH are in metres. The ball comes along z from the highest vertex in z, and is taken away at the end."""
import sys

import numpy as np
import rospy
import softbody

if len(sys.argv) < 3:
    sys.exit(__doc__)
rospy.init_node("press_with_ball", anonymous=True)
radius, depth = float(sys.argv[1]), float(sys.argv[2])
body = softbody.Body()
vertices = body.wait(timeout_s=60).vertices
top = vertices[vertices[:, 2].argmax()]
rospy.on_shutdown(lambda: body.release("ball"))
for share in np.linspace(0, 1, int(30 * float(sys.argv[3]) if len(sys.argv) > 3 else 60)):
    centre = top + [0, 0, radius - share * depth]
    body.set_obstacle("ball", "sphere", centre, radius=radius)
    body.wait(after=body.latest())
    nearest = body.closest_point(centre)
    print(f"{1000 * share * depth:.1f} mm deep, {1000 * nearest.distance:.1f} mm from centre to body", flush=True)
