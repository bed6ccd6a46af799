#!/usr/bin/python3
"""Checks that docs/pipeline/rules.md lists every chosen constant of the tracker's core, and nothing else, and that each
has a comment that says why it has this value: on its lines or above.

Usage: rules.py [ROOT]
Prints one line per fault; exit code 1 if there is any. A constant is chosen if its value has a number and does not follow
from another constant. Tools and printed markers are not part of the page.
"""
import pathlib
import re
import sys

CORE, PUBLIC = "src/softbody_tracking/src/core", "src/softbody_tracking/include"
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


def chosen(root):
    """{(file below core, name)}."""
    return {(str(file), name) for file, _, _, names in declarations(root / CORE) for name in names
            if file.parts[0] not in NOT_ON_PAGE}


def without_reason(root):
    for folder in (CORE, PUBLIC):
        for file, text, declaration, names in declarations(root / folder):
            begin, end = text.rindex("\n", 0, declaration.start()), text.index("\n", declaration.end())
            above = text[:begin].rsplit("\n", 1)[-1].strip()
            if "//" not in text[begin:end] and not above.startswith("//"):
                yield f"{folder}/{file}: a constant without a reason: {', '.join(sorted(names))}"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    page = root / "docs/pipeline/rules.md"
    listed = {(file, name) for file, names in ROW.findall(page.read_text()) for name in re.findall(r"k\w+", names)}
    present = chosen(root)
    faults = [f"{file}: {name} is missing in {page}" for file, name in sorted(present - listed)]
    faults += [f"{page}: {file} has no chosen constant {name}" for file, name in sorted(listed - present)]
    faults += without_reason(root)
    print("\n".join(faults), end="\n" if faults else "")
    return 1 if faults or not present else 0


if __name__ == "__main__":
    sys.exit(main())
