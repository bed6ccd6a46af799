"""A bag that starts again: time jumps back, and the graph starts again without help."""
import unittest

from rosgraph_msgs.msg import Log
from softbody_msgs.msg import MeshState, TrackingStatus

from recorder import Recorder


def since_last_jump(messages):
    """The messages after the last stamp that went backwards, and whether there was one."""
    start = 0
    for i in range(1, len(messages)):
        if messages[i].header.stamp < messages[i - 1].header.stamp:
            start = i
    return messages[start:] if start else []


class Loop(unittest.TestCase):
    def test_states_and_tracking_come_back(self):
        recorder = Recorder(softbody__surface__state=MeshState, softbody__status=TrackingStatus, rosout=Log)
        # Few: a slow machine leaves out most frames of the short bag.
        states = recorder.wait(
            lambda seen: len(since_last_jump(seen["softbody/surface/state"])) >= 3
            and since_last_jump(seen["softbody/surface/state"]), "three surface states after a jump back")
        stamps = [state.header.stamp for state in states]
        self.assertEqual(stamps, sorted(set(stamps)))
        recorder.wait(
            lambda seen: any(status.state == TrackingStatus.TRACKING
                             for status in since_last_jump(seen["softbody/status"])), "TRACKING after a jump back")
        self.expect_one_line_a_loop(recorder)

    def expect_one_line_a_loop(self, recorder):
        """The nodes say once that the bag starts again, and call nothing of it a mistake."""
        jumps = "time jumped back"
        def said(seen):
            logs = [log for log in seen["rosout"] if log.name.startswith("/softbody/")]
            ends = [i for i, log in enumerate(logs) if jumps in log.msg]
            return len(ends) >= 3 and logs[ends[0]:ends[2]]
        logs = recorder.wait(said, "two whole loops")
        self.assertEqual([log.name for log in logs if jumps in log.msg], 2 * ["/softbody/camera_ingest"])
        refused = ("is not used", "is dropped", "is unusable")
        self.assertEqual([log.msg for log in logs if any(words in log.msg for words in refused)], [])
