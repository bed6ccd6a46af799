"""CPU times of a ROS graph's processes and threads. Other programs do not change them."""
import os


def command_line(pid):
    """The words of a process's command; none if it has ended."""
    try:
        with open(f"/proc/{pid}/cmdline", encoding="utf-8") as line:
            return line.read().split("\0")
    except OSError:
        return []


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


def row_of(words):
    """What a process counts as: the name that roslaunch gave it, or its program."""
    program = next((os.path.basename(word) for word in words[:2] if "python" not in word and word), "?")
    if program == "nodelet_loader":
        return program
    return next((word[len("__name:="):] for word in words if word.startswith("__name:=")), program)


def graph_times(pids, camera):
    """CPU time [s] of processes so far, by row. A node's callbacks run in the main thread of its process, or in a thread with its name in the
    manager. All other threads of these processes are "transport". All of a camera with its own process counts as the camera."""
    processes = {pid: command_line(pid) for pid in pids}
    rows = {pid: row_of(words) for pid, words in processes.items()}
    nodelets = {word[len("__name:="):] for pid, words in processes.items() if rows[pid] == "nodelet_loader"
                for word in words if word.startswith("__name:=")}
    times = {}
    for pid, row in rows.items():
        rest = cpu_seconds(pid)
        if any(word.startswith("__name:=") for word in processes[pid]) and row not in (camera, "nodelet_loader", "rosout", "play"):
            own = {name: name[:15] for name in nodelets} if row == "manager" else {}
            for thread, comm in thread_names(pid).items():
                name = row if thread == pid else next((name for name, short in own.items() if short == comm), None)
                if name:
                    seconds = cpu_seconds(f"{pid}/task/{thread}")
                    times[name] = times.get(name, 0.0) + seconds
                    rest -= seconds
            row = "transport"
        times[row] = times.get(row, 0.0) + rest
    return times
