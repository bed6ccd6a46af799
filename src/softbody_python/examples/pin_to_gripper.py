#!/usr/bin/env python3
"""Lets an end of the body follow a gripper. Usage: pin_to_gripper.py FRAME [SECONDS]

FRAME is the gripper's frame on tf. The end is the lowest tenth along the longest axis at rest. It is let go after
SECONDS, or when the program ends."""
import sys

import rospy
import softbody

if len(sys.argv) < 2 or sys.argv[1] == "--help":
    sys.exit(__doc__)
rospy.init_node("pin_to_gripper", anonymous=True)
body = softbody.Body()
rest = body.wait(timeout_s=60).volume.topology.rest_vertices
low, high = rest.min(axis=0) - 0.001, rest.max(axis=0) + 0.001  # [m]
axis = (high - low).argmax()
high[axis] = low[axis] + 0.1 * (high - low)[axis]
count = body.pin("gripper", low, high, frame=sys.argv[1])
rospy.on_shutdown(lambda: body.release("gripper"))
print(f"{count} vertices of the volume follow {sys.argv[1]}", flush=True)
rospy.sleep(float(sys.argv[2]) if len(sys.argv) > 2 else 1e9)
