"""Cuts, undo and kills, all at random, and always the same."""
import collections
import random
import signal
import threading
import time

import rospy
from geometry_msgs.msg import Point, Vector3
from softbody_msgs.msg import MeshTopology
from softbody_msgs.srv import CutBody
from std_srvs.srv import Trigger

from soaking.processes import memory_mb

EDITS = ["cut"] * 5 + ["undo"] * 2 + ["redo"] + ["reset"] * 2
SETTLED_S = 1.0  # after a reset, until its memory is free
SCENE_S = 14.0  # the knife's scene is over: the camera starts again, with a whole body


class Editor(threading.Thread):
    """Calls the surface's services at random. What a service refuses is counted. The memory of all nodes is measured where the
    body is whole: cuts need memory, and edits can be undone."""

    def __init__(self, graph, side, begin, end, stop):
        super().__init__(daemon=True)
        self.graph, self.side, self.random = graph, side, random.Random(side.namespace)
        self.begin, self.end, self.stop = begin, end, stop
        self.counts = collections.Counter()
        self.memory = {}  # (node, process id): (time, MB)
        self.box = None

    def run(self):
        wait = self.begin - time.time()
        while not self.stop.wait(wait) and time.time() < self.end:
            self.edit(self.random.choice(EDITS))
            wait = self.random.uniform(1.5, 4.0)
        self.edit("reset")  # the calm at the end has a whole body, as that at the beginning

    def edit(self, edit):
        try:
            answer = self.cut() if edit == "cut" else self.call(edit, Trigger)()
        except (rospy.ServiceException, rospy.ROSException):
            self.counts[f"{edit} without an answer"] += 1  # the node was killed
            return
        self.counts[f"{edit} {'made' if answer.success else 'refused'}"] += 1
        if edit == "reset" and "on its way" not in answer.message and not self.stop.wait(SETTLED_S):
            self.measure()

    def measure(self):
        for name, pid in self.graph.nodes().items():
            size = memory_mb(pid) if name.startswith(self.side.namespace + "/") else None
            if size:
                self.memory.setdefault((name, pid), []).append((time.time(), size))

    def call(self, name, kind):
        service = f"{self.side.namespace}/surface/{name}"
        rospy.wait_for_service(service, 2)
        return rospy.ServiceProxy(service, kind)

    def cut(self):
        if self.box is None:
            topology = rospy.wait_for_message(f"{self.side.namespace}/surface/topology", MeshTopology, 5)
            columns = list(zip(*((p.x, p.y, p.z) for p in topology.rest_vertices)))
            self.box = [(min(column), max(column)) for column in columns]
        point = Point(*(self.random.uniform(low, high) for low, high in self.box))
        return self.call("cut", CutBody)(point=point, normal=Vector3(*(self.random.gauss(0, 1) for _ in range(3))))


class Killer(threading.Thread):
    """Kills one node after another at random, except the injector: the launch would end with it."""

    def __init__(self, graph, sides, options, begin, end, stop):
        super().__init__(daemon=True)
        self.graph, self.sides, self.stop = graph, sides, stop
        self.begin, self.end = begin, end
        self.period, self.most = options.kill_every, options.kills
        self.random = random.Random(1)
        self.done = 0

    def run(self):
        while self.most is None or self.done < self.most:
            due = max(self.begin - time.time(), self.random.uniform(0.7, 1.3) * self.period)
            if self.stop.wait(due) or time.time() > self.end:
                return
            self.kill_one()

    def kill_one(self):
        name = self.random.choice(sorted(name for name in self.graph.nodes()
                                         if name.count("/") == 2 and not name.endswith("/injector")))
        side = next(side for side in self.sides if name.startswith(side.namespace + "/"))
        moment = time.time()
        if self.graph.kill(name):
            with side.lock:
                side.kills.append((moment, name))
            self.done += 1


def restart_scene(graph, side):
    """The camera shows its scene again from the beginning."""
    camera = f"{side.namespace}/virtual_camera"
    with side.lock:
        side.kills.append((time.time(), camera))
    graph.kill(camera, signal.SIGINT)
