"""The processes of a roslaunch: which node is which process, how each ends, and how much memory it holds."""
import os
import re
import signal
import subprocess
import threading
import time

_DIED = re.compile(r"\[([\w/]+)-\d+\] process has died \[pid (\d+), exit code (-?\d+)")
_FINISHED = re.compile(r"\[([\w/]+)-\d+\] process has finished cleanly")
_STUBBORN = re.compile(r"\[([\w/]+)-\d+\] escalating to (SIG\w+)")
_LISTED_S = 0.5  # a look at /proc is good for so long


class Graph:
    """A running roslaunch. Its output goes to a file."""

    def __init__(self, command, log_path):
        self.killed = {}  # pid: time of our signal
        self.faults = []  # sentences on processes that ended by themselves or did not end
        self._nodes, self._listed = {}, 0.0
        self._ending = False
        self._launch = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                                        start_new_session=True)
        self._reader = threading.Thread(target=self._read, args=(log_path,), daemon=True)
        self._reader.start()

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
            self._nodes, self._listed = dict(_nodes_below(self._launch.pid)), time.monotonic()
        return self._nodes

    def kill(self, name, number=signal.SIGKILL):
        """@return whether the node was there."""
        pid = dict(_nodes_below(self._launch.pid)).get(name)
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


def _nodes_below(root):
    parents = {}
    for entry in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{entry}/stat", encoding="utf-8") as stat:
                parents[int(entry)] = int(stat.read().rsplit(")", 1)[1].split()[1])
        except OSError:
            continue  # the process has ended
    children = {root}
    for pid in sorted(parents):
        if parents[pid] in children:
            children.add(pid)
            name = _node_name(pid)
            if name:
                yield name, pid


def _node_name(pid):
    try:
        with open(f"/proc/{pid}/cmdline", encoding="utf-8") as line, open(f"/proc/{pid}/environ", encoding="utf-8") as variables:
            names = [word[8:] for word in line.read().split("\0") if word.startswith("__name:=")]
            spaces = [word[14:] for word in variables.read().split("\0") if word.startswith("ROS_NAMESPACE=")]
    except (OSError, UnicodeDecodeError):
        return None
    if not names:
        return None
    return f"/{spaces[0].strip('/')}/{names[0]}" if spaces and spaces[0].strip("/") else f"/{names[0]}"


def memory_mb(pid):
    """Memory of its own that a process holds [MB], or None. Files and libraries do not count."""
    try:
        with open(f"/proc/{pid}/status", encoding="utf-8") as status:
            return next(int(line.split()[1]) / 1024 for line in status if line.startswith("RssAnon:"))
    except (OSError, StopIteration):
        return None
