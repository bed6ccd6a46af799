#!/usr/bin/env python3
"""Predicts a lift of the body, gripped at five places along its longest axis. Usage: predict_grip.py HEIGHT

HEIGHT is in metres, along z of the states' frame. It is reached in a second. Prints for each place the force on the
gripper, and how far the body reaches along z, half a second later."""
import sys

import numpy as np
import rospy
import softbody

if len(sys.argv) < 2 or sys.argv[1] == "--help":
    sys.exit(__doc__)
rospy.init_node("predict_grip", anonymous=True)
lift = [(1.0, [0, 0, float(sys.argv[1])])]
body = softbody.Body()
rest = body.wait(timeout_s=60).volume.topology.rest_vertices
low, high = rest.min(axis=0) - 0.001, rest.max(axis=0) + 0.001  # [m]
along = np.eye(3)[(high - low).argmax()] * (high - low)
places = np.arange(5) / 5
plans = [softbody.Plan().grip("claw", low + place * along, high - (0.8 - place) * along, path=lift) for place in places]
running = body.predict_plans(plans, [1.5], on_progress=lambda done, total: print(f"{done} of {total}", flush=True))
for place, [end] in zip(places, running.result(timeout_s=60)):
    print(f"gripped at {place:.1f} to {place + 0.2:.1f} of the length: force {end.reactions['claw'][0].round(4)} N, "
          f"the body reaches over {1000 * np.ptp(end.vertices[:, 2]):.0f} mm", flush=True)
