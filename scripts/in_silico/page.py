"""Writes tables and figures into docs/experiments.md, between its markers: the words are people's, the numbers are not."""

import re
import shutil


def markdown(table):
    lines = ["| " + " | ".join(table["head"]) + " |", "|" + "---|" * len(table["head"])]
    lines += ["| " + " | ".join(row) + " |" for row in table["rows"]]
    return "\n".join(lines)


def claims_table(claims):
    rows = [f"| {claim['text']} | {claim['found']} | {'yes' if claim['holds'] else '**no**'} |" for claim in claims]
    return "\n".join(["| claim | found | holds |", "|---|---|---|", *rows])


def write(lab, names, docs):
    """Each `<!-- begin NAME -->` .. `<!-- end NAME -->` takes its table; a table without markers, or markers without a
    table, is an error."""
    page = docs / "experiments.md"
    text = page.read_text()
    found = [lab.kept(name) for name in names]
    parts = {table["name"]: markdown(table) for one in found for table in one["tables"]}
    parts["claims"] = claims_table([claim for one in found for claim in one["claims"]])
    wanted = set(re.findall(r"<!-- begin ([\w-]+) -->", text))
    if wanted != set(parts):
        raise SystemExit(f"scripts/experiments: {page}: markers {sorted(wanted)}, tables {sorted(parts)}")
    for name, part in parts.items():
        marks = re.compile(rf"(<!-- begin {name} -->\n).*?(<!-- end {name} -->)", re.DOTALL)
        text = marks.sub(lambda mark: mark[1] + "\n" + part + "\n\n" + mark[2], text)
    page.write_text(text)
    (docs / "experiments").mkdir(exist_ok=True)
    for figure in (figure for one in found for figure in one["figures"]):
        shutil.copyfile(lab.folder / figure, docs / "experiments" / figure)
