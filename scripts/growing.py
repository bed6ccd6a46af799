"""Runs with growing inputs."""
import json
import pathlib
import tempfile
from dataclasses import dataclass

from pages import ROOT
from tools import evaluate, recording, run_measured, tool

CELLS = (4, 6, 8, 12, 17, 26)
PIECES = (1, 2, 4, 8, 16, 48)
SUBDIVISIONS = 5
WIDTHS = (320, 480, 640, 960, 1280)
FEATURES = (125, 250, 500, 1000, 2000)


@dataclass
class Series:
    """What grows, and a list of (size, {quantity: value [ms or MB]}). Exponents are those from `fitted_from` on."""
    size: str
    rows: list
    fitted_from: float = 0.0


def of_simulator(kind, argument):
    """Number of tets and the quantities of a body, by measure_growth."""
    found = json.loads(tool("measure_growth", kind, argument, package="development/softbody_sim"))
    return found["tets"], {"solver": found["solver_ms"], "frame": found["frame_ms"], "preparation": found["prepare_ms"],
                           "cut": found["cut_ms"], "memory": found["memory_mb"]}


def of_tracking(folder, bag, config=ROOT / "config/sponge.yaml", parameters="{}"):
    """The quantities of `replay`. A frame is the sum of its stages' medians, the preparation that of the first ones."""
    result, settings, log = folder / "result.bag", folder / "parameters.yaml", folder / "log.txt"
    settings.write_text(parameters)
    code, _, usage = run_measured("replay", bag, "--object", config, "--output", result, "--timing", "--allow-outside",
                                  "--parameters", settings, log=log)
    if code != 0:
        raise RuntimeError(f"replay failed: {log.read_text()}")
    stages = evaluate(result, "--truth", bag)["stages"]
    return {"frame": sum(row["median_ms"] for row in stages if not row["initialization"]),
            "preparation": sum(row["mean_ms"] for row in stages if row["initialization"]),
            "memory": usage.ru_maxrss / 1024.0}


def recorded(folder, width=640):
    return recording(folder / f"{width}.bag", "bend", "--seed", "1", "--width", width, "--height", width * 3 // 4,
                     "--duration", "1.5")


def subdivided(lines):
    """An OBJ file's lines with each triangle in four; corners are v/vt with the same or with other numbers."""
    lists, faces, others, halves = {"v": [], "vt": []}, [], [], {}
    for line in lines:
        kind, *words = line.split()
        if kind in lists:
            lists[kind].append([float(word) for word in words])
        elif kind == "f":
            faces.append([tuple(map(int, word.split("/")[:2])) for word in words])
        elif kind in ("mtllib", "usemtl"):
            others.append(line)

    def middle(a, b):
        """The corner between two corners; made once for each pair of numbers."""
        for kind, *pair in zip(lists, a, b):
            key = (kind, *sorted(pair))
            if key not in halves:
                lists[kind].append([0.5 * (x + y) for x, y in zip(*(lists[kind][number - 1] for number in pair))])
                halves[key] = len(lists[kind])
            yield halves[key]

    for a, b, c in faces:
        ab, bc, ca = (tuple(middle(*ends)) for ends in ((a, b), (b, c), (c, a)))
        for face in ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)):
            others.append("f " + " ".join("/".join(map(str, corner)) for corner in face))
    return [*(" ".join([kind, *(f"{number:.7g}" for number in row)]) for kind in lists for row in lists[kind]), *others]


def vertex_rows(folder):
    rows, config = [], folder / "sponge.yaml"
    lines = [line for line in (ROOT / "config/sponge.obj").read_text().splitlines() if line.strip()]
    text = (ROOT / "config/sponge.yaml").read_text()
    for name in ("sponge_cage.obj", "sponge_tets.vtu"):
        text = text.replace(name, str(ROOT / "config" / name))
    config.write_text(text)
    with recorded(folder) as bag:
        for level in range(SUBDIVISIONS + 1):
            lines = subdivided(lines) if level > 0 else lines
            (folder / "sponge.obj").write_text("\n".join(lines) + "\n")
            rows.append((sum(line.startswith("v ") for line in lines), of_tracking(folder, bag, config)))
    return rows


def pixel_rows(folder):
    rows = []
    for width in WIDTHS:
        with recorded(folder, width) as bag:
            rows.append((width * width * 3 // 4, of_tracking(folder, bag)))
    return rows


def feature_rows(folder):
    with recorded(folder) as bag:
        return [(count, of_tracking(folder, bag, parameters=f"feature_tracker: {{max_features: {count}}}\n"))
                for count in FEATURES]


def all_series():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        return [Series("tets", [of_simulator("tets", cells) for cells in CELLS], 1000),
                Series("pieces", [(count, of_simulator("pieces", count)[1]) for count in PIECES]),
                Series("pixels", pixel_rows(folder)), Series("features", feature_rows(folder)),
                # The last, because a new process counts this one's memory, too.
                Series("visual vertices", vertex_rows(folder), 5000)]
