"""Points and poses of messages as arrays, and the sponge's."""
import numpy as np
from geometry_msgs.msg import PoseStamped

CORNERS_M = np.array([[x, y, z] for x in (-0.1, 0.1) for y in (-0.05, 0.05) for z in (-0.02, 0.02)])  # of the sponge
# In these the sponge looks the same in depth: half turns about its axes, as quaternions (x, y, z, w).
ALIKE = [(0, 0, 0, 1), (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0)]


def vector(point):
    return np.array([point.x, point.y, point.z])


def array(points):
    """One row a point."""
    return np.array([[p.x, p.y, p.z] for p in points])


def rotation(q):
    """@param q quaternion as a message, or as x, y, z, w."""
    x, y, z, w = (q.x, q.y, q.z, q.w) if hasattr(q, "w") else q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def placed(position, orientation, points):
    """Points moved by a message's position (or translation) and orientation (or rotation)."""
    return points @ rotation(orientation).T + vector(position)


def pose_in(frame, position=(0, 0, 0), orientation=(0, 0, 0, 1)):
    pose = PoseStamped()
    pose.header.frame_id = frame
    pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = position
    q = pose.pose.orientation
    q.x, q.y, q.z, q.w = orientation
    return pose
