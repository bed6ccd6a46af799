#!/usr/bin/python3
"""Features found in the frames of a bag of `replay`, as JSON. Runs in the environment of the workspace.

Usage: feature_counts.py RESULT.bag
"""
import json
import statistics
import sys

import rosbag

with rosbag.Bag(sys.argv[1]) as bag:
    counts = [message.width * message.height for _, message, _ in bag.read_messages(topics="/softbody/features")]
print(json.dumps({"median": statistics.median(counts) if counts else 0}))
