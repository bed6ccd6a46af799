"""rviz on a virtual screen, with displays and a view of one's own, and nothing else."""
import os
import subprocess
import tempfile
import time

import numpy as np
import yaml

from hand_made_body import FRAME
from virtual_screen import VirtualScreen

PATIENCE_S = 15.0


def pixels_of(picture, color):
    """Rows and columns of the pixels of a colour, under light of any strength."""
    values = picture.astype(float)
    length = np.linalg.norm(values, axis=2)
    cosine = values @ np.array(color, float) / np.maximum(length, 1.0) / np.linalg.norm(color)
    return np.nonzero((cosine > 0.99) & (length > 80.0))


class Rviz:
    """Runs until end()."""

    def __init__(self, displays, view, width=800, height=600, namespace="/"):
        self.folder = tempfile.TemporaryDirectory()
        self.screen = VirtualScreen(width, height)
        self.screen.__enter__()
        path = os.path.join(self.folder.name, "test.rviz")
        config = {"Panels": [], "Visualization Manager": {
            "Class": "", "Displays": displays, "Enabled": True, "Name": "root", "Tools": [], "Value": True,
            "Global Options": {"Background Color": "0; 0; 0", "Fixed Frame": FRAME, "Frame Rate": 10},
            "Views": {"Current": view}}, "Window Geometry": {"Width": width, "Height": height}}
        with open(path, "w", encoding="utf-8") as file:
            yaml.safe_dump(config, file)
        # Mesa's default, llvmpipe, now and then crashes in its compiler (libLLVM) on a busy machine.
        environment = {**self.screen.environment, "GALLIUM_DRIVER": "softpipe"}
        self.process = subprocess.Popen(["/usr/lib/rviz/rviz", "-d", path, f"__ns:={namespace}"], env=environment, start_new_session=True)

    def end(self):
        self.process.terminate()
        self.process.wait()
        self.screen.__exit__()
        self.folder.cleanup()

    def is_alive(self):
        return self.process.poll() is None

    def picture(self):
        return self.screen.picture()

    def wait_for(self, condition):
        """Whether the screen comes to fulfil a condition."""
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline and self.is_alive():
            if condition(self.picture()):
                return True
            time.sleep(0.2)
        return False
