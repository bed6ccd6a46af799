"""The processes of a roslaunch: which node is which process, how each ends, and how much memory it holds."""
import os
import re
import signal
import subprocess
import threading
import time

import rosgraph

from live.graph import MARK, free_port, processes_of
from live.process_times import command_line

_DIED = re.compile(r"\[([\w/]+)-\d+\] process has died \[pid (\d+), exit code (-?\d+)")
_FINISHED = re.compile(r"\[([\w/]+)-\d+\] process has finished cleanly")
_STUBBORN = re.compile(r"\[([\w/]+)-\d+\] escalating to (SIG\w+)")
_LISTED_S = 0.5  # a look at /proc is good for so long


class Graph:
    """A running roslaunch with a master of its own. Its output goes to graph.log of a folder, and what ROS keeps to folders there."""

    def __init__(self, arguments, output):
        port = free_port()
        os.environ.setdefault("ROS_HOME", str(output / "ros"))
        os.environ.setdefault("ROS_LOG_DIR", str(output / "ros/log"))
        os.environ.setdefault("XDG_CACHE_HOME", str(output / "cache"))
        os.environ.update(ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_IP="127.0.0.1", ROSCONSOLE_STDOUT_LINE_BUFFERED="1",
                          **{MARK: str(port)})
        self._mark = str(port)
        self.killed = {}  # pid: time of our signal
        self.faults = []  # sentences on processes that ended by themselves or did not end
        self._nodes, self._listed = {}, 0.0
        self._ending = False
        self._launch = subprocess.Popen(["roslaunch", "-p", str(port), *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                        text=True, errors="replace", start_new_session=True)
        self._reader = threading.Thread(target=self._read, args=(output / "graph.log",), daemon=True)
        self._reader.start()
        while self.runs() and not rosgraph.is_master_online():
            time.sleep(0.1)

    def _read(self, log_path):
        with open(log_path, "w", encoding="utf-8") as log:
            for line in self._launch.stdout:
                log.write(f"{time.time():.3f} {line}")
                log.flush()
                self._judge(line)

    def _judge(self, line):
        died, finished, stubborn = _DIED.search(line), _FINISHED.search(line), _STUBBORN.search(line)
        if died and int(died[2]) not in self.killed:
            self.faults.append(f"{died[1]} (process {died[2]}) ended with exit code {died[3]}")
        elif finished and not self._ending and not any(time.time() - sent < 20 for sent in self.killed.values()):
            self.faults.append(f"{finished[1]} ended by itself")
        elif stubborn:
            self.faults.append(f"{stubborn[1]} did not end by itself at the end: {stubborn[2]}")

    def runs(self):
        return self._launch.poll() is None

    def nodes(self):
        """Process id by full node name."""
        if time.monotonic() - self._listed > _LISTED_S:
            self._nodes, self._listed = dict(_nodes_of(self._mark)), time.monotonic()
        return self._nodes

    def kill(self, name, number=signal.SIGKILL):
        """@return whether the node was there."""
        pid = dict(_nodes_of(self._mark)).get(name)
        if pid is None:
            return False
        self.killed[pid] = time.time()
        os.kill(pid, number)
        self._listed = 0.0
        return True

    def close(self):
        self._ending = True
        if self.runs():
            self._launch.send_signal(signal.SIGINT)
        try:
            self._launch.wait(90)
        except subprocess.TimeoutExpired:
            self.faults.append("roslaunch did not end within 90 s")
            os.killpg(self._launch.pid, signal.SIGKILL)
        self._reader.join(10)


def _nodes_of(mark):
    """Name and process id of each node."""
    for pid in processes_of(mark):
        names = [word[len("__name:="):] for word in command_line(pid) if word.startswith("__name:=")]
        try:
            with open(f"/proc/{pid}/environ", "rb") as variables:
                spaces = [word[14:].decode() for word in variables.read().split(b"\0") if word.startswith(b"ROS_NAMESPACE=")]
        except OSError:
            continue  # the process has ended
        if names:
            yield "/".join(["", *filter(None, spaces[0].split("/") if spaces else []), names[0]]), pid


def memory_mb(pid):
    """Memory of its own that a process holds [MB], or None. Files and libraries do not count."""
    try:
        with open(f"/proc/{pid}/status", encoding="utf-8") as status:
            return next(int(line.split()[1]) / 1024 for line in status if line.startswith("RssAnon:"))
    except (OSError, StopIteration):
        return None
