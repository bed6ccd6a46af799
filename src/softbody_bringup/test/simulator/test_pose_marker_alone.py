"""The interactive marker says what it waits for, until it has it."""
import unittest

import rospy
from geometry_msgs.msg import Point32
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import CameraInfo
from shape_msgs.msg import MeshTriangle
from softbody_msgs.msg import MeshTopology
from visualization_msgs.msg import InteractiveMarkerUpdate

from recorder import Recorder

FRAME = "made_by_hand"


class PoseMarkerAlone(unittest.TestCase):
    def test_what_it_waits_for_is_told(self):
        recorder = Recorder(rosout=Log, softbody__pose_marker__update=InteractiveMarkerUpdate)
        recorder.wait_for_log("/softbody/pose_marker", "/softbody/rgb/camera_info (publishers: 0)")
        info = rospy.Publisher("/softbody/rgb/camera_info", CameraInfo, queue_size=1, latch=True)
        message = CameraInfo()
        message.header.frame_id = FRAME
        info.publish(message)
        recorder.wait_for_log("/softbody/pose_marker", "/softbody/surface/topology (publishers: 0)")
        topology = rospy.Publisher("/softbody/surface/topology", MeshTopology, queue_size=1, latch=True)
        topology.publish(MeshTopology(rest_vertices=[Point32(), Point32(x=1), Point32(y=1)],
                                      triangles=[MeshTriangle(vertex_indices=(0, 1, 2))], vertex_parents=[0, 1, 2],
                                      triangle_bodies=[0], cut_triangles=[False]))
        marker = recorder.wait(lambda seen: next((marker for update in seen["softbody/pose_marker/update"]
                                                  for marker in update.markers), None), "the marker")
        self.assertEqual(marker.header.frame_id, FRAME)
