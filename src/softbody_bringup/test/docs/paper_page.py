"""What docs/paper.md says line by line, read from its tables: links, commands and parameters."""
import os
import re

LINE = re.compile(r"^\|(.*)\|$", re.MULTILINE)
TABLE = re.compile(r"(?:^\|.*\n)+", re.MULTILINE)
LINK = re.compile(r"\]\(([^)\s]+)\)")
CODE = re.compile(r"`([^`]+)`")
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)
PARAMETER = re.compile(r"[a-z][a-z0-9_]*$")
PROGRAM = "paper_method"  # of softbody_evaluation
NODE = re.compile(r"^Parameters of `(\w+)`:\n\n(?:<!--.*-->\n\n)?((?:\|.*\n)+)", re.MULTILINE)


def cells_of(line):
    return [cell.strip() for cell in line.strip("|").split("|")]


def rows(page):
    """[(paper, here, what differs, shown by)] of the part before the measured one."""
    text = page.split("## Line by line")[1].split("## Measured")[0]
    found = [cells_of(line) for line in LINE.findall(text)]
    return [row for row in found if row[0] != "paper" and not row[0].startswith("---")]


def anchors(page):
    """The anchors of a page's headings, as GitHub makes them."""
    plain = [LINK.sub("]", heading).replace("[", "").replace("]", "") for heading in HEADING.findall(page)]
    return {re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-") for heading in plain}


def broken_links(path):
    """One sentence for each relative link of a page whose file or anchor is missing."""
    with open(path, encoding="utf-8") as file:
        page = file.read()
    faults = []
    for target in LINK.findall(page):
        if target.startswith(("http:", "https:")):
            continue
        name, _, anchor = target.partition("#")
        linked = os.path.normpath(os.path.join(os.path.dirname(path), name)) if name else path
        if not os.path.exists(linked):
            faults.append(f"{target}: there is no file {linked}")
        elif anchor:
            with open(linked, encoding="utf-8") as file:
                if anchor not in anchors(file.read()):
                    faults.append(f"{target}: {linked} has no heading with the anchor {anchor}")
    return faults


def documented_parameters(pages):
    """{parameter: (node, default)} from the tables of parameters."""
    found = {}
    for page in pages:
        for node, table in NODE.findall(page):
            for line in table.splitlines()[2:]:
                name, default, *_ = cells_of(line)
                found[name] = node, default
    return found


def table_under(heading, page):
    """{first cell: {column: cell}} of the first table under a heading."""
    lines = TABLE.search(page.split(f" {heading}\n")[1])[0].splitlines()
    columns = cells_of(lines[0])
    return {cells_of(line)[0]: dict(zip(columns, cells_of(line))) for line in lines[2:]}


def parameters(row):
    """[(name, value or None)] that a row names, in all cells but the last."""
    spans = [span.partition(":") for cell in row[:3] for span in CODE.findall(cell)]
    return [(name, value.strip() or None) for name, _, value in spans if PARAMETER.match(name) and name != PROGRAM]
