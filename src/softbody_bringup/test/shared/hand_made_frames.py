"""Frames for a simulator, as of a tracker whose camera sees what a test says."""
import threading

import rospy
from geometry_msgs.msg import Pose, Quaternion
from softbody_msgs.msg import Targets, TetTopology

PERIOD = rospy.Duration(nsecs=33333333)


class Frames:
    """Frames that a test sends one by one."""

    def __init__(self, recorder, frame="made_by_hand", first_s=1000):
        """@param recorder with softbody/volume/state. @param frame of the targets."""
        self.recorder, self.frame, self.stamp = recorder, frame, rospy.Time(first_s)
        self.publisher = rospy.Publisher("/softbody/targets", Targets, queue_size=1000)
        self.wait_for_simulator()

    def wait_for_simulator(self):
        self.recorder.wait(lambda _: self.publisher.get_num_connections() > 0, "a simulator that listens")

    def send(self, stamp=None, **fields):
        """Targets without a body's motion, if the fields of the message do not say another. @return their stamp."""
        if stamp is None:
            stamp = self.stamp = self.stamp + PERIOD
        message = Targets(**{"body_pose": Pose(orientation=Quaternion(w=1.0)), **fields})
        message.header.stamp, message.header.frame_id = stamp, self.frame
        self.publisher.publish(message)
        return stamp

    def state_of(self, stamp):
        return self.recorder.first("softbody/volume/state", lambda s: s.header.stamp == stamp,
                                   f"the volume state of {stamp.to_sec():.3f}")

    def step(self, stamp=None, **fields):
        """@return the state that answers a frame."""
        return self.state_of(self.send(stamp, **fields))


class EndlessFrames(threading.Thread):
    """Frames without targets, 20 a second, until they are stopped. A body that is not placed gets targets with reset."""

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
