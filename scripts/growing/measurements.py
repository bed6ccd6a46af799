"""Runs with growing inputs."""
import json
import os
import pathlib
import subprocess
import tempfile
from dataclasses import dataclass

from evaluation.runs import DEVEL, ROOT, tool

CELLS = (4, 6, 8, 12, 17, 26)
PIECES = (1, 2, 4, 8, 16, 48)
SUBDIVISIONS = 5
WIDTHS = (320, 480, 640, 960, 1280)
FEATURES = (125, 250, 500, 1000, 2000)
UNITS = {"memory": "MB"}  # all others: ms


@dataclass
class Series:
    """What grows, in words, and a list of (size, {quantity: value}). Exponents are those from `fitted_from` on."""
    size: str
    words: str
    rows: list
    fitted_from: float = 0.0


def of_simulator(kind, argument):
    """Number of tets and the quantities of a body, by measure_growth."""
    command = [DEVEL / "env.sh", DEVEL / "lib/development/softbody_sim/measure_growth", kind, str(argument)]
    found = json.loads(subprocess.run(command, stdout=subprocess.PIPE, check=True).stdout)
    return found["tets"], {"solver": found["solver_ms"], "frame": found["frame_ms"], "preparation": found["prepare_ms"],
                           "cut": found["cut_ms"], "memory": found["memory_mb"]}


def of_tracking(folder, recording, config, parameters="{}"):
    """The quantities of `replay`. A frame is the sum of its stages' medians, the preparation that of the first stages."""
    result, settings = folder / "result.bag", folder / "parameters.yaml"
    settings.write_text(parameters)
    command = [DEVEL / "env.sh", DEVEL / "lib/softbody_bringup/replay", recording, "--object", config, "--output", result,
               "--timing", "--allow-outside", "--parameters", settings]
    log = folder / "log.txt"
    with log.open("w") as output, subprocess.Popen(command, stdout=output, stderr=output) as process:
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise RuntimeError(log.read_text())
    stages = json.loads(tool("evaluate", result, "--truth", recording, "--json"))["stages"]
    return {"frame": sum(row["median_ms"] for row in stages if not row["initialization"]),
            "preparation": sum(row["mean_ms"] for row in stages if row["initialization"]),
            "memory": usage.ru_maxrss / 1024.0}


def record(folder, width):
    recording = folder / f"{width}.bag"
    tool("virtual_camera", "--scene", "bend", "--seed", "1", "--width", str(width), "--height", str(width * 3 // 4),
         "--duration", "1.5", "--output", recording)
    return recording


def subdivided(lines):
    """An OBJ file's lines with each triangle in four; corners are v/vt with the same or with other numbers."""
    lists = {"v": [], "vt": []}
    for line in lines:
        words = line.split()
        if words and words[0] in lists:
            lists[words[0]].append([float(word) for word in words[1:]])
    halves, result = {}, []

    def middle(kind, a, b):
        key = (kind, min(a, b), max(a, b))
        if key not in halves:
            lists[kind].append([0.5 * (x + y) for x, y in zip(lists[kind][a - 1], lists[kind][b - 1])])
            halves[key] = len(lists[kind])
        return halves[key]

    for line in lines:
        words = line.split()
        if not words or words[0] != "f":
            if words and words[0] in ("mtllib", "usemtl"):
                result.append(line)
            continue
        corners = [tuple(int(number) for number in word.split("/")[:2]) for word in words[1:]]
        kinds = ("v", "vt")[:len(corners[0])]
        between = [tuple(middle(kind, a[i], b[i]) for i, kind in enumerate(kinds))
                   for a, b in zip(corners, corners[1:] + corners[:1])]
        for face in ((corners[0], between[0], between[2]), (corners[1], between[1], between[0]),
                     (corners[2], between[2], between[1]), between):
            result.append("f " + " ".join("/".join(map(str, corner)) for corner in face))
    points = [" ".join([kind, *(f"{number:.7g}" for number in row)]) for kind in lists for row in lists[kind]]
    return points + result


def vertex_rows(folder):
    recording, rows = record(folder, 640), []
    lines = (ROOT / "config/sponge.obj").read_text().splitlines()
    config = folder / "sponge.yaml"
    text = (ROOT / "config/sponge.yaml").read_text()
    for name in ("sponge_cage.obj", "sponge_tets.vtu"):
        text = text.replace(name, str(ROOT / "config" / name))
    config.write_text(text)
    for level in range(SUBDIVISIONS + 1):
        if level > 0:
            lines = subdivided(lines)
        (folder / "sponge.obj").write_text("\n".join(lines) + "\n")
        count = sum(line.startswith("v ") for line in lines)
        rows.append((count, of_tracking(folder, recording, config)))
    return rows


def pixel_rows(folder):
    return [(width * width * 3 // 4, of_tracking(folder, record(folder, width), ROOT / "config/sponge.yaml"))
            for width in WIDTHS]


def feature_rows(folder):
    recording = record(folder, 640)
    return [(count, of_tracking(folder, recording, ROOT / "config/sponge.yaml",
                                f"feature_tracker: {{max_features: {count}}}\n")) for count in FEATURES]


def all_series():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        series = [Series("tets", "A box under 1500 moving depth targets. A frame is a step of the simulator, the solver's "
                         "part ten iterations of projective dynamics in single precision with a given factor. The cut "
                         "goes through the middle; its time includes the two frames after it.",
                         [of_simulator("tets", cells) for cells in CELLS], 1000),
                  Series("pieces", "The same for boxes side by side with 10,368 tets together.",
                         [(count, of_simulator("pieces", count)[1]) for count in PIECES]),
                  Series("pixels", "The sponge (300 tets) in the scene `bend`. A frame is tracking, simulation and "
                         "interpolation. Memory is the largest of `replay`.", pixel_rows(folder)),
                  Series("features", "The same at 640 x 480 with other `max_features`.", feature_rows(folder))]
        # The last, because a new process counts this one's memory, too.
        return [*series, Series("visual vertices", "The same with the visual mesh subdivided.", vertex_rows(folder), 5000)]
