"""What status, states and log say from the start of the graph to the end of its camera, in a namespace of its own."""
import subprocess
import unittest

import rospy
from geometry_msgs.msg import Point32, TransformStamped
from rosgraph_msgs.msg import Log
from softbody_msgs.msg import MeshState, MeshTopology, TrackingStatus
from softbody_msgs.srv import Pin, Release
from std_msgs.msg import Header
from tf2_msgs.msg import TFMessage

from recorder import Recorder

CAMERA, BODY, TRACKER = "camera_color_optical_frame", "left/softbody", "/left/feature_tracker"
STATUS, STATE = "left/status", "left/surface/state"


class SilentCamera(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(left__status=TrackingStatus, left__surface__state=MeshState,
                                left__surface__topology=MeshTopology, rosout=Log, tf=TFMessage)
        cls.tf = rospy.Publisher("/tf", TFMessage, queue_size=1)

    def lines(self, words):
        return [log for log in self.recorder.messages["rosout"] if words in log.msg]

    def test_1_the_status_is_there_from_the_start(self):
        status = self.recorder.wait_for(STATUS, 2)[0]
        self.assertEqual((status.state, status.reason), (TrackingStatus.INITIALIZING, "waiting for the first image"))
        self.assertTrue(self.recorder.latched(STATUS))

    def test_2_a_body_that_is_found_is_said(self):
        self.recorder.wait_for("left/surface/topology")
        with subprocess.Popen(["rosrun", "rosbag", "play", "--quiet", "--rate=0.2", rospy.get_param("~bag")],
                              stdin=subprocess.DEVNULL) as player:
            said = self.recorder.wait_for_log(TRACKER, "the tracking state is TRACKING", Log.INFO)
            self.assertEqual(said.level, Log.INFO)
            self.assertEqual(player.wait(), 0)
        self.assertEqual(self.recorder.messages[STATE][-1].header.frame_id, CAMERA)
        self.assertEqual(self.recorder.messages["left/surface/topology"][-1].header.frame_id, BODY)
        children = {transform.child_frame_id for message in self.recorder.messages["tf"] for transform in message.transforms}
        self.assertIn(BODY, children)
        self.assertNotIn("softbody", children)

    def test_3_a_pin_says_that_it_waits_for_its_frame(self):
        pin = rospy.ServiceProxy("/left/simulator/pin", Pin)
        corners = {"min": Point32(-1, -1, -1), "max": Point32(1, 1, 1)}
        for _ in range(2):
            answer = pin(name="hold", header=Header(frame_id="/nowhere"), **corners)
            self.assertTrue(answer.success)
            self.assertIn("waiting for frame 'nowhere'", answer.message)
        self.recorder.wait_for_log("/left/simulator", "waiting for frame 'nowhere'")
        self.assertEqual(len(self.lines("leading slash")), 1)
        self.assertTrue(rospy.ServiceProxy("/left/simulator/release", Release)(name="hold").success)

    def test_4_a_camera_that_dies_is_said(self):
        self.recorder.wait_for_log(TRACKER, "the tracking state is LOST: no image for")
        self.recorder.wait(lambda seen: sum(status.state == TrackingStatus.LOST and "no image for" in status.reason
                                            for status in seen[STATUS]) >= 3, "a status every second")

    def test_5_states_claim_nothing_without_images(self):
        last = self.recorder.wait(lambda seen: max(seen[STATE][-1].confidence) < 0.01 and seen[STATE][-1], "no confidence")
        self.assertGreater(last.header.stamp, last.observed)
        self.assertGreater(min(last.standard_deviation), 0.05)
        self.assertEqual([log.msg for log in self.lines("is not used: its stamp is that of the last one")], [])

    def test_6_a_second_sender_of_the_frame_is_named(self):
        transform = TransformStamped(child_frame_id="/" + BODY)
        transform.header.frame_id, transform.header.stamp = CAMERA, rospy.Time.now()
        transform.transform.rotation.w = 1.0
        self.tf.publish(TFMessage([transform]))
        said = self.recorder.wait_for_log(TRACKER, f"the frame '{BODY}' on /tf is sent by this node")
        self.assertIn(rospy.get_name(), said.msg)
