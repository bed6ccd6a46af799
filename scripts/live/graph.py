"""A roslaunch with a master of its own, which ends with the measurement however that ends."""
import os
import signal
import socket
import subprocess
import sys
import time
import uuid

MARK = "MEASURE_LIVE"  # the variable by which the processes of a graph are known: roslaunch copies it to each node
POLL_S = 0.1
PATIENCE_S = 60.0  # roslaunch itself kills a node that does not end within 20 s


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def processes_of(mark):
    """Ids of the other processes of this graph. roslaunch starts each node in a session of its own."""
    variable = f"{MARK}={mark}".encode()
    for entry in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{entry}/environ", "rb") as environment:
                if variable in environment.read().split(b"\0") and int(entry) != os.getpid():
                    yield int(entry)
        except OSError:
            continue  # it has ended, or belongs to somebody else


class Graph:
    """While it is entered, the launch runs, and signals that ask to stop raise SystemExit in sleep()."""

    def __init__(self, arguments):
        """@param arguments of roslaunch. This process finds the master, too."""
        port = free_port()
        self._mark = str(uuid.uuid4())
        self._command = ["roslaunch", "-p", str(port), *arguments]
        self._launch, self._signal = None, None
        os.environ.update(ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_IP="127.0.0.1", **{MARK: self._mark})

    def __enter__(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            if signal.getsignal(number) != signal.SIG_IGN:  # nohup
                signal.signal(number, self._note)
        self._launch = subprocess.Popen(self._command, stdout=subprocess.DEVNULL, start_new_session=True)
        return self

    def _note(self, number, _):
        self._signal = number

    def processes(self):
        """Ids of what roslaunch has started."""
        return [pid for pid in processes_of(self._mark) if pid != self._launch.pid]

    def runs(self):
        return self._launch.poll() is None

    def sleep(self, seconds):
        end = time.monotonic() + seconds
        while True:
            if self._signal:
                print(f"measure_live: was stopped by {signal.Signals(self._signal).name}", file=sys.stderr)
                sys.exit(128 + self._signal)
            left = end - time.monotonic()
            if left <= 0.0:
                return
            time.sleep(min(left, POLL_S))

    def __exit__(self, *_):
        if self.runs():
            self._launch.send_signal(signal.SIGINT)
        try:
            self._launch.wait(PATIENCE_S)
        except subprocess.TimeoutExpired:
            print(f"measure_live: roslaunch did not end within {PATIENCE_S:.0f} s and is killed", file=sys.stderr)
        deadline = time.monotonic() + PATIENCE_S
        while left := list(processes_of(self._mark)):
            if time.monotonic() > deadline:
                print(f"measure_live: these processes do not end: {left}", file=sys.stderr)
                return
            for pid in left:
                try:
                    os.kill(pid, signal.SIGKILL)
                except OSError:
                    pass  # it has just ended, or this user may not
            self._launch.poll()
            time.sleep(POLL_S)
