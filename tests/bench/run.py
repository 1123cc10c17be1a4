"""make bench: every comparison with peers, one after the other; one table, and results/bench/*.csv.

    python3 tests/bench/run.py BIN OUT [RUNS]

BIN: folder of the executables; OUT: where modes.csv, identification.csv, wind.csv, reliability.csv and all of them as bench.csv go; RUNS: how many runs
a median is of (5). Peers do the same work in the same run of this script; seconds are processor time unless the row says otherwise.
"""
import pathlib
import sys

import modes
import reliability
import identification
import table
import wind_field


def main():
    binaries, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    runs = int(sys.argv[3]) if len(sys.argv) > 3 else 5
    out.mkdir(parents=True, exist_ok=True)
    everything = []
    for name, part in (("modes", modes), ("identification", identification), ("wind", wind_field), ("reliability", reliability)):
        print(f"bench: {name} …", file=sys.stderr, flush=True)
        rows = part.rows(binaries, runs)
        table.write(rows, out / f"{name}.csv")
        everything += rows
    table.write(everything, out / "bench.csv")
    print("Medians of", runs, "runs. ratio = peer over ours unless the row says otherwise; aims are ratios or bounds of the same row.")
    table.show(everything)


if __name__ == "__main__":
    main()
