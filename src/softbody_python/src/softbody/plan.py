"""What a prediction assumes about pins and obstacles."""
import collections.abc

import numpy as np
from geometry_msgs.msg import Point, Point32, Pose, Quaternion, Vector3
from softbody_msgs.msg import MotionPlan, PlannedMotion, PlannedObstacle, PlannedPin, PlannedRelease

RIGID_TOLERANCE = 1e-3  # of the entries of R^T R and of the last row: matrices of float32, and rounded by hand


class Plan:
    """Motions of pins and obstacles, and pins and obstacles that come or go. Each function returns the plan.

    Times are in seconds from the present state. A path is a list of (time, motion), with times above 0. A motion is a
    shift [m], or a rigid 4 x 4 matrix, in the frame of the states. It starts from the present place. Between two times it
    is linear.
    """

    def __init__(self):
        self._message = MotionPlan()

    def move(self, name, path):
        """Moves a pin or an obstacle along a path."""
        self._message.motions.append(PlannedMotion(name=name, times=[time for time, _ in path],
                                                   poses=[_pose(motion) for _, motion in path]))
        return self

    def grip(self, name, low, high, frame=None, begin_s=0.0, end_s=None, path=None):
        """Holds what lies in a box, where it is at `begin_s`. Lets them go at `end_s`; None: never.

        @param low, high: corners [m]. @param frame: None: the box is in rest space. Otherwise it is in this frame of tf
        at present (empty: the frame of the states). It does not follow the frame; only the path moves it.
        @param path: None: it stays.
        """
        pin = PlannedPin(name=name, min=Point32(*low), max=Point32(*high), in_frame=frame is not None, grip_time=begin_s,
                         release_time=_end(end_s))
        pin.header.frame_id = frame or ""
        self._message.pins.append(pin)
        return self._along(name, path)

    def add_obstacle(self, name, shape, position=(0, 0, 0), orientation=(0, 0, 0, 1), frame="", radius=0.0, length=0.0,
                     size=(0, 0, 0), friction=0.0, begin_s=0.0, end_s=None, path=None):
        """Adds an obstacle at `begin_s`, and removes it at `end_s`; None: it stays. The others as in Body.set_obstacle.

        @param friction: coefficient of Coulomb friction. @param path: None: it does not move.
        """
        obstacle = PlannedObstacle(name=name, shape=shape, radius=radius, length=length, size=Vector3(*size),
                                   pose=Pose(Point(*position), Quaternion(*orientation)), friction=friction,
                                   begin_time=begin_s, end_time=_end(end_s))
        obstacle.header.frame_id = frame
        self._message.obstacles.append(obstacle)
        return self._along(name, path)

    def release(self, name, time_s=0.0):
        """Lets a pin go that holds at present, or removes an obstacle."""
        self._message.releases.append(PlannedRelease(name=name, time=time_s))
        return self

    def message(self):
        return self._message

    def _along(self, name, path):
        return self if path is None else self.move(name, path)


def plan_messages(plans):
    """@param plans: each a Plan, or a map: name of a pin or obstacle -> its path."""
    if isinstance(plans, (Plan, collections.abc.Mapping)):
        raise ValueError("plans is a list of plans")
    return [_plan_message(plan) for plan in plans]


def _plan_message(plan):
    if isinstance(plan, Plan):
        return plan.message()
    motions = Plan()
    for name, path in plan.items():
        motions.move(name, path)
    return motions.message()


def _end(time_s):
    """In messages, 0 means never."""
    if time_s is not None and time_s <= 0.0:
        raise ValueError(f"end_s is {time_s}; allowed: above begin_s, or None")
    return 0.0 if time_s is None else time_s


def _pose(motion):
    motion = np.asarray(motion, dtype=float)
    if motion.shape == (3,):
        return Pose(Point(*motion), Quaternion(w=1.0))
    if motion.shape != (4, 4):
        raise ValueError(f"a motion has the shape {motion.shape}; allowed: a shift of 3 numbers, or a 4 x 4 matrix")
    if not _is_rigid(motion):
        raise ValueError(f"the matrix of a motion is not rigid: {motion.tolist()}; allowed: a rotation and a shift, with the "
                         "last row 0 0 0 1")
    return Pose(Point(*motion[:3, 3]), Quaternion(*_quaternion(motion[:3, :3])))


def _is_rigid(motion):
    rotation = motion[:3, :3]
    return (np.isfinite(motion).all() and np.allclose(rotation.T @ rotation, np.eye(3), rtol=0, atol=RIGID_TOLERANCE)
            and np.linalg.det(rotation) > 0 and np.allclose(motion[3], [0, 0, 0, 1], rtol=0, atol=RIGID_TOLERANCE))


def _quaternion(rotation):
    """x, y, z, w: the eigenvector of the largest eigenvalue (Bar-Itzhack 2000)."""
    r = rotation
    matrix = np.array([[r[0, 0] - r[1, 1] - r[2, 2], r[0, 1] + r[1, 0], r[0, 2] + r[2, 0], r[2, 1] - r[1, 2]],
                       [r[0, 1] + r[1, 0], r[1, 1] - r[0, 0] - r[2, 2], r[1, 2] + r[2, 1], r[0, 2] - r[2, 0]],
                       [r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], r[2, 2] - r[0, 0] - r[1, 1], r[1, 0] - r[0, 1]],
                       [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], np.trace(r)]])
    return np.linalg.eigh(matrix)[1][:, -1]
