"""The project's folder, and which of its files are Python."""
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]


def is_python(path):
    return path.suffix == ".py" or (
        path.suffix == "" and path.is_file() and b"python3" in path.read_bytes().split(b"\n")[0])
