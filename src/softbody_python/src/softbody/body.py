"""The tracked body, live. Call rospy.init_node first."""
import collections
import itertools
import os
import threading
import time

import rospy
from geometry_msgs.msg import Point, Point32, Pose, PoseStamped, Quaternion, Vector3
from softbody_msgs.msg import MeshState, MeshTopology, PredictPlansGoal, TetTopology
from softbody_msgs.srv import (ClosestPoint, ClosestPointRequest, CutBody, CutBodyRequest, LoadObject, Pin, PinRequest,
                               Predict, PreviewCut, PreviewCutRequest, Release, SaveMesh, SetMaterial, SetObstacle,
                               SetObstacleRequest, SetPose)
from std_srvs.srv import SetBool, Trigger

from softbody.errors import Refused
from softbody.join import Joiner
from softbody.lazy import bytes_of, lazy
from softbody.plan import plan_messages
from softbody.prediction import Predictions
from softbody.running_prediction import RunningPrediction, connect
from softbody.wire import WrongMessage, decode

QUEUE_SIZE, BUFFER_SIZE = 30, 1 << 24  # messages; bytes, which hold the largest message


class Body:
    """States by subscription, and the services of the graph as functions.

    Every function that asks the graph raises rospy.ROSException if it does not answer, and Refused with the graph's reason
    if it does not do what was asked.
    """

    def __init__(self, namespace="/softbody", with_volume=True, service_timeout_s=10.0):
        """@param with_volume: states wait for the tets of the same frame. The first state has them."""
        self.namespace, self.service_timeout_s = rospy.resolve_name(namespace).rstrip("/"), service_timeout_s
        self._with_volume, self._joiner = with_volume, Joiner(with_volume)
        self._changed = threading.Condition()
        self._order = threading.RLock()  # one callback at a time, in the order of the states
        self._latest, self._undelivered, self._callbacks = None, collections.deque(), []
        self._predict_client = None  # of the action, from the first use on
        subjects = [("surface/topology", MeshTopology, self._joiner.add_topology),
                    ("surface/state", MeshState, self._joiner.add_surface)]
        if with_volume:
            subjects += [("volume/topology", TetTopology, self._joiner.add_topology),
                         ("volume/state", MeshState, self._joiner.add_volume)]
        self._subscribers = [rospy.Subscriber(self._name(name), lazy(kind), self._receive, add, QUEUE_SIZE, BUFFER_SIZE,
                                              tcp_nodelay=True) for name, kind, add in subjects]

    def close(self):
        """Ends the subscriptions."""
        for subscriber in self._subscribers:
            subscriber.unregister()
        if self._predict_client is not None:
            self._predict_client.stop()

    # --- states --------------------------------------------------------------------------------------------------
    def latest(self):
        """The newest complete state, or None."""
        with self._changed:
            return self._latest

    def wait(self, timeout_s=10.0, after=None, revision=0):
        """The newest state, as soon as it satisfies the conditions.

        @param after: a State or a stamp; the state is later. @param revision: the state has this one or a higher one.
        @throw TimeoutError.
        """
        after = getattr(after, "stamp", after)
        end = time.monotonic() + timeout_s
        with self._changed:
            while True:
                state = self._latest
                if state is not None and state.revision >= revision and (after is None or state.stamp > after):
                    return state
                if not self._changed.wait(min(0.1, end - time.monotonic())) and time.monotonic() >= end:
                    raise TimeoutError(self._what_is_missing(state, timeout_s, revision))
                if rospy.is_shutdown():
                    raise rospy.ROSInterruptException("the node ends")

    def on_state(self, callback):
        """Calls `callback(state)` for every later state, in order, in a thread of rospy. It should return quickly."""
        self._callbacks.append(callback)

    # --- services ------------------------------------------------------------------------------------------------
    def find_again(self, position=None, orientation=(0, 0, 0, 1), frame=""):
        """Restarts tracking: near a pose of the rest frame, or without one by a search, as at the start. Cuts stay.

        @param position: x, y, z [m]. The pose may be wrong by a few cm and about 15 degrees.
        @param orientation: quaternion x, y, z, w. @param frame: any frame of tf; empty: the colour optical frame.
        """
        if position is None:
            self._call("feature_tracker/find_again", Trigger)
            return
        pose = PoseStamped(pose=_pose(position, orientation))
        pose.header.frame_id = frame
        self._call("feature_tracker/set_pose", SetPose, pose)

    def load_object(self, path):
        """Tracks another object, without a restart of the graph. It takes as long as the object's loading.

        @param path: object YAML, or the folder of its object.yaml, on the machine of the node `simulator`.
        @return the revision of its first states. Pins are gone, obstacles stay.
        """
        return self._call("simulator/load_object", LoadObject, os.path.abspath(path)).revision

    def cut(self, point=None, normal=None, polygon=None):
        """Cuts along a plane (point, normal) or within a convex polygon (K x 3), in the rest frame [m].

        @return the revision of the states after the cut.
        """
        return self._call("surface/cut", CutBody, _where(CutBodyRequest(), point, normal, polygon)).revision

    def preview_cut(self, point=None, normal=None, polygon=None):
        """Volumes [m^3] of the pieces that the cut would leave, largest first. Changes nothing."""
        request = _where(PreviewCutRequest(), point, normal, polygon)
        return list(self._call("surface/preview", PreviewCut, request).volumes)

    def undo(self):
        """Undoes the last stroke. @return the revision of the states after it."""
        return self._edit("surface/undo")

    def redo(self):
        """Makes the last undone stroke again. @return the revision of the states after it."""
        return self._edit("surface/redo")

    def reset_cuts(self):
        """Undoes all strokes. @return the revision of the states after it."""
        return self._edit("surface/reset")

    def closest_point(self, point, frame=""):
        """The point of the surface, in the last state, that is closest to a point [m].

        @param frame: of the point, any frame of tf; empty: the frame of the states.
        @return the service's answer: surface_point, normal, distance, revision, piece, triangle, ...
        """
        request = ClosestPointRequest()
        request.point.header.frame_id, request.point.point = frame, Point(*point)
        return self._call("surface/closest_point", ClosestPoint, request)

    def save_mesh(self, name):
        """Writes the surface as it is, on the machine of the node `surface`.

        @param name: of the file, ends in .obj. @return its path. A file that exists stays.
        """
        return self._call("surface/save_mesh", SaveMesh, name).path

    # --- surroundings --------------------------------------------------------------------------------------------
    def set_material(self, youngs_modulus_pa, poisson_ratio, density_kg_m3, damping):
        """Changes the material from the next step on. @param damping: share of the velocity lost per 1/30 s, 0 to 1."""
        self._call("simulator/set_material", SetMaterial, youngs_modulus_pa, poisson_ratio, density_kg_m3, damping)

    def set_obstacle(self, name, shape="", position=(0, 0, 0), orientation=(0, 0, 0, 1), frame="", radius=0.0,
                     length=0.0, size=(0, 0, 0), friction=0.0):
        """Adds an obstacle that the body cannot enter, or replaces the one of the same name.

        @param shape: plane, sphere, capsule or box; empty: only moves the obstacle. @param position: x, y, z [m].
        @param orientation: quaternion x, y, z, w. @param frame: it follows this frame of tf; empty: that of the states.
        @param radius: [m] of a sphere or capsule, or of a box's edges. @param length: [m] of a capsule along z.
        @param size: [m] of a box. @param friction: coefficient of Coulomb friction, 0 to 10.
        """
        request = SetObstacleRequest(name=name, shape=shape, radius=radius, length=length, size=Vector3(*size),
                                     pose=_pose(position, orientation), friction=friction)
        request.header.frame_id = frame
        self._call("simulator/set_obstacle", SetObstacle, request)

    def pin(self, name, low, high, frame=""):
        """Holds what lies in a box in rest space, from the next step on.

        @param low, high: corners [m]. @param frame: they follow this frame of tf; empty: they stay where they are.
        @return the number of the tets' vertices that are held.
        """
        request = PinRequest(name=name, min=Point32(*low), max=Point32(*high))
        request.header.frame_id = frame
        return self._call("simulator/pin", Pin, request).vertices

    def release(self, name):
        """Lets a pin go, or removes an obstacle."""
        self._call("simulator/release", Release, name)

    def grip(self, closed=True):
        """Closes the gripper of the graph (launch argument gripper), or opens it. Closed, it holds what is between its
        fingers, until it opens.

        @return the number of the volume's vertices that are held now. If the frame of the gripper has no pose yet, it
        takes hold later, and this is 0.
        """
        answer = self._call("simulator/grip", SetBool, closed)
        return int(answer.message.split()[0]) if closed else 0

    def predict(self, plans, times, time_step_s=0.0):
        """Simulates plans from the present state. The tracked body does not change.

        @param plans: a list, each a softbody.Plan, or a map: name of a pin or obstacle -> list of (time [s], motion), the
        motion a shift [m] or a rigid 4 x 4 matrix in the frame of the states. @param times: when the body is wanted [s],
        ascending, above 0.
        @return Predictions: per plan a list with a Prediction per time. They have stamp, frame and revision.
        """
        return Predictions(self._call("simulator/predict", Predict, time_step_s, times, plan_messages(plans)), len(times))

    def predict_plans(self, plans, times, time_step_s=0.0, on_progress=None):
        """Starts what predict() does, and returns at once. Ten times as many steps are allowed.

        @param on_progress: called with (plans done, plans in total), in a thread of rospy. @return a RunningPrediction:
        `result(timeout_s)` waits and returns, `cancel()` ends it. The graph works at one at a time: the next one replaces
        it.
        """
        goal = PredictPlansGoal(time_step_s, times, plan_messages(plans))
        if self._predict_client is None:
            self._predict_client = connect(self._name("simulator/predict_plans"), self.service_timeout_s)
        return RunningPrediction(self._predict_client, goal, on_progress)

    # --- inside --------------------------------------------------------------------------------------------------
    def _name(self, name):
        return f"{self.namespace}/{name}"

    def _receive(self, message, add):
        try:
            decoded = decode(message._type, message._md5sum, bytes_of(message))
        except WrongMessage as error:
            rospy.logwarn_throttle(5, f"{self.namespace}: a message is not used: {error}")
            return
        with self._changed:
            states = add(decoded)
            if self._with_volume and self._latest is None:
                # The volume's topics may be connected after those of the surface.
                states = list(itertools.dropwhile(lambda state: state.volume is None, states))
            self._undelivered.extend(states)
            if states:
                self._latest = states[-1]
                self._changed.notify_all()
        self._deliver()

    def _deliver(self):
        with self._order:
            while self._undelivered:
                state = self._undelivered.popleft()
                for callback in list(self._callbacks):
                    callback(state)

    def _what_is_missing(self, state, timeout_s, revision):
        if state is None:
            return f"no state on {self._name('surface/state')} within {timeout_s} s; is the body found?"
        return f"no state of revision {revision} or later within {timeout_s} s, or no new one; the last has " \
               f"revision {state.revision} and stamp {state.time:.3f}"

    def _edit(self, name):
        """The surface answers an edit with "revision N"."""
        return int(self._call(name, Trigger).message.split()[-1])

    def _call(self, name, kind, *arguments):
        name = self._name(name)
        rospy.wait_for_service(name, self.service_timeout_s)
        try:
            answer = rospy.ServiceProxy(name, kind)(*arguments)
        except rospy.ServiceException as error:
            raise rospy.ROSException(f"{name}: no answer: {error}") from error
        if not answer.success:
            raise Refused(f"{name}: {answer.message}")
        return answer


def _pose(position, orientation):
    return Pose(Point(*position), Quaternion(*orientation))


def _where(request, point, normal, polygon):
    """Fills a request for a cut."""
    is_plane = point is not None and normal is not None
    if is_plane == (polygon is not None):
        raise ValueError("give a point and a normal, or a polygon")
    if is_plane:
        request.point, request.normal = Point(*point), Vector3(*normal)
    else:
        request.polygon = [Point32(*corner) for corner in polygon]
    return request
