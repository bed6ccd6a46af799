#!/usr/bin/python3
"""Checks the walls between ROS and the cores, between packages and between rooms.

Libraries are checked once they are built. Prints one line per fault; exit code 1 if there is any.
A room is a folder of src/core with the public headers of the folder of the same name below include/PACKAGE.
"""
import functools
import graphlib
import os
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

from files import ROOT

LIBRARIES = ROOT / "catkin_ws/devel/lib"
# A package uses only packages to its left.
PACKAGES = ["softbody_msgs", "softbody_common", "softbody_python", "softbody_rviz_plugins", "softbody_tracking", "softbody_sim",
            "softbody_recordings", "softbody_virtual_camera", "softbody_scanning", "softbody_evaluation",
            "softbody_bringup"]
MOST_FILES = 25
MOST_LINES = 350
CPP = {".h", ".cpp"}
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.MULTILINE)
ROS_LIBRARY = re.compile(
    r"lib(ros|xmlrpcpp|cpp_common|tf2?[._]|tf2_|cv_bridge|image_|message_filters|nodelet|pluginlib|class_loader|"
    r"diagnostic_|interactive_markers|topic_tools|eigen_conversions|softbody_\w+_(ros|nodes)\b)")
NOT_SOURCES = {".git", "catkin_ws", "__pycache__", "bench", "demo_output", "evaluation", "soak", "validation"}


class Source:
    """A C++ file: its package, its place in the package, and what it includes."""

    def __init__(self, path):
        self.name = str(path.relative_to(ROOT))
        self.package, *parts = path.relative_to(ROOT / "src").parts
        self.place = pathlib.PurePosixPath(*parts)
        self.includes = [(quote, pathlib.PurePosixPath(target))
                         for quote, target in INCLUDE.findall(path.read_text())]
        self.public = f"include/{self.package}"
        self.may_use_ros = self.package == "softbody_bringup" or self.is_below(
            f"{self.public}/ros", "src/ros", "src/nodes", "bench/ros", "test")

    def is_below(self, *folders):
        return any(self.place.is_relative_to(folder) for folder in folders)

    @property
    def room(self):
        """The room of a core's file, or None."""
        for folder in ("src/core", self.public):
            if self.is_below(folder) and not self.is_below(f"{self.public}/ros"):
                return str(self.place.relative_to(folder).parent)
        return None


@functools.cache
def is_ros(target):
    """Whether a header belongs to a ROS package: Debian installs a package.xml for each."""
    package = target.parts[0]
    if package in ("ros", "rosbag", "softbody_msgs"):
        return True
    if package.startswith("softbody_"):
        return target.parts[1:2] == ("ros",)
    return pathlib.Path("/usr/share", package, "package.xml").exists()


def ros_faults(sources):
    for source in sources:
        if source.may_use_ros:
            continue
        for _, target in source.includes:
            if is_ros(target) or target.parts[0] in ("nodes", "ros"):
                yield f"{source.name}: includes ROS ({target}); only ros/ and nodes/ may"


def package_faults(sources):
    for source in sources:
        for _, target in source.includes:
            other = target.parts[0]
            if other in PACKAGES and PACKAGES.index(other) > PACKAGES.index(source.package):
                yield f"{source.name}: includes {target} of a package above its own"
    for package in PACKAGES:
        manifest = ElementTree.parse(ROOT / "src" / package / "package.xml").getroot()
        for other in {element.text for element in manifest if element.tag.endswith("depend")}:
            if other in PACKAGES[PACKAGES.index(package):]:
                yield f"src/{package}/package.xml: depends on {other}, which is not below it"


