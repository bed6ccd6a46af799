"""How right models from recordings are: records walks round three bodies, scans them, and compares with the truth.

Then scans recordings with faults: each must give a right model, or no model and a reason. At last it tracks scenes with
scanned models and with the true mesh. Writes docs/measured/scans.md; recordings (900 MB each), models and results go to
evaluation/scans. Each recording is removed after its last use. Run by `make scans`.

Usage, in scripts/: python3 -m evaluation.scans [--keep] [ROW...]
With rows: only these are measured, and nothing is written. Rows that track need the rows of their models
  --keep   keeps the recordings; a later run uses them again
"""
import dataclasses
import json
import shutil
import sys
import time

from evaluation import faulty_bags
from evaluation.scan_bodies import write_scaled, write_toy
from evaluation.scans_tables import rows_of
from pages import ROOT, commit, publish, row_of
from tools import OUTPUT, chosen, evaluate, run_measured, tool

FOLDER = OUTPUT / "scans"
LARGER = 1.5  # than the sponge: covers markers
TRUE = {"sponge": ROOT / "config/sponge.obj", "doll": ROOT / "config/doll.obj", "toy": FOLDER / "toy.obj",
        "large": FOLDER / "large.obj"}
NO_SHEET = ("--sheet", "none")
MODELS = ("sponge_walk", "sponge_flip")  # rows whose models are tracked


@dataclasses.dataclass(frozen=True)
class Recording:
    body: str
    scene: str
    arguments: tuple = ()

    @property
    def path(self):
        words = [self.body, self.scene, *(word.lstrip("-") for word in self.arguments)]
        return FOLDER / f"{'_'.join(words)}.bag"

    def make(self):
        """Records it, if it is not there yet."""
        if not self.path.exists():
            scene = f"doll_{self.scene}" if self.body == "doll" else self.scene
            body = ("--body", TRUE[self.body]) if self.body in ("toy", "large") else ()
            tool("virtual_camera", "--scene", scene, *body, *self.arguments, "--output", self.path)


@dataclasses.dataclass(frozen=True)
class Row:
    name: str
    words: str
    recordings: tuple
    known_motion: bool = True  # by the sheet or tf
    fault: tuple = ()  # `inject` with its arguments, or a fault of faulty_bags.py


def body_rows(body, words):
    # The faulty recordings are made of the sponge's walk, with its labels.
    walk = Recording(body, "walk", ("--labels",) if body == "sponge" else ())
    return [
        Row(f"{body}_walk", f"{words}: walk", (walk,)),
        Row(f"{body}_flip", f"{words}: walk, and turned over", (walk, Recording(body, "flip"))),
        Row(f"{body}_tf", f"{words}: no sheet, camera on an arm",
            (Recording(body, "walk", (*NO_SHEET, "--camera-tf")),)),
        Row(f"{body}_none_rich", f"{words}: no sheet, rich texture", (Recording(body, "walk", NO_SHEET),), False),
        Row(f"{body}_none_weak", f"{words}: no sheet, weak texture",
            (Recording(body, "walk", (*NO_SHEET, "--texture", "weak")),), False)]


WALK = (Recording("sponge", "walk", ("--labels",)),)
PARTS = {
    "Recordings": [
        *body_rows("sponge", "sponge"), *body_rows("doll", "doll"), *body_rows("toy", "toy with thin legs"),
        Row("turntable", "sponge: turntable", (Recording("sponge", "turntable"),)),
        Row("hand_jerks", "sponge: a hand passes, and jerks of 0.3 m/s",
            (Recording("sponge", "walk_hand", ("--jerks",)),)),
        Row("seed", "sponge: walk, another seed", (Recording("sponge", "walk", ("--seed", "2")),))],
    "Faulty recordings": [
        Row("fault_drop", "30 % of the images dropped", WALK, fault=("inject", "--drop", "0.3")),
        Row("fault_jerks", "jerks of 0.3 m/s", (Recording("sponge", "walk", ("--jerks",)),)),
        Row("fault_hand", "a hand passes", (Recording("sponge", "walk_hand"),)),
        Row("fault_flicker", "the exposure flickers by 40 %", WALK, fault=("flicker",)),
        Row("fault_black", "black object: no depth on it", WALK, fault=("black",)),
        Row("fault_shiny", "shiny object: 30 % of its depth missing, 10 % up to 60 mm wrong", WALK, fault=("shiny",)),
        Row("fault_large", "object covers a part of the markers", (Recording("large", "walk"),)),
        Row("fault_no_depth", "no depth topic", WALK, fault=("no_depth",)),
        Row("fault_millimetres", "depth in mm, called m", WALK, fault=("millimetres",)),
        Row("fault_no_info", "no camera_info", WALK, fault=("no_info",)),
        Row("fault_half", "only half of the walk", WALK, fault=("half",)),
        Row("fault_cut_off", "recording cut off in the middle of a write", WALK, fault=("cut_off",)),
        Row("fault_hidden_sheet", "sheet not seen for a third of the time", WALK, fault=("hidden_sheet",))],
    # Scenes that track the sponge with its true mesh and with scanned models.
    "Tracking with the scanned model": [Row(f"track_{scene}", f"sponge: {scene}", (Recording("sponge", scene),))
                                        for scene in ("bend", "push", "touch")]}


