"""Frames without targets for a simulator, as of a tracker whose camera sees nothing but finds every body at once."""
import threading

import rospy
from geometry_msgs.msg import Pose, Quaternion
from softbody_msgs.msg import Targets, TetTopology

PERIOD = rospy.Duration(nsecs=33333333)


class Frames(threading.Thread):
    """Sends frames until it is stopped. A body that is not placed gets targets with reset."""

    def __init__(self):
        super().__init__(daemon=True)
        self.publisher = rospy.Publisher("/softbody/targets", Targets, queue_size=1)
        self.stamp, self.topology, self.stopped = rospy.Time(1000), None, threading.Event()
        rospy.Subscriber("/softbody/volume/topology", TetTopology, self.follow)

    def follow(self, topology):
        self.topology = topology

    def run(self):
        while not self.stopped.wait(0.05):
            if self.topology is not None:
                self.send(self.topology)

    def send(self, topology):
        self.stamp += PERIOD
        message = Targets(revision=topology.revision, body_pose=Pose(orientation=Quaternion(w=1.0)),
                          reset=topology.header.stamp.is_zero())
        message.header.stamp, message.header.frame_id = self.stamp, "made_by_hand"
        self.publisher.publish(message)
