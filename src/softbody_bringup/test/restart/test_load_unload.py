"""Nodelets of the whole graph are loaded into one manager and unloaded, in any order and at any moment, while a camera publishes.
The manager keeps its threads, its memory and its registrations. LOAD_ROUNDS: how often."""
import os
import random
import time
import unittest

import rosgraph
import rospy
from nodelet.srv import NodeletList, NodeletLoad, NodeletUnload
from softbody_msgs.msg import MeshState

from processes import process_of, status_of
from recorder import Recorder

MANAGER = "/softbody/manager"
GRAPH = {"/softbody/camera_ingest": "softbody_tracking/CameraIngest", "/softbody/feature_tracker": "softbody_tracking/FeatureTracker",
         "/softbody/tool_tracker": "softbody_tracking/ToolTracker", "/softbody/pose_marker": "softbody_tracking/PoseMarker",
         "/softbody/simulator": "softbody_sim/Simulator", "/softbody/surface": "softbody_sim/Surface"}
CAMERA = [f"/camera/{name}" for name in ("color/image_raw", "color/camera_info", "aligned_depth_to_color/image_raw")]
WARM_UP = 2  # rounds in which libraries and allocators settle
MOST_GROWTH_MB, MOST_THREADS = 60, 3


def registrations():
    """Publishers, subscribers and services of the manager, as the master knows them."""
    return sum(nodes.count(MANAGER) for kind in rosgraph.Master("/test").getSystemState() for _, nodes in kind)


class LoadUnload(unittest.TestCase):
    def setUp(self):
        self.random = random.Random(3)
        rospy.wait_for_service(f"{MANAGER}/load_nodelet", 60)
        load, unload, self.loaded = (rospy.ServiceProxy(f"{MANAGER}/{name}", kind) for name, kind in
                                     (("load_nodelet", NodeletLoad), ("unload_nodelet", NodeletUnload), ("list", NodeletList)))
        self.load = lambda name: load(name, GRAPH[name], [f"/softbody{topic}" for topic in CAMERA], CAMERA, [], "").success
        self.unload = lambda name: unload(name).success

    def in_any_order(self):
        return self.random.sample(list(GRAPH), len(GRAPH))

    def pause(self, most_s):
        time.sleep(self.random.uniform(0.0, most_s))

    def refuses(self, call, name):
        try:
            return not call(name)
        except rospy.ServiceException:
            return True

    def round(self):
        """Ends with an empty manager."""
        for name in self.in_any_order():
            self.assertTrue(self.load(name), name)
            if self.random.random() < 1 / 6:
                self.assertTrue(self.refuses(self.load, name), f"{name} twice")
            self.pause(0.05)
            if self.random.random() < 1 / 8:  # it ends at once, and comes back
                self.assertTrue(self.unload(name), name)
                self.assertTrue(self.load(name), name)
        self.pause(0.5)
        for name in self.in_any_order():
            self.assertTrue(self.unload(name), name)
            self.pause(0.05)
        self.assertEqual(self.loaded().nodelets, [])

    def expect_the_graph_to_work(self):
        recorder = Recorder(softbody__surface__state=MeshState)
        for name in self.in_any_order():
            self.assertTrue(self.load(name), name)
        recorder.wait_for("softbody/surface/state", 10)
        for name in GRAPH:
            self.assertTrue(self.unload(name), name)
        recorder.subscribers[0].unregister()

    def sizes(self):
        process = process_of(MANAGER)
        return status_of(process, "Threads"), status_of(process, "VmRSS") / 1000

    def test_a_manager_keeps_its_threads_and_its_memory(self):
        rounds = int(os.environ.get("LOAD_ROUNDS", 3))
        process = process_of(MANAGER)
        self.expect_the_graph_to_work()
        for _ in range(WARM_UP):
            self.round()
        (threads, memory), registered = self.sizes(), registrations()
        for _ in range(rounds):
            self.round()
        self.expect_the_graph_to_work()
        time.sleep(0.5)
        threads_after, memory_after = self.sizes()
        print(f"{rounds} rounds: threads {threads}, then {threads_after}; memory {memory:.0f} MB, then {memory_after:.0f} MB")
        self.assertEqual(process_of(MANAGER), process, "the manager has ended")
        self.assertGreater(registered, 0)
        self.assertEqual(registrations(), registered)
        self.assertLessEqual(threads_after, threads + MOST_THREADS)
        self.assertLessEqual(memory_after, memory + MOST_GROWTH_MB)
