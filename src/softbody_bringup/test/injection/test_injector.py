"""The live injector does to a stream what `inject` does to a bag with the same faults."""
import os
import subprocess
import tempfile
import time
import unittest

import rosbag
import rospy
from sensor_msgs.msg import CameraInfo, Image

COLOR, DEPTH, INFO = "color/image_raw", "aligned_depth_to_color/image_raw", "color/camera_info"
FRAMES, WIDTH, HEIGHT = 60, 64, 48
FAULTS = ["--seed", "7", "--drop", "0.2", "--duplicate", "0.1", "--reorder", "0.1", "--wrong-stamp", "0.1", "--stamp-by",
          "-0.25", "--holes", "0.25", "--occluder", "0.3", "--occluder-from", "0.5", "--occluder-for", "0.5"]
PATIENCE_S = 120.0


def image(number, encoding, pixel_bytes):
    message = Image(height=HEIGHT, width=WIDTH, encoding=encoding, step=pixel_bytes * WIDTH,
                    data=bytes([2]) * (pixel_bytes * WIDTH * HEIGHT))
    message.header.stamp = rospy.Time(1600000000 + number // 30, number % 30 * 33000000)
    message.header.frame_id = "camera"
    return message


def content(message):
    return message.header.stamp.to_nsec(), message.data


def by_bag():
    """What `inject` makes of the stream, by topic."""
    with tempfile.TemporaryDirectory() as folder:
        before, after = os.path.join(folder, "in.bag"), os.path.join(folder, "out.bag")
        with rosbag.Bag(before, "w") as bag:
            for k in range(FRAMES):
                for topic, message in ((COLOR, image(k, "bgr8", 3)), (DEPTH, image(k, "16UC1", 2))):
                    bag.write("/camera/" + topic, message, message.header.stamp)
        subprocess.run(["rosrun", "softbody_bringup", "inject", before, "--output", after, *FAULTS], check=True)
        seen = {COLOR: [], DEPTH: []}
        for topic, message, _ in rosbag.Bag(after).read_messages():
            seen[topic[len("/camera/"):]].append(content(message))
        return seen


class Injector(unittest.TestCase):
    def wait(self, condition, what):
        deadline = time.monotonic() + PATIENCE_S
        while not condition():
            self.assertLess(time.monotonic(), deadline, what)
            time.sleep(0.02)

    def test_live_is_as_in_a_bag(self):
        expected = by_bag()
        seen = {COLOR: [], DEPTH: [], INFO: []}
        publishers = {topic: rospy.Publisher("/camera/" + topic, kind, queue_size=100)
                      for topic, kind in ((COLOR, Image), (DEPTH, Image), (INFO, CameraInfo))}
        subscribers = [rospy.Subscriber("/camera_faulty/" + topic, kind, seen[topic].append, queue_size=1000)
                       for topic, kind in ((COLOR, Image), (DEPTH, Image), (INFO, CameraInfo))]
        self.wait(lambda: all(p.get_num_connections() for p in publishers.values()), "the injector subscribes")
        self.wait(lambda: all(s.get_num_connections() for s in subscribers), "the injector publishes")
        for k in range(FRAMES):
            publishers[COLOR].publish(image(k, "bgr8", 3))
            publishers[DEPTH].publish(image(k, "16UC1", 2))
            publishers[INFO].publish(CameraInfo(width=k + 1))
            time.sleep(0.02)
        self.wait(lambda: all(len(seen[topic]) >= len(expected[topic]) for topic in expected) and len(seen[INFO]) == FRAMES,
                  f"{[len(messages) for messages in expected.values()]} images and {FRAMES} camera infos")
        for topic in (COLOR, DEPTH):
            self.assertLess(len(expected[topic]), FRAMES)
            self.assertEqual([content(message) for message in seen[topic]], expected[topic])
        self.assertEqual([info.width for info in seen[INFO]], list(range(1, FRAMES + 1)))
