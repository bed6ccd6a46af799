#!/usr/bin/env python3
"""Predicts the force on a pin that lifts the body by 1 to 5 cm in a second. Usage: predict_lift.py PIN [AXIS]

PIN is the name of a pin, set before. AXIS (x, y or z, default z) is an axis of the states' frame."""
import sys

import numpy as np
import rospy
import softbody

if len(sys.argv) < 2 or sys.argv[1] == "--help":
    sys.exit(__doc__)
rospy.init_node("predict_lift", anonymous=True)
pin, axis = sys.argv[1], np.eye(3)["xyz".index(sys.argv[2] if len(sys.argv) > 2 else "z")]
heights = [0.01, 0.02, 0.03, 0.04, 0.05]  # [m]
for height, [end] in zip(heights, softbody.Body().predict([{pin: [(1.0, h * axis)]} for h in heights], [1.0])):
    print(f"{height:.2f} m: force on {pin} {end.reactions[pin][0].round(4)} N", flush=True)
