"""The processes of a roslaunch: which node is which process, how each ends, and how much memory it holds."""
import os
import re
import signal
import subprocess
import threading
import time

from live.graph import Graph
from live.process_times import names_of

_DIED = re.compile(r"\[([\w/]+)-\d+\] process has died \[pid (\d+), exit code (-?\d+)")
_FINISHED = re.compile(r"\[([\w/]+)-\d+\] process has finished cleanly")
_STUBBORN = re.compile(r"\[([\w/]+)-\d+\] escalating to (SIG\w+)")


class WatchedGraph(Graph):
    """A graph whose output goes to graph.log of a folder, and what ROS keeps to folders there."""

    def __init__(self, program, arguments, folder):
        for name, place in (("ROS_HOME", "ros"), ("ROS_LOG_DIR", "ros/log"), ("XDG_CACHE_HOME", "cache")):
            os.environ.setdefault(name, str(folder / place))
        os.environ["ROSCONSOLE_STDOUT_LINE_BUFFERED"] = "1"
        self.killed = {}  # pid: time of our signal
        self._ending = False
        super().__init__(program, arguments, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, errors="replace")
        self._reader = threading.Thread(target=self._read, args=(folder / "graph.log",), daemon=True)
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

    def nodes(self):
        """Process id by full node name."""
        named = [(names_of(pid)[1], environment, pid) for pid, environment in self.processes()]
        return {f"{environment.get('ROS_NAMESPACE', '')}/{name}": pid for name, environment, pid in named if name}

    def kill(self, name, number=signal.SIGKILL):
        """@return whether the node was there."""
        pid = self.nodes().get(name)
        if pid is None:
            return False
        self.killed[pid] = time.time()
        os.kill(pid, number)
        return True

    def __exit__(self, *_):
        self._ending = True
        super().__exit__()
        self._reader.join(10)


def memory_mb(pid):
    """Memory of its own that a process holds [MB], or None. Files and libraries do not count."""
    try:
        with open(f"/proc/{pid}/status", encoding="utf-8") as status:
            return next(int(line.split()[1]) / 1024 for line in status if line.startswith("RssAnon:"))
    except (OSError, StopIteration):
        return None
