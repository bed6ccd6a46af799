"""The knife of scenes with a cut, by the ground truth."""
import numpy as np
import rospy
import yaml
from geometry_msgs.msg import PoseStamped
from scipy.spatial.transform import Rotation
from sensor_msgs.msg import CameraInfo

from live.streams import CAMERA
from pages import ROOT

KNIFE = ROOT / "config/knife.yaml"
TRUE_TOOL = "/ground_truth/tool/pose"


def moved(pose, points):
    """Points (rows), transformed by a pose x y z qx qy qz qw."""
    return Rotation.from_quat(pose[3:]).apply(points) + pose[:3]


class Knife:
    """The frames in which a marker of the knife is in the image."""

    def __init__(self):
        self.markers = yaml.safe_load(KNIFE.read_text(encoding="utf-8"))["tool"]["markers"]
        self.shown, self.info = set(), None
        # AnyMsg, because rospy allows only one type per topic.
        rospy.Subscriber(CAMERA, rospy.AnyMsg, self.set_info, queue_size=1)
        rospy.Subscriber(TRUE_TOOL, PoseStamped, self.add, queue_size=100)

    def set_info(self, message):
        self.info = self.info or CameraInfo().deserialize(message._buff)

    def add(self, message):
        p, q = message.pose.position, message.pose.orientation
        if self.info and any(self.in_picture(marker, [p.x, p.y, p.z, q.x, q.y, q.z, q.w]) for marker in self.markers):
            self.shown.add(message.header.stamp.to_sec())

    def in_picture(self, marker, pose):
        half = 0.5 * marker["size_m"]
        corners = np.array([[x, y, 0.0] for x in (-half, half) for y in (-half, half)])
        homogeneous = moved(pose, moved(marker["pose"], corners)) @ np.reshape(self.info.K, (3, 3)).T
        pixels = homogeneous[:, :2] / homogeneous[:, 2:]
        inside = (pixels >= 0).all() and (pixels < [self.info.width, self.info.height]).all()
        return bool(inside and (homogeneous[:, 2] > 0).all())
