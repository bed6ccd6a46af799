"""The shipped recording with other messages, e.g. with compressed images."""
import rosbag
import rospkg

SHARE = rospkg.RosPack().get_path("softbody_bringup")
BAG = f"{SHARE}/rosbags/bend_small.bag"
COLOR, DEPTH = "/camera/color/image_raw", "/camera/aligned_depth_to_color/image_raw"


def copy_bag(path, change):
    """Writes what change(topic, message) makes of each message of the recording, without the truth. @return path"""
    with rosbag.Bag(path, "w") as copied:
        for topic, message, stamp in rosbag.Bag(BAG):
            if not topic.startswith("/ground_truth"):
                copied.write(*change(topic, message), stamp)
    return path
