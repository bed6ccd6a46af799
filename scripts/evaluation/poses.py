"""Poses: x y z, then a quaternion x y z w."""
import math

from scipy.spatial.transform import Rotation


def turned_by(quaternion, axis, angle):
    """A rotation after a turn about a unit vector."""
    return (Rotation.from_rotvec([angle * part for part in axis]) * Rotation.from_quat(quaternion)).as_quat().tolist()


def direction(drawn):
    vector = [drawn.gauss(0.0, 1.0) for _ in range(3)]
    length = math.hypot(*vector)
    return [part / length for part in vector]


def moved(pose, way, distance):
    return [*(place + distance * part for place, part in zip(pose[:3], way)), *pose[3:]]


def near(pose, drawn, most_m, most_rad):
    """A pose near a pose, evenly distributed in the ball of places and in the angles."""
    way, axis = direction(drawn), direction(drawn)
    distance, angle = most_m * drawn.random() ** (1.0 / 3.0), most_rad * drawn.random()
    return [*moved(pose, way, distance)[:3], *turned_by(pose[3:], axis, angle)]
