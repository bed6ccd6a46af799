"""CPU times of a ROS graph's processes and threads. Other programs do not change them."""
import os

NAME = "__name:="


def names_of(pid):
    """The program of a process, or its script, and its name by roslaunch or ""; two times nothing if it has ended."""
    try:
        with open(f"/proc/{pid}/cmdline", encoding="utf-8") as line:
            words = line.read().split("\0")
    except OSError:
        return "", ""
    program = next((os.path.basename(word) for word in words[:2] if "python" not in word and word), "?")
    return program, next((word[len(NAME):] for word in words if word.startswith(NAME)), "")


def cpu_seconds(folder):
    """User and system time [s] of a process or thread."""
    try:
        with open(f"/proc/{folder}/stat") as stat:
            fields = stat.read().rsplit(")", 1)[1].split()
    except OSError:
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def thread_names(pid):
    """Names of the threads of a process, by thread id."""
    names = {}
    try:
        for thread in os.listdir(f"/proc/{pid}/task"):
            with open(f"/proc/{pid}/task/{thread}/comm") as comm:
                names[int(thread)] = comm.read().strip()
    except OSError:
        pass  # the process or the thread has ended
    return names


def graph_times(found):
    """CPU time [s] so far of processes (id, environment), by row. A node's callbacks run in the main thread of its
    process, or in a thread with its name in the manager. All other threads of these processes are "transport". All of a
    camera with its own process counts as the camera."""
    processes = {pid: names_of(pid) for pid, _ in found}
    nodelets = {name[:15]: name for program, name in processes.values() if program == "nodelet_loader" and name}
    times = {}
    for pid, (program, name) in processes.items():
        row, rest = name or program or "?", cpu_seconds(pid)
        if program == "nodelet_loader":
            row = program
        elif name and name not in ("virtual_camera", "rosout", "play"):
            for thread, comm in thread_names(pid).items():
                of_node = name if thread == pid else nodelets.get(comm) if name == "manager" else None
                if of_node:
                    seconds = cpu_seconds(f"{pid}/task/{thread}")
                    times[of_node] = times.get(of_node, 0.0) + seconds
                    rest -= seconds
            row = "transport"
        times[row] = times.get(row, 0.0) + rest
    return times