def with_fault(row):
    """The recordings that are scanned; a faulty one is made of the first."""
    if not row.fault:
        return [recording.path for recording in row.recordings]
    original, faulty = row.recordings[0].path, FOLDER / f"{row.name}.bag"
    if row.fault[0] == "inject":
        tool("inject", original, "--output", faulty, *row.fault[1:])
    else:
        faulty_bags.write(row.fault[0], original, faulty)
    return [faulty]


def scan(row):
    """Makes a model with default settings."""
    bags, model, log = with_fault(row), FOLDER / row.name, FOLDER / f"{row.name}.log"
    shutil.rmtree(model, ignore_errors=True)
    code, seconds, usage = run_measured("scan_model", *bags, "--output", model, log=log)
    if row.fault:
        bags[0].unlink()
    result = {"code": code, "seconds": seconds, "cpu_seconds": usage.ru_utime + usage.ru_stime,
              "memory_gb": 1024e-9 * usage.ru_maxrss, "text": log.read_text()}
    if code in (0, 3):
        result["report"] = evaluate("--model", model, TRUE[row.recordings[0].body])
    return result


def track(row, description):
    """The report of `evaluate` on `replay` with default settings."""
    bag, result = row.recordings[0].path, FOLDER / f"{row.name}_result.bag"
    tool("replay", bag, "--object", description, "--output", result)
    report = evaluate(result, "--truth", bag)
    result.unlink()
    return report


def track_all(row):
    """Tracks a scene with each mesh."""
    return {"true": track(row, ROOT / "config/sponge.yaml"),
            "scanned": {model: track(row, FOLDER / model / "object.yaml") for model in MODELS}}


def perform(rows, keep):
    """{name of a row: its result}. The results are kept in evaluation/scans, too."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    write_toy(TRUE["toy"])
    write_scaled(TRUE["sponge"], LARGER, TRUE["large"])
    start, results = time.monotonic(), {}
    for done, row in enumerate(rows, 1):
        for recording in row.recordings:
            recording.make()
        result = {"commit": commit(), **(track_all if row.name.startswith("track_") else scan)(row)}
        results[row.name] = result
        (FOLDER / f"{row.name}.json").write_text(json.dumps(result, indent=1))
        print(f"[{done}/{len(rows)}, {time.monotonic() - start:.0f} s]", *map(row_of, rows_of(row, result)),
              file=sys.stderr, flush=True)
        later = {recording for other in rows[done:] for recording in other.recordings}
        for recording in {*row.recordings} - later:
            if not keep:
                recording.path.unlink(missing_ok=True)
    return results


def main():
    known = {row.name: row for part in PARTS.values() for row in part}
    names = chosen(known, [word for word in sys.argv[1:] if word != "--keep"])
    if any(name.startswith("track_") for name in names):
        names = list(dict.fromkeys((*MODELS, *names)))
    results = perform([row for name, row in known.items() if name in names], "--keep" in sys.argv)
    tables = {heading: [cells for row in part if row.name in results for cells in rows_of(row, results[row.name])]
              for heading, part in PARTS.items()}
    publish("measured/scans.md", "scans", tables, complete=len(results) == len(known))


if __name__ == "__main__":
    main()
