#!/usr/bin/python3
"""Checks that docs/pipeline/rules.md lists every chosen constant of the tracker's core, and nothing else.

Usage: rules.py [ROOT]
Prints one line per fault; exit code 1 if there is any. A constant is chosen if its value has a number and does not follow
from another constant. Tools and printed markers are not part of the page.
"""
import pathlib
import re
import sys

CORE = "src/softbody_tracking/src/core"
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


def chosen(root):
    """{(file below core, name)}."""
    core, names = root / CORE, set()
    for path in sorted([*core.rglob("*.h"), *core.rglob("*.cpp")]):
        file = path.relative_to(core)
        if file.parts[0] in NOT_ON_PAGE:
            continue
        code = re.sub(r"//[^\n]*", "", path.read_text())
        for declaration in DECLARATION.finditer(code):
            names |= {(str(file), name) for name, value in declared(declaration[1])
                      if re.search(r"\d", value) and not FOLLOWS.search(value)}
    return names


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    page = root / "docs/pipeline/rules.md"
    listed = {(file, name) for file, names in ROW.findall(page.read_text()) for name in re.findall(r"k\w+", names)}
    present = chosen(root)
    faults = [f"{file}: {name} is missing in {page}" for file, name in sorted(present - listed)]
    faults += [f"{page}: {file} has no chosen constant {name}" for file, name in sorted(listed - present)]
    print("\n".join(faults), end="\n" if faults else "")
    return 1 if faults or not present else 0


if __name__ == "__main__":
    sys.exit(main())
