"""make growth: processor seconds and peak memory as models and records grow, beside peers, with exponents fitted to them.

    python3 tests/bench/growth.py BIN OUT [modes=SIZES] [records=SAMPLES] [channels=CHANNELS[:SAMPLES]] [places=PLACES] [steps=RUNS]

BIN: folder of the executables; OUT: where modes.csv, records.csv, places.csv, exponents.csv and a figure of each go. Without names everything runs with the
sizes below. A number of channels without samples has a million; places are those of `make bench-places`. A run of the modes that would take more than LIMIT_S of processor time or LIMIT_GB is ended, and its row says so; larger sizes of that program are not
tried. Everything runs on one thread. Rows of earlier runs stay unless they are measured again. IDENTIFICATION=FILE in the environment measures another
executable of step 3, for a comparison.
"""
import csv
import math
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import threading

import peers
import table

ROOT = pathlib.Path(__file__).resolve().parents[2]
SIZES = {"modes": "deck:3e4,1e5,3e5,1e6;building:3e4,1e5", "records": "1e5,1e6,1e7", "channels": "64,256", "places": "100,200,400", "steps": "200"}
LIMIT_S, LIMIT_GB = 1500, 12
REFERENCES = 16  # channels that every channel is correlated with: of a record with more, the first sixteen
TRUE_HZ = (0.72, 0.98, 1.05, 1.32, 1.68, 2.31, 2.36, 2.95, 3.40, 4.00, 4.70, 5.50, 6.40, 7.40)  # identification_record.hpp
RATE_HZ = 20.0
MODES_COLUMNS = ["family", "degrees_of_freedom", "program", "cpu_s", "peak_MB", "assemble_s", "apart", "note"]
RECORDS_COLUMNS = ["channels", "samples", "program", "cpu_s", "peak_MB", "held_MB", "record_MB", "modes_found", "others_found"]


def limits():
    resource.setrlimit(resource.RLIMIT_CPU, (LIMIT_S, LIMIT_S))
    resource.setrlimit(resource.RLIMIT_AS, (LIMIT_GB << 30, LIMIT_GB << 30))


def measured(*command, environment=table.ONE_THREAD):
    """({name: value} that a command prints, "" or why there is none)"""
    done = subprocess.run(table.launched(*command), capture_output=True, text=True, env=environment, preexec_fn=limits)
    if done.returncode == 0:
        return {name: float(value) for name, value in (line.split() for line in done.stdout.splitlines())}, ""
    if done.returncode in (137, 152, -9, -24):
        return {}, f"ended after {LIMIT_S} s"
    if "emory" in done.stderr or "bad_alloc" in done.stderr:
        return {}, f"wanted more than {LIMIT_GB} GB"
    return {}, (done.stderr.strip().splitlines() or [f"exit {done.returncode}"])[-1][:90]


