"""Runs of `make starts`: short recordings of cluttered scenes, tracked from a rough pose or without one."""
import json
import math
import random
import shutil

from evaluation.runs import OUTPUT, ToolFailed, bags, object_of, tool, track, with_pose
from evaluation.worlds import direction, turned_by

SEEDS = range(1, 21)
TEXTURE, DURATION_S = "weak", "1"
# The scenes, and which of them gives the body without the other things: it is at rest, so most have the same images.
ALONE = {"twin": "twin", "neighbour": "twin", "stack": "twin", "clutter": "twin", "held": "held"}
SCENES = list(ALONE)
NO_POSE = ("clutter", "doll_clutter")
ROUGH_M, ROUGH_RAD = 0.012, math.radians(10.0)  # largest error of a rough pose
START_S, WRONG_MM = 0.5, 15.0


def record(name, scene, seed, *more):
    recording = OUTPUT / f"{name}.bag"
    tool("virtual_camera", "--scene", scene, "--texture", TEXTURE, "--seed", str(seed), "--duration", DURATION_S,
         "--output", recording, *more)
    return recording


def rough(pose, seed):
    """A pose near a pose, evenly distributed in the ball of places and in the angles."""
    drawn = random.Random(seed)
    way, axis = direction(drawn), direction(drawn)
    distance, angle = ROUGH_M * drawn.random() ** (1.0 / 3.0), ROUGH_RAD * drawn.random()
    return [*[p + distance * part for p, part in zip(pose[:3], way)], *turned_by(pose[3:], axis, angle)]


def tracked(name, recording, scene, seed):
    """The result from a rough pose."""
    config = with_pose(object_of(scene), name, rough(bags("pose", recording), seed))
    return track(name, recording, config, "--allow-outside")


def report_of(result, truth):
    return json.loads(tool("evaluate", result, "--truth", truth, "--json"))


def alone_result(scene, seed):
    return OUTPUT / f"starts_alone_{scene}_{seed}_result.bag"


def alone_run(scene, seed):
    """Keeps the result of the body alone, for all scenes that are compared with it."""
    name = f"starts_alone_{scene}_{seed}"
    recording = record(name, scene, seed, "--no-hands")
    tracked(name, recording, scene, seed)
    recording.unlink()


def scene_run(scene, seed):
    """(scene, report, report of the body alone on the same truth: also with the same seen vertices)."""
    name = f"starts_{scene}_{seed}"
    recording = record(name, scene, seed)
    result = tracked(name, recording, scene, seed)
    reports = report_of(result, recording), report_of(alone_result(ALONE[scene], seed), recording)
    recording.unlink()
    result.unlink()
    return (scene, *reports)


def free_run(scene, seed):
    """(scene, report) of a body with a picture that is searched in the whole image; an empty report: not found."""
    name = f"starts_free_{scene}_{seed}"
    pictured = OUTPUT / name
    recording = record(name, scene, seed, "--object", pictured)
    try:
        result = track(name, recording, pictured)
        report = report_of(result, recording)
        result.unlink()
    except ToolFailed as error:
        if "the body was not found" not in str(error):
            raise
        report = {}
    recording.unlink()
    shutil.rmtree(pictured)
    return scene, report
