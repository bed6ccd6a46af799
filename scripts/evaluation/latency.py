"""The live graph from image to mesh: latency and CPU times of sponge and doll, as nodes and nodelets, at 30 and 60 Hz,
at 640x480 and 1280x720, from the virtual camera and from a bag.

Writes docs/latency.md; recordings go to evaluation/ and are removed. Run by `make latency`; nothing else should run.

Usage, in scripts/: python3 -m evaluation.latency [SCENE...]
With scenes: only these are measured, and nothing is written
"""
import json
import subprocess
import sys

from evaluation.figures import get
from evaluation.runs import object_of
from live.streams import SURFACE
from pages import ROOT, number, processor, publish
from tools import DEVEL, OUTPUT, chosen, recording

NODES = ["camera_ingest", "feature_tracker", "simulator", "surface", "transport"]
LATENCIES = ["median", "p95", "p99", "worst"]
SCENES = ["bend", "doll_bend"]
SIZES = [(640, 480), (1280, 720)]
RATES_HZ = [30, 60]
RECORDED_HZ = 30  # a bag is played faster for other rates
CAMERA_S, BAG_S = 10, 6
RECORDING_S = 20  # the first mesh and the warm-up of measure_live, and BAG_S, at the highest rate


def measured(scene, size, rate_hz, nodelets, bag=None):
    """A row: the cells of what was measured, the metrics of measure_live, or None, and its complaint, or ""."""
    width, height = size
    command = [DEVEL / "env.sh", ROOT / "scripts/measure_live", scene, "--json", "--rate", rate_hz]
    if bag:
        command += ["--bag", bag, "--object", object_of(scene), "--speed", rate_hz / RECORDED_HZ, "--seconds", BAG_S]
    else:
        command += ["--width", width, "--height", height, "--seconds", CAMERA_S]
    command += ["--nodelets"] if nodelets else []
    run = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    said = [line for line in run.stderr.splitlines() if line.startswith("measure_live: ")]
    complaint = said[-1].removeprefix("measure_live: ").replace(str(ROOT) + "/", "") if said else ""
    if run.returncode and not complaint:
        complaint = f"exit code {run.returncode}"
    kind = ["doll" if scene.startswith("doll_") else "sponge", "bag" if bag else "camera",
            "nodelets" if nodelets else "nodes", f"{width}x{height}", rate_hz]
    print(*kind, complaint, file=sys.stderr, flush=True)
    return kind, json.loads(run.stdout) if run.stdout else None, complaint


def rows_of(scene, size):
    kinds = [(rate, nodelets) for nodelets in (False, True) for rate in RATES_HZ]
    rows = [measured(scene, size, *kind) for kind in kinds]
    with recording(OUTPUT / f"latency_{scene}_{size[0]}.bag", scene, "--duration", RECORDING_S, "--rate", RECORDED_HZ,
                   "--width", size[0], "--height", size[1]) as bag:
        return rows + [measured(scene, size, *kind, bag) for kind in kinds]


def latency_cells(metrics, complaint):
    if metrics is None:
        return ["-", "failed", *["-"] * (1 + len(LATENCIES))]
    mesh = metrics["streams"][SURFACE]
    answered = f"{mesh.get('answered', 0)} of {mesh['due']}" + (", failed" if complaint else "")
    return [number(metrics["frames"] / metrics["seconds"], 1), answered,
            *[number(get(mesh, f"latency_ms.{name}"), 1) for name in LATENCIES], number(metrics["load"], 1)]


def cpu_cells(metrics, source):
    cpu = get(metrics, "cpu")
    if cpu is None:
        return ["-"] * (len(NODES) + 2)
    return [*[number(cpu["nodes_ms"].get(name, 0.0), 1) for name in NODES], number(cpu["graph_ms"], 1),
            "-" if source == "bag" else number(cpu["camera_ms"], 1)]


def main():
    scenes = chosen(SCENES, sys.argv[1:])
    OUTPUT.mkdir(exist_ok=True)
    rows = [row for scene in scenes for size in SIZES for row in rows_of(scene, size)]
    tables = {"From image to mesh": [[*kind, *latency_cells(*found)] for kind, *found in rows],
              "CPU time": [[*kind, *cpu_cells(metrics, kind[1])] for kind, metrics, _ in rows],
              "Failed": [[*kind, complaint] for kind, _, complaint in rows if complaint] or [["none", *5 * "-"]]}
    publish("latency.md", "latency", tables, f", on {processor()}", scenes == SCENES)


if __name__ == "__main__":
    main()
