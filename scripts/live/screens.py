"""A virtual screen with a ROS master beside it, and programs that run for a while."""
import contextlib
import signal
import subprocess
import sys

from pages import ROOT

sys.path.insert(0, str(ROOT / "src/softbody_rviz_plugins/test/ros"))
from virtual_screen import VirtualScreen, free_port  # noqa: E402

END_S = 20.0  # longest until a program ends


@contextlib.contextmanager
def started(environment, *command, how_to_end=signal.SIGINT):
    """A program that runs until the end of a with statement. It is killed if it does not end in time."""
    program = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               start_new_session=True)
    try:
        yield
    finally:
        program.send_signal(how_to_end)
        try:
            program.wait(END_S)
        except subprocess.TimeoutExpired:
            program.kill()
            program.wait()


@contextlib.contextmanager
def screen_with_master(width, height):
    """The screen, and the environment of programs that draw on it and find the master."""
    port = str(free_port())
    with VirtualScreen(width, height) as screen:
        environment = {**screen.environment, "ROS_MASTER_URI": f"http://127.0.0.1:{port}", "ROS_IP": "127.0.0.1"}
        with started(environment, "roscore", "-p", port):
            yield screen, environment
