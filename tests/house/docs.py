#!/usr/bin/python3
"""Holds the documents against the tree: links resolve, no machine's own paths, the README names every command."""

import argparse
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
LINK = re.compile(r"!?\[[^\]]*\]\(([^)#\s]+)(#[^)]*)?\)")
MACHINE_PATH = re.compile(r"(?<![\w/.])/(home|root|work|Users)/\w+")


def documents():
    folders = [ROOT / "docs", ROOT / "projects", ROOT / "tests"]
    found = [ROOT / "README.md", ROOT / "CHANGELOG.md"]
    for folder in folders:
        found += sorted(folder.rglob("*.md"))
    return [path for path in found if path.exists()]


def check_document(path):
    breaks, text = [], path.read_text()
    name = path.relative_to(ROOT)
    for match in LINK.finditer(text):
        target = match.group(1)
        if re.match(r"[a-z]+:", target):
            continue
        if not (path.parent / target).exists():
            breaks.append(f"{name}: links to {target}, which does not exist")
    for match in MACHINE_PATH.finditer(text):
        breaks.append(f"{name}: names a path of one machine, {match.group(0)}")
    return breaks


def check_commands(program):
    """Every command of `focalstage --help` stands in the README's list, and the other way round."""
    shown = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
    commands = set(re.findall(r"^  ([a-z][a-z-]+) {2,}\S", shown.split("Commands:")[1], re.MULTILINE))
    readme = (ROOT / "README.md").read_text()
    listed = set(re.findall(r"^    focalstage ([a-z][a-z-]+)", readme, re.MULTILINE))
    breaks = [f"README.md: the command list lacks {name}" for name in sorted(commands - listed)]
    breaks += [f"README.md: lists {name}, which focalstage --help does not" for name in sorted(listed - commands)]
    if not commands:
        breaks.append("focalstage --help: no commands found")
    return breaks


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", help="the focalstage executable, to hold the README's list against")
    program = parser.parse_args().program
    found = documents()
    breaks = [line for path in found for line in check_document(path)]
    if program:
        breaks += check_commands(program)
    for line in breaks:
        print(line)
    print(f"docs: {len(found)} documents, {len(breaks)} breaks")
    return 1 if breaks else 0


if __name__ == "__main__":
    sys.exit(main())
