"""Bags with compressed images, with other topic names, with shifted depth, and no bag at all."""
import os
import subprocess
import tempfile
import unittest

import numpy as np
import rosbag
from softbody.compress_bag import pixels_of

from compressed_bag import BAG, COLOR, DEPTH, SHARE, copy_bag

OBJECT = f"{SHARE}/config/sponge.yaml"
RENAMED = {COLOR: "/rgb/image_raw", "/camera/color/camera_info": "/rgb/camera_info",
           DEPTH: "/depth_to_rgb/image_raw", "/camera/aligned_depth_to_color/camera_info": "/depth_to_rgb/camera_info"}
NAMES = ["--color", "/rgb/image_raw", "--depth", "/depth_to_rgb/image_raw"]


def shift(topic, image):
    if topic == DEPTH:
        image.data = np.roll(pixels_of(image), 30, axis=1).tobytes()
    return topic, image


def tool(name, *arguments):
    return subprocess.run(["rosrun", "softbody_bringup", name, *arguments], capture_output=True, text=True, timeout=300,
                          check=False)


class CameraBags(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def copy(self, name, change):
        return copy_bag(self.path(name), change)

    def surfaces(self, bag, *names):
        result = self.path("result.bag")
        done = tool("replay", bag, "--object", OBJECT, "--output", result, *names)
        self.assertEqual(done.returncode, 0, done.stderr)
        vertices = [message.vertices for _, message, _ in rosbag.Bag(result).read_messages("/softbody/surface/state")]
        self.assertTrue(vertices)
        return vertices

    def test_compressed_images_are_replayed_like_raw_ones(self):
        """PNG loses nothing."""
        compressed = self.path("compressed.bag")
        made = tool("compress_bag", BAG, compressed)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertLess(os.path.getsize(compressed), os.path.getsize(BAG))
        again = tool("compress_bag", BAG, compressed)
        self.assertEqual(again.returncode, 1)
        self.assertEqual(again.stderr, f"compress_bag: {compressed} exists; give another name or remove it\n")
        self.assertEqual(self.surfaces(compressed), self.surfaces(BAG))
        checked = tool("validate_bag", compressed)
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)

    def test_an_image_with_missing_rows_is_not_compressed(self):
        def shorten(topic, message):
            if topic == COLOR:
                message.data = message.data[:-1]
            return topic, message
        refused = tool("compress_bag", self.copy("short.bag", shorten), self.path("short_compressed.bag"))
        self.assertEqual(refused.returncode, 1)
        self.assertRegex(refused.stderr, f"{COLOR} at .* s: the image has [0-9]+ bytes, not [0-9]+ rows of")
        self.assertFalse([name for name in os.listdir(self.path("")) if name.startswith("short_compressed")])

    def test_topics_may_have_other_names(self):
        renamed = self.copy("renamed.bag", lambda topic, message: (RENAMED.get(topic, topic), message))
        self.assertEqual(self.surfaces(renamed, *NAMES), self.surfaces(BAG))
        self.assertEqual(tool("validate_bag", renamed, *NAMES).returncode, 0)
        refused = tool("replay", renamed, "--object", OBJECT, "--output", self.path("result.bag"))
        self.assertEqual(refused.returncode, 1)
        self.assertIn("/rgb/image_raw", refused.stderr)
        self.assertIn("--color", refused.stderr)

    def test_depth_beside_colour_is_found(self):
        shifted = tool("validate_bag", self.copy("shifted.bag", shift))
        self.assertEqual(shifted.returncode, 1)
        self.assertIn("pixels beside those of", shifted.stdout)
        self.assertEqual(tool("validate_bag", BAG).returncode, 0)

    def test_no_file_is_called_so(self):
        for name, more in (("validate_bag", []), ("replay", ["--object", OBJECT, "--output", self.path("out.bag")])):
            refused = tool(name, self.path("nothing.bag"), *more)
            self.assertEqual(refused.returncode, 2, name)
            self.assertIn(f"File does not exist: {self.path('nothing.bag')}", refused.stdout + refused.stderr)
