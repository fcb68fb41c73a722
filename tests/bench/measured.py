"""What the scripts of tests/bench share: running the programs, their comma-separated lines, medians,
and what a table has to say about where its figures come from."""
import datetime
import os
import platform
import statistics
import subprocess
import sys

TOP = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
SETS = ["primary", "shadow", "bounce", "bounceany"]


def output(*command):
    """What a command prints; the script ends with the command's own message when it fails."""
    done = subprocess.run(command, cwd=TOP, stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{os.path.basename(command[0])} failed with exit code {done.returncode}")
    return done.stdout


def figures(text):
    """{(kind, what): [numbers]}: what is a set of rays, "build" or "picture"; numbers as they stand in
    the line of `bench` or peer_embree."""
    found = {}
    for line in text.splitlines():
        words = line.split(",")
        if words[0] in ("BUILD", "PICTURE"):
            kind, what, numbers = words[6], words[0].lower(), words[7:]
            numbers = numbers[1:] if what == "picture" else numbers
        else:
            kind, what, numbers = words[5], words[6], words[9:]
        found[kind, what] = [float(number) for number in numbers]
    return found


def hits(text):
    """{set: rays that hit}"""
    rows = (line.split(",") for line in text.splitlines())
    return {row[6]: int(row[8]) for row in rows if row[0] not in ("BUILD", "PICTURE")}


median = statistics.median


def cpuName():
    """The model as the system names it."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            for line in file:
                if line.startswith("model name"):
                    return " ".join(line.split(":", 1)[1].split())
    except OSError:
        pass
    return platform.processor() or platform.machine()


def commit():
    """The commit that is measured, with a + when files differ from it."""
    def git(*words):
        return subprocess.run(["git", *words], cwd=TOP, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                              text=True, check=False).stdout.strip()
    return (git("rev-parse", "--short=10", "HEAD") or "unknown") + ("+" if git("status", "--porcelain", "Code") else "")


def today():
    return datetime.date.today().isoformat()


def load():
    """Programs that ran or waited in the last minute, this one included."""
    return f"{os.getloadavg()[0]:.1f}"


def appendRows(name, columns, rows):
    """To a table of tests/bench, with its heading when the file is new."""
    path = os.path.join(TOP, "tests", "bench", name)
    fresh = not os.path.exists(path)
    with open(path, "a", encoding="utf-8") as file:
        for row in ([columns] if fresh else []) + rows:
            file.write("\t".join(str(cell) for cell in row) + "\n")


def printTable(heading, rows):
    """Left column to the left, the others to the right."""
    table = [[str(cell) for cell in row] for row in [heading] + rows]
    widths = [max(len(row[i]) for row in table) for i in range(len(heading))]
    for row in table:
        print("  ".join(cell.ljust(w) if i == 0 else cell.rjust(w) for i, (cell, w) in enumerate(zip(row, widths))).rstrip(),
              flush=True)