def keep(out, name, columns, rows, key):
    """Writes rows over those of earlier runs with the same key."""
    file = out / f"{name}.csv"
    known = {}
    if file.is_file():
        with open(file, newline="") as stream:
            known = {tuple(row[c] for c in key): row for row in csv.DictReader(stream)}
    for row in rows:
        cells = {c: str(row[c]) if isinstance(row[c], int) else table.text(row[c]) for c in columns}
        known[tuple(cells[c] for c in key)] = cells
    with open(file, "w", newline="") as stream:
        writer = csv.DictWriter(stream, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(sorted(known.values(), key=lambda row: tuple(number(row[c]) for c in key)))


def number(text):
    try:
        return (0, float(text), "")
    except ValueError:
        return (1, 0.0, text)


def modes(binaries, out, sizes):
    programs = {"twindeck": [binaries / "bench_growth", "modes"]}
    programs |= {name: [sys.executable, "-c", script] for name, script in peers.modes(peers.FROM_NPY).items()}
    for family, asked in (part.split(":") for part in sizes.split(";")):
        beyond = set()
        for dofs in asked.split(","):
            with tempfile.TemporaryDirectory(dir=out) as folder:
                model, why = measured(binaries / "bench_growth", "model", family, dofs, folder)
                if why:
                    raise SystemExit(f"growth: {family} with {dofs} degrees of freedom: {why}")
                ours = None
                for program, command in programs.items():
                    if program in beyond:
                        continue
                    found, why = measured(*command, folder, environment=peers.environment())
                    if why:
                        beyond.add(program)
                    hertz = [found.get(f"frequency_{i}_Hz", math.nan) for i in range(1, 16)]
                    ours = ours or hertz
                    row = {"family": family, "degrees_of_freedom": int(model["degrees_of_freedom"]), "program": program, "cpu_s": found.get("modes_s"),
                           "peak_MB": found.get("peak_MB"), "assemble_s": model["assemble_s"] if program == "twindeck" else None,
                           "apart": max(abs(a / b - 1) for a, b in zip(hertz, ours)) if found else None, "note": why}
                    print("growth:", {k: v for k, v in row.items() if v not in (None, "")}, flush=True)
                    keep(out, "modes", MODES_COLUMNS, [row], ("family", "degrees_of_freedom", "program"))


def campaign(folder, channels, samples, binaries):
    """A campaign with one record of the bench structure. @return size of the record [MB]"""
    names = [f"A{c + 1:03d}" for c in range(channels)]
    with open(folder / "channels.csv", "w", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow("channel,point,x_m,y_m,z_m,dx,dy,dz,quantity,unit,gain,reference,role".split(","))
        for c, name in enumerate(names):
            writer.writerow([name, f"P{c + 1}", c, 0, 0, 0, 0, 1, "acceleration", "m/s^2", 1, int(c < REFERENCES), "response"])
    quoted = ", ".join(f'"{name}"' for name in names)
    (folder / "campaign.toml").write_text(f'[[record]]\nsetup = "ST1"\nkind = "ambient"\nfile = "record.npy"\nsampling_rate_Hz = {RATE_HZ}\nchannels = [{quoted}]\n')
    subprocess.run([binaries / "bench_growth", "record", folder / "record.npy", str(channels), str(samples)], check=True)
    return (folder / "record.npy").stat().st_size / 1e6


def identified(out):
    """(true modes found, others) of a step's modes.csv"""
    with open(out / "modes.csv", newline="") as stream:
        found = [float(row["frequency_Hz"]) for row in csv.DictReader(stream)]
    true = sum(any(abs(f / t - 1) < 0.005 for f in found) for t in TRUE_HZ)
    return true, len(found) - true


def watched(command, environment):
    """@return processor seconds, peak memory [MB], and the part of it that no file holds [MB]: of the rest the system takes back what others need."""
    with tempfile.NamedTemporaryFile("r") as told:
        held, ended = [0.0], threading.Event()

        def watch():
            while not ended.wait(0.1):
                told.seek(0)
                try:
                    status = pathlib.Path(f"/proc/{told.read().strip()}/status").read_text()
                    held.append(float(re.search(r"RssAnon:\s*(\d+)", status)[1]) / 1024)
                except (OSError, TypeError):
                    continue

        watcher = threading.Thread(target=watch)
        watcher.start()
        try:
            _, cpu, memory = table.run_child(["/bin/sh", "-c", 'echo $$ >"$0"; exec "$@"', told.name, *command], env=environment)
        finally:
            ended.set()
            watcher.join()
    return cpu, memory, max(held)


def records(binaries, out, cases):
    program = pathlib.Path(os.environ.get("IDENTIFICATION", binaries / "s3_identification"))
    for channels, samples in cases:
        with tempfile.TemporaryDirectory(dir=out) as name:
            folder = pathlib.Path(name)
            size = campaign(folder, channels, samples, binaries)
            # Files that hold what memory should not hold lie beside the record.
            cpu, memory, held = watched([program, "--campaign", folder, "--out", folder / "out", "--quiet", "--threads", "1"], dict(table.ONE_THREAD, TMPDIR=str(folder)))
            true, others = identified(folder / "out")
            row = {"channels": channels, "samples": samples, "program": program.name, "cpu_s": cpu, "peak_MB": memory, "held_MB": held, "record_MB": size,
                   "modes_found": true, "others_found": others}
            print("growth:", row, flush=True)
            keep(out, "records", RECORDS_COLUMNS, [row], ("channels", "samples", "program"))


def small_runs(binaries, out, count):
    """What a run costs beside its computation: many short runs of a step, one after the other."""
    with tempfile.TemporaryDirectory(dir=out) as name:
        template = ROOT / "data" / "template"
        script = 'i=0; while [ $i -lt "$1" ]; do i=$((i + 1)); "$3" --model "$4" --features "$5" --quiet --threads 1 --seed $i --out "$2/$i" || exit 1; done'
        wall, cpu, memory = table.run_child(["/bin/sh", "-c", script, "sh", str(count), name, binaries / "s6_updating", template / "model", template / "features"])
    print(f"growth: {count} runs of s6_updating on the template: {cpu / count:.4f} s of processor time each, {memory:.0f} MB", flush=True)
    with open(out / "runs.csv", "w", newline="") as stream:
        csv.writer(stream, lineterminator="\n").writerows([["runs", "cpu_s_each", "peak_MB"], [count, table.text(cpu / count), table.text(memory)]])


def fitted(points):
    """Exponent of a power law through (size, value), least squares of the logarithms; nan of fewer than two sizes."""
    if len(points) < 2:
        return math.nan
    x, y = ([math.log(p[i]) for p in points] for i in (0, 1))
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    spread = sum((a - mean_x) ** 2 for a in x)
    return sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / spread if spread else math.nan


def series(file, group, size, quantities):
    """{(group values): {quantity: [(size, value)]}}"""
    found = {}
    if file.is_file():
        with open(file, newline="") as stream:
            for row in csv.DictReader(stream):
                for quantity in quantities:
                    if row[quantity]:
                        found.setdefault(tuple(f"{row[g]} channels" if g == "channels" else row[g] for g in group), {}).setdefault(quantity, []).append((float(row[size]), float(row[quantity])))
    return found


# Table, columns that tell rows of different lines apart, column of the size, quantities with their axes.
COST = {"cpu_s": "processor time of one thread [s]", "peak_MB": "peak memory [MB]"}
TABLES = [("modes", ("family", "program"), "degrees_of_freedom", COST), ("records", ("channels", "program"), "samples", COST),
          ("places", (), "places", {"form_off_s": "processor time, exact model [s]", "form_on_s": "processor time, form error [s]",
                                    "form_off_MB": "peak memory, exact model [MB]", "form_on_MB": "peak memory, form error [MB]"})]


def draw(file, found, size, axes_of):
    """One figure of a table; @return its rows of exponents: group, quantity, number of sizes, from, to, exponent"""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    lines = []
    figure, axes = pyplot.subplots(1, len(axes_of), figsize=(4.5 * len(axes_of), 4), layout="constrained")
    for axis, (quantity, label) in zip(axes, axes_of.items()):
        for who, quantities in found.items():
            points = sorted(quantities.get(quantity, []))
            exponent = fitted(points)
            known = not math.isnan(exponent)
            if known:
                lines.append([", ".join(who), quantity, len(points), f"{points[0][0]:.3g}", f"{points[-1][0]:.3g}", f"{exponent:.2f}"])
            axis.loglog([p[0] for p in points], [p[1] for p in points], marker="o", label=", ".join([*who, f"exponent {exponent:.2f}"] if known else who))
        axis.set_xlabel(size.replace("_", " "))
        axis.set_ylabel(label)
        axis.grid(True, which="major", alpha=0.4)
        if axis.lines:
            axis.legend(fontsize=7)
    figure.savefig(file, dpi=150)
    pyplot.close(figure)
    return lines


def summarise(out):
    """exponents.csv and one figure a table, from what the tables hold now."""
    lines = []
    for name, group, size, axes_of in TABLES:
        if found := series(out / f"{name}.csv", group, size, axes_of):
            lines += [[name, *line] for line in draw(out / f"{name}.png", found, size, axes_of)]
    with open(out / "exponents.csv", "w", newline="") as stream:
        csv.writer(stream, lineterminator="\n").writerows([["table", "group", "quantity", "sizes", "from", "to", "exponent"], *lines])
    for line in lines:
        print("growth:", *line)


def main():
    binaries, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    asked = dict(argument.split("=", 1) for argument in sys.argv[3:])
    if unknown := set(asked) - set(SIZES):
        raise SystemExit(f"growth: unknown {', '.join(sorted(unknown))}; known are {', '.join(SIZES)}")
    wanted = asked or SIZES
    out.mkdir(parents=True, exist_ok=True)
    if "modes" in wanted:
        modes(binaries, out, wanted["modes"])
    if "records" in wanted:
        records(binaries, out, [(16, int(float(n))) for n in wanted["records"].split(",")])
    if "channels" in wanted:
        records(binaries, out, [(int(c), int(float(n or 1e6))) for c, _, n in (part.partition(":") for part in wanted["channels"].split(","))])
    if "places" in wanted:
        subprocess.run([sys.executable, ROOT / "tests/bench/places.py", binaries, out, *wanted["places"].split(",")], env=table.ONE_THREAD, check=True)
    if "steps" in wanted:
        small_runs(binaries, out, int(wanted["steps"]))
    summarise(out)


if __name__ == "__main__":
    main()
