"""Measures a live graph: what it sends and when, and its CPU time."""
import math
import os
import subprocess
import sys
import time

import rospy

from live.graph import Graph
from live.knife import KNIFE, Knife
from live.process_times import graph_times
from live.streams import CAMERA, CUTS, STREAMS, SURFACE, Stream
from pages import ROOT

START_S = 120.0  # longest time until the first surface
WARM_UP_S = 2.0  # after the first mesh: past the first registration
SILENCE_S = 1.0  # of the camera: the bag is over
LATE_S = 10.0  # after the bag: no search for the body takes longer
AFTER_S = 0.5  # until the answers to the last frames have arrived


def launch_arguments(options):
    thing = options.object or ROOT / "config" / ("doll.yaml" if options.scene.startswith("doll_") else "sponge.yaml")
    arguments = ["softbody_bringup", "playback.launch" if options.bag else "demo.launch", "rviz:=false",
                 "object:=" + os.path.abspath(thing), "nodelets:=" + str(options.nodelets).lower()]
    if options.bag:
        arguments += ["bag:=" + os.path.abspath(options.bag), f"rate:={options.speed}"]
    else:
        arguments += [f"{name}:={getattr(options, name)}" for name in ("scene", "rate", "width", "height")]
    if options.cuts:  # the scene starts 6 s late, when the graph is ready for its only cut
        arguments += [f"tool:={KNIFE}", "hold:=6"]
    return arguments


class Measurement:
    """The streams by topic, the knife if the scene has one, begin and end of the measurement, and CPU seconds by node."""

    def __init__(self, options):
        """Raises SystemExit with a sentence if there is nothing to measure, or if a signal asks to stop."""
        self.options = options
        with Graph("measure_live", launch_arguments(options), stdout=subprocess.DEVNULL) as graph:
            graph.wait_for_master()
            rospy.init_node("measure_live", anonymous=True, disable_signals=True)
            self.streams = {topic: Stream(topic) for topic in [CAMERA] + STREAMS + [CUTS]}
            self.knife = Knife() if options.cuts else None
            self._wait_for_surface(graph)
            self._measure(graph)

    def _wait_for_surface(self, graph):
        camera, bag = self.streams[CAMERA], self.options.bag
        deadline = time.monotonic() + START_S
        while not self.streams[SURFACE].stamps:
            if bag and camera.arrivals and time.monotonic() > camera.arrivals[-1] + LATE_S:
                sys.exit(f"measure_live: {bag} ended {LATE_S:.0f} s ago, and there is no mesh yet: it is too short, or it does not "
                         f"show the object. Play a longer bag; replay says whether the body is found")
            if not graph.runs():
                sys.exit(f"measure_live: the launch ended before anything came on {SURFACE}")
            if time.monotonic() > deadline:
                sys.exit(f"measure_live: nothing came on {SURFACE} within {START_S:.0f} s")
            graph.sleep(0.1)
        graph.sleep(WARM_UP_S)

    def _measure(self, graph):
        camera, options = self.streams[CAMERA], self.options
        before, self.begin, first = graph_times(graph.processes()), time.monotonic(), len(camera.stamps)
        # A slow camera delays the scene, and so its cut.
        due, longest_s = (first + options.rate * options.seconds, 4.0 * options.seconds) if options.cuts else (math.inf, options.seconds)
        while len(camera.stamps) < due and time.monotonic() < min(self.begin + longest_s, camera.arrivals[-1] + SILENCE_S):
            graph.sleep(0.01)
        self.end = min(time.monotonic(), camera.arrivals[-1] + 1.0 / options.rate)
        self.times = {row: seconds - before.get(row, 0.0) for row, seconds in graph_times(graph.processes()).items()}
        self.load = os.getloadavg()[0]
        graph.sleep(AFTER_S)
        if not camera.between(self.begin, self.end):
            sys.exit(f"measure_live: no image came in the measurement, which begins {WARM_UP_S:g} s after the first mesh. " + self._why_none())

    def _why_none(self):
        if not self.options.bag:
            return "The virtual camera is too slow, or it has ended: its log says why"
        after = self.streams[CAMERA].arrivals[-1] - self.streams[SURFACE].arrivals[0]
        return (f"{self.options.bag} ended {max(after, 0.0):.1f} s after it: it is too short. Play a bag that is at least "
                f"{WARM_UP_S - after + 1.0:.0f} s longer")
