"""What the repository says for the report: README.md, FeatureList.txt, tables, and the benchmark's output."""
import os
import re
import subprocess
import sys

from page import Failure, TOP, read


def readme():
    """First paragraph and first block of code of README.md."""
    text = read("README.md")
    match = re.match(r"# (\S.*)\n\n((?:.+\n)+)\n```\n((?:.+\n)+?)```\n", text)
    if not match:
        raise Failure("README.md does not begin with a title, a paragraph and the commands")
    return match.group(1), " ".join(match.group(2).split()), match.group(3).rstrip("\n")


def features():
    """[(picture without extension, its path, [feature, ...])] in order, and the partial list."""
    listed, _, partial = read("FeatureList.txt").partition("\n#Partial\n")
    groups = {}
    for line in listed.splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        fields = [field.strip() for field in line.split("|")]
        if len(fields) != 4:
            raise Failure(f"FeatureList.txt: not four fields: {line}")
        stem = os.path.splitext(os.path.basename(fields[2]))[0]
        groups.setdefault(stem, []).append(fields[0])
    notes = []  # each begins with "# - " and goes on in the lines below
    for line in partial.splitlines():
        if line.startswith("# - "):
            notes.append(line[4:])
        elif line.startswith("#   ") and notes:
            notes[-1] += " " + line[4:]
    return [(stem, f"Output/{stem}.ppm", names) for stem, names in groups.items()], notes


def bench(saved, raytracer):
    """Rows of tests/bench/bench.sh: [[name, number, ...]]."""
    if saved:
        try:
            with open(saved, encoding="utf-8") as file:
                text = file.read()
        except OSError as error:
            raise Failure(f"can't read {saved}: {error.strerror}") from None
    else:
        print("running tests/bench/bench.sh, about a minute", file=sys.stderr)
        run = subprocess.run(["sh", "tests/bench/bench.sh", raytracer, "1"], cwd=TOP, text=True,
                             stdout=subprocess.PIPE, check=False)
        if run.returncode != 0:
            raise Failure(f"tests/bench/bench.sh failed with exit code {run.returncode}")
        text = run.stdout
    columns = ["what", "parse_s", "build_s", "render_s", "write_s", "rays_per_s", "peak_bytes"]
    lines = [line.split("\t") for line in text.splitlines() if "\t" in line]
    if len(lines) < 2 or lines[0] != columns:
        raise Failure("the output of tests/bench/bench.sh has other columns than expected")
    rows = []
    for line in lines[1:]:
        try:
            numbers = [float(field) for field in line[1:]]
        except ValueError:
            numbers = []
        if len(numbers) != len(columns) - 1:
            raise Failure(f"tests/bench/bench.sh gave no figures for {line[0]}; does the program run?")
        rows.append([line[0], *numbers])
    return rows


def tsv(path):
    """The rows of a table of the repository, as dictionaries."""
    lines = [line.split("\t") for line in read(path).splitlines()]
    return [dict(zip(lines[0], line)) for line in lines[1:]]


def newest(rows):
    """Those of the last commit that was measured."""
    return [row for row in rows if row["commit"] == rows[-1]["commit"]]
