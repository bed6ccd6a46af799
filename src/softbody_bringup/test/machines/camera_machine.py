#!/usr/bin/env python3
"""The machine with the camera: sends the shipped recording with compressed images, forwards and backwards, stamped with
the present time; watches the results as rviz does, and prints them as JSON. Arguments: frames to see, clock's offset [s]."""
import json
import os
import sys
import threading

import numpy as np
import rosbag
import rospy
from rosgraph_msgs.msg import Log
from softbody.compress_bag import compress
from softbody_msgs.msg import MeshState, MeshTopology, TrackingStatus

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.join(HERE, "..", "shared"))
from compressed_bag import BAG  # pylint: disable=wrong-import-position
from poses import array  # pylint: disable=wrong-import-position
from recorder import Recorder  # pylint: disable=wrong-import-position

RATE_HZ = 5
TRUTH = "/ground_truth/surface/state"


class Camera(threading.Thread):
    def __init__(self, offset_s):
        super().__init__(daemon=True)
        self.offset, self.truths, self.frames = rospy.Duration(offset_s), {}, {}
        for topic, message, stamp in rosbag.Bag(BAG):
            name, packed = compress(topic, message)
            if topic == TRUTH or topic.startswith("/camera"):
                self.frames.setdefault(stamp, {})[name] = packed
        names = {name: type(message) for name, message in self.frames[min(self.frames)].items() if name != TRUTH}
        self.publishers = {name: rospy.Publisher(name, kind, queue_size=5) for name, kind in names.items()}

    def run(self):
        order = sorted(self.frames)
        order += order[::-1]
        rate = rospy.Rate(RATE_HZ)
        while not rospy.is_shutdown():
            for stamp in order:
                self.send(self.frames[stamp], rospy.Time.now() + self.offset)
                rate.sleep()

    def send(self, frame, now):
        self.truths[now] = array(frame[TRUTH].vertices)
        for name, publisher in self.publishers.items():
            frame[name].header.stamp = now
            publisher.publish(frame[name])


def main(frames, offset_s):
    rospy.init_node("camera_machine")
    recorder = Recorder(softbody__surface__state=MeshState, softbody__surface__topology=MeshTopology,
                        softbody__status=TrackingStatus, rosout=Log)
    camera = Camera(offset_s)
    camera.start()
    recorder.wait(lambda seen: sum(status.state == TrackingStatus.TRACKING for status in seen["softbody/status"]) >= frames,
                  f"{frames} frames TRACKING")
    states = recorder.wait_for("softbody/surface/state", frames)
    compared = [state for state in states if state.header.stamp in camera.truths]
    errors = [np.linalg.norm(array(state.vertices) - camera.truths[state.header.stamp], axis=1).mean()
              for state in compared]
    deviations = [np.mean(state.standard_deviation) for state in compared]
    print(json.dumps({"states": len(states), "compared": len(compared), "mean_error_m": float(np.mean(errors)),
                      "mean_deviation_m": float(np.mean(deviations)),
                      "topologies": len(recorder.wait_for("softbody/surface/topology")),
                      "warnings": sorted({log.msg for log in recorder.messages["rosout"] if log.level >= Log.WARN})}))


if __name__ == "__main__":
    main(int(sys.argv[1]), float(sys.argv[2]))
