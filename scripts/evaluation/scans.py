"""Rows of `make scans`: recordings of the virtual camera, what `scan_model` makes of them, and how right it is."""
import dataclasses
import datetime
import json
import os
import shutil
import subprocess
import time

from evaluation.document import commit
from evaluation.runs import DEVEL, OUTPUT, ROOT, ToolFailed, tool
from evaluation.scan_bodies import write_scaled, write_toy

FOLDER = OUTPUT / "scans"
LARGER = 1.5  # than the sponge: covers markers
TRUE = {"sponge": ROOT / "config/sponge.obj", "doll": ROOT / "config/doll.obj", "toy": FOLDER / "toy.obj",
        "large": FOLDER / "large.obj"}
WORDS = {"sponge": "sponge", "doll": "doll", "toy": "toy with thin legs"}
NO_SHEET = ("--sheet", "none")


@dataclasses.dataclass(frozen=True)
class Recording:
    body: str
    scene: str
    arguments: tuple = ()

    @property
    def path(self):
        words = [self.body, self.scene, *(word.lstrip("-") for word in self.arguments)]
        return FOLDER / f"{'_'.join(words)}.bag"

    def camera_arguments(self):
        scene = f"doll_{self.scene}" if self.body == "doll" else self.scene
        body = ("--body", TRUE[self.body]) if self.body in ("toy", "large") else ()
        return ("--scene", scene, *body, *self.arguments, "--output", self.path)


@dataclasses.dataclass(frozen=True)
class Row:
    name: str
    words: str
    recordings: tuple
    known_motion: bool = True  # by the sheet or tf
    fault: tuple = ()  # `inject` with its arguments, or a fault of faulty_bags.py

    @property
    def body(self):
        return self.recordings[0].body


def body_rows(body):
    words = WORDS[body]
    # The faulty recordings are made of the sponge's walk, with its labels.
    walk = Recording(body, "walk", ("--labels",) if body == "sponge" else ())
    return [
        Row(f"{body}_walk", f"{words}: walk", (walk,)),
        Row(f"{body}_flip", f"{words}: walk, and turned over", (walk, Recording(body, "flip"))),
        Row(f"{body}_tf", f"{words}: no sheet, camera on an arm", (Recording(body, "walk", (*NO_SHEET, "--camera-tf")),)),
        Row(f"{body}_none_rich", f"{words}: no sheet, rich texture", (Recording(body, "walk", NO_SHEET),), False),
        Row(f"{body}_none_weak", f"{words}: no sheet, weak texture",
            (Recording(body, "walk", (*NO_SHEET, "--texture", "weak")),), False)]


def good_rows():
    return [
        *(row for body in WORDS for row in body_rows(body)),
        Row("turntable", "sponge: turntable", (Recording("sponge", "turntable"),)),
        Row("hand_jerks", "sponge: a hand passes, and jerks of 0.3 m/s", (Recording("sponge", "walk_hand", ("--jerks",)),)),
        Row("seed", "sponge: walk, another seed", (Recording("sponge", "walk", ("--seed", "2")),))]


def faulty_rows():
    walk = (Recording("sponge", "walk", ("--labels",)),)
    return [
        Row("fault_drop", "30 % of the images dropped", walk, fault=("inject", "--drop", "0.3")),
        Row("fault_jerks", "jerks of 0.3 m/s", (Recording("sponge", "walk", ("--jerks",)),)),
        Row("fault_hand", "a hand passes", (Recording("sponge", "walk_hand"),)),
        Row("fault_flicker", "the exposure flickers by 40 %", walk, fault=("flicker",)),
        Row("fault_black", "black object: no depth on it", walk, fault=("black",)),
        Row("fault_shiny", "shiny object: 30 % of its depth missing, 10 % up to 60 mm wrong", walk, fault=("shiny",)),
        Row("fault_large", "object covers a part of the markers", (Recording("large", "walk"),)),
        Row("fault_no_depth", "no depth topic", walk, fault=("no_depth",)),
        Row("fault_millimetres", "depth in mm, called m", walk, fault=("millimetres",)),
        Row("fault_no_info", "no camera_info", walk, fault=("no_info",)),
        Row("fault_half", "only half of the walk", walk, fault=("half",)),
        Row("fault_cut_off", "recording cut off in the middle of a write", walk, fault=("cut_off",)),
        Row("fault_hidden_sheet", "sheet not seen for a third of the time", walk, fault=("hidden_sheet",))]


def make_bodies():
    FOLDER.mkdir(parents=True, exist_ok=True)
    write_toy(TRUE["toy"])
    write_scaled(TRUE["sponge"], LARGER, TRUE["large"])


def with_fault(row):
    """The recordings that are scanned; a faulty one is made of the first."""
    if not row.fault:
        return [recording.path for recording in row.recordings]
    original, faulty = row.recordings[0].path, FOLDER / f"{row.name}.bag"
    if row.fault[0] == "inject":
        tool("inject", original, "--output", faulty, *row.fault[1:])
        return [faulty]
    command = [DEVEL / "env.sh", "/usr/bin/python3", ROOT / "scripts/evaluation/faulty_bags.py", *row.fault, original, faulty]
    run = subprocess.run(command, stderr=subprocess.PIPE, text=True, check=False)
    if run.returncode != 0:
        raise ToolFailed(f"faulty_bags.py {row.fault[0]}\n{run.stderr}")
    return [faulty]


def scan(bags, model, log):
    """Runs `scan_model` with default settings: exit code, wall time [s], CPU time [s], memory [GB], what it printed."""
    command = [DEVEL / "env.sh", DEVEL / "lib/softbody_bringup/scan_model", *bags, "--output", model]
    begin = time.monotonic()
    with open(log, "w", encoding="utf-8") as file, subprocess.Popen(command, stdout=file, stderr=file) as process:
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    return {"code": process.returncode, "seconds": time.monotonic() - begin, "cpu_seconds": usage.ru_utime + usage.ru_stime,
            "memory_gb": 1024e-9 * usage.ru_maxrss, "text": log.read_text()}


def measure(row):
    """Makes what is missing and measures a row; the result is kept in evaluation/scans."""
    for recording in row.recordings:
        if not recording.path.exists():
            tool("virtual_camera", *recording.camera_arguments())
    bags, model = with_fault(row), FOLDER / row.name
    shutil.rmtree(model, ignore_errors=True)
    result = {"commit": commit(ROOT), "date": str(datetime.date.today()),
              **scan(bags, model, FOLDER / f"{row.name}.log")}
    if row.fault:
        bags[0].unlink()
    if result["code"] in (0, 3):
        result["report"] = json.loads(tool("evaluate", "--model", model, TRUE[row.body], "--json"))
    path_of(row).write_text(json.dumps(result, indent=1))
    return result


def path_of(row):
    """The file of its result."""
    return FOLDER / f"{row.name}.json"


def measured(rows):
    """(row, result) of those that were measured."""
    files = [(row, path_of(row)) for row in rows]
    return [(row, json.loads(file.read_text())) for row, file in files if file.exists()]
