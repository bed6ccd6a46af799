"""Runs with growing inputs."""
import json
import pathlib
import tempfile
from dataclasses import dataclass

import numpy

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


def subdivided(points, triangles):
    """Points and triangles, whose numbers begin with 1, with each triangle in four."""
    ends = numpy.sort(numpy.stack([triangles, numpy.roll(triangles, -1, axis=1)], axis=2), axis=2).reshape(-1, 2)
    edges, middles = numpy.unique(ends, axis=0, return_inverse=True)
    (a, b, c), (ab, bc, ca) = triangles.T, len(points) + 1 + middles.reshape(-1, 3).T
    return (numpy.concatenate([points, points[edges - 1].mean(axis=1)]),
            numpy.stack([a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca], axis=1).reshape(-1, 3))


def vertex_rows(folder):
    rows, config = [], folder / "sponge.yaml"
    lines = [line.split() for line in (ROOT / "config/sponge.obj").read_text().splitlines()]
    corners = numpy.array([[word.split("/")[:2] for word in line[1:]] for line in lines if line[:1] == ["f"]], int)
    lists = {kind: (numpy.array([line[1:] for line in lines if line[:1] == [kind]], float), corners[..., column])
             for column, kind in enumerate(("v", "vt"))}
    text = (ROOT / "config/sponge.yaml").read_text()
    for name in ("sponge_cage.obj", "sponge_tets.vtu"):
        text = text.replace(name, str(ROOT / "config" / name))
    config.write_text(text)
    with recorded(folder) as bag:
        for level in range(SUBDIVISIONS + 1):
            lists = {kind: subdivided(*lists[kind]) if level > 0 else lists[kind] for kind in lists}
            points = [" ".join([kind, *map("{:.7g}".format, point)]) for kind in lists for point in lists[kind][0]]
            faces = [f"f {' '.join(map('{}/{}'.format, *pair))}" for pair in zip(lists["v"][1], lists["vt"][1])]
            (folder / "sponge.obj").write_text("\n".join([*points, *faces]) + "\n")
            rows.append((len(lists["v"][0]), of_tracking(folder, bag, config)))
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
