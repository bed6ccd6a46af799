"""Streams of messages from the camera to the surface: stamps, arrivals, and what lacks between them."""
import struct
import time

import rospy

# CameraInfo is small, and one is sent with every image.
CAMERA, SURFACE = "/camera/color/camera_info", "/softbody/surface/state"
TOOL = "/softbody/tool/pose"
STREAMS = ["/softbody/rgb/camera_info", TOOL, "/softbody/targets", "/softbody/volume/state", SURFACE]
CUTS = "/softbody/cut"
AROUND_S = 0.5  # before and after a cut


def header(buffer):
    """The stamp [s] of a message, and where it goes on after its header."""
    _, secs, nsecs, length = struct.unpack_from("<IIII", buffer)
    return secs + 1e-9 * nsecs, 16 + length


class Stream:
    """Stamps and arrival times of a topic's messages."""

    def __init__(self, topic):
        self.stamps, self.arrivals, self.clock = [], [], []
        rospy.Subscriber(topic, rospy.AnyMsg, self.add, queue_size=100, buff_size=1 << 24, tcp_nodelay=True)

    def add(self, message):
        self.stamps.append(header(message._buff)[0])
        self.arrivals.append(time.monotonic())
        self.clock.append(time.time())

    def between(self, begin, end):
        """Stamps and arrival times of the messages that arrived in this time."""
        return [(s, a) for s, a in zip(self.stamps, self.arrivals) if begin <= a < end]


def gaps(messages, frames, due, cuts, begin, end, rate):
    """The longest gap between two messages, in due frames (by stamps), and in ms (by arrivals) over gaps in which all frames are
    due. Begin and end of the measurement count as messages if the first or the last due frame has no message. With cuts, only gaps
    near a cut count."""
    first_due, last_due = min(due, default=0.0), max(due, default=0.0)
    if messages[0][0] > first_due:
        messages = [(first_due - 0.5 / rate, begin), *messages]
    if messages[-1][0] < last_due:
        messages = [*messages, (last_due, end)]
    steps = []
    for (before, last), (now, arrival) in zip(messages, messages[1:]):
        between = [frame for frame in frames if before < frame <= now]
        near = not cuts or any(before - AROUND_S <= cut <= now + AROUND_S for cut in cuts)
        if near and due.intersection(between):
            steps.append((sum(frame in due for frame in between), 1e3 * (arrival - last) if due.issuperset(between) else 0.0))
    return max((step[0] for step in steps), default=0), max((step[1] for step in steps), default=0.0)
