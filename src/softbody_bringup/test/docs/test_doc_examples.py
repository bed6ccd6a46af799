"""Every example of README.md and docs runs: bash blocks in order, page by page; YAML blocks are loaded by their tool.
Log sentences that a page quotes are those of the sources, and programs that it shows are the files that it names."""
import atexit
import glob
import os
import re
import signal
import sys
import tempfile
import unittest

import rospkg

import doc_pages
import example_runner
import log_sentences
import stand_ins

ROOT = os.path.realpath(os.path.join(rospkg.RosPack().get_path("softbody_bringup"), "../.."))
PAGES = ["README.md", *sorted(os.path.relpath(path, ROOT) for path in glob.glob(f"{ROOT}/docs/**/*.md", recursive=True))]


class DocExamples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(1))
        cls.scratch = tempfile.TemporaryDirectory(prefix="doc_examples_")
        cls.addClassCleanup(cls.scratch.cleanup)
        cls.stand_ins = f"{cls.scratch.name}/stand_ins"
        os.makedirs(cls.stand_ins)
        stand_ins.make(cls.stand_ins, f"{ROOT}/config")

    def run_page(self, text, name):
        examples = doc_pages.examples(text)
        if not examples:
            return
        with tempfile.TemporaryDirectory(prefix="page_", dir=self.scratch.name) as scratch:
            runner = example_runner.PageRunner(ROOT, self.stand_ins, scratch)
            atexit.register(runner.close)  # also where the test is ended from outside
            for example in examples:
                try:
                    runner.run(example)
                except example_runner.ExampleFailed as error:
                    runner.close()
                    self.fail(f"{name}:{example.line}: {error}\nThe example:\n{example.text}")
            runner.close()

    def test_an_example_that_is_wrong_fails(self):
        for broken, reason in (
                ("```bash\nrosrun softbody_bringup replay my.bag --no-such-option\n```\n", "no-such-option"),
                ("```bash\nroslaunch softbody_bringup demo.launch no_such_argument:=1\n```\n", "no argument 'no_such_argument'"),
                ("```bash\nroslaunch softbody_bringup track.launch object:=no_such_file.yaml\n```\n", "there is no such file"),
                ("```bash\nmake no_such_target\n```\n", "no_such_target"),
                ("<!-- example: live -->\n```bash\nrosrun softbody_bringup replay --no-such-option\n```\n", "names no option"),
                ("<!-- example: live -->\n```bash\nrosrun rviz no_such_program\n```\n", "no_such_program"),
                ("```bash\necho 'verdict: wrong'\n```\n", "the verdict is wrong"),
                ("<!-- example: bad -->\n```bash\necho 'verdict: good'\n```\n", "the verdict is good"),
                ("<!-- example: fails -->\n```bash\nrosrun softbody_bringup validate_bag my.bag\n```\n", "exit code 0"),
                ("```yaml\nobject:\n  visual_mesh: sponge.obj\n  pins: [{name: grip, min: [5, 5, 5], max: [6, 6, 6]}]\n```\n",
                 "contains nothing of the body at rest"),
                ("```yaml\nfeature_tracker: {no_such_parameter: 1}\n```\n", "no_such_parameter")):
            with self.assertRaisesRegex(self.failureException, reason):
                self.run_page(broken, "broken")

    def test_shown_files(self):
        shown = set()
        for page in PAGES:
            with open(f"{ROOT}/{page}", encoding="utf-8") as file:
                for path, text in re.findall(r"<!-- file: (\S+) -->\n```cpp\n(.*?)```", file.read(), re.DOTALL):
                    with open(f"{ROOT}/{path}", encoding="utf-8") as source:
                        self.assertEqual(source.read(), text, f"{page} does not show {path} as it is")
                    shown.add(path)
        self.assertEqual(shown, {os.path.relpath(path, ROOT) for pattern in ("*.cpp", "*.h")
                                 for path in glob.glob(f"{ROOT}/src/softbody_bringup/test/downstream/{pattern}")})

    def test_quoted_log_sentences(self):
        sources, wrong = log_sentences.literals(ROOT), []
        for page in PAGES:
            with open(f"{ROOT}/{page}", encoding="utf-8") as file:
                for sentence in log_sentences.quoted(file.read()):
                    wrong += [f"{page}: no source says '{part}'" for part in log_sentences.missing(sentence, sources)]
        self.assertEqual(wrong, [])


def page_test(page):
    def test(self):
        with open(f"{ROOT}/{page}", encoding="utf-8") as file:
            self.run_page(file.read(), page)
    return test


for page_name in PAGES:
    setattr(DocExamples, "test_" + page_name.replace("/", "_").replace(".md", ""), page_test(page_name))
