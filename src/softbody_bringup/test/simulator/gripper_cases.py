"""Test cases of a gripper that closes, for the test of the surroundings."""
import numpy as np
import rospy
from poses import array
from std_msgs.msg import Bool
from std_srvs.srv import SetBool

FAR = [0.0, 0.0, 5.0]


class GripperCases:
    def test_a_closed_gripper_takes_along_what_is_between_its_fingers(self):
        grip = rospy.ServiceProxy("/softbody/simulator/grip", SetBool)
        self.places["hand"] = [self.rest[:, 0].max(), 0.0, 0.0]
        before = array(self.step().vertices)
        between = (np.abs(before - self.places["hand"]) < [0.05, 0.2, 0.2]).all(axis=1)
        answer = grip(True)
        self.addCleanup(grip, False)
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.message, f"{between.sum()} vertices are held")
        self.places["hand"] = np.add(self.places["hand"], [0.0, 0.0, 0.05])
        lifted = array(self.step().vertices)
        np.testing.assert_allclose(lifted[between], before[between] + [0.0, 0.0, 0.05], atol=1e-4)
        self.assertTrue(grip(False).success)
        self.places["hand"] = FAR
        for _ in range(30):
            state = self.step()
        self.assertLess(array(state.vertices)[between][:, 2].mean(), lifted[between][:, 2].mean() - 0.01)  # it fell
        self.refused(grip(True), "holds nothing", "'hand'")

    def test_a_gripper_that_says_it_is_closed_holds_once(self):
        closed = rospy.Publisher("/softbody/gripper/closed", Bool, queue_size=10)
        self.recorder.wait(lambda _: closed.get_num_connections() > 0, "a simulator that listens")
        holds = lambda: "/softbody/reaction/gripper" in self.reactions()  # pylint: disable=unnecessary-lambda-assignment
        self.places["hand"] = [self.rest[:, 0].max(), 0.0, 0.0]
        self.step()
        closed.publish(True)
        self.wait_until(holds, "a pin of the gripper")
        self.assertTrue(self.release(name="gripper").success)
        closed.publish(True)  # said again: nothing new
        rospy.sleep(0.2)
        self.assertFalse(holds())
        closed.publish(False)
        closed.publish(True)
        self.wait_until(holds, "a pin of the gripper that closes again")
        closed.publish(False)
        self.wait_until(lambda: not holds(), "a gripper that lets go")
