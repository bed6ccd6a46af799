"""The action simulator/predict_plans."""
import threading
import time

import actionlib
import rospy
from actionlib import CommState
from actionlib_msgs.msg import GoalStatus
from softbody_msgs.msg import PredictPlansAction

from softbody.errors import Cancelled, Refused
from softbody.prediction import Predictions

PERIOD_S = 0.1  # between two looks at whether the server is there


def connect(name, timeout_s):
    """A client of the action. @throw rospy.ROSException if no server answers in time."""
    client = actionlib.ActionClient(name, PredictPlansAction)
    deadline = time.monotonic() + timeout_s
    # Not wait_for_server() alone: its time is that of a bag, which may stand still.
    while client.last_status_msg is None:
        if time.monotonic() > deadline or rospy.is_shutdown():
            client.stop()
            raise rospy.ROSException(f"{name}: no server within {timeout_s} s; does the simulator run?")
        time.sleep(0.01)
    client.wait_for_server()
    return client


class RunningPrediction:
    """A prediction on its way."""

    def __init__(self, client, goal, on_progress):
        self._client, self._name, self._time_count = client, client.ns, len(goal.times)
        self._changed = threading.Condition()
        feedback = None if on_progress is None else lambda _, progress: on_progress(progress.done, progress.total)
        self._handle = client.send_goal(goal, self._wake, feedback)
        # A goal that is cancelled before the server knows it gets lost.
        self._wait(lambda: self._handle.get_comm_state() != CommState.WAITING_FOR_GOAL_ACK, None)

    def done(self):
        """Whether result() has something to say."""
        return self._handle.get_comm_state() == CommState.DONE

    def cancel(self):
        """Ends it soon. Then result() raises Cancelled, unless it was done already."""
        self._handle.cancel()

    def result(self, timeout_s=None):
        """Waits for the predictions. @param timeout_s: None: as long as it takes. @return as Body.predict.

        @throw Refused with the graph's reason. @throw Cancelled. @throw TimeoutError: it goes on.
        @throw rospy.ROSException if the simulator has ended or was started again.
        """
        if not self._wait(self.done, timeout_s):
            raise TimeoutError(f"{self._name}: not done within {timeout_s} s")
        status, result = self._handle.get_goal_status(), self._handle.get_result()
        if status == GoalStatus.SUCCEEDED:
            return Predictions(result, self._time_count)
        if status == GoalStatus.LOST:
            raise rospy.ROSException(f"{self._name}: the simulator was started again, and does not know the prediction")
        reason = f"{self._name}: {self._handle.get_goal_status_text()}"
        if status in (GoalStatus.PREEMPTED, GoalStatus.RECALLED):
            raise Cancelled(reason)
        raise Refused(reason)

    def _wake(self, _):
        with self._changed:
            self._changed.notify_all()

    def _wait(self, condition, timeout_s):
        """@return whether the condition came. @throw rospy.ROSException if the server is gone."""
        end = None if timeout_s is None else time.monotonic() + timeout_s
        with self._changed:
            while not condition():
                if rospy.is_shutdown():
                    raise rospy.ROSInterruptException("the node ends")
                left = PERIOD_S if end is None else min(PERIOD_S, end - time.monotonic())
                if left <= 0.0:
                    return False
                if not self._changed.wait(left) and self._client.pub_goal.get_num_connections() == 0:
                    raise rospy.ROSException(f"{self._name}: the simulator has ended")
        return True
