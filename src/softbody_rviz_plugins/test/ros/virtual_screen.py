"""A screen without hardware (Xvfb), and what is on it as numpy arrays and PNG files."""
import os
import socket
import struct
import subprocess
import tempfile
import zlib

import numpy as np


class VirtualScreen:
    """Runs Xvfb until the end of a with statement. Programs with `environment` draw on it, in software."""

    def __init__(self, width, height):
        self.size = f"{width}x{height}x24"
        self.folder = tempfile.TemporaryDirectory()

    def __enter__(self):
        reader, writer = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writer), "-screen", "0", self.size, "-fbdir", self.folder.name, "-nolisten", "tcp", "-nocursor"],
            pass_fds=[writer], stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as numbers:  # Xvfb writes its number when it is ready
            number = numbers.readline().strip()
        if not number:
            raise RuntimeError("Xvfb did not start")
        self.environment = {**os.environ, "DISPLAY": ":" + number, "LIBGL_ALWAYS_SOFTWARE": "1", "QT_X11_NO_MITSHM": "1",
                            "XDG_RUNTIME_DIR": self.folder.name}
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()
        self.folder.cleanup()

    def picture(self):
        """Height x width x 3, red green blue, 0 to 255."""
        with open(os.path.join(self.folder.name, "Xvfb_screen0"), "rb") as file:  # an XWD file
            data = file.read()
        header = struct.unpack(">25I", data[:100])
        begin, width, height, stride = header[0] + 12 * header[19], header[4], header[5], header[12]
        rows = np.frombuffer(data, np.uint8, stride * height, begin).reshape(height, stride)
        return rows[:, :4 * width].reshape(height, width, 4)[:, :, 2::-1]


def write_png(path, picture):
    """Writes a picture (height x width x 3)."""
    height, width, _ = picture.shape
    rows = np.zeros((height, 3 * width + 1), np.uint8)  # each row begins with its filter: none
    rows[:, 1:] = picture.reshape(height, -1)

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)) + chunk(b"IEND", b""))


def free_port():
    """A TCP port for a ROS master."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]
