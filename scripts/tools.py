"""Runs the tools of the built workspace, and pieces of work side by side."""
import concurrent.futures
import contextlib
import json
import os
import subprocess
import sys
import time

from pages import ROOT

DEVEL = ROOT / "catkin_ws/devel"
OUTPUT = ROOT / "evaluation"
sys.path.append(str(DEVEL / "lib/python3/dist-packages"))  # the module softbody


class ToolFailed(SystemExit):
    """Ends the program with the output of a tool that failed."""


def tool(name, *arguments, package="softbody_bringup"):
    """Standard output of a tool."""
    command = [DEVEL / "env.sh", DEVEL / "lib" / package / name, *map(str, arguments)]
    run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    if run.returncode != 0:
        raise ToolFailed(f"{' '.join(map(str, command[1:]))}\n{run.stderr}")
    return run.stdout


def evaluate(*arguments):
    """The report of the tool `evaluate`."""
    return json.loads(tool("evaluate", *arguments, "--json"))


@contextlib.contextmanager
def recording(path, scene, *arguments):
    """Records a scene of the virtual camera. The bag is removed at the end: it has some 1.2 MB a frame."""
    tool("virtual_camera", "--scene", scene, *arguments, "--output", path)
    try:
        yield path
    finally:
        path.unlink(missing_ok=True)


def run_measured(name, *arguments, log):
    """Runs a tool of softbody_bringup, which prints into a file: exit code, wall time [s], and what it used."""
    command = [DEVEL / "env.sh", DEVEL / "lib/softbody_bringup" / name, *map(str, arguments)]
    begin = time.monotonic()
    with open(log, "w", encoding="utf-8") as file, subprocess.Popen(command, stdout=file, stderr=file) as process:
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, time.monotonic() - begin, usage


def perform(work, jobs=2):
    """The results of pieces of work (words, function, arguments...), in their order. Prints the progress. If one fails,
    those that wait are not begun."""
    start = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        futures = {pool.submit(function, *arguments): words for words, function, *arguments in work}
        try:
            for done, future in enumerate(concurrent.futures.as_completed(futures), 1):
                future.result()
                print(f"[{done}/{len(futures)}, {time.monotonic() - start:.0f} s] {futures[future]}",
                      file=sys.stderr, flush=True)
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    return [future.result() for future in futures]


def use_one_thread():
    """One thread per process: several processes run side by side, or times are those of one thread."""
    os.environ.update({"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "OPENCV_FOR_THREADS_NUM": "1"})


def chosen(known, words):
    """The words of the command line, or all known ones; ends the program if one is not known."""
    for word in words:
        if word not in known:
            sys.exit(f"'{word}' is not known; known are {', '.join(known)}")
    return words or list(known)
