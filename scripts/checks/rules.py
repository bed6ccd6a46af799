#!/usr/bin/python3
"""Checks that docs/pipeline/rules.md lists every chosen constant of the tracker's core, and nothing else, and that each
has a comment that says why it has this value: on its lines or above.

Prints one line per fault; exit code 1 if there is any. A constant is chosen if its value has a number and does not follow
from another constant. Tools and printed markers are not part of the page.
"""
import re
import sys

from files import ROOT

CORE, PUBLIC = ROOT / "src/softbody_tracking/src/core", ROOT / "src/softbody_tracking/include"
PAGE = ROOT / "docs/pipeline/rules.md"
NOT_ON_PAGE = {"tool", "blade", "marker_board"}
DECLARATION = re.compile(r"\bconstexpr\s+[\w:<>, ]*?\b(k[A-Z]\w*[^;]*);", re.DOTALL)
NAME = re.compile(r"\s*(k[A-Z]\w*)\s*(?:\[[^\]]*\])?(.*)", re.DOTALL)
FOLLOWS = re.compile(r"\bk[A-Z]")
ROW = re.compile(r"^\| `([\w/.]+)` \| ((?:`k\w+`(?:, )?)+) \|", re.MULTILINE)


def declared(text):
    """(name, value) of each constant in a declaration with commas between them."""
    depth, part = 0, ""
    for character in text + ",":
        depth += {"(": 1, "{": 1, "[": 1, "<": 1, ")": -1, "}": -1, "]": -1, ">": -1}.get(character, 0)
        if character == "," and depth == 0:
            found = NAME.match(part)
            if found:
                yield found[1], found[2]
            part = ""
        else:
            part += character


def declarations(folder):
    """(file, its text, a declaration, names of the chosen constants in it)."""
    for path in sorted([*folder.rglob("*.h"), *folder.rglob("*.cpp")]):
        text = path.read_text()
        # Comments become blanks, so that places stay.
        code = re.sub(r"//[^\n]*", lambda comment: " " * len(comment[0]), text)
        for declaration in DECLARATION.finditer(code):
            names = {name for name, value in declared(declaration[1])
                     if re.search(r"\d", value) and not FOLLOWS.search(value)}
            if names:
                yield path.relative_to(folder), text, declaration, names


def without_reason():
    for folder in (CORE, PUBLIC):
        for file, text, declaration, names in declarations(folder):
            begin, end = text.rindex("\n", 0, declaration.start()), text.index("\n", declaration.end())
            above = text[:begin].rsplit("\n", 1)[-1].strip()
            if "//" not in text[begin:end] and not above.startswith("//"):
                yield f"{folder}/{file}: a constant without a reason: {', '.join(sorted(names))}"


def main():
    listed = {(file, name) for file, names in ROW.findall(PAGE.read_text()) for name in re.findall(r"k\w+", names)}
    present = {(str(file), name) for file, _, _, names in declarations(CORE) for name in names
               if file.parts[0] not in NOT_ON_PAGE}
    sys.exit("\n".join([*(f"{file}: {name} is missing in {PAGE}" for file, name in sorted(present - listed)),
                        *(f"{PAGE}: {file} has no chosen constant {name}" for file, name in sorted(listed - present)),
                        *without_reason()]) or int(not present))


main()
