"""One message with an odd stamp on any topic changes nothing: the graph goes on, cut as it is."""
import itertools
import unittest
from xmlrpc.client import ServerProxy

import rosgraph
import rosnode
import rospy
from geometry_msgs.msg import Point, Point32, PolygonStamped, TransformStamped, Vector3
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import Image
from softbody_msgs.msg import MeshState, Targets, TrackingStatus
from softbody_msgs.srv import CutBody
from tf2_msgs.msg import TFMessage

from recorder import Recorder

FRAMES = 4
STATES, STATUS = "softbody/surface/state", "softbody/status"
TOPICS = {"/camera/color/image_raw": Image, "/camera/aligned_depth_to_color/image_raw": Image,
          "/softbody/rgb/image_rect_color": Image, "/softbody/targets": Targets, "/softbody/volume/state": MeshState}


def odd_stamps():
    now = rospy.Time.now()
    return (rospy.Time(4294967295, 999999999), rospy.Time(), rospy.Time(1), now - rospy.Duration(20),
            now + rospy.Duration(20), now + rospy.Duration(100))


def processes(nodes):
    """Process id by node, as each node itself says. An error if a node has ended."""
    master = rosgraph.Master("/test_odd_stamps")
    return {node: ServerProxy(master.lookupNode(node)).getPid("/test_odd_stamps")[2] for node in nodes}


class OddStamps(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__surface__state=MeshState, softbody__status=TrackingStatus, rosout=Log)
        cls.recorder.wait(lambda seen: len(seen[STATES]) > 5 and seen[STATUS][-1].state == TrackingStatus.TRACKING,
                          "tracking")
        rospy.wait_for_service("/softbody/surface/cut", 30)
        answer = rospy.ServiceProxy("/softbody/surface/cut", CutBody)(point=Point(), normal=Vector3(1, 0, 0))
        assert answer.success, answer.message
        cls.revision = answer.revision
        cls.recorder.wait(lambda seen: seen[STATES][-1].revision == cls.revision, "a state of the cut")
        cls.recorder.wait(lambda _: "/softbody/tool_tracker" in rosnode.get_node_names("/softbody"), "the tool tracker")
        cls.processes = processes(rosnode.get_node_names("/softbody"))

    def publisher(self, topic, kind):
        publisher = rospy.Publisher(topic, kind, queue_size=10)
        self.recorder.wait(lambda _: publisher.get_num_connections() > 0, f"who listens to {topic}")
        return publisher

    def expect_to_go_on(self, what):
        """States of new frames come from the same processes, cut as before, and none has an odd stamp."""
        before = len(self.recorder.messages[STATES])
        self.recorder.wait(lambda seen: len(seen[STATES]) >= before + FRAMES, f"states after {what}")
        states = self.recorder.messages[STATES][before:]
        self.assertEqual({state.revision for state in states}, {self.revision}, what)
        now = rospy.Time.now().to_sec()
        for state in states:
            self.assertLess(abs(state.header.stamp.to_sec() - now), 15.0, what)
        self.assertEqual(processes(self.processes), self.processes, what)

    def test_messages_of_the_graph(self):
        for topic, kind in TOPICS.items():
            message, publisher = rospy.wait_for_message(topic, kind, 60), self.publisher(topic, kind)
            for stamp in odd_stamps():
                message.header.stamp = stamp
                publisher.publish(message)
                self.expect_to_go_on(f"{topic} stamped {stamp.to_sec()} s")
            publisher.unregister()

    def test_blades(self):
        publisher = self.publisher("/softbody/tool/blade", PolygonStamped)
        blade = PolygonStamped()
        blade.header.frame_id = "camera_color_optical_frame"
        blade.polygon.points = [Point32(x, y, 0.2) for x, y in ((0, 0), (0.01, 0), (0.01, 0.01), (0, 0.01))]
        for stamp in odd_stamps():
            blade.header.stamp = stamp
            publisher.publish(blade)
            self.expect_to_go_on(f"a blade stamped {stamp.to_sec()} s")

    def test_transforms(self):
        publisher = self.publisher("/tf", TFMessage)
        for stamp in odd_stamps():
            for child in ("softbody", "elsewhere"):
                transform = TransformStamped(child_frame_id=child)
                transform.header.stamp, transform.header.frame_id = stamp, "camera_color_optical_frame"
                transform.transform.rotation.w = 1.0
                publisher.publish(TFMessage([transform]))
            self.expect_to_go_on(f"a transform stamped {stamp.to_sec()} s")

    def test_what_is_refused_is_told(self):
        message, publisher = rospy.wait_for_message("/softbody/targets", Targets, 60), self.publisher(
            "/softbody/targets", Targets)
        self.recorder.messages["rosout"].clear()
        far = itertools.cycle((4294967295, 4000000000))  # each is alone

        def is_told(seen):  # the first ones may come before the simulator listens, or right after another sentence
            message.header.stamp = rospy.Time(next(far))
            publisher.publish(message)
            return any("/softbody/targets" in log.msg and "alone there" in log.msg for log in seen["rosout"])
        self.recorder.wait(is_told, "a sentence on the refused targets")
