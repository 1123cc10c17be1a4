"""What the benchmarks print and write: one row a comparison, the ratio first, never a pass or a fail."""
import csv
import os
import subprocess
import sys

COLUMNS = ["part", "quantity", "ours", "peer", "unit", "ratio", "aim", "beside"]


def row(part, quantity, ours, unit, peer=None, beside="", ratio=None, aim=""):
    """`ratio` is peer over ours (how many times quicker, smaller) where a peer is given and nothing else is said."""
    if ratio is None and peer is not None and ours:
        ratio = peer / ours
    return dict(zip(COLUMNS, [part, quantity, ours, peer, unit, ratio, aim, beside]))


def text(value):
    return "" if value is None else value if isinstance(value, str) else f"{value:.4g}"


def write(rows, file):
    with open(file, "w", newline="") as stream:
        writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows({name: text(value) for name, value in r.items()} for r in rows)


def show(rows):
    names = ["quantity", "ours", "peer", "unit", "ratio", "aim", "beside"]
    cells = [[text(r[name]) for name in names] for r in rows]
    widths = [max(len(line[i]) for line in [names, *cells]) for i in range(len(names))]
    part = None
    for r, line in zip(rows, cells):
        if r["part"] != part:
            part = r["part"]
            print(f"\n{part}")
            print("  " + "  ".join(n.ljust(w) if i in (0, 6) else n.rjust(w) for i, (n, w) in enumerate(zip(names, widths))).rstrip())
        print("  " + "  ".join(c.ljust(w) if i in (0, 6) else c.rjust(w) for i, (c, w) in enumerate(zip(line, widths))).rstrip())


ONE_THREAD = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")


def launched(*command):
    """The command as a child of a shell: Linux counts what the process that forks holds into the peak memory of what it starts, and a shell
    holds next to nothing."""
    return ["/bin/sh", "-c", '"$@"; exit $?', "sh", *map(str, command)]


# Runs a command as the only child of a process of its own, so that the children's peak memory and time are the command's.
CHILD = """
import resource, subprocess, sys, time
start = time.perf_counter()
done = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
if done.returncode:
    sys.exit(done.stderr)
print(time.perf_counter() - start, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024)
"""


def run_child(command, cwd=None, env=None):
    """@return wall seconds, processor seconds, peak memory [MB] of a command."""
    done = subprocess.run(launched(sys.executable, "-c", CHILD, *command), cwd=cwd, env=env or ONE_THREAD, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"bench: {command[0]} failed:\n{done.stderr}")
    return tuple(map(float, done.stdout.split()))


def measures(*command, environment=ONE_THREAD):
    """`name value` lines that a command prints."""
    done = subprocess.run(launched(*command), capture_output=True, text=True, env=environment)
    if done.returncode:
        raise SystemExit(f"bench: {command[0]} failed:\n{done.stderr}")
    return {name: float(value) for name, value in (line.split() for line in done.stdout.splitlines())}
