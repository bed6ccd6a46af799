"""What the drivers of cameras publish: topics, encodings, sizes and frames, as their documentation says."""
import struct
import threading
import time

import numpy as np
import rospy
import tf2_ros
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import CameraInfo, CompressedImage, Image
from softbody.compress_bag import png

HOLE = (slice(0, 8), slice(0, 8))  # rows and columns without depth
DEPTH_M = 0.6
CHANNELS = {"rgb8": 3, "bgr8": 3, "rgba8": 4, "bgra8": 4, "mono8": 1}
TYPES = {"16UC1": np.uint16, "32FC1": np.float32}


class Stream:
    def __init__(self, topic, encoding, frame, size, focal_px, transport="raw", info=True, model="plumb_bob", coefficients=5):
        self.topic, self.encoding, self.frame, self.size, self.focal_px = topic, encoding, frame, size, focal_px
        self.transport, self.info, self.model, self.coefficients = transport, info, model, coefficients

    def info_topic(self):
        return self.topic.rsplit("/", 1)[0] + "/camera_info"

    def pixels(self):
        width, height = self.size
        if self.encoding in CHANNELS:
            image = np.zeros((height, width, CHANNELS[self.encoding]), np.uint8)
            image[..., 0] = np.arange(width, dtype=np.uint8)
            image[..., -1] = 200
            return image
        millimetres = self.encoding == "16UC1"
        depth = np.full((height, width), DEPTH_M * (1000 if millimetres else 1), TYPES[self.encoding])
        depth[HOLE] = 0 if millimetres else np.nan
        return depth


COLOR, DEPTH = "camera_color_optical_frame", "camera_depth_optical_frame"
# One row for each driver: its colour, its depth, frames a second.
DRIVERS = {
    "realsense": (Stream("/camera/color/image_raw", "rgb8", COLOR, (640, 480), 615),
                  Stream("/camera/aligned_depth_to_color/image_raw", "16UC1", COLOR, (640, 480), 615), 60),
    "realsense_unregistered": (Stream("/camera/color/image_raw", "rgb8", COLOR, (640, 480), 615),
                               Stream("/camera/depth/image_rect_raw", "16UC1", DEPTH, (848, 480), 425), 30),
    "azure_kinect": (Stream("/rgb/image_raw", "bgra8", "rgb_camera_link", (1280, 720), 608, model="rational_polynomial",
                            coefficients=8),
                     Stream("/depth_to_rgb/image_raw", "16UC1", "rgb_camera_link", (1280, 720), 608,
                            model="rational_polynomial", coefficients=8), 15),
    "azure_kinect_unregistered": (Stream("/rgb/image_raw", "bgra8", "rgb_camera_link", (1280, 720), 608,
                                         model="rational_polynomial", coefficients=8),
                                  Stream("/depth/image_raw", "32FC1", "depth_camera_link", (640, 576), 504,
                                         model="rational_polynomial", coefficients=8), 15),
    "openni2": (Stream("/camera/rgb/image_raw", "rgb8", "camera_rgb_optical_frame", (640, 480), 525),
                Stream("/camera/depth_registered/image_raw", "16UC1", "camera_rgb_optical_frame", (640, 480), 525), 30),
    "openni2_unregistered": (Stream("/camera/rgb/image_raw", "rgb8", "camera_rgb_optical_frame", (640, 480), 525),
                             Stream("/camera/depth/image_raw", "16UC1", DEPTH, (640, 480), 570), 30),
    "zed": (Stream("/zed/zed_node/rgb/image_rect_color", "bgra8", "zed_left_camera_optical_frame", (672, 376), 340),
            Stream("/zed/zed_node/depth/depth_registered", "32FC1", "zed_left_camera_optical_frame", (672, 376), 340), 15),
}


def compressed(stream, pixels):
    """@return format and data, as image_transport's plugins write them."""
    if stream.transport == "compressed":
        return f"{stream.encoding}; png compressed bgr8", png(pixels.squeeze())
    if stream.encoding == "16UC1":
        return "16UC1; compressedDepth png", struct.pack("<iff", 0, 0, 0) + png(pixels.squeeze())
    a = 100.0 * 101.0  # depth_quantization 100, depth_max 10 m
    b = 1.0 - a / 10.0
    inverse = np.where(np.isfinite(pixels), a / np.where(np.isfinite(pixels), pixels, 1.0) + b, 0.0).astype(np.uint16)
    return "32FC1; compressedDepth png", struct.pack("<iff", 0, a, b) + png(inverse)


def camera_info(stream):
    width, height = stream.size
    f, cx, cy = stream.focal_px, 0.5 * (width - 1), 0.5 * (height - 1)
    return CameraInfo(width=width, height=height, distortion_model=stream.model, D=[0.0] * stream.coefficients,
                      K=[f, 0, cx, 0, f, cy, 0, 0, 1], R=[1, 0, 0, 0, 1, 0, 0, 0, 1], P=[f, 0, cx, 0, 0, f, cy, 0, 0, 0, 1, 0])


class DriverCamera:
    """Publishes a colour and a depth stream with equal stamps. The depth camera is 15 mm beside that of colour."""

    def __init__(self, color, depth, rate):
        self.streams, self.rate, self.on = [stream for stream in (color, depth) if stream], rate, True
        self.messages, self.publishers = [], []
        for stream in self.streams:
            self.prepare(stream)
        if color and depth and color.frame != depth.frame:
            self.place(color.frame, depth.frame)
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def prepare(self, stream):
        pixels = stream.pixels()
        if stream.transport == "raw":
            message = Image(height=stream.size[1], width=stream.size[0], encoding=stream.encoding,
                            step=pixels.strides[0], data=pixels.tobytes())
            topic = stream.topic
        else:
            form, data = compressed(stream, pixels)
            message, topic = CompressedImage(format=form, data=data), f"{stream.topic}/{stream.transport}"
        topics = [(topic, message)] + ([(stream.info_topic(), camera_info(stream))] if stream.info else [])
        for name, prepared in topics:
            prepared.header.frame_id = stream.frame
            self.messages.append(prepared)
            self.publishers.append(rospy.Publisher(name, type(prepared), queue_size=2))

    def place(self, parent, child):
        transform = TransformStamped(child_frame_id=child)
        transform.header.frame_id = parent
        transform.transform.translation.x, transform.transform.rotation.w = 0.015, 1.0
        self.broadcaster = tf2_ros.StaticTransformBroadcaster()
        self.broadcaster.sendTransform(transform)

    def run(self):
        while self.on and not rospy.is_shutdown():
            stamp = rospy.Time.from_sec(time.time())
            for publisher, message in zip(self.publishers, self.messages):
                message.header.stamp = stamp
                publisher.publish(message)
            time.sleep(1.0 / self.rate)

    def stop(self):
        self.on = False
        self.thread.join()
