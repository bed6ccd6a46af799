#!/usr/bin/env python3
"""The program export: what it selects, what it refuses, and that a failure leaves nothing behind."""
import collections
import io
import os
import pathlib
import re
import resource
import signal
import sys
import tempfile
import traceback
import unittest

import rosbag
import rostest
from std_msgs.msg import String

import hand_made
import softbody

Result = collections.namedtuple("Result", "stderr returncode")
FORMATS = ("ply", "obj", "vtk", "gltf")
PROGRAM = "import sys; from softbody.export.command import main; sys.exit(main())"
# The program gets a signal while it writes the second frame.
INTERRUPTED = """
import os, signal, sys
from softbody.export import command
for kind in set(command.FORMATS.values()):
    def add(self, time, state, original=kind.add):
        original(self, time, state)
        if time > 0:
            os.kill(os.getpid(), signal.{name})
    kind.add = add
sys.exit(command.main())
"""


class Command(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="command_")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.bag = self.folder / "result.bag"
        hand_made.write_bag(self.bag, [0, 0, 1, 1, 1, 2])

    def run_program(self, *words, program=PROGRAM, largest_file=None):
        """In a copy of this process, which has all modules already."""
        heard, said = os.pipe()
        process = os.fork()
        if process == 0:
            sys.argv, sys.stdout, sys.stderr = ["export", *map(str, words)], io.StringIO(), os.fdopen(said, "w")
            self.run_and_exit(program, largest_file)
        os.close(said)
        with os.fdopen(heard) as pipe:
            return Result(stderr=pipe.read(), returncode=os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]))

    def run_and_exit(self, program, largest_file):
        code = 1
        try:
            os.chdir(self.folder)
            if largest_file:
                resource.setrlimit(resource.RLIMIT_FSIZE, (largest_file, largest_file))
            exec(program, {})  # pylint: disable=exec-used
        except SystemExit as end:
            code = end.code or 0
        except BaseException:  # pylint: disable=broad-except
            traceback.print_exc()
        sys.stderr.flush()
        os._exit(code)

    def export(self, *words, output="out", **options):
        return self.run_program(self.bag, "--output", output, *words, **options)

    def files(self):
        """Every file below the scratch folder, with its content."""
        return {path.relative_to(self.folder): path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}

    def expect_refused(self, result, sentence, before, code=1):
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertIn(sentence, result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        self.assertEqual(self.files(), before)

    def test_selection(self):
        for words, expected in (([], [0, 1, 2, 3, 4, 5]), (["--step", 2], [0, 2, 4]), (["--from", 0.06], [2, 3, 4, 5]),
                                (["--to", 0.1], [0, 1, 2, 3]), (["--from", 0.03, "--to", 0.14, "--step", 3], [1, 4])):
            result = self.export("--format", "ply", *words)
            self.assertEqual(result.returncode, 0, result.stderr)
            rows = (self.folder / "out/frames.csv").read_text().splitlines()[1:]
            stamps = [hand_made.stamp_of(frame) for frame in expected]
            self.assertEqual([row.split(",")[2] for row in rows], [f"{stamp.secs}.{stamp.nsecs:09}" for stamp in stamps])
            self.assertEqual(len(list((self.folder / "out").iterdir())), 1 + len(expected))

    def test_progress(self):
        self.assertIn("frame 6 of 6", self.export("--format", "ply").stderr)

    def test_all_formats_and_again(self):
        """The same bag gives the same files, and an earlier export is replaced, whatever its format."""
        for kind in FORMATS:
            for output in (f"first_{kind}", "again"):
                result = self.export("--format", kind, output=output)
                self.assertEqual(result.returncode, 0, result.stderr)
            first, again = (sorted((self.folder / name).iterdir()) for name in (f"first_{kind}", "again"))
            self.assertEqual([path.name for path in first], [path.name for path in again])
            self.assertEqual([path.read_bytes() for path in first], [path.read_bytes() for path in again])
        result = self.export(output="body.glb")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((self.folder / "body.glb").read_bytes(), (self.folder / "again/body.glb").read_bytes())

    def test_a_folder_of_somebody_else(self):
        (self.folder / "out").mkdir()
        (self.folder / "out/surface_000000.ply").write_text("of an earlier export")
        (self.folder / "out/thesis.tex").write_text("three years")
        self.expect_refused(self.export("--format", "ply"), "thesis.tex, which is not part of an export", self.files())
        self.expect_refused(self.export("--format", "ply", output=self.bag), "is not a folder", self.files())
        (self.folder / "link").symlink_to(self.folder / "out")
        self.expect_refused(self.export("--format", "ply", output="link"), "is not a folder", self.files())
        (self.folder / "folder.glb").mkdir()
        self.expect_refused(self.export(output="folder.glb"), "is not a file that can be replaced", self.files())

    def test_interrupted(self):
        for kind in FORMATS:
            self.assertEqual(self.export("--format", kind).returncode, 0)
            before = self.files()
            for name in ("SIGINT", "SIGTERM", "SIGHUP"):
                result = self.export("--format", kind, program=INTERRUPTED.format(name=name))
                self.expect_refused(result, "", before, code=-getattr(signal, name))
                self.assertEqual({path.name for path in self.folder.iterdir()}, {"result.bag", "out"})

    def test_full_disk(self):
        for kind in FORMATS:
            self.assertEqual(self.export("--format", kind).returncode, 0)
            result = self.export("--format", kind, largest_file=300)
            self.expect_refused(result, "export: out: cannot be written: File too large", self.files())
            self.assertEqual({path.name for path in self.folder.iterdir()}, {"result.bag", "out"})

    def test_bags_that_cannot_be_exported(self):
        self.write_object()
        content = self.bag.read_bytes()
        (self.folder / "text.bag").write_text("this is no bag")
        (self.folder / "empty.bag").write_bytes(b"")
        (self.folder / "unended.bag").write_bytes(content[:len(content) // 2])
        with rosbag.Bag(str(self.folder / "other.bag"), "w") as bag:
            bag.write("/words", String("hello"), hand_made.stamp_of(0))
        with rosbag.Bag(str(self.folder / "bare.bag"), "w") as bag:
            bag.write("/softbody/surface/topology", hand_made.surface_topology(1, revision=4), hand_made.stamp_of(0))
            bag.write("/softbody/surface/state", hand_made.surface_state(1, 0, 0), hand_made.stamp_of(0))
        with rosbag.Bag(str(self.folder / "wrong.bag"), "w") as bag:
            topology = hand_made.surface_topology(1)
            topology.triangles[3].vertex_indices = [0, 1, 999]
            bag.write("/softbody/surface/topology", topology, hand_made.stamp_of(0))
            bag.write("/softbody/surface/state", hand_made.surface_state(1, 0, 0), hand_made.stamp_of(0))
        for name, sentence in (("missing.bag", "missing.bag: No such file"), ("text.bag", "is not a bag"),
                               ("empty.bag", "empty.bag: "), ("unended.bag", "unended.bag: "),
                               ("other.bag", "no messages on /softbody/surface/state and /softbody/surface/topology"),
                               ("bare.bag", "no state has its topology"),
                               ("wrong.bag", "/softbody/surface/topology is wrong: triangles names a vertex"),
                               (".", "Is a directory")):
            for words in ((), ("--object", "object/object.yaml")):
                result = self.run_program(name, "--output", "new/folder/out", "--format", "ply", *words)
                self.expect_refused(result, sentence, self.files())
                self.assertFalse((self.folder / "new").exists())

    def test_the_advice_for_a_loop_helps(self):
        with rosbag.Bag(str(self.folder / "looped.bag"), "w") as bag:
            bag.write("/softbody/surface/topology", hand_made.surface_topology(1), hand_made.stamp_of(0))
            for place, frame in enumerate((0, 1, 2, 0, 1)):
                bag.write("/softbody/surface/state", hand_made.surface_state(1, frame, 0), hand_made.stamp_of(place))
        words = ("looped.bag", "--output", "out", "--format", "ply")
        refused = self.run_program(*words)
        self.expect_refused(refused, "jump back", self.files())
        advice = re.search(r"--to \S+", refused.stderr).group(0).split()
        self.assertEqual(self.run_program(*words, *advice).returncode, 0)
        self.assertEqual(len(list((self.folder / "out").glob("*.ply"))), 3)

    def test_a_damaged_bag(self):
        """Wherever a byte is wrong: a sentence and nothing left, or an export of what is there."""
        content = self.bag.read_bytes()
        for place in range(0, len(content), len(content) // 25):
            damaged = bytearray(content)
            damaged[place] ^= 0xff
            (self.folder / "damaged.bag").write_bytes(damaged)
            before = self.files()
            result = self.run_program("damaged.bag", "--output", "damaged", "--format", "ply")
            if result.returncode == 0:
                for path in (self.folder / "damaged").iterdir():
                    path.unlink()
                (self.folder / "damaged").rmdir()
            else:
                self.expect_refused(result, "damaged.bag", before)

    def test_wrong_usage(self):
        for words, sentence in ((["--format", "ply", "--step", 0], "0 is not 1 or more"),
                                (["--format", "ply", "--from", -1], "-1 is not 0 or more"),
                                (["--format", "ply", "--to", "nan"], "nan is not 0 or more"),
                                (["--format", "ply", "--from", 2, "--to", 1], "--to 1 is before --from 2"),
                                (["--format", "stl"], "invalid choice"), ([], "--format"),
                                (["--format", "vtk", "--object", "x.yaml"], "have no image")):
            self.expect_refused(self.export(*words), sentence, self.files(), code=2)
        self.expect_refused(self.export("--format", "ply", output="x.glb"), "is for --format gltf", self.files(), code=2)
        self.expect_refused(self.export("--format", "ply", "--from", 7), "no state is 7 s or more after", self.files())

    def write_object(self, image="image.png", mesh="mesh.obj", content=b"\x89PNG\r\n\x1a\n..."):
        (self.folder / "object").mkdir(exist_ok=True)
        (self.folder / "object/object.yaml").write_text(f"object: {{visual_mesh: {mesh}}}\n")
        (self.folder / "object/mesh.obj").write_text("# a mesh\nmtllib mesh.mtl\nv 0 0 0\n")
        (self.folder / "object/mesh.mtl").write_text(f"newmtl skin\nmap_Kd {image}\n" if image else "newmtl skin\n")
        (self.folder / "image.png").write_bytes(content)
        (self.folder / "object/image.png").write_bytes(content)

    def test_texture(self):
        words = ("--object", "object/object.yaml", "--format")
        self.write_object()
        for kind, mesh in (("ply", "surface_000000.ply"), ("obj", "surface.mtl")):
            self.assertEqual(self.export(*words, kind).returncode, 0)
            self.assertEqual((self.folder / "out/texture.png").read_bytes(), b"\x89PNG\r\n\x1a\n...")
            self.assertIn(b"texture.png", (self.folder / "out" / mesh).read_bytes())
        self.assertEqual(self.export("--object", "object", "--format", "ply").returncode, 0)
        self.write_object(image="C:\\Users\\me\\image.png")
        self.assertEqual(self.export(*words, "ply").returncode, 0)
        self.write_object(image="../image.png")
        self.expect_refused(self.export(*words, "gltf"), "allow it with --allow-outside", self.files())
        self.assertEqual(self.export("--allow-outside", *words, "gltf").returncode, 0)
        self.write_object(content=b"GIF89a")
        self.expect_refused(self.export(*words, "gltf"), "is no PNG or JPEG", self.files())
        self.write_object(image="nothing.png")
        self.expect_refused(self.export(*words, "gltf"), "nothing.png: No such file", self.files())
        (self.folder / "object/object.yaml").write_text("tool: {}\n")
        self.expect_refused(self.export(*words, "gltf"), "has no key object/visual_mesh", self.files())
        (self.folder / "object/object.yaml").write_text("object: [\n")
        self.expect_refused(self.export(*words, "gltf"), "is not YAML", self.files())
        self.write_object(image=None)
        result = self.export(*words, "obj")
        self.assertEqual(result.returncode, 0)
        self.assertIn("names no image; exported without", result.stderr)
        self.write_object()
        hand_made.write_bag(self.bag, [0, 0], has_texture=False)
        result = self.export(*words, "obj")
        self.assertEqual(result.returncode, 0)
        self.assertIn("result.bag has no texture coordinates; exported without", result.stderr)
        self.assertFalse((self.folder / "out/texture.png").exists())

    def test_python_sees_what_the_program_sees(self):
        bag = softbody.ResultBag(self.bag)
        self.assertEqual(len(bag), 6)
        self.assertEqual([state.revision for state in bag], [0, 0, 1, 1, 1, 2])
        self.assertEqual([state.revision for state in bag], [0, 0, 1, 1, 1, 2])  # once more
        with self.assertRaisesRegex(softbody.BagError, "no messages on /elsewhere/surface/state"):
            softbody.ResultBag(self.bag, "/elsewhere")


if __name__ == "__main__":
    rostest.rosrun("softbody_python", "command", Command, sys.argv)
