"""Runs the examples of one page, in order, in a scratch folder that looks like the repository."""
import os
import re
import shutil
import signal
import socket
import subprocess
import time

import yaml

HERE = os.path.dirname(os.path.abspath(__file__))
TIMEOUT_S = 600
# Programs that only check their arguments: in every block, and in a block that is marked live.
ALWAYS_CHECKED = ("roslaunch", "make")
CHECKED_LIVE = ALWAYS_CHECKED + ("rosrun", "rosbag", "rosservice", "rostopic", "rosparam", "rosnode", "rqt_graph", "rviz", "roscore", "time")
GRAPH_SECTIONS = ("camera_ingest", "feature_tracker", "pose_marker", "simulator", "surface", "tool_tracker")


class ExampleFailed(Exception):
    pass


def free_port():
    with socket.socket() as server:
        server.bind(("localhost", 0))
        return server.getsockname()[1]


def end_group(process, number):
    """Sends a signal to a process and its group, and waits for the process."""
    try:
        os.killpg(process.pid, number)
        process.wait(60)
    except (ProcessLookupError, subprocess.TimeoutExpired):
        pass


def end_all_of(master):
    """Ends what still runs with this master: roslaunch starts its nodes in groups of their own."""
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{pid}/environ", "rb") as environment:
                if f"ROS_MASTER_URI={master}".encode() in environment.read().split(b"\0") and int(pid) != os.getpid():
                    os.kill(int(pid), signal.SIGKILL)
        except (OSError, ProcessLookupError):
            pass  # it has ended, or belongs to somebody else


