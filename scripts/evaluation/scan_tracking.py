"""Rows of `make scans` that track the sponge with its true mesh and with scanned models, and compare the errors."""
import dataclasses
import datetime
import json

from evaluation import scans
from evaluation.document import commit
from evaluation.runs import ROOT, tool

MODELS = ("sponge_walk", "sponge_flip")  # rows of scans.py


@dataclasses.dataclass(frozen=True)
class Scene:
    name: str
    words: str
    recordings: tuple  # of the scene, then those that the models are made from


def scenes():
    scanned = {recording: None for row in scans.good_rows() if row.name in MODELS for recording in row.recordings}
    return [Scene(f"track_{scene}", words, (scans.Recording("sponge", scene), *scanned))
            for scene, words in (("bend", "sponge: bend"), ("push", "sponge: push"), ("touch", "sponge: touch"))]


def scanned_object(model):
    """The object YAML of a scanned model; one of another commit is made again."""
    row = next(row for row in scans.good_rows() if row.name == model)
    made = next((result for _, result in scans.measured([row])), None)
    if made is None or made["commit"] != commit(ROOT):
        scans.measure(row)
    return scans.FOLDER / model / "object.yaml"


def track(scene, description):
    """The report of `evaluate` on `replay` with default settings."""
    recording, result = scene.recordings[0].path, scans.FOLDER / f"{scene.name}_result.bag"
    tool("replay", recording, "--object", description, "--output", result)
    report = json.loads(tool("evaluate", result, "--truth", recording, "--json"))
    result.unlink()
    return report


def measure(scene):
    """Makes what is missing and measures a scene with each mesh; the result is kept in evaluation/scans."""
    recording = scene.recordings[0]
    if not recording.path.exists():
        tool("virtual_camera", *recording.camera_arguments())
    result = {"commit": commit(ROOT), "date": str(datetime.date.today()),
              "true": track(scene, ROOT / "config/sponge.yaml"),
              "scanned": {model: track(scene, scanned_object(model)) for model in MODELS}}
    scans.path_of(scene).write_text(json.dumps(result, indent=1))
    return result
