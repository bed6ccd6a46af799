#!/usr/bin/python3
"""Checks that functions are short: at most MOST_LINES, from the name to the last line.

Prints one line per fault; exit code 1 if there is any.
"""
import ast
import re
import sys

from files import ROOT, is_python

MOST_LINES = 40
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\'|^[ \t]*#(?:\\\n|[^\n])*',
                      re.DOTALL | re.MULTILINE)
SCOPE = re.compile(r"\b(?:namespace|extern)\b|^\s*(?:template\s*<.*>\s*)?(?:class|struct|union|enum)\b[^()]*$", re.DOTALL)


def cpp_functions(text):
    """(head, first line, last line) of each function that is defined outside of another one."""
    # Comments, literals and preprocessor lines become blanks; every line stays where it is.
    code = NOT_CODE.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)
    scopes, head, parentheses = [], 0, 0
    for at, character in enumerate(code):
        if character in "()":
            parentheses += 1 if character == "(" else -1
        elif character == "{":
            before = code[head:at]
            if SCOPE.search(before):
                scopes.append(("scope", head))
            elif "(" in before and all(kind == "scope" for kind, _ in scopes) and not re.search(r"=\s*$|[,:]\s*\w+\s*$", before):
                scopes.append(("function", head))
            else:
                scopes.append(("braces", head))
                continue
            head = at + 1
        elif character == "}" and scopes:
            kind, begin = scopes.pop()
            if kind == "function":
                begin += len(code[begin:at]) - len(code[begin:at].lstrip())
                yield (" ".join(code[begin:].split("{")[0].split()), code.count("\n", 0, begin) + 1, code.count("\n", 0, at) + 1)
            if kind != "braces":
                head = at + 1
        elif character == ";" and not parentheses and all(kind != "braces" for kind, _ in scopes):
            head = at + 1


def python_functions(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            yield node.name, node.lineno, node.end_lineno


def sources():
    for path in sorted([*(ROOT / "src").rglob("*"), *(ROOT / "scripts").rglob("*")]):
        if path.suffix in (".h", ".cpp"):
            yield path, cpp_functions
        elif is_python(path):
            yield path, python_functions


def length_faults():
    found = 0
    for path, functions in sources():
        for name, first, last in functions(path.read_text()):
            found += functions is cpp_functions
            if last - first + 1 > MOST_LINES:
                yield f"{path.relative_to(ROOT)}:{first}: {last - first + 1} lines, more than {MOST_LINES}: {name[:60]}"
    if not found:
        yield f"{ROOT}/src: no C++ function found"


sys.exit("\n".join(length_faults()) or 0)
