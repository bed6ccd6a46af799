"""Python modules of MoveIt's messages, made from the definitions in this folder: Debian does not have them."""
import glob
import os
import subprocess
import sys

import rospkg

DEFINITIONS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "msg")
STANDARD = ("std_msgs", "geometry_msgs", "shape_msgs")
GENERATE = "import sys; from genpy.generator import MsgGenerator; from genpy.genpy_main import genmain; " \
           "genmain(['genmsg_py'] + sys.argv[1:], 'genmsg_py', MsgGenerator())"


def make(folder):
    """Writes the packages into a folder, and makes them known to this process."""
    packages = os.listdir(DEFINITIONS)
    paths = {package: f"{rospkg.RosPack().get_path(package)}/msg" for package in STANDARD}
    paths.update({package: f"{DEFINITIONS}/{package}" for package in packages})
    search = [f"-I{package}:{path}" for package, path in paths.items()]
    for package in packages:
        _run("-p", package, "-o", f"{folder}/{package}/msg", *search, *glob.glob(f"{DEFINITIONS}/{package}/*.msg"))
        _run("--initpy", "-p", package, "-o", f"{folder}/{package}/msg")
        with open(f"{folder}/{package}/__init__.py", "w", encoding="ascii"):
            pass
    sys.path.append(folder)


def _run(*arguments):
    subprocess.run([sys.executable, "-c", GENERATE, *arguments], check=True)
