"""Parameters of a simulator that change while it runs, with the tools of dynamic_reconfigure. The body hangs from soft
targets in gravity: how far it sinks shows what is in force."""
import copy
import subprocess
import unittest

import numpy as np
import rosnode
import rospy
from dynamic_reconfigure import DynamicReconfigureCallbackException
from dynamic_reconfigure.client import Client
from geometry_msgs.msg import Point32
from rosgraph_msgs.msg import Log
from softbody_msgs.msg import MeshState, Target, TetTopology
from softbody_msgs.srv import SetMaterial

from hand_made_frames import Frames
from poses import array
from recorder import Recorder

NODE = "/softbody/simulator"
STIFFNESS, STEPS = 1e-3, 60
MATERIAL = {"youngs_modulus_pa": 2.0e4, "poisson_ratio": 0.2, "density_kg_m3": 30.0, "damping": 0.1}


def heights(points):
    return np.array([p.z for p in points])


class LiveParameters(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorder = Recorder(softbody__volume__topology=TetTopology, softbody__volume__state=MeshState, rosout=Log)
        cls.frames = Frames(cls.recorder, "world")
        topology = cls.recorder.wait_for("softbody/volume/topology")[-1]
        cls.rest = array(topology.rest_vertices)
        centres = cls.rest[np.array([tet.vertex_indices for tet in topology.tets])].mean(axis=1)
        cls.targets = [Target(kind=Target.MANUAL, tet=i, barycentric=[0.25] * 4, weight=1.0, position=Point32(*centre))
                       for i, centre in enumerate(centres)]
        cls.client = Client(NODE, timeout=60)
        cls.initial = cls.client.get_configuration(timeout=60)

    def setUp(self):
        self.wait_for_simulator()
        self.client.update_configuration({"target_stiffness": STIFFNESS, "load_fade_s": 0.0, **MATERIAL})

    def wait_for_simulator(self):
        self.frames.wait_for_simulator()
        rospy.wait_for_service(NODE + "/set_parameters", 60)

    def step(self, targets, reset=False):
        return self.frames.step(targets=targets, reset=reset)

    def depth(self, reset=True):
        """How far the middle of the body sinks [m]."""
        state = self.step(self.targets, reset)
        for _ in range(STEPS):
            state = self.step(self.targets)
        return self.rest[:, 2].mean() - heights(state.vertices).mean()

    def parameter(self, name):
        return rospy.get_param(f"{NODE}/{name}")

    def test_the_values_in_force_are_offered(self):
        self.assertEqual(self.initial["target_stiffness"], STIFFNESS)
        self.assertEqual(self.initial["iterations"], 200)
        for name, value in MATERIAL.items():
            self.assertEqual(self.initial[name], value)
        offered = {p["name"]: p for p in self.client.get_parameter_descriptions(timeout=60)}
        self.assertNotIn("solver", offered)  # not while it runs
        self.assertEqual((offered["iterations"]["min"], offered["iterations"]["max"]), (1, 1000))
        self.assertIn("[Pa]", offered["youngs_modulus_pa"]["description"])

    def test_softer_targets_let_the_body_sink_deeper(self):
        before = self.depth()
        self.assertGreater(before, 5e-4)
        answer = self.client.update_configuration({"target_stiffness": 0.25 * STIFFNESS})
        self.assertEqual(answer["target_stiffness"], 0.25 * STIFFNESS)
        self.assertEqual(self.parameter("target_stiffness"), 0.25 * STIFFNESS)
        after = self.depth(reset=False)  # the state goes on
        self.assertAlmostEqual(after / before, 4.0, delta=0.2)

    def test_targets_of_a_stiffer_body_are_stiffer(self):
        before = self.depth()
        self.client.update_configuration({"youngs_modulus_pa": 4.0e4})
        self.assertAlmostEqual(self.depth() / before, 0.5, delta=0.025)

    def test_dynparam_sets_a_value(self):
        subprocess.run(["rosrun", "dynamic_reconfigure", "dynparam", "set", NODE, "density_kg_m3", "60"], check=True,
                       timeout=60)
        self.recorder.wait(lambda _: rospy.get_param(NODE + "/density_kg_m3") == 60.0, "the density on the server")
        heavy = self.depth()
        self.client.update_configuration({"density_kg_m3": 30.0})
        self.assertAlmostEqual(heavy / self.depth(), 2.0, delta=0.1)

    def test_a_refused_value_changes_nothing_and_is_named(self):
        before = self.depth()
        for name, value, allowed in (("target_stiffness", -1.0, "1e-06 to 100000"),
                                     ("iterations", 0, "1 to 1000"), ("poisson_ratio", 0.6, "0 to 0.495")):
            with self.assertRaises(DynamicReconfigureCallbackException):
                self.client.update_configuration({name: value, "density_kg_m3": 60.0})
            said = self.recorder.wait_for_log(NODE, f"{NODE}/{name} is ").msg
            self.assertIn(f"{value:g}; allowed: {allowed}", said)
        config = self.client.update_configuration({})
        self.assertEqual({name: config[name] for name in self.initial}, dict(self.initial))
        self.assertAlmostEqual(self.depth() / before, 1.0, delta=1e-3)

    def test_set_material_is_the_same(self):
        updates = []
        self.client.set_config_callback(updates.append)
        rospy.ServiceProxy(NODE + "/set_material", SetMaterial)(**{**MATERIAL, "youngs_modulus_pa": 3.0e4})
        self.recorder.wait(lambda _: updates and updates[-1]["youngs_modulus_pa"] == 3.0e4, "an update")
        self.assertEqual(self.parameter("youngs_modulus_pa"), 3.0e4)

    def test_set_material_forgets_loads(self):
        """Also with the present values: the next motion without targets is another one."""
        self.client.update_configuration({"target_stiffness": 1.0, "load_fade_s": 1.0})
        set_material = rospy.ServiceProxy(NODE + "/set_material", SetMaterial)
        kept, forgotten = self.after_pulling(lambda: None), self.after_pulling(lambda: set_material(**MATERIAL))
        self.client.update_configuration({"load_fade_s": 0.0})
        without, same = self.after_pulling(lambda: None), self.after_pulling(lambda: set_material(**MATERIAL))
        self.assertGreater(np.abs(kept - forgotten).max(), 1e-3)
        self.assertLess(np.abs(without - same).max(), 1e-6)

    def after_pulling(self, change):
        """@return vertices a few frames after a target that pulled has gone, and all others."""
        pulled = copy.deepcopy(self.targets)
        pulled[0].position.x += 0.02
        for frame in range(10):
            self.step(pulled, frame == 0)
        change()
        for _ in range(5):
            state = self.step([])
        return array(state.vertices)

    def test_a_simulator_that_starts_again_keeps_the_values(self):
        self.client.update_configuration({"target_stiffness": 0.5 * STIFFNESS, "youngs_modulus_pa": 4.0e4})
        before = self.depth()
        count = len(self.recorder.messages["softbody/volume/topology"])
        rosnode.kill_nodes([NODE])
        self.recorder.wait(lambda seen: len(seen["softbody/volume/topology"]) > count, "the simulator's next start")
        self.wait_for_simulator()
        rospy.sleep(1.0)  # publishers connect one after the other
        self.assertAlmostEqual(self.depth() / before, 1.0, delta=1e-3)
        again = Client(NODE, timeout=60)
        config = again.get_configuration(timeout=60)
        self.assertEqual((config["target_stiffness"], config["youngs_modulus_pa"]), (0.5 * STIFFNESS, 4.0e4))
        again.close()