def include_style_faults(sources):
    for source in sources:
        package = ROOT / "src" / source.package
        # A header of the same package has one spelling; bench/ and test/ add their own folders.
        folders = [package / "src/core", package / "src", package / "test", package]
        for quote, target in source.includes:
            first = target.parts[0]
            own = first.startswith("softbody_") and first != "softbody_msgs"
            if own and quote == "<":
                yield f'{source.name}: <{target}> should be "{target}"'
            if own and not (ROOT / "src" / first / "include" / target).exists():
                yield f"{source.name}: there is no public header {target}"
            if quote == '"' and not own and not any((folder / target).exists() for folder in folders):
                yield f"{source.name}: {target} is not room/file.h from src/core, src or test"


def header_faults(sources):
    names = {(source.package, str(source.place)) for source in sources}
    for source in sources:
        if source.place.suffix != ".cpp" or not source.is_below("src/core"):
            continue
        header = source.place.with_suffix(".h")
        public = f"{source.public}/{header.relative_to('src/core')}"
        if not {(source.package, str(header)), (source.package, public)} & names:
            yield f"{source.name}: has no header of its own ({header.name} beside it or in {public})"


def room_faults(sources):
    graphs = {}  # {package: {room: {room it includes: a file that does}}} of the cores
    for source in sources:
        if source.room is None:
            continue
        graph = graphs.setdefault(source.package, {}).setdefault(source.room, {})
        for quote, target in source.includes:
            if target.parts[0] == source.package:
                target = target.relative_to(source.package)
            elif quote == "<" or not (ROOT / "src" / source.package / "src/core" / target).exists():
                continue
            if str(target.parent) != source.room:
                graph.setdefault(str(target.parent), source.name)
    for package, graph in graphs.items():
        try:
            graphlib.TopologicalSorter(graph).prepare()
        except graphlib.CycleError as error:
            ring = error.args[1][::-1]  # each room includes the next
            steps = [f"{a} -> {b} ({graph[a][b]})" for a, b in zip(ring, ring[1:])]
            yield f"src/{package}: the rooms include each other: {', '.join(steps)}"


def size_faults():
    for place, folders, names in os.walk(ROOT):
        folder = pathlib.Path(place)
        left_out = NOT_SOURCES if folder == ROOT else {"__pycache__"}
        folders[:] = sorted(name for name in folders if name not in left_out)
        files = [folder / name for name in sorted(names) if not (folder / name).is_symlink()]
        if len(files) > MOST_FILES:
            yield f"{folder.relative_to(ROOT)}: {len(files)} files, more than {MOST_FILES}"
        for path in files:
            is_text = path.suffix in CPP | {".py"} or (path.suffix == "" and path.read_bytes()[:2] == b"#!")
            lines = len(path.read_text().splitlines()) if is_text else 0
            if lines > MOST_LINES:
                yield f"{path.relative_to(ROOT)}: {lines} lines, more than {MOST_LINES}"


def library_faults():
    if not LIBRARIES.is_dir():
        return
    lists = "".join(path.read_text() for path in sorted((ROOT / "src").glob("*/CMakeLists.txt")))
    for name in re.findall(r"^softbody_core_library\((\w+)", lists, re.MULTILINE):
        path = LIBRARIES / f"lib{name}.so"
        if not path.exists():
            yield f"{path}: not built"
            continue
        dynamic = subprocess.run(["readelf", "-d", path], stdout=subprocess.PIPE, text=True, check=True).stdout
        for needed in re.findall(r"\(NEEDED\).*\[(.*)\]", dynamic):
            if ROS_LIBRARY.match(needed):
                yield f"{path.name}: linked to {needed}; a core does without ROS"


# All but the programs of a package of its own (CATKIN_IGNORE).
sources = [Source(path) for path in sorted((ROOT / "src").rglob("*"))
           if path.suffix in CPP and not (path.parent / "CATKIN_IGNORE").exists()]
faults = [*ros_faults(sources), *package_faults(sources), *include_style_faults(sources), *header_faults(sources),
          *room_faults(sources), *size_faults(), *library_faults()]
sys.exit("\n".join(faults) or int(not sources))
