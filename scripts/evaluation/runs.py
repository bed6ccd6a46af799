"""Records, tracks and measures the scenes. Every run returns reports of `evaluate` by (kind, name)."""
import json
import re

from evaluation import bags
from evaluation.figures import (CLUTTERED, DEPTH_HOLES, FEW_FEATURES, MOVING, NOISE_FREE, SCANNED,
                                WRONG_MATCH_SEEDS, wrong_matches)
from evaluation.poses import moved
from pages import ROOT
from tools import OUTPUT, evaluate, recording, tool

TOY = ROOT.parent / "shared/data/toys"
TOY_POSE = "[0.059, -0.038, 0.630, 0.611, -0.488, 0.171, 0.599]"  # rough, from the data set's README
LONG_S = "60"
LONG = ("still", "bend")
MOTION, WORLD = ("--camera-motion", "orbit"), ("--output-frame", "world")
# More faults of one scene, as arguments of inject.
MORE_FAULTS = {"bend": {
    "occluder in front of half of the body for 2 s": ["--occluder", "0.15", "--occluder-u", "0.72",
                                                      "--occluder-from", "1.5", "--occluder-for", "2"],
    "20 % dropped": ["--drop", "0.2"],
    "20 % reordered": ["--reorder", "0.2"],
    "20 % twice": ["--duplicate", "0.2"],
    "20 % late by 0.1 s": ["--delay", "0.2"],
    "2 % with a stamp 0.1 s off": ["--wrong-stamp", "0.02"],
}}
FINE_CAGE = "300"  # vertices; the shipped sponge has the paper's 132
# Scenes in which a hand hides the body. Their normal error is that without the hand.
HIDDEN = ("occlude", "doll_occlude", "touch", "doll_touch", "squeeze", "doll_squeeze")
# Scenes with known forces. The tracker is told how well the stiffness is known, so that it says them in newtons.
PRESSED, STIFFNESS_STD_PA = ("stamp", "doll_stamp"), 200
FARTHER_M = {"far": 0.4, "doll_far": 0.4, "two_bodies": 0.25}  # away from the camera than the rough poses say


def all_scenes():
    """Those of a body alone, or with what deforms it. `make scans` measures those that are made to be scanned."""
    scenes = re.search(r"--scene \S*?\{([^}]*)\}", tool("virtual_camera", "--help"))[1].split(",")
    return [scene for scene in scenes if scene.removeprefix("doll_") not in (*CLUTTERED, *SCANNED)]


def recorded(name, scene, *arguments):
    return recording(OUTPUT / f"{name}.bag", scene, *arguments)


def track(name, bag, config, *more):
    """The result of `replay`."""
    result = OUTPUT / f"{name}_result.bag"
    tool("replay", bag, "--object", config, "--output", result, "--timing", *more)
    return result


def measure(name, bag, config, *against, more=(), pictures=True):
    """Tracks a recording, with more arguments for `replay`; the report of `evaluate`."""
    result = track(name, bag, config, "--labels", *more)
    report = evaluate(result, *against, *(("--report", OUTPUT / name) if pictures else ()))
    (OUTPUT / f"{name}.json").write_text(json.dumps(report, indent=1))
    return report


def object_of(scene):
    """The object that a scene's body is made from: the longest prefix that names one, otherwise the sponge."""
    shipped = [path for path in (ROOT / "config").glob("*.yaml") if scene.startswith(path.stem + "_")]
    return max(shipped, key=lambda path: len(path.stem), default=ROOT / "config/sponge.yaml")


def changed(config, name, pattern, text):
    """The object with another text: a file in evaluation/. `replay` needs --allow-outside for it."""
    meshes = re.sub(r"(_mesh: *)(\S+)", lambda found: f"{found[1]}{config.parent / found[2]}", config.read_text())
    other = OUTPUT / f"{name}.yaml"
    other.write_text(re.sub(pattern, text, meshes))
    return other


def with_pose(config, name, pose):
    """The object with another rough pose."""
    return changed(config, name, r"initial_pose:.*", f"initial_pose: [{', '.join(f'{part:.9f}' for part in pose)}]")


def pose_of(config):
    """The rough pose of an object YAML: position and quaternion."""
    return [float(number) for number in re.search(r"initial_pose: *\[([^\]]*)\]", config.read_text())[1].split(",")]


def config_of(scene, name):
    """The object YAML for a scene, and arguments of `replay` for it."""
    config = object_of(scene)
    if scene in PRESSED:
        return (changed(config, name, r"material: *{", f"material: {{youngs_modulus_std: {STIFFNESS_STD_PA}, "),
                ("--allow-outside", "--forces"))
    if scene not in FARTHER_M:
        return config, ()
    return with_pose(config, name, moved(pose_of(config), (0.0, 0.0, 1.0), FARTHER_M[scene])), ("--allow-outside",)


def tool_of(scene):
    """Arguments of `replay` for a scene in which the body is cut or tears."""
    if re.search(r"(^|_)tear", scene):
        return ("--parameters", ROOT / "config/tear.yaml")
    return ("--tool", ROOT / "config/knife.yaml") if re.search(r"(^|_)cut", scene) else ()


