"""The shipped recording with compressed images, as image_transport's plugins write them."""
import struct

import numpy as np
import rosbag
import rospkg
from sensor_msgs.msg import CompressedImage

from driver_camera import png

SHARE = rospkg.RosPack().get_path("softbody_bringup")
BAG = f"{SHARE}/rosbags/bend_small.bag"
COLOR, DEPTH = "/camera/color/image_raw", "/camera/aligned_depth_to_color/image_raw"


def array(image):
    if image.encoding == "16UC1":
        return np.frombuffer(image.data, np.uint16).reshape(image.height, image.width)
    pixels = np.frombuffer(image.data, np.uint8).reshape(image.height, image.width, 3)
    return pixels if image.encoding == "rgb8" else pixels[..., ::-1]


def compress(topic, image):
    if topic not in (COLOR, DEPTH):
        return topic, image
    packed = CompressedImage(header=image.header)
    packed.format = f"{image.encoding}; png compressed bgr8" if topic == COLOR else "16UC1; compressedDepth png"
    packed.data = png(array(image)) if topic == COLOR else struct.pack("<iff", 0, 0, 0) + png(array(image))
    return topic + ("/compressed" if topic == COLOR else "/compressedDepth"), packed


def copy_bag(path, change):
    """Writes what change(topic, message) makes of each message of the recording, without the truth. @return path"""
    with rosbag.Bag(path, "w") as copied:
        for topic, message, stamp in rosbag.Bag(BAG):
            if not topic.startswith("/ground_truth"):
                copied.write(*change(topic, message), stamp)
    return path
