"""Two machines on one computer: network namespaces, and a cable between them that delays and loses packets."""
import ctypes
import fcntl
import heapq
import os
import random
import select
import shutil
import struct
import subprocess
import sys
import time

ADDRESSES = ("10.77.0.1", "10.77.0.2")
DELAY_S, LOSS = 0.005, 0.01  # of each packet, in each direction: 10 ms there and back
LONGEST_QUEUE = 2000  # packets; a switch drops what is beyond
NEW_NETWORK, SET_TUN = 0x40000000, 0x400454CA  # of unshare(2) and setns(2); of ioctl
TUN, NO_HEADER = 0x0001, 0x1000


def why_impossible():
    """Empty if this computer can have network namespaces and a cable between them."""
    if os.geteuid() != 0:
        return "network namespaces need the rights of root"
    missing = [program for program in ("ip", "nsenter", "unshare") if shutil.which(program) is None]
    if missing:
        return f"these programs are missing: {', '.join(missing)}"
    try:
        os.close(os.open("/dev/net/tun", os.O_RDWR))
    except OSError as error:
        return f"/dev/net/tun cannot be used: {error.strerror}"
    if subprocess.run(["unshare", "-n", "true"], check=False, stderr=subprocess.DEVNULL).returncode != 0:
        return "unshare -n is not permitted"
    return ""


class Machine:
    """A network namespace. It ends with close()."""

    def __init__(self):
        self.holder = subprocess.Popen(["unshare", "-n", "sleep", "infinity"])
        while os.stat(f"/proc/{self.holder.pid}/ns/net").st_ino == os.stat("/proc/self/ns/net").st_ino:
            time.sleep(0.01)
        self.run("ip", "link", "set", "lo", "up")

    def command(self, *words):
        return ["nsenter", "-t", str(self.holder.pid), "-n", *words]

    def run(self, *words):
        subprocess.run(self.command(*words), check=True)

    def close(self):
        self.holder.kill()
        self.holder.wait()


class Cable:
    """Joins two machines, which get the ADDRESSES. It ends with close()."""

    def __init__(self, machines):
        self.process = subprocess.Popen([sys.executable, __file__, *(str(machine.holder.pid) for machine in machines)],
                                        stdout=subprocess.PIPE, text=True)
        assert self.process.stdout.readline() == "plugged in\n"
        for machine, address in zip(machines, ADDRESSES):
            machine.run("ip", "addr", "add", f"{address}/24", "dev", "cable")
            machine.run("ip", "link", "set", "cable", "up")

    def close(self):
        self.process.terminate()
        self.process.communicate()


def open_end(pid):
    """An end of the cable in the network of a process: a network card whose packets this process reads and writes."""
    with open(f"/proc/{pid}/ns/net", encoding="ascii") as network:
        if ctypes.CDLL(None, use_errno=True).setns(network.fileno(), NEW_NETWORK) != 0:
            raise OSError(ctypes.get_errno(), "setns")
    end = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(end, SET_TUN, struct.pack("16sH", b"cable", TUN | NO_HEADER))
    return end


def carry(ends):
    """Carries packets from each end to the other, until the process ends."""
    waiting, carried, chance = [], 0, random.Random(1)  # waiting: when, number, to which end, what
    while True:
        pause_s = max(0.0, waiting[0][0] - time.monotonic()) if waiting else 1.0
        for end in select.select(ends, [], [], pause_s)[0]:
            packet = os.read(end, 65536)
            carried += 1
            if chance.random() >= LOSS and len(waiting) < LONGEST_QUEUE:
                other = ends[1 - ends.index(end)]
                heapq.heappush(waiting, (time.monotonic() + DELAY_S, carried, other, packet))
        while waiting and waiting[0][0] <= time.monotonic():
            _, _, end, packet = heapq.heappop(waiting)
            try:
                os.write(end, packet)
            except OSError:  # that card is not up, or its queue is full: the packet is lost
                pass


if __name__ == "__main__":
    BOTH = [open_end(pid) for pid in sys.argv[1:]]
    print("plugged in", flush=True)
    carry(BOTH)