class PageRunner:
    """A scratch copy of the repository's root, a master of its own, and the reader's files."""

    def __init__(self, root, stand_ins, scratch):
        self.folder, self.background, self.yaml_files = f"{scratch}/page", [], 0
        shutil.copytree(stand_ins, self.folder)
        for name in ("config", "launch", "rosbags", "docs", "src", "tests", "Makefile", "README.md"):
            os.symlink(f"{root}/{name}", f"{self.folder}/{name}")
        self.stubs(f"{self.folder}/scripts", [name for name in os.listdir(f"{root}/scripts") if "." not in name])
        self.programs = {**dict.fromkeys(("run", "fails", "bad"), f"{scratch}/run"), "live": f"{scratch}/live", "background": ""}
        self.stubs(self.programs["run"], ALWAYS_CHECKED)
        self.stubs(self.programs["live"], CHECKED_LIVE)
        self.port = free_port()
        self.environment = {**os.environ, "ROS_MASTER_URI": f"http://localhost:{self.port}", "PWD": self.folder,
                            "XDG_CACHE_HOME": f"{scratch}/cache"}
        os.makedirs(f"{self.folder}/catkin_ws/devel")
        with open(f"{self.folder}/catkin_ws/devel/setup.bash", "w", encoding="utf-8"):
            pass  # the environment is set up already

    @staticmethod
    def stubs(folder, names):
        os.makedirs(folder)
        for name in names:
            os.symlink(f"{HERE}/check_only.py", f"{folder}/{name}")

    def run(self, example):
        """Raises ExampleFailed with what the example printed."""
        if example.language == "yaml":
            self.load(example)
        elif example.marker == "background":
            self.start(example.text)
        else:
            self.bash(example)

    def environment_of(self, marker):
        return {**self.environment, "PATH": f"{self.programs[marker]}:{self.environment['PATH']}"}

    def bash(self, example):
        try:
            result = subprocess.run(["bash", "-e", "-c", example.text], cwd=self.folder, env=self.environment_of(example.marker),
                                    stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                    errors="replace", timeout=TIMEOUT_S, check=False)
        except subprocess.TimeoutExpired as error:
            raise ExampleFailed(f"runs for more than {TIMEOUT_S} s") from error
        refused = "success: False" in result.stdout  # what rosservice prints of a service that does not do it
        if (result.returncode != 0 or refused) != (example.marker == "fails"):
            raise ExampleFailed(f"exit code {result.returncode}:\n{result.stdout[-3000:]}")
        # What evaluate says of the example's result; `bad` marks one that shows a bad result.
        verdicts = re.findall(r"^verdict: (\w+)$", result.stdout, re.MULTILINE)
        if (set(verdicts) - {"good"} != set()) != (example.marker == "bad"):
            raise ExampleFailed(f"the verdict is {', '.join(verdicts) or 'missing'}:\n{result.stdout[-3000:]}")

    def start(self, command):
        log = open(f"{self.folder}/background.log", "a", encoding="utf-8")
        self.background.append(subprocess.Popen(["bash", "-c", command], cwd=self.folder, env=self.environment,
                                                stdin=subprocess.DEVNULL, stdout=log, stderr=log, start_new_session=True))

        self.wait_for_master()

    def wait_for_master(self):
        """The next example takes for granted that the graph has been started."""
        end = time.monotonic() + TIMEOUT_S
        while time.monotonic() < end:
            with socket.socket() as client:
                if client.connect_ex(("localhost", self.port)) == 0:
                    return
            time.sleep(0.1)
        raise ExampleFailed("no master comes up")

    def close(self):
        for process in self.background:
            end_group(process, signal.SIGINT)
        if self.background:
            end_all_of(self.environment["ROS_MASTER_URI"])
        self.background.clear()

    def tool(self, command, accepted=(0,)):
        result = subprocess.run(command.split(), cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=TIMEOUT_S, check=False)
        if result.returncode not in accepted or "unknown" in result.stdout:  # an unknown key is only a warning
            raise ExampleFailed(f"{command}: exit code {result.returncode}:\n{result.stdout[-3000:]}")
        return result.stdout

    # --- YAML ----------------------------------------------------------------------------------------------------------
    def load(self, example):
        """Loads a YAML example by the tool that it is for."""
        self.yaml_files += 1
        name = f"my_object/example_{self.yaml_files}.yaml"
        with open(f"{self.folder}/{name}", "w", encoding="utf-8") as file:
            file.write(example.text)
        for mesh in ("sponge.obj", "sponge_cage.obj", "sponge_tets.vtu", "doll.obj"):
            if not os.path.exists(f"{self.folder}/my_object/{mesh}"):
                shutil.copy(f"{self.folder}/config/{mesh}", f"{self.folder}/my_object/{mesh}")
        keys = set(yaml.safe_load(example.text))
        if "object" in keys:
            self.load_object(name)
        elif "gripper" in keys or "frame" in yaml.safe_load(example.text).get("tool", {}):
            self.tool(f"rosrun softbody_bringup replay my.bag --object config/sponge.yaml --{min(keys)} {name} --output example.bag")
        elif "tool" in keys:
            # It reads the file, or says where it is wrong; the stand-in's tool is not in view all the time.
            if "frames " not in self.tool(f"rosrun softbody_bringup check_tool my.bag --tool {name}", accepted=(0, 1)):
                raise ExampleFailed("check_tool does not read it")
        elif "image_width" in keys:
            self.tool(f"rosrun softbody_bringup import_images my_images --camera {name} --output example.bag")
        elif keys <= set(GRAPH_SECTIONS):
            self.load_parameters(name, keys)
        else:
            raise ExampleFailed(f"no tool is known for a YAML file with the keys {sorted(keys)}")

    def load_object(self, name):
        self.tool(f"rosrun softbody_bringup replay my.bag --object {name} --output example.bag")
        self.start_node(f"rosrun softbody_sim simulator __ns:=/softbody _object:={self.folder}/{name}")

    def load_parameters(self, name, sections):
        self.tool(f"rosrun softbody_bringup replay my.bag --object config/sponge.yaml --parameters {name} --output example.bag")
        if "simulator" in sections:
            self.start_node(f"rosrun softbody_sim simulator __ns:=/softbody _object:={self.folder}/config/sponge.yaml", name)

    def start_node(self, command, parameters=None):
        """A node takes its files and parameters if it still runs once it has sent a topology."""
        with open(f"{self.folder}/node.log", "w+", encoding="utf-8") as log:
            def start(words):
                return subprocess.Popen(words, cwd=self.folder, env=environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                                        start_new_session=True)

            environment = {**self.environment, "ROS_MASTER_URI": f"http://localhost:{free_port()}"}
            processes = [start(["rosmaster", "--core", "-p", environment["ROS_MASTER_URI"].rsplit(":", 1)[1]])]
            try:
                if parameters:
                    self.wait_for(["rosparam", "load", parameters, "/softbody"], environment, processes)
                processes.append(start(command.split()))
                self.wait_for(["rostopic", "echo", "-n1", "/softbody/volume/topology/revision"], environment, processes)
            except ExampleFailed as error:
                log.seek(0)
                raise ExampleFailed(f"{command}: {error}\n{log.read()[-3000:]}") from error
            finally:
                for process in reversed(processes):
                    end_group(process, signal.SIGKILL)

    def wait_for(self, command, environment, processes):
        end = time.monotonic() + TIMEOUT_S
        while time.monotonic() < end:
            ended = [process for process in processes if process.poll() is not None]
            if ended:
                raise ExampleFailed("it ends")
            try:
                if subprocess.run(command, cwd=self.folder, env=environment, timeout=10, capture_output=True, check=False).returncode == 0:
                    return
            except subprocess.TimeoutExpired:
                pass
            time.sleep(0.2)
        raise ExampleFailed(f"{' '.join(command)} does not answer")
