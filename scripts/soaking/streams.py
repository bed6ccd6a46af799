"""What one graph gets and gives: stamps of its images, and its states with their revisions and latency."""
import math
import struct
import threading
import time

import rospy

from live.streams import header

BEFORE_S = 0.5  # frames so close before a kill need no answer
NODE_S = 2.0  # longest time until a killed node works again
CAMERA_S = 10.0  # in which a camera is back


def is_outside(moment, spans):
    return not any(begin <= moment <= end for begin, end in spans)


class Side:
    """One graph, by its namespace and its camera's. All times are those of the system clock, as the stamps are."""

    def __init__(self, namespace, camera):
        self.namespace, self.begun = namespace, time.time()
        self.lock = threading.Lock()
        self.frames, self.states, self.kills = [], [], []  # stamps; (stamp, arrival); (time, node)
        self.halves = {"color": set(), "aligned_depth_to_color": set()}  # stamps of images
        self.revisions = {"volume": 0, "surface": 0}
        self.apart_since, self.longest_apart = None, 0.0
        subscribe = {"queue_size": 100, "buff_size": 1 << 24, "tcp_nodelay": True}
        for stream in self.halves:
            rospy.Subscriber(f"{camera}/{stream}/image_raw", rospy.AnyMsg, self._add_image, stream, **subscribe)
        for body in ("volume", "surface"):
            rospy.Subscriber(f"{namespace}/{body}/state", rospy.AnyMsg, self._add_state, body, **subscribe)

    def _add_image(self, message, stream):
        stamp, _ = header(message._buff)
        with self.lock:
            self.halves[stream].add(stamp)
            # A colour image needs its depth. What is late or repeated is dropped by the graph, as it should be.
            if all(stamp in stamps for stamps in self.halves.values()) and stamp > max(self.frames[-1:], default=0):
                self.frames.append(stamp)

    def _add_state(self, message, body):
        stamp, offset = header(message._buff)
        (revision,) = struct.unpack_from("<I", message._buff, offset + 8)  # after the time `observed`
        now = time.time()
        with self.lock:
            if body == "surface":
                self.states.append((stamp, now))
            self.revisions[body] = revision
            if self.revisions["volume"] == self.revisions["surface"]:
                self.apart_since = None
            elif self.apart_since is None:
                self.apart_since = now
            else:
                self.longest_apart = max(self.longest_apart, now - self.apart_since)

    def recovery_s(self, node):
        """Longest time until a killed node works again [s]; a frame in this time needs no answer. A manager starts the
        whole graph again, and may take as long as the graph's own start, on this machine beside the same work."""
        return self.states[0][1] - self.begun if node.endswith("/manager") else NODE_S

    def _disturbances(self):
        """(begin, end) of the times around kills in which a frame needs no answer. After that of a camera the graph
        recovers from its first frame on: the one after the longest silence."""
        for kill, node in self.kills:
            back = kill
            if node.endswith("/virtual_camera"):
                near = [stamp for stamp in self.frames if kill - BEFORE_S < stamp < kill + CAMERA_S]
                back = max(zip(near, near[1:]), key=lambda pair: pair[1] - pair[0], default=(kill, kill))[1]
            yield kill - BEFORE_S, back + self.recovery_s(node)

    def unanswered(self, begin, end):
        """Stamps of frames that got no state although no kill was near, and the number of all such frames."""
        with self.lock:
            answered = {stamp for stamp, _ in self.states}
            disturbed = list(self._disturbances())
            due = [stamp for stamp in self.frames if begin <= stamp < end and is_outside(stamp, disturbed)]
        return [stamp for stamp in due if stamp not in answered], len(due)

    def slowest_recoveries(self, end):
        """(limit [s], (time until a state of a later frame came [s], node)) of the kills with each limit; infinite
        if none came within a minute. A kill during a recovery begins it anew. Kills of the camera do not
        count: there are no frames until it is back."""
        with self.lock:
            states = list(self.states)
        slowest = {}
        for kill, node in self.kills:
            times = (arrival - kill for stamp, arrival in states if kill < stamp and arrival < kill + 60)
            time_s = min(times, default=float("inf"))
            again = math.isfinite(time_s) and any(kill < other < kill + time_s for other, _ in self.kills)
            if kill < end and not again and not node.endswith("/virtual_camera"):
                slowest.setdefault(self.recovery_s(node), []).append((time_s, node))
        return [(limit, max(times)) for limit, times in sorted(slowest.items())]

    def latency(self, begin, end):
        """Median time from a frame's stamp to its state [s], away from kills; None without states."""
        with self.lock:
            frames, disturbed = set(self.frames), list(self._disturbances())
            times = sorted(arrival - stamp for stamp, arrival in self.states
                           if begin <= stamp < end and stamp in frames and is_outside(stamp, disturbed))
        return times[len(times) // 2] if times else None
