"""Records and tracks the scenes of `make paper`: a scene once with each texture, equal runs once."""
import json
import shutil
import typing

from evaluation.runs import object_of, tool_of
from pages import ROOT
from paper_parts.methods import CUT_THROUGH, PAPER, TEAR
from paper_parts.results import counts, cut_quality, tear_times
from tools import OUTPUT, evaluate, perform, tool

FOLDER = OUTPUT / "paper"
BOARD = "cut_board"  # scene cut; the marked board itself is the blade
BOARD_TOOL = ("--tool", ROOT / "config/board.yaml")
COARSE = "coarse"  # the doll with as many cage vertices as the paper's
COARSE_VERTICES = "128"


class Run(typing.NamedTuple):
    """One scene, tracked by one method."""

    scene: str
    text: str = ""     # of methods.py
    model: str = ""    # empty: the shipped object
    texture: str = ""  # of the recorded body; empty: that of the virtual camera


def measured(parts):
    """Reports by run of parts.py: those of `evaluate`, with more that is read from the result. Runs of timed parts have
    the machine for themselves. The results of parts that keep them and the recordings stay until clear_bags(); the
    reports name them."""
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    runs = list(dict.fromkeys(run for part in parts for run in part.runs))
    timed, kept = ({run for part in parts if part.timed for run in part.runs},
                   {run for part in parts if part.kept for run in part.runs})
    if any(run.model for run in runs):
        tool("prepare_model", ROOT / "config/doll.obj", "--cage-vertices", COARSE_VERTICES, "--output", FOLDER / COARSE,
             package="softbody_sim")
    needed = list(dict.fromkeys((run.scene, run.texture) for run in runs))
    recordings = dict(zip(needed, perform([(" ".join((*which, "recorded")), record, *which) for which in needed])))
    reports = {}
    for is_timed, jobs in ((False, 2), (True, 1)):
        work = {run: (run.scene, measure, number, run, recordings[run.scene, run.texture], run in kept)
                for number, run in enumerate(runs) if (run in timed) == is_timed}
        reports |= zip(work, perform(work.values(), jobs))
    return reports


def clear_bags():
    for bag in FOLDER.glob("*.bag"):
        bag.unlink()


def record(scene, texture):
    path = FOLDER / f"{'_'.join(filter(None, (scene, texture)))}.bag"
    played = ("cut", *BOARD_TOOL) if scene == BOARD else (scene,)
    tool("virtual_camera", "--scene", *played, *(("--texture", texture) if texture else ()), "--output", path)
    return path


def measure(number, run, recording, keep):
    """The report of one run."""
    name = f"{run.scene}_{number}"
    result = FOLDER / f"{name}_result.bag"
    track(run, recording, FOLDER / f"{name}.yaml", result)
    report = {**evaluate(result, "--truth", recording), "recording": str(recording), "result": str(result),
              **counts(result)}
    if run.scene in CUT_THROUGH:
        report["quality"] = cut_quality(result)
    if run.scene == TEAR:
        report["times"] = tear_times(result, recording)
    (FOLDER / f"{name}.json").write_text(json.dumps(report))
    if not keep:
        result.unlink()
    return report


def track(run, recording, parameters, result):
    """Writes the result of a run, and its parameters."""
    config = FOLDER / COARSE / "object.yaml" if run.model else object_of(run.scene)
    files = recording, "--object", config, "--output", result
    if run.text.startswith(PAPER):
        program, *options = run.text.split()
        tool(program, *files, *options, package="development/softbody_evaluation")
        return
    parameters.write_text(run.text)
    knife = BOARD_TOOL if run.scene == BOARD else tool_of(run.scene)
    tool("replay", *files, "--timing", *knife, *(("--parameters", parameters) if run.text else ()))
