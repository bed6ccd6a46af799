"""The live graph from image to mesh: latency and CPU times of sponge and doll, as nodes and nodelets, at 30 and 60 Hz, at
640x480 and 1280x720, from the virtual camera and from a bag.

Writes docs/latency.md; recordings go to evaluation/ and are removed. Run by `make latency` on a machine with nothing else to do.

Usage, in scripts/: python3 -m evaluation.measure_latency [SCENE...]
With scenes: only these are measured, and nothing is written
"""
import itertools
import json
import subprocess
import sys

from evaluation import latency_tables
from evaluation.runs import DEVEL, OUTPUT, ROOT, ToolFailed, object_of, tool
from replace_file import replace_file

SCENES = ["bend", "doll_bend"]
SIZES = [(640, 480), (1280, 720)]
RATES_HZ = [30, 60]
RECORDED_HZ = 30  # a bag is played faster for other rates
CAMERA_S, BAG_S = 10, 6
RECORDING_S = 20  # the first mesh and the warm-up of measure_live, and BAG_S, at the highest rate


def measured(scene, size, rate_hz, nodelets, bag=None):
    """A row: what was measured, the figures of measure_live, or None, and its complaint, or ""."""
    width, height = size
    command = [DEVEL / "env.sh", ROOT / "scripts/measure_live", scene, "--json", "--rate", rate_hz]
    command += ["--bag", bag, "--object", object_of(scene), "--speed", rate_hz / RECORDED_HZ, "--seconds", BAG_S] if bag else \
        ["--width", width, "--height", height, "--seconds", CAMERA_S]
    command += ["--nodelets"] if nodelets else []
    run = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    said = [line for line in run.stderr.splitlines() if line.startswith("measure_live: ")]
    complaint = said[-1].removeprefix("measure_live: ").replace(str(ROOT) + "/", "") if said else ""
    if run.returncode and not complaint:
        complaint = f"exit code {run.returncode}"
    row = {"scene": scene, "size": f"{width}x{height}", "rate_hz": rate_hz, "nodelets": nodelets, "bag": bag is not None,
           "figures": json.loads(run.stdout) if run.stdout else None, "complaint": complaint}
    print(json.dumps({key: row[key] for key in row if key != "figures"}), file=sys.stderr, flush=True)
    return row


def rows_of(scene, size):
    kinds = list(itertools.product((False, True), RATES_HZ))
    rows = [measured(scene, size, rate, nodelets) for nodelets, rate in kinds]
    bag = OUTPUT / f"latency_{scene}_{size[0]}.bag"
    try:
        tool("virtual_camera", "--scene", scene, "--duration", str(RECORDING_S), "--rate", str(RECORDED_HZ),
             "--width", str(size[0]), "--height", str(size[1]), "--output", bag)
        return rows + [measured(scene, size, rate, nodelets, bag) for nodelets, rate in kinds]
    finally:
        bag.unlink(missing_ok=True)


def main():
    scenes = sys.argv[1:] or SCENES
    OUTPUT.mkdir(exist_ok=True)
    try:
        rows = [row for scene in scenes for size in SIZES for row in rows_of(scene, size)]
    except ToolFailed as error:
        print(f"latency: {error}", file=sys.stderr)
        return 1
    text = latency_tables.document(ROOT, rows)
    print(text, end="")
    if scenes == SCENES:
        replace_file(ROOT / "docs/latency.md", text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
