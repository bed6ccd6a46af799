"""Runs of scenes like the real world: bodies of one colour, from many starts, wrong objects, frames without images."""
import math
import random

from evaluation import bags
from evaluation.figures import OWN_COLOUR, PLAIN, STARTS, TEXTURED, TEXTURES
from evaluation.poses import direction, moved, near, turned_by
from evaluation.runs import OUTPUT, changed, config_of, measure, object_of, pose_of, recorded, track, with_pose
from evaluation.scan_bodies import write_scaled
from pages import ROOT
from tools import evaluate

PLAIN_CAMERA = {"still": ("--duration", "10")}
START_M, START_RAD = 0.001, math.radians(0.5)  # from the middle, so starts are within 2 mm and 1 degree of each other
WRONG_S = "2"
WRONG_M, WRONG_RAD, WRONG_POSES = 0.02, math.radians(20.0), 4
# Scenes whose last fifth is predicted without images, and what holds the body there.
SHARE = 0.2
CLAMP = "{name: clamp, frame: clamp, min: [-1, -1, -1], max: [-0.06, 1, 1]}"
GRIPPER = "{name: gripper, frame: gripper, min: [0.06, -1, -1], max: [1, 1, 1]}"
PLATE = "{name: plate, frame: plate, min: [0.095, -1, -1], max: [1, 1, 1]}"  # the body sticks to it
HELD = {"bend_held": (CLAMP, GRIPPER), "push_held": (CLAMP, PLATE), "twist_held": (CLAMP, GRIPPER),
        "press_held": (CLAMP, GRIPPER), "pull_held": (CLAMP, GRIPPER)}
# A box with the area of the round stamp.
STAMP = """simulator:
  obstacles:
    - {name: stamp, frame: stamp, shape: box, size_m: [0.044, 0.044, 0.02], rounding_m: 0.002,
       pose: [0, 0, 0.01, 0, 0, 0, 1], friction: 1}
"""


def plain_run(scene):
    """A body of one colour: the report; without hands also how far apart the results from several starts are."""
    name, config = f"{scene}_plain", object_of(scene)
    drawn, results = random.Random(1), []
    with recorded(name, scene, "--texture", "plain", "--labels", *PLAIN_CAMERA.get(scene, ())) as bag:
        reports = {("plain", scene): measure(name, bag, config, "--truth", bag)}
        for number in range(1, 1 + STARTS * (scene in PLAIN)):
            start = f"{name}_start_{number}"
            pose = near(pose_of(config), drawn, START_M, START_RAD)
            results.append(track(start, bag, with_pose(config, start, pose), "--allow-outside"))
    if results:
        reports[("starts", scene)] = bags.spread(*results)
    for result in results:
        result.unlink()
    return reports


def texture_run(scene, texture):
    """A scene with another texture, without pictures; {(texture, scene): report}."""
    name = f"{scene}_{texture}"
    with recorded(name, scene, "--texture", texture, "--labels") as bag:
        config, allowed = config_of(scene, name)
        return {(texture, scene): measure(name, bag, config, "--truth", bag, more=allowed, pictures=False)}


def scaled_object(config, factor, name):
    """The object with another size, at the same rough pose; its cage and tets are made at the start of `replay`."""
    mesh, scaled = OUTPUT / f"{name}.obj", OUTPUT / f"{name}.yaml"
    write_scaled(config.with_suffix(".obj"), factor, mesh)
    scaled.write_text(f"object:\n  visual_mesh: {mesh}\n  initial_pose: {pose_of(config)}\n")
    return scaled


def wrong_runs():
    """The scene bend with objects that are not there, at the place of the true one, and with the right one at poses off
    by 20 mm or 20 degrees in some direction, which the tracker is told and does not search. {("wrong", what): the
    states}, {("placed", what): report}."""
    sponge, drawn, poses, reports = ROOT / "config/sponge.yaml", random.Random(1), {}, {}
    right = pose_of(sponge)
    cases = {"the object 1.3 times as large": scaled_object(sponge, 1.3, "wrong_1_3"),
             "the object 1.15 times as large": scaled_object(sponge, 1.15, "wrong_1_15"),
             "another object of the same length": with_pose(ROOT / "config/doll.yaml", "wrong_doll", right)}
    for number in range(1, WRONG_POSES + 1):
        poses[f"20 mm off, direction {number}"] = moved(right, direction(drawn), WRONG_M)
        poses[f"20 degrees off, axis {number}"] = [*right[:3], *turned_by(right[3:], direction(drawn), WRONG_RAD)]
    with recorded("wrong", "bend", "--duration", WRONG_S) as bag:
        for number, (what, config) in enumerate(cases.items(), 1):
            result = track(f"wrong_{number}", bag, config, "--allow-outside", "--placed")
            reports[("wrong", what)] = {"states_by_time": bags.states(result)}
        for number, (what, pose) in enumerate(poses.items(), 1):
            config = with_pose(sponge, f"placed_{number}", pose)
            result = track(f"placed_{number}", bag, config, "--allow-outside", "--placed")
            reports[("placed", what)] = evaluate(result, "--truth", bag)
    return reports


def open_loop_run(scene):
    """{("open loop", scene): report}. The tracker is told where the body begins, because both ends are hidden."""
    name = f"{scene}_open_loop"
    parameters = OUTPUT / f"{name}_parameters.yaml"
    parameters.write_text(STAMP if scene == "press_held" else "simulator: {}\n")
    with recorded(name, scene) as bag:
        pose = ", ".join(f"{part:.9f}" for part in bags.start(bag))
        config = changed(ROOT / "config/sponge.yaml", name, r"initial_pose:.*",
                         f"initial_pose: [{pose}]\n  pins: [{', '.join(HELD[scene])}]")
        result = track(name, bag, config, "--allow-outside", "--placed", "--open-loop", SHARE, "--parameters",
                       parameters)
        return {("open loop", scene): evaluate(result, "--truth", bag, "--open-loop", SHARE)}


def world_runs(scenes):
    """Pieces of work (words, function, arguments...)."""
    textured = [(scene, texture) for texture in TEXTURES for scene in TEXTURED
                if scene in scenes and not (texture == "plain" and scene in PLAIN)]
    return [*((f"{scene}, plain", plain_run, scene) for scene in (*PLAIN, *OWN_COLOUR) if scene in scenes),
            *((", ".join(which), texture_run, *which) for which in textured),
            *([("wrong objects and poses", wrong_runs)] if "bend" in scenes else []),
            *((f"{scene}, open loop", open_loop_run, scene) for scene in HELD if scene in scenes)]
