"""A roslaunch with a master of its own, which ends with the program however that ends."""
import os
import signal
import subprocess
import sys
import time
import uuid

import rosgraph

from live.screens import free_port

MARK = "MEASURE_LIVE"  # the variable by which the processes of a graph are known: roslaunch copies it to each node
POLL_S = 0.1
PATIENCE_S = 90.0  # roslaunch itself kills a node that does not end within 20 s


class Graph:
    """The launch runs until the end of a with statement. Signals that ask to stop raise SystemExit in sleep()."""

    def __init__(self, program, arguments, **streams):
        """@param program: its name, for messages. @param arguments of roslaunch. @param streams: where its output goes.
        This process finds the master, too."""
        port = free_port()
        self._program, self._mark, self._signal = program, str(uuid.uuid4()), None
        self.faults = []  # sentences on processes that ended by themselves or did not end
        os.environ.update(ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_IP="127.0.0.1", **{MARK: self._mark})
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            if signal.getsignal(number) != signal.SIG_IGN:  # nohup
                signal.signal(number, self._note)
        self._launch = subprocess.Popen(["roslaunch", "-p", str(port), *arguments], start_new_session=True, **streams)

    def __enter__(self):
        return self

    def _note(self, number, _):
        self._signal = number

    def wait_for_master(self):
        while not rosgraph.is_master_online():
            if not self.runs():
                sys.exit(f"{self._program}: roslaunch ended at its start")
            self.sleep(POLL_S)

    def processes(self):
        """(id, environment) of each process that roslaunch has started. It starts each node in a session of its own."""
        for entry in filter(str.isdigit, os.listdir("/proc")):
            try:
                with open(f"/proc/{entry}/environ", encoding="utf-8", errors="replace") as file:
                    environment = dict(word.partition("=")[::2] for word in file.read().split("\0"))
            except OSError:
                continue  # it has ended, or belongs to somebody else
            if environment.get(MARK) == self._mark and int(entry) not in (os.getpid(), self._launch.pid):
                yield int(entry), environment

    def runs(self):
        return self._launch.poll() is None

    def sleep(self, seconds):
        end = time.monotonic() + seconds
        while True:
            if self._signal:
                print(f"{self._program}: was stopped by {signal.Signals(self._signal).name}", file=sys.stderr)
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
            self._complain(f"roslaunch did not end within {PATIENCE_S:.0f} s and is killed")
            self._launch.kill()
        deadline = time.monotonic() + PATIENCE_S
        while left := [pid for pid, _ in self.processes()]:
            if time.monotonic() > deadline:
                self._complain(f"these processes do not end: {left}")
                return
            for pid in left:
                try:
                    os.kill(pid, signal.SIGKILL)
                except OSError:
                    pass  # it has just ended, or this user may not
            time.sleep(POLL_S)

    def _complain(self, sentence):
        print(f"{self._program}: {sentence}", file=sys.stderr)
        self.faults.append(sentence)
