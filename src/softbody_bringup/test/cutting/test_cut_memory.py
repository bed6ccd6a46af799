"""The memory of simulator and surface stays bounded over many cuts and undos. Prints what they need."""
import time
import unittest

import numpy as np
import rospy
from geometry_msgs.msg import Point, Vector3
from softbody_msgs.msg import MeshTopology
from softbody_msgs.srv import CutBody
from std_srvs.srv import Trigger

from poses import array
from processes import process_of, status_of

PATIENCE_S = 120.0


def when_ready(call):
    """Calls until the edit before is made."""
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        answer = call()
        if "still on its way" not in answer.message:
            return answer
        time.sleep(0.005)
    raise AssertionError("the simulator does not make a cut")


class CutMemory(unittest.TestCase):
    def slice_up(self, body, count, tilt):
        """Slices across the longest axis, in random order. @param tilt of the planes; most of them cross at 0.1."""
        topology = rospy.wait_for_message(f"/{body}/surface/topology", MeshTopology, PATIENCE_S)
        rest = array(topology.rest_vertices)
        low, high = rest.min(axis=0), rest.max(axis=0)
        axis = np.eye(3)[np.argmax(high - low)]
        rospy.wait_for_service(f"/{body}/surface/cut", PATIENCE_S)
        cut = rospy.ServiceProxy(f"/{body}/surface/cut", CutBody, persistent=True)
        random = np.random.default_rng(18)
        made = 0
        for _ in range(3 * count):
            point, normal = random.uniform(low, high), axis + random.uniform(-tilt, tilt, 3)
            answer = when_ready(lambda: cut(point=Point(*point), normal=Vector3(*normal)))
            made += answer.success
            if made == count:
                return
        self.fail(f"only {made} of {count} cuts were made; the last refusal: {answer.message}")

    def expect_bounded(self, body, cuts, tilt, limit_mb):
        begin = time.monotonic()
        self.slice_up(body, cuts, tilt)
        topology = rospy.wait_for_message(f"/{body}/surface/topology", MeshTopology, PATIENCE_S)
        print(f"{body}: {cuts} cuts in {time.monotonic() - begin:.1f} s, {1 + max(topology.triangle_bodies)} pieces, "
              f"{len(topology.triangles)} triangles")
        undo = rospy.ServiceProxy(f"/{body}/surface/undo", Trigger, persistent=True)
        for steps in (0, cuts // 2):
            begin = time.monotonic()
            for _ in range(steps):
                answer = when_ready(undo)
                self.assertTrue(answer.success, answer.message)
            for node in ("simulator", "surface"):
                process = process_of(f"/{body}/{node}")
                now, most = (status_of(process, entry) / 1024 for entry in ("VmRSS", "VmHWM"))
                print(f"{body}: {node} after {steps} undos in {time.monotonic() - begin:.1f} s: {now:.0f} MB, "
                      f"at most {most:.0f} MB", flush=True)
                self.assertLess(most, limit_mb, f"{body}: {node}")

    def test_sponge(self):
        self.expect_bounded("sponge", 100, 0.1, 300)

    def test_doll(self):
        self.expect_bounded("doll", 50, 0.01, 600)
