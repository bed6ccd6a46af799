"""Test cases of the external forces on a body that is seen, for the test of the surroundings."""
import numpy as np
import rospy
from geometry_msgs.msg import Point32, WrenchStamped
from poses import vector
from recorder import Recorder
from softbody_msgs.msg import Forces
from softbody_msgs.srv import Pin
from visualization_msgs.msg import Marker, MarkerArray

FAR = [0.0, 0.0, 5.0]


class ForceCases:
    def hear_forces(self, **types):
        heard = Recorder(softbody__forces=Forces, softbody__forces__marker=MarkerArray, **types)
        self.addCleanup(lambda: [subscriber.unregister() for subscriber in heard.subscribers])
        return heard

    def bent(self):
        """Targets of a body whose right half is lifted."""
        targets = self.at_rest()
        for target in targets:
            target.position.z += 0.3 * max(0.0, target.position.x)
        return targets

    def hold(self, name, low, high, frame):
        request = Pin._request_class(name=name, min=Point32(low, -1.0, -1.0), max=Point32(high, 1.0, 1.0))
        request.header.frame_id = frame
        answer = self.pin(request)
        self.addCleanup(self.release, name=name)
        self.assertTrue(answer.success, answer.message)
        return answer.vertices

    def forces_of_a_frame(self, heard, targets, move=lambda: None):
        """Frames until one has forces: twice as long as the last estimate took are between two. @return them."""
        for _ in range(1000):
            move()
            self.step(targets=targets)
            self.reaction("ground")  # comes after the forces, which only some frames have
            rospy.sleep(0.03)
            for message in heard.messages["softbody/forces"]:
                if message.header.stamp == self.stamp:
                    return message
        return self.fail("no forces in 1000 frames")

    def test_the_wrench_is_in_a_frame_that_moves(self):
        heard = self.hear_forces()
        self.hold("hold", -1.0, self.rest[:, 0].min() + 0.03, "world")

        def move():
            self.places["finger"] = np.add(self.places["finger"], [20.0, 0.0, 0.0])
        for _ in range(3):
            forces = self.forces_of_a_frame(heard, self.bent(), move)
        self.assertEqual((forces.header.frame_id, forces.wrench_frame), ("world", "finger"))
        self.assertTrue(forces.patches)
        total = sum(vector(patch.force) for patch in forces.patches)
        torque = sum(np.cross(vector(patch.place) - self.places["finger"], vector(patch.force))
                     for patch in forces.patches)
        np.testing.assert_allclose(vector(forces.wrench.force), total, atol=1e-9)
        # Its places are means, near enough for a frame that moved by 20 m since the last step.
        np.testing.assert_allclose(vector(forces.wrench.torque), torque, atol=2.0 * np.linalg.norm(total))

    def test_a_new_pin_does_not_read_what_another_one_carried(self):
        heard = self.hear_forces(softbody__reaction__left=WrenchStamped, softbody__reaction__right=WrenchStamped)

        def reaction(name):
            """The first one that is heard."""
            while not heard.messages[f"softbody/reaction/{name}"]:
                self.step(targets=seen)
            return heard.messages[f"softbody/reaction/{name}"][-1].wrench.force.z

        end, seen = self.rest[:, 0].max() - 0.03, self.at_rest()
        count = self.hold("left", -1.0, -end, "hand")
        reaction("left")
        self.places["hand"] = np.add(FAR, [0.0, 0.0, 0.004])
        self.forces_of_a_frame(heard, seen)
        self.forces_of_a_frame(heard, seen)
        carried = reaction("left")
        self.release(name="left")
        self.assertEqual(self.hold("right", end, 1.0, "world"), count)
        self.assertLess(abs(reaction("right")), 0.3 * abs(carried))

    def test_a_reaction_has_the_stamp_of_its_estimate(self):
        heard = self.hear_forces(softbody__reaction__still=WrenchStamped)
        self.hold("still", -1.0, self.rest[:, 0].min() + 0.03, "world")
        first = self.forces_of_a_frame(heard, self.at_rest()).header.stamp
        last = max(self.forces_of_a_frame(heard, self.at_rest()).header.stamp for _ in range(3))
        heard.wait(lambda seen: any(m.header.stamp >= last for m in seen["softbody/reaction/still"]), "a reaction")
        stamps = {name: [m.header.stamp for m in heard.messages[name] if first < m.header.stamp <= last]
                  for name in ("softbody/forces", "softbody/reaction/still")}
        self.assertEqual(stamps["softbody/reaction/still"], stamps["softbody/forces"])

    def test_arrows_go_when_nothing_is_measured(self):
        heard = self.hear_forces()
        self.forces_of_a_frame(heard, self.bent())
        stamp = self.stamp
        heard.first("softbody/forces/marker", lambda m: m.markers[0].header.stamp == stamp and len(m.markers) > 1,
                    "arrows")
        self.step()
        last = heard.first("softbody/forces/marker", lambda m: m.markers[0].header.stamp == self.stamp, "no arrows")
        self.assertEqual([marker.action for marker in last.markers], [Marker.DELETEALL])
