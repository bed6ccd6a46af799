#!/usr/bin/env python3
"""A camera whose clock is 100 s behind, as on another machine: body and tool are followed, /diagnostics do not take it for
silence, and say that the clocks differ."""
import os
import sys
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "shared"))
from recorder import Recorder  # pylint: disable=wrong-import-position

EXPECTED = {"feature_tracker: tracking": (DiagnosticStatus.OK, "tracking"), "tool_tracker: tool": (DiagnosticStatus.OK, "seen"),
            "camera_ingest: frames": (DiagnosticStatus.WARN, "100")}


class OtherClock(unittest.TestCase):
    def test_frames_are_no_silence(self):
        recorder = Recorder(diagnostics=DiagnosticArray)
        for name, (level, words) in EXPECTED.items():
            recorder.wait(lambda seen: any(status.name.endswith(name) and status.level == level
                                           and words in status.message.lower()
                                           for message in seen["diagnostics"] for status in message.status),
                          f"{name} that says {words}")


if __name__ == "__main__":
    rospy.init_node("test_other_clock")
    rostest.rosrun("softbody_bringup", "test_other_clock", OtherClock, sys.argv)
