"""A body made by hand: two squares side by side, each a piece of its own, and later a strip that fills a cut."""
import rospy
from geometry_msgs.msg import Point32
from shape_msgs.msg import MeshTriangle
from softbody_msgs.msg import MeshState, MeshTopology

FRAME = "camera"
SIDE = 0.2  # of a square [m]
LEFT, RIGHT = (86, 180, 233), (230, 159, 0)  # colours of the pieces
BODY_DISPLAY = {"Class": "softbody_rviz_plugins/SoftBody", "Name": "Body", "Enabled": True, "Color By": "Piece",
                "Topology Topic": "/test/topology", "State Topic": "/test/state"}
STRIP = 0.1  # height of the strip below the squares [m]


def rectangle(left, top, width, height):
    return [(left, top), (left + width, top), (left + width, top - height), (left, top - height)]


class Body:
    """Publishes the two squares, piece 0 left and piece 1 right of the origin, facing the viewer on +z; with cut, the strip, too."""

    def __init__(self):
        self.topology = rospy.Publisher("/test/topology", MeshTopology, queue_size=1, latch=True)
        self.state = rospy.Publisher("/test/state", MeshState, queue_size=1, latch=True)

    def corners(self, cut):
        parts = [rectangle(-SIDE, SIDE / 2, SIDE, SIDE), rectangle(0.0, SIDE / 2, SIDE, SIDE)]
        return parts + ([rectangle(-SIDE, -SIDE / 2, 2 * SIDE, STRIP)] if cut else [])

    def send_topology(self, revision=0, cut=False, change=None):
        message = MeshTopology()
        message.header.frame_id, message.revision = FRAME, revision
        for piece, part in enumerate(self.corners(cut)):
            first = len(message.rest_vertices)
            message.rest_vertices += [Point32(x, y, 0.0) for x, y in part]
            for triangle in ((0, 2, 1), (0, 3, 2)):
                message.triangles.append(MeshTriangle([first + k for k in triangle]))
                message.triangle_bodies.append(piece % 2)
                message.cut_triangles.append(piece == 2)
        message.vertex_parents = list(range(len(message.rest_vertices)))
        if change is not None:
            change(message)
        self.topology.publish(message)

    def send_state(self, revision=0, cut=False, offset=(0.0, 0.0, 0.0), change=None):
        """@param change: called with the message before it is sent."""
        message = MeshState()
        message.header.frame_id, message.header.stamp, message.revision = FRAME, rospy.Time.now(), revision
        message.observed = message.header.stamp
        message.vertices = [Point32(x + offset[0], y + offset[1], offset[2]) for part in self.corners(cut) for x, y in part]
        message.confidence = [1.0] * len(message.vertices)
        message.standard_deviation = [0.001 * k for k in range(len(message.vertices))]  # each vertex has its own
        if change is not None:
            change(message)
        self.state.publish(message)
