"""A camera whose messages a test makes by hand."""
import threading
import time

import rospy
from sensor_msgs.msg import CameraInfo, Image

WIDTH, HEIGHT = 64, 48
OPTICAL_FRAME = "camera_color_optical_frame"
TOPICS = {"color": "/camera/color/image_raw", "info": "/camera/color/camera_info",
          "depth": "/camera/aligned_depth_to_color/image_raw"}


class Camera:
    """Images of nothing at 10 Hz, in wall time."""

    def __init__(self, **state):
        """@param state as in be()."""
        self.publishers = {name: rospy.Publisher(topic, CameraInfo if name == "info" else Image, queue_size=10)
                           for name, topic in TOPICS.items()}
        self.lock, self.on = threading.Lock(), True
        self.be(**state)
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def be(self, copies=None, unstamped=(), frames=None, late_by_s=0.0, apart_s=0.0):
        """@param copies of messages, by stream; 1 where nothing is said. @param frames by stream, likewise.
        @param apart_s by which depth's stamps are before colour's."""
        with self.lock:
            self.copies, self.unstamped, self.late_by_s = copies or {}, unstamped, late_by_s
            self.frames, self.apart_s = frames or {}, apart_s

    def run(self):
        while self.on:
            self.publish()
            time.sleep(0.1)

    def stop(self):
        self.on = False
        self.thread.join()
        for publisher in self.publishers.values():
            publisher.unregister()

    def publish(self):
        messages = {
            "info": CameraInfo(height=HEIGHT, width=WIDTH, K=[60, 0, 32, 0, 60, 24, 0, 0, 1],
                               P=[60, 0, 32, 0, 0, 60, 24, 0, 0, 0, 1, 0], R=[1, 0, 0, 0, 1, 0, 0, 0, 1]),
            "color": Image(height=HEIGHT, width=WIDTH, encoding="rgb8", step=3 * WIDTH, data=bytes(3 * WIDTH * HEIGHT)),
            "depth": Image(height=HEIGHT, width=WIDTH, encoding="16UC1", step=2 * WIDTH, data=bytes(2 * WIDTH * HEIGHT))}
        with self.lock:
            now = time.time() - self.late_by_s
            for name, message in messages.items():
                stamp = rospy.Time.from_sec(now - (self.apart_s if name == "depth" else 0.0))
                message.header.stamp = rospy.Time() if name in self.unstamped else stamp
                message.header.frame_id = self.frames.get(name, OPTICAL_FRAME)
                for _ in range(self.copies.get(name, 1)):
                    self.publishers[name].publish(message)
