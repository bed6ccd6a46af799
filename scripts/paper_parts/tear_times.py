#!/usr/bin/python3
"""Times at which a body tears [s from the first frame]: in the truth, and each tear in a bag of `replay`, as JSON. Runs
in the environment of the workspace.

Usage: tear_times.py RESULT.bag RECORDING.bag
"""
import json
import sys

import rosbag

with rosbag.Bag(sys.argv[2]) as bag:
    bodies = [message for _, message, _ in bag.read_messages(topics="/ground_truth/surface/topology")]
start = bodies[0].header.stamp
truth = next(body.header.stamp for body in bodies if body.revision == 1)
with rosbag.Bag(sys.argv[1]) as bag:
    tears = [message.header.stamp for _, message, _ in bag.read_messages(topics="/softbody/cut")]
print(json.dumps({"truth_s": (truth - start).to_sec(), "tears_s": [(tear - start).to_sec() for tear in tears]}))
