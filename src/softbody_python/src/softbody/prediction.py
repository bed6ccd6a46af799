"""Requests and results of the service simulator/predict."""
import collections

import numpy as np
from geometry_msgs.msg import Point, Pose, Quaternion
from softbody_msgs.msg import MotionPlan, PlannedMotion

# At one time of one plan. time [s] from the present, vertices #V by 3 [m], converged, reactions: name -> (force [N],
# torque about the frame's origin [N m]).
Prediction = collections.namedtuple("Prediction", "time vertices converged reactions")


def plan_message(plan):
    """@param plan: name of a pin or obstacle -> list of (time [s], motion): a shift [m], or a 4 x 4 matrix."""
    return MotionPlan(motions=[PlannedMotion(name=name, times=[time for time, _ in path],
                                             poses=[_pose(motion) for _, motion in path])
                               for name, path in plan.items()])


def prediction_of(state):
    vector = lambda v: np.array([v.x, v.y, v.z])
    return Prediction(state.time, np.array([[p.x, p.y, p.z] for p in state.vertices]), state.converged,
                      {name: (vector(reaction.force), vector(reaction.torque))
                       for name, reaction in zip(state.names, state.reactions)})


def _pose(motion):
    motion = np.asarray(motion, dtype=float)
    if motion.shape == (3,):
        return Pose(Point(*motion), Quaternion(w=1.0))
    if motion.shape != (4, 4):
        raise ValueError(f"a motion has the shape {motion.shape}; allowed: a shift of 3 numbers, or a 4 x 4 matrix")
    return Pose(Point(*motion[:3, 3]), Quaternion(*_quaternion(motion[:3, :3])))


def _quaternion(rotation):
    """x, y, z, w: the eigenvector of the largest eigenvalue (Bar-Itzhack 2000)."""
    r = rotation
    matrix = np.array([[r[0, 0] - r[1, 1] - r[2, 2], r[0, 1] + r[1, 0], r[0, 2] + r[2, 0], r[2, 1] - r[1, 2]],
                       [r[0, 1] + r[1, 0], r[1, 1] - r[0, 0] - r[2, 2], r[1, 2] + r[2, 1], r[0, 2] - r[2, 0]],
                       [r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], r[2, 2] - r[0, 0] - r[1, 1], r[1, 0] - r[0, 1]],
                       [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], np.trace(r)]])
    return np.linalg.eigh(matrix)[1][:, -1]
