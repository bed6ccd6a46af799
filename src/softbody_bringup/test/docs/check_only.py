#!/usr/bin/env python3
"""Stands in for a program in an example that a test cannot run: checks that the program takes these arguments. Called under the
program's name, with the directory of the real programs behind it on PATH."""
import os
import re
import subprocess
import sys

FILE_ARGUMENTS = ("object", "tool", "bag", "params", "faults")


def fail(sentence):
    print(f"{os.path.basename(sys.argv[0])}: {sentence}", file=sys.stderr)
    sys.exit(1)


def real(*command):
    """Output of a command, run without the stand-ins."""
    path = os.environ["PATH"].split(":")
    environment = {**os.environ, "PATH": ":".join(p for p in path if p != os.path.dirname(sys.argv[0]))}
    return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60, check=False)


def check_roslaunch(arguments):
    """The launch file exists, has every argument named, has all that it needs, and files named exist."""
    positional = [word for word in arguments if ":=" not in word and not word.startswith("-")]
    if "--ros-args" in arguments:
        result = real("roslaunch", *arguments)
        if result.returncode != 0:
            fail(result.stdout + result.stderr)
        return
    known = re.findall(r"^\s*([A-Za-z_]\w*)(?: \(default.*)?:", real("roslaunch", "--ros-args", *positional).stdout, re.MULTILINE)
    for word in arguments:
        name, assigned, value = word.partition(":=")
        if assigned and name not in known:
            fail(f"{' '.join(positional)} has no argument '{name}'; it has {', '.join(known)}")
        if assigned and name in FILE_ARGUMENTS and not os.path.exists(value):
            fail(f"{name}:={value}: there is no such file")
    result = real("roslaunch", "--nodes", *arguments)
    if result.returncode != 0:
        fail(result.stdout + result.stderr)


def check_rosrun(arguments):
    """The program exists. If it is ours, its help names every option; others may need a display, or have no help."""
    found = real("rosrun", "--prefix", "true", *arguments[:2])
    if found.returncode != 0:
        fail(found.stdout + found.stderr)
    if not arguments[0].startswith("softbody_"):
        return
    result = real("rosrun", *arguments[:2], "--help")
    text = result.stdout + result.stderr
    if "Usage:" not in text:
        fail(f"{' '.join(arguments[:2])} --help: {text}")
    for word in arguments[2:]:
        if word.startswith("--") and not re.search(rf"(^|[\s,]){re.escape(word)}\b", text):
            fail(f"{arguments[1]} --help names no option {word}")


def check_make(arguments):
    targets = [word for word in arguments if "=" not in word]
    result = real("make", "--dry-run", *targets)
    if result.returncode != 0:
        fail(result.stdout + result.stderr)


CHECKS = {"roslaunch": check_roslaunch, "rosrun": check_rosrun, "make": check_make}

if __name__ == "__main__":
    CHECKS.get(os.path.basename(sys.argv[0]), lambda arguments: None)(sys.argv[1:])
