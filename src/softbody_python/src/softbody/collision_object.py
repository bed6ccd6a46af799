"""The tracked body as an obstacle of MoveIt: a node that publishes moveit_msgs/CollisionObject at a bounded rate."""
import argparse
import sys

import rospy
from geometry_msgs.msg import Point, Pose, Quaternion
from shape_msgs.msg import Mesh, MeshTriangle

from softbody.body import Body
from softbody.export.command import Help, Version

PARAMETERS = "Parameters: _namespace:=/softbody, _rate:=2.0 [Hz], _id:=softbody, _coarse:=false (true: the boundary of the " \
             "tets, which encloses the visual mesh with far fewer triangles)"
MOST_HZ = 30.0
FAREWELL_S = 0.2  # for the last message to leave
TOPIC = "/collision_object"  # where MoveIt's planning scene monitor listens


def mesh_of(vertices, triangles):
    """shape_msgs/Mesh of N x 3 vertices [m] and F x 3 triangles."""
    return Mesh([MeshTriangle(row) for row in triangles.tolist()], [Point(*row) for row in vertices.tolist()])


def shape_of(state, coarse):
    """Vertices and triangles of a State; None: it has no tets."""
    if not coarse:
        return state.vertices, state.triangles
    return None if state.volume is None else (state.volume.vertices, state.volume.topology.surface_triangles)


class CollisionObjectPublisher:
    """Replaces the object of MoveIt's scene by the newest state, and removes it at the end. A new subscriber gets the object at
    once, also if the body stands still: the topic is latched."""

    def __init__(self, kind, body, name, coarse):
        """@param kind: the class moveit_msgs.msg.CollisionObject. @param name: id of the object in the scene."""
        self.kind, self.body, self.name, self.coarse = kind, body, name, coarse
        self.sent = None  # the last State
        self.publisher = rospy.Publisher(TOPIC, kind, queue_size=1, latch=True)
        rospy.on_shutdown(self.remove)

    def publish(self):
        """The newest state, if it is new and somebody listens. MOVE is for rigid objects only; ADD replaces the mesh."""
        state = self.body.latest()
        if state is None or state is self.sent or self.publisher.get_num_connections() == 0:
            return
        shape = shape_of(state, self.coarse)
        if shape is None:
            return
        message = self._message(self.kind.ADD)
        message.header.stamp, message.header.frame_id = state.stamp, state.frame
        message.meshes, message.mesh_poses = [mesh_of(*shape)], [_identity()]
        self.publisher.publish(message)
        self.sent = state

    def remove(self):
        """The scene keeps an object until it is told."""
        if self.sent is None:
            return
        message = self._message(self.kind.REMOVE)
        message.header.frame_id = self.sent.frame
        self.publisher.publish(message)
        rospy.rostime.wallsleep(FAREWELL_S)

    def _message(self, operation):
        message = self.kind(id=self.name, operation=operation)
        if hasattr(message, "pose"):  # MoveIt of Melodic has none
            message.pose = _identity()
        return message


def _identity():
    return Pose(orientation=Quaternion(w=1.0))


def _rate():
    rate = rospy.get_param("~rate", 2.0)
    if not isinstance(rate, (int, float)) or not 0 < rate <= MOST_HZ:
        sys.exit(f"collision_object: parameter {rospy.resolve_name('~rate')} is {rate}; allowed: above 0 to {MOST_HZ:g} Hz")
    return rate


def main():
    parser = argparse.ArgumentParser("collision_object", formatter_class=Help, epilog=PARAMETERS,
                                     description="A node that adds the tracked body to MoveIt's scene as an obstacle")
    parser.add_argument("--version", action=Version, nargs=0, help="print package and version and exit")
    parser.parse_args(rospy.myargv()[1:])
    rospy.init_node("collision_object")
    try:
        from moveit_msgs.msg import CollisionObject  # pylint: disable=import-outside-toplevel
    except ImportError as error:
        sys.exit(f"collision_object: MoveIt's messages are not installed ({error}). Install moveit_msgs, or read the mesh from "
                 "the topic surface/mesh (shape_msgs/Mesh)")
    namespace = rospy.resolve_name(rospy.get_param("~namespace", "/softbody"))
    coarse = rospy.get_param("~coarse", False)
    rate = _rate()
    body = Body(namespace, with_volume=coarse)
    publisher = CollisionObjectPublisher(CollisionObject, body, rospy.get_param("~id", namespace.strip("/").replace("/", "_")),
                                         coarse)
    period = rospy.Rate(rate, reset=True)
    while not rospy.is_shutdown():
        publisher.publish()
        try:
            period.sleep()
        except rospy.ROSInterruptException:
            break
