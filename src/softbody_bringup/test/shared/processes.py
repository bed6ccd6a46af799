"""Processes of nodes, and their ends."""
import os
import time
import xmlrpc.client

import rosgraph

PATIENCE_S = 120.0
CALLER = "/test_processes"


def process_of(node):
    """The process id that a node itself gives, or None if it does not answer."""
    try:
        return xmlrpc.client.ServerProxy(rosgraph.Master(CALLER).lookupNode(node)).getPid(CALLER)[2]
    except (OSError, rosgraph.MasterException, xmlrpc.client.Error):
        return None


def status_of(process, entry):
    """A number of /proc/PID/status, sizes in kB: VmRSS, resident now; VmHWM, the most so far; Threads."""
    with open(f"/proc/{process}/status", encoding="ascii") as status:
        return next(int(line.split()[1]) for line in status if line.startswith(entry + ":"))


def kill(node, number):
    """Sends a signal to a node. @return its process id."""
    process = process_of(node)
    os.kill(process, number)
    return process


def wait_for_another(node, process):
    """Until the node is started again, as another process."""
    deadline = time.monotonic() + PATIENCE_S
    while process_of(node) in (None, process):
        assert time.monotonic() < deadline, f"{node} is not started again"
        time.sleep(0.05)