def scene_run(kind, scene, camera=(), replay=()):
    """Records and measures one scene, with more arguments of the camera and of `replay`; {(kind, scene): report}.
    Faults are put into the same recording."""
    name = scene if kind == "scene" else f"{scene}_{kind.replace(' ', '_')}"
    with recorded(name, scene, "--labels", *camera) as bag:
        config, allowed = config_of(scene, name)
        reports, unhidden = {}, ()
        if kind == "scene" and scene in HIDDEN:
            with recorded(f"{scene}_unhidden", scene, "--no-hands") as alone:
                unhidden = ("--unhidden", track(f"{scene}_unhidden", alone, config))
            reports[("unhidden", scene)] = evaluate(unhidden[1], "--truth", bag)
        reports[(kind, scene)] = measure(name, bag, config, "--truth", bag, *unhidden,
                                         more=(*tool_of(scene), *allowed, *replay))
        if kind == "scene" and scene in WRONG_MATCH_SEEDS:
            reports.update(fault_runs(scene, bag, config))
        if kind == "scene" and scene in NOISE_FREE:
            fine = fine_sponge(scene)
            reports[("fine", scene)] = measure(f"{scene}_fine", bag, fine, "--truth", bag)
            # Both volumes, simulated from the exact visible vertices.
            reports[("exact", scene)] = simulate(f"{scene}_exact", bag, config)
            reports[("fine exact", scene)] = simulate(f"{scene}_fine_exact", bag, fine)
    return reports


def with_known(scene, bag, config):
    """Arguments of `replay` for the other things of a scene that are known, and of `evaluate` for the body."""
    if scene == "arm":
        return ("--robot", f"{bag}.urdf"), ()
    if scene != "two_bodies":
        return (), ()
    second = with_pose(ROOT / "config/doll.yaml", f"{config.stem}_second", bags.pose(bag, "ground_truth_second"))
    return ("--object", second), ("--namespace", f"/{config.stem}")


def cluttered_run(scene):
    """A scene with other things, and the same motion without them; both on the truth with them."""
    name = f"cluttered_{scene}"
    config, allowed = config_of(scene, name)
    with recorded(f"{name}_alone", scene, "--no-hands") as alone:
        result = track(f"{name}_alone", alone, config, *allowed)
    with recorded(name, scene, "--labels") as bag:
        known, which = with_known(scene, bag, config)
        return {("cluttered", scene): measure(name, bag, config, "--truth", bag, *which, more=(*allowed, *known)),
                ("uncluttered", scene): evaluate(result, "--truth", bag)}


def fine_sponge(scene):
    """The object with a finer volume."""
    folder = OUTPUT / f"{scene}_fine_sponge"
    tool("prepare_model", ROOT / "config/sponge.obj", "--output", folder, "--cage-vertices", FINE_CAGE,
         package="softbody_sim")
    description = folder / "object.yaml"
    pose = re.search(r"^ *initial_pose:.*$", (ROOT / "config/sponge.yaml").read_text(), re.MULTILINE)[0]
    description.write_text(f"{description.read_text().rstrip()}\n{pose}\n")
    return description


def simulate(name, truth, config):
    """The report of `evaluate` on `simulate_truth`."""
    result = OUTPUT / f"{name}.bag"
    tool("simulate_truth", truth, "--object", config, "--output", result)
    report = evaluate(result, "--truth", truth)
    result.unlink()
    return report


def fault_runs(scene, bag, config):
    """The same recording with faults, and with other parameters; {("fault", (scene, fault)): report}."""
    drawn = {wrong_matches(seed): ["--misplaced", "0.2", "--seed", str(seed)] for seed in WRONG_MATCH_SEEDS[scene]}
    faults, reports = {DEPTH_HOLES: ["--holes", "0.3"], **drawn, **MORE_FAULTS.get(scene, {})}, {}
    for number, (fault, arguments) in enumerate(faults.items(), 1):
        name = f"{scene}_fault_{number}"
        faulty = OUTPUT / f"{name}.bag"
        tool("inject", bag, "--output", faulty, *arguments)
        reports[("fault", (scene, fault))] = measure(name, faulty, config, "--truth", bag, "--recording", faulty)
        faulty.unlink()
    parameters = OUTPUT / f"{scene}_parameters_1.yaml"
    parameters.write_text("feature_tracker: {max_features: 50}\n")
    reports[("fault", (scene, FEW_FEATURES))] = measure(parameters.stem, bag, config, "--truth", bag,
                                                        more=("--parameters", parameters))
    return reports


def toy_run():
    """Report of the recorded toy, depth only; empty if the recording is missing."""
    if not TOY.is_dir():
        return {("toys", "toys"): {}}
    bag, config, reports = OUTPUT / "toys.bag", OUTPUT / "toys.yaml", {}
    body = f"object:\n  visual_mesh: {TOY}/toy_surface.obj\n  tet_mesh: {TOY}/toy_tets.vtu\n"
    tool("import_images", TOY, "--output", bag)
    for kind, pose in (("toys", f"  initial_pose: {TOY_POSE}\n"), ("no pose", "")):
        config.write_text(body + pose)
        reports[(kind, "toys")] = measure(kind.replace(" ", "_"), bag, config, "--recording", bag,
                                          more=("--allow-outside",))
    bag.unlink()
    return reports


def runs(scenes):
    """Pieces of work (words, function, arguments...), the longest first."""
    def those(among):
        return [scene for scene in among if scene in scenes]

    alone = [scene for scene in scenes if scene not in ("toys", *CLUTTERED)]
    return [*((f"{scene}, {LONG_S} s", scene_run, "long", scene, ("--duration", LONG_S)) for scene in those(LONG)),
            *((scene, scene_run, "scene", scene) for scene in alone),
            *((scene, cluttered_run, scene) for scene in those(CLUTTERED)),
            *((f"{scene}, noise off", scene_run, "noise off", scene, ("--noise", "off"))
              for scene in those(NOISE_FREE)),
            *((f"{scene}, moving camera", scene_run, "moving camera", scene, MOTION, WORLD) for scene in those(MOVING)),
            *((scene, toy_run) for scene in those(("toys",)))]
