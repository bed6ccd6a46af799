#!/usr/bin/python3
"""Checks that every error and warning of the C++ and Python sources says what, where and what to do.

Prints one line per fault and the number of messages; exit code 1 if there is any. A message names a thing: it has a
value, a name or a noun. It has a verb: what holds, or what to do. What a node logs also says what is allowed, what to
do, or what the node does now. Shorter texts than three words are parts of other messages. Each row of "Other messages"
in docs/troubleshooting.md quotes one of them.
"""
import ast
import re
import sys

from files import ROOT, is_python

VARIES = "..."
# What leads to a message: an exception, a log, a helper that throws or warns, a reason in a status or an answer.
SAYS = re.compile(r"\bthrow\s+(?!CLI::)[\w:]+\s*[({]"
                  r"|\b(?P<log>(?:ROS|NODELET)_(?:WARN|ERROR|FATAL))\w*\s*\("
                  r"|\b(?:fail|failAt|refuse|logDropped|tell)\("
                  r"|\bwarnings?(?:->|\.)(?:push_back|emplace_back)\("
                  r"|\b(?:\w*reason_?|message|error)\s*=(?!=)")
PYTHON_LOGS = re.compile(r"log(?:warn|err|fatal)")
TOKEN = re.compile(r'"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)\'|//[^\n]*|[A-Za-z_]\w*|\s+|.', re.DOTALL)
WRAPS = {"std", "string", "fmt", "format", "runtime_error", "invalid_argument", "to_string"}
NAMES = re.compile(r"\.\.\.|[/_<'\"]|--\w|[A-Z]{2}|\b(?:the|an?|its?|no|this|there|nothing)\b", re.IGNORECASE)
HOLDS = re.compile(
    r"\b(?:is|are|was|were|has|have|had|can|cannot|could|would|may|does|do|did|must|no|not|only|without|agrees?|"
    r"announces|belongs|bounds?|came|comes?|contains|crosses|cross|differs?|ended|ends?|exists|fills?|fits?|gives?|"
    r"goes|holds?|intersects|knows?|leaves?|lies?|meets|misses|names?|needs?|overlap|passes|reach(?:es)?|refers|shows?|"
    r"stays?|touch(?:es)?|tracked|twice)\b|\s\.\.\.$")
TO_DO = re.compile(
    r"\b(?:allowed|must|needs?|expected|instead|only|known|supported|limit|up to|ignored|used|stays?|goes on|dropped|"
    r"taken|left out|made|starts?|placed|sent|follows?|waiting|until|searched for|held|add|ask|begin|call|check|choose|"
    r"compare|convert|correct|enlarge|find|give|install|join|keep|let|load|make|measure|move|name|print|publish|put|"
    r"read|record|release|remove|repair|run|save|see|send|set|source|start|stop|take|turn|use|wait|write|rostopic|"
    r"rosbag)\b|: \.\.\.|\?$")


def cpp_text(source, begin):
    """The message in an expression, from behind its opening bracket or `=`. What varies becomes three dots."""
    parts, depth = [], 0
    for token in (found[0] for found in TOKEN.finditer(source, begin)):
        depth += (token in "({[") - (token in ")}]")
        if depth < 0 or (depth == 0 and token == ";"):
            break
        if token[0] == '"':
            parts.append(re.sub(r"\{[^{}]*\}|%[-\d.]*[a-z]", VARIES, token[1:-1]))
        elif token == "," and depth == 0:
            parts.append(" ")
        elif re.match(r"[A-Za-z_]", token) and token not in WRAPS and parts[-1:] != [VARIES]:
            parts.append(VARIES)
    return "".join(parts)


def cpp_messages(source):
    """(line, text, whether a node logs it)."""
    for match in SAYS.finditer(source):
        yield source.count("\n", 0, match.start()) + 1, cpp_text(source, match.end()), bool(match["log"])


def python_text(node):
    if isinstance(node, ast.Constant):
        return str(node.value)
    if isinstance(node, ast.JoinedStr):
        return "".join(map(python_text, node.values))
    if isinstance(node, ast.BinOp):
        return python_text(node.left) + python_text(node.right)
    return VARIES


def python_messages(source):
    """(line, text, whether a node logs it)."""
    for node in ast.walk(ast.parse(source)):
        call = node.exc if isinstance(node, ast.Raise) else node
        if not isinstance(call, ast.Call) or not call.args:
            continue
        name = ast.unparse(call.func)
        is_log = bool(PYTHON_LOGS.search(name))
        is_print = name == "print" and ": " in python_text(call.args[0]) and "sys.stderr" in ast.unparse(call)
        if is_log or is_print or isinstance(node, ast.Raise) or name in ("sys.exit", "parser.error", "fail"):
            yield call.lineno, " ".join(map(python_text, call.args)), is_log


def faults_of(text, is_log):
    if not NAMES.search(text):
        yield "names nothing"
    if not HOLDS.search(text) and not TO_DO.search(text):
        yield "does not say what holds"
    if is_log and not TO_DO.search(text):
        yield "does not say what is allowed, what to do, or what the node does now"


def messages():
    """(file, line, text, whether a node logs it)."""
    for path in sorted([*(ROOT / "src").rglob("*"), *(ROOT / "scripts").rglob("*")]):
        if {"test", "bench", "examples"} & set(path.parts):
            continue
        find = cpp_messages if path.suffix in (".cpp", ".h") else python_messages if is_python(path) else None
        if find:
            yield from ((path, *message) for message in find(path.read_text(encoding="utf-8")))


def stale_rows(page, texts):
    """A fault for each quotation of which no message has all parts, or if there is no quotation."""
    rows = page.partition("\n## Other messages\n")[2]
    for quoted in re.findall(r"^\| `(.*?)` \|", rows, re.MULTILINE) or ["(a row of Other messages)"]:
        if not any(all(part.strip() in text for part in quoted.split(VARIES)) for text in texts):
            yield f"docs/troubleshooting.md: no message says '{quoted}'"


def main():
    found = [message for message in messages() if len(re.findall(r"[A-Za-z_]{2,}", message[2])) > 2]
    faults = [f"{path.relative_to(ROOT)}:{line}: {fault}: {' '.join(text.split())}"
              for path, line, text, is_log in found for fault in faults_of(text, is_log)]
    faults += stale_rows((ROOT / "docs/troubleshooting.md").read_text(encoding="utf-8"), [row[2] for row in found])
    print("\n".join([*faults, f"{len(found)} messages"]))
    return 1 if faults or not found else 0


sys.exit(main())
