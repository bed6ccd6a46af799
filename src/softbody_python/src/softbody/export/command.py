"""The command line: `rosrun softbody_bringup export RESULT.bag --output DIR --format gltf`."""
import argparse
import contextlib
import math
import pathlib
import sys

import rospkg
from softbody.bag import BagError, ResultBag
from softbody.export.errors import ExportError
from softbody.export.gltf_file import Scene
from softbody.export.mesh_files import ObjSequence, PlySequence
from softbody.export.progress import with_progress
from softbody.export.selection import select
from softbody.export.staging import Interrupted, end_by_signal, interrupt_on_signals, staged_folder
from softbody.export.texture import texture_of
from softbody.export.vtk_files import VtkSeries

FORMATS = {"ply": PlySequence, "obj": ObjSequence, "vtk": VtkSeries, "gltf": Scene}


class Help(argparse.HelpFormatter):
    """Help as the other tools print it."""

    def add_usage(self, usage, actions, groups, prefix=None):
        super().add_usage(usage, actions, groups, prefix or "Usage: ")


def _seconds(text):
    value = float(text)
    if not math.isfinite(value) or value < 0:
        raise argparse.ArgumentTypeError(f"{text} is not 0 or more")
    return value


def _step(text):
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError(f"{text} is not 1 or more")
    return value


class Version(argparse.Action):
    """Prints package and version from package.xml, as the other tools do."""

    def __call__(self, parser, namespace, values, option_string=None):
        package = "softbody_python"
        print(package, rospkg.RosPack().get_manifest(package).version)
        parser.exit()


def _arguments(words):
    parser = argparse.ArgumentParser("export", formatter_class=Help, description="Writes the states of a result to files of "
                                     "other programs: meshes of each frame, a series for ParaView, or an animation")
    parser.add_argument("--version", action=Version, nargs=0, help="print package and version and exit")
    parser.add_argument("bag", metavar="RESULT.bag", help="bag of replay, or one recorded live")
    parser.add_argument("--output", required=True, metavar="DIR", help="folder to write, or FILE.glb for gltf")
    parser.add_argument("--format", choices=FORMATS, help="ply, obj: surface of each frame; vtk: surface and tets of each "
                        "frame for ParaView; gltf: one animation. Default: gltf if --output ends with .glb")
    parser.add_argument("--object", metavar="FILE", type=pathlib.Path, help="object YAML, or its folder, for the image of its mesh")
    parser.add_argument("--allow-outside", action="store_true", help="the YAML and the mesh may name files in other folders")
    parser.add_argument("--namespace", default="/softbody", metavar="NAME", help="of the topics; default: /softbody")
    parser.add_argument("--from", dest="begin", default=0.0, type=_seconds, metavar="S", help="begin [s] after the first state")
    parser.add_argument("--to", dest="end", default=math.inf, type=_seconds, metavar="S", help="end [s] after the first state")
    parser.add_argument("--step", default=1, type=_step, metavar="N", help="every N-th state only; default: 1")
    arguments = parser.parse_args(words)
    arguments.output = pathlib.Path(arguments.output)
    _complete(parser, arguments)
    return arguments


def _complete(parser, arguments):
    """What depends on several arguments."""
    arguments.single_file = "body.glb" if arguments.output.suffix == ".glb" else None
    arguments.format = arguments.format or ("gltf" if arguments.single_file else None)
    if arguments.format is None:
        parser.error(f"the following arguments are required: --format {{{','.join(FORMATS)}}}")
    if arguments.single_file and arguments.format != "gltf":
        parser.error(f"--output {arguments.output} is for --format gltf; give a folder for {arguments.format}")
    if arguments.object and arguments.format == "vtk":
        parser.error("--object is for ply, obj and gltf; the files of vtk have no image")
    if arguments.end < arguments.begin:
        parser.error(f"--to {arguments.end:g} is before --from {arguments.begin:g}")


def _texture(arguments, bag):
    if arguments.object is None:
        return None
    texture = texture_of(arguments.object, arguments.allow_outside)
    if texture is None:
        print(f"export: warning: the mesh of {arguments.object} names no image; exported without", file=sys.stderr)
        return None
    first = next(iter(bag), None)
    if first is not None and first.texture_coordinates is None:
        print(f"export: warning: {bag.path} has no texture coordinates; exported without {texture.path}", file=sys.stderr)
        return None
    return texture


def run(arguments):
    """Returns how many states were written. @throw ExportError, BagError, OSError."""
    bag = ResultBag(arguments.bag, arguments.namespace)
    texture = _texture(arguments, bag)
    count = 0
    with staged_folder(arguments.output, arguments.single_file) as folder:
        writer = FORMATS[arguments.format](folder, texture)
        with contextlib.closing(with_progress(bag, len(bag))) as states:
            for time, state in select(states, arguments.begin, arguments.end, arguments.step):
                writer.add(time, state)
                count += 1
        writer.finish()
    return count


def _place(error, arguments):
    """The file that an OSError is about, by the name that the user knows."""
    is_staged = error.filename is None or ".part-" in str(error.filename)
    return f"{arguments.output}: cannot be written" if is_staged else error.filename


def main(words=None):
    """Returns the exit code: 0 done, 1 the data could not be exported. Wrong usage ends with 2."""
    arguments = _arguments(words)
    interrupt_on_signals()
    try:
        count = run(arguments)
    except Interrupted as interrupted:
        return end_by_signal(interrupted.number)
    except OSError as error:
        print(f"export: {_place(error, arguments)}: {error.strerror or error}", file=sys.stderr)
        return 1
    except (BagError, ExportError) as error:
        print(f"export: {error}", file=sys.stderr)
        return 1
    print(f"{arguments.output}: {arguments.format}, {count} frames", file=sys.stderr)
    return 0
