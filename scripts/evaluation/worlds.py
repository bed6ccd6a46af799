"""Runs of scenes like the real world: bodies of one colour, from many starts, and objects that are not there."""
import json
import math
import random
import re

from evaluation.figures import OWN_COLOUR, PLAIN, STARTS, TEXTURED, TEXTURES
from evaluation.runs import (OUTPUT, ROOT, bags, config_of, measure, object_of, pose_of, tool, track, with_pose)

PLAIN_CAMERA = {"still": ("--duration", "10")}
START_M, START_RAD = 0.001, math.radians(0.5)  # from the middle, so starts are within 2 mm and 1 degree of each other
WRONG_S = "2"
WRONG_M, WRONG_RAD, WRONG_POSES = 0.02, math.radians(20.0), 4


def turned_by(quaternion, axis, angle):
    """A rotation (x, y, z, w) after a turn about a unit vector."""
    x, y, z, w = quaternion
    a, b, c = (math.sin(0.5 * angle) * part for part in axis)
    d = math.cos(0.5 * angle)
    return [d * x + a * w + b * z - c * y, d * y - a * z + b * w + c * x, d * z + a * y - b * x + c * w,
            d * w - a * x - b * y - c * z]


def direction(drawn):
    vector = [drawn.gauss(0.0, 1.0) for _ in range(3)]
    length = math.hypot(*vector)
    return [part / length for part in vector]


def starts(pose, count=STARTS, seed=1):
    """Poses near a pose, evenly distributed in all directions."""
    drawn = random.Random(seed)
    poses = []
    for _ in range(count):
        way, axis = direction(drawn), direction(drawn)
        distance, angle = START_M * drawn.random() ** (1.0 / 3.0), START_RAD * drawn.random()
        place = [p + distance * w for p, w in zip(pose[:3], way)]
        poses.append([*place, *turned_by(pose[3:], axis, angle)])
    return poses


def plain_run(scene):
    """A body of one colour: the report; without hands also how far apart the results from several starts are."""
    name = f"{scene}_plain"
    recording, config = OUTPUT / f"{name}.bag", object_of(scene)
    tool("virtual_camera", "--scene", scene, "--texture", "plain", "--labels", "--output", recording,
         *PLAIN_CAMERA.get(scene, ()))
    reports = {("plain", scene): measure(name, recording, config, "--truth", recording)}
    results = []
    for number, pose in enumerate(starts(pose_of(config)) if scene in PLAIN else [], 1):
        start = f"{name}_start_{number}"
        results.append(track(start, recording, with_pose(config, start, pose), "--allow-outside"))
    if results:
        reports[("starts", scene)] = bags("spread", *results)
    for used in (recording, *results):
        used.unlink()
    return reports


def texture_run(scene, texture):
    """A scene with another texture, without pictures; {(texture, scene): report}."""
    name = f"{scene}_{texture}"
    recording = OUTPUT / f"{name}.bag"
    tool("virtual_camera", "--scene", scene, "--texture", texture, "--labels", "--output", recording)
    config, allowed = config_of(scene, name)
    result = track(name, recording, config, "--labels", *allowed)
    text = tool("evaluate", result, "--truth", recording, "--json")
    (OUTPUT / f"{name}.json").write_text(text)
    recording.unlink()
    return {(texture, scene): json.loads(text)}


def scaled_object(config, factor, name):
    """The object with another size, at the same rough pose; its cage and tets are made at the start of `replay`."""
    mesh = OUTPUT / f"{name}.obj"
    lines = (config.parent / re.search(r"visual_mesh: *(\S+)", config.read_text())[1]).read_text().splitlines()
    mesh.write_text("\n".join("v " + " ".join(str(factor * float(x)) for x in line.split()[1:4])
                              if line.startswith("v ") else line for line in lines) + "\n")
    scaled = mesh.with_suffix(".yaml")
    scaled.write_text(f"object:\n  visual_mesh: {mesh}\n  initial_pose: {pose_of(config)}\n")
    return scaled


def wrong_object_runs(recording):
    """An object that is not there, at the place of the true one; {("wrong", what): the states}."""
    sponge, doll = ROOT / "config/sponge.yaml", ROOT / "config/doll.yaml"
    cases = {"the object 1.3 times as large": scaled_object(sponge, 1.3, "wrong_1_3"),
             "the object 1.15 times as large": scaled_object(sponge, 1.15, "wrong_1_15"),
             "another object of the same length": with_pose(doll, "wrong_doll", pose_of(sponge))}
    return {("wrong", what): {"states_by_time": bags("states", track(f"wrong_{number}", recording, config,
                                                                     "--allow-outside", "--placed"))}
            for number, (what, config) in enumerate(cases.items(), 1)}


def wrong_poses(pose, seed=1):
    """(words, pose off by 20 mm or 20 degrees in some direction)."""
    drawn = random.Random(seed)
    for number in range(1, WRONG_POSES + 1):
        moved = [p + WRONG_M * part for p, part in zip(pose[:3], direction(drawn))]
        yield f"20 mm off, direction {number}", [*moved, *pose[3:]]
        yield f"20 degrees off, axis {number}", [*pose[:3], *turned_by(pose[3:], direction(drawn), WRONG_RAD)]


def wrong_pose_runs(recording):
    """The right object at a wrong pose; {("placed", what): report}."""
    sponge = ROOT / "config/sponge.yaml"
    reports = {}
    for number, (what, pose) in enumerate(wrong_poses(pose_of(sponge)), 1):
        config = with_pose(sponge, f"placed_{number}", pose)
        result = track(f"placed_{number}", recording, config, "--allow-outside", "--placed")
        reports[("placed", what)] = json.loads(tool("evaluate", result, "--truth", recording, "--json"))
    return reports


def wrong_runs():
    """The scene bend with wrong objects and poses, which the tracker is told and does not search."""
    recording = OUTPUT / "wrong.bag"
    tool("virtual_camera", "--scene", "bend", "--duration", WRONG_S, "--output", recording)
    reports = {**wrong_object_runs(recording), **wrong_pose_runs(recording)}
    recording.unlink()
    return reports


def world_runs(scenes):
    """Pieces of work as (words, function)."""
    work = [(f"{scene}, plain", lambda scene=scene: plain_run(scene))
            for scene in (*PLAIN, *OWN_COLOUR) if scene in scenes]
    work += [(f"{scene}, {texture}", lambda scene=scene, texture=texture: texture_run(scene, texture))
             for texture in TEXTURES for scene in TEXTURED
             if scene in scenes and not (texture == "plain" and scene in PLAIN)]
    return work + ([("wrong objects and poses", wrong_runs)] if "bend" in scenes else [])
