"""The displays of the volume in track.rviz: each shows something if it is switched on, and nothing otherwise. All displays
follow the namespace of rviz."""
import sys
import unittest

import rosgraph
import rospkg
import rospy
import yaml
from geometry_msgs.msg import Point32, Pose, Quaternion
from shape_msgs.msg import MeshTriangle
from softbody_msgs.msg import MeshState, Target, Targets, Tetrahedron, TetTopology

PACKAGES = rospkg.RosPack()
sys.path.append(PACKAGES.get_path("softbody_rviz_plugins") + "/test/ros")
from hand_made_body import FRAME, SIDE
from rviz_screen import Rviz, pixels_of

CONFIGURATION = PACKAGES.get_path("softbody_bringup") + "/rviz/track.rviz"
EDGES, ARROW = (230, 230, 230), (80, 220, 100)  # default colours of the low-resolution mesh and of a feature's target
PIXELS_PER_M = 1000.0
PULL = 0.02  # distance of the target from the body [m]
VIEW = {"Class": "rviz/TopDownOrtho", "Name": "View", "Angle": 0.0, "Scale": PIXELS_PER_M, "X": 0.0, "Y": 0.0,
        "Target Frame": FRAME}


def publish():
    """A single tet, whose largest face is seen from +z, and a feature that pulls it to the left."""
    corners = [Point32(0, 0, 0), Point32(SIDE, 0, 0), Point32(0, SIDE, 0), Point32(0, 0, -SIDE)]
    topology, state, targets = TetTopology(), MeshState(), Targets()
    for message in (topology, state, targets):
        message.header.frame_id, message.header.stamp = FRAME, rospy.Time.now()
    topology.rest_vertices, topology.tets = corners, [Tetrahedron([0, 2, 1, 3])]
    topology.surface_triangles = [MeshTriangle(list(face)) for face in ((0, 1, 2), (0, 3, 1), (1, 3, 2), (0, 2, 3))]
    topology.vertex_parents, topology.tet_bodies = [0, 1, 2, 3], [0]
    state.vertices, state.confidence, state.observed = corners, [1.0] * 4, state.header.stamp
    targets.body_pose = Pose(orientation=Quaternion(w=1.0))
    targets.targets = [Target(kind=Target.FEATURE, tet=0, barycentric=[1, 0, 0, 0], weight=1.0,
                              position=Point32(-PULL, 0, 0))]
    publishers = []
    for name, message in (("volume/topology", topology), ("volume/state", state), ("targets", targets)):
        publishers.append(rospy.Publisher("/softbody/" + name, type(message), queue_size=1, latch=True))
        publishers[-1].publish(message)
    return publishers


def topics_of(settings):
    """The topics that a display's settings name."""
    found = set()
    for key, value in settings.items():
        if isinstance(value, dict):
            found |= topics_of(value)
        elif key.endswith("Topic"):
            found.add(value)
    return found


def subscribed(prefix):
    """What the nodes whose names begin so subscribe to."""
    _, subscribers, _ = rosgraph.Master("/test_rviz_configuration").getSystemState()
    return {topic for topic, nodes in subscribers if any(node.startswith(prefix) for node in nodes)}


class TestConfiguration(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.publishers = publish()

    def displays(self, *names):
        """The configuration's displays of the volume; those of these names are switched on."""
        with open(CONFIGURATION, encoding="utf-8") as file:
            displays = yaml.safe_load(file)["Visualization Manager"]["Displays"]
        volume = [display for display in displays if display["Class"] == "softbody_rviz_plugins/Tets"]
        self.assertEqual({display["Name"] for display in volume}, {"Tets", "Low-resolution mesh", "Targets"})
        return [{**display, "Enabled": display["Name"] in names} for display in volume]

    def expect(self, names, edges, arrow, face):
        """Edges, arrow and coloured face come onto the screen, or stay away."""
        rviz = Rviz(self.displays(*names), VIEW, namespace="/softbody")

        def fits(picture):
            picture = picture[100:340, 290:620]  # around the body, without the window and the colour bar
            seen = [len(pixels_of(picture, color)[0]) for color in (EDGES, ARROW)]
            area = (picture.max(axis=2) > 20).sum() / PIXELS_PER_M**2 / (SIDE**2 / 2)  # 1: the whole triangle
            return (seen[0] > 200) == edges and (seen[1] > 20) == arrow and (area > 0.9) == face

        try:
            self.assertTrue(rviz.wait_for(fits), f"{names} show something else")
        finally:
            rviz.end()

    def test_every_topic_follows_the_namespace(self):
        with open(CONFIGURATION, encoding="utf-8") as file:
            displays = yaml.safe_load(file)["Visualization Manager"]["Displays"]
        rviz = Rviz([{**display, "Enabled": True} for display in displays], VIEW, namespace="/left")
        expected = {"/left/" + topic for display in displays for topic in topics_of(display)}
        expected -= {"/left/pose_marker/update"}  # rviz subscribes to it when its server has answered
        try:
            self.assertTrue(rviz.wait_for(lambda _: expected <= subscribed("/left/rviz")),
                            f"not subscribed: {expected - subscribed('/left/rviz')}")
            elsewhere = {topic for topic in subscribed("/left/rviz") if not topic.startswith("/left/")}
            self.assertEqual(elsewhere - {"/tf", "/tf_static", "/clock"}, set())
        finally:
            rviz.end()

    def test_each_display_shows_its_own(self):
        self.expect(["Low-resolution mesh", "Targets"], edges=True, arrow=True, face=False)
        self.expect(["Tets"], edges=False, arrow=False, face=True)
