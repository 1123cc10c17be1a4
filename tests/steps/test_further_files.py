"""49 further files as loggers and programs write them: time, tables, matrices, universal files. What `s3_identification --inspect` says of each.

Oracle: every file holds the same 6,000 samples of three channels at 50 Hz, of which the means are 11.5, 23 and 34.5 and the true rate is known; a file
that cannot be read so is refused, with the words that say what it is.
"""
import datetime
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
N, RATE = 6000, 50.0
MEANS = ("11.5", "23", "34.5")


def samples():
    t = np.arange(N) / RATE
    data = np.column_stack([np.sin(2 * np.pi * f * t + f) + 0.01 * np.random.default_rng(3).standard_normal(N) for f in (1.3, 2.9, 4.1)])
    return data - data.mean(axis=0) + [11.5, 23.0, 34.5]


DATA = samples()
T = np.arange(N) / RATE
START = datetime.datetime(2024, 5, 17, 10, 0, 0)


def table(stamps, separator=",", decimal=".", header="time_s,A,B,C", cell=lambda text: text, end="\n", data=DATA, first=""):
    lines = [first + header.replace(",", separator)] if header else []
    for stamp, row in zip(stamps, data):
        cells = [stamp] + [f"{value:.9g}" for value in row]
        lines.append(separator.join(cell(c.replace(".", decimal) if decimal != "." else c) for c in cells))
    return end.join(lines) + end


def dates(form, seconds=T, start=START):
    return [(start + datetime.timedelta(seconds=float(s))).strftime(form) for s in seconds]


def universal(data=DATA, unit=1.0, titles=("A", "B", "C"), data_type=4, even=True):
    text = ""
    for c in range(3):
        text += "    -1\n    58\n" + "".join(f"{title:<80}\n" for title in (titles[c], "NONE", "17-May-24 10:00:00", "NONE", "NONE"))
        text += f"{1:5d}{0:10d}{0:5d}{0:10d} {'NONE':<10}{c + 1:10d}{3:4d} {'NONE':<10}{0:10d}{0:4d}\n"
        text += f"{data_type:10d}{N:10d}{int(even):10d}{0.0:13.5E}{unit / RATE if even else 0.0:13.5E}{0.0:13.5E}\n"
        text += f"{17:10d}{0:5d}{0:5d}{0:5d} {'Time':<20} {'s':<20}\n{12:10d}{0:5d}{0:5d}{0:5d} {'Acceleration':<20} {'m/s^2':<20}\n"
        text += 2 * f"{0:10d}{0:5d}{0:5d}{0:5d} {'NONE':<20} {'NONE':<20}\n"
        if even:
            text += "\n".join("".join(f"{v:20.12E}" for v in data[i:i + 4, c]) for i in range(0, N, 4)) + "\n"
        else:
            text += "\n".join(f"{t:13.5E}{v:20.12E}" + f"{t2:13.5E}{v2:20.12E}" for t, v, t2, v2 in zip(T[::2], data[::2, c], T[1::2], data[1::2, c])) + "\n"
        text += "    -1\n"
    return text


def jittered(seed=1):
    return T + 0.004 * np.random.default_rng(seed).random(N)


TEXTS = {  # name: (text, words beside the means)
    "seconds": (table([f"{t:.2f}" for t in T]), ["50 Hz"]),
    "milliseconds": (table([f"{1000 * t:.0f}" for t in T], header="t_ms,A,B,C"), ["50 Hz"]),
    "microseconds": (table([f"{1e6 * t:.0f}" for t in T], header="Time [us],A,B,C"), ["50 Hz"]),
    "nanoseconds since 1970": (table([f"{1.7e18 + 1e9 * t:.0f}" for t in T], header="timestamp,A,B,C"), ["50"]),
    "milliseconds since 1970": (table([f"{1.7e12 + 1e3 * t:.0f}" for t in T], header="epoch_ms,A,B,C"), ["50"]),
    "days of a spreadsheet": (table([f"{45429 + t / 86400:.10f}" for t in T], header="Time (days),A,B,C"), ["50"]),
    "iso dates": (table(dates("%Y-%m-%dT%H:%M:%S.%f"), header="time,A,B,C"), ["50 Hz"]),
    "iso dates with Z": (table([d + "Z" for d in dates("%Y-%m-%dT%H:%M:%S.%f")], header="time,A,B,C"), ["50 Hz"]),
    "german dates": (table(dates("%d.%m.%Y %H:%M:%S,%f"), separator=";", header="Zeit;A;B;C"), ["50 Hz"]),
    "american dates": (table(dates("%m/%d/%Y %H:%M:%S.%f"), header="Time,A,B,C"), ["50 Hz"]),
    "time of day over midnight": (table(dates("%H:%M:%S.%f", start=datetime.datetime(2024, 5, 17, 23, 59, 30)), header="time,A,B,C"), ["50 Hz"]),
    "late stamps": (table([f"{t:.3f}" for t in jittered()]), ["49.99997 Hz +- 2.5e-05 Hz"]),
    "packets of 25": (table([f"{T[25 * (i // 25)]:.2f}" for i in range(N)]), ["50"]),
    "whole seconds": (table([f"{int(t)}" for t in T], header="timestamp,A,B,C"), ["50"]),
    "one digit": (table([f"{t:.1f}" for t in T]), ["50"]),
    "decimal commas, semicolons": (table([f"{t:.2f}" for t in T], ";", ","), ["50 Hz", "decimal comma"]),
    "decimal commas, tabs": (table([f"{t:.2f}" for t in T], "\t", ","), ["50 Hz"]),
    "decimal commas, blanks": (table([f"{t:.2f}" for t in T], " ", ","), ["50 Hz"]),
    "quoted decimal commas": (table([f"{t:.2f}" for t in T], ",", ",", cell=lambda text: f'"{text}"'), ["50 Hz"]),
    "quoted cells": (table([f"{t:.2f}" for t in T], cell=lambda text: f'"{text}"'), ["50 Hz"]),
    "sep line of a spreadsheet": ("sep=;\n" + table([f"{t:.2f}" for t in T], ";"), ["50 Hz"]),
    "CR LF": (table([f"{t:.2f}" for t in T], end="\r\n"), ["50 Hz"]),
    "CR": (table([f"{t:.2f}" for t in T], end="\r"), ["50 Hz"]),
    "no end of the last line": (table([f"{t:.2f}" for t in T]).rstrip("\n"), ["50 Hz"]),
    "a separator at the end of each line": (table([f"{t:.2f}" for t in T], end=",\n"), ["50 Hz"]),
    "a header of twenty lines": ("".join(f"# key {i}: value\n" for i in range(20)) + table([f"{t:.2f}" for t in T]), ["50 Hz"]),
    "units below the names": ("time_s,A,B,C\ns,m/s2,m/s2,m/s2\n" + table([f"{t:.2f}" for t in T], header=""), ["50 Hz"]),
    "rate in the header": ("Sampling rate: 50 Hz\n" + table([""] * N, header="").replace("\n,", "\n").lstrip(","), ["50 Hz"]),
    "latin-1 degree sign": ("Temperatur 12 \xb0C\n" + table([f"{t:.2f}" for t in T]), ["50 Hz"]),
    "universal file": (universal(), ["50 Hz"]),
    "universal file, one title": (universal(titles=("run 7",) * 3), ["50 Hz", "1+z"]),
    "universal file, uneven abscissa": (universal(even=False), ["50"]),
}


class Further(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def inspected(self, file):
        return subprocess.run([BIN / "s3_identification", "--inspect", file], capture_output=True, text=True, timeout=60)

    def expect(self, file, words):
        done = self.inspected(file)
        self.assertEqual(done.returncode, 0, done.stderr)
        for word in ("6000 samples", *(f" {mean} " for mean in MEANS), *words):
            self.assertIn(word, done.stdout, done.stdout)

    def test_texts(self):
        self.assertGreaterEqual(len(TEXTS), 32)
        for name, (text, words) in TEXTS.items():
            with self.subTest(name):
                file = self.folder / "record.txt"
                file.write_bytes(text.encode("latin-1"))
                self.expect(file, words)

    def test_encodings(self):
        for encoding in ("utf-8-sig", "utf-16", "utf-16-le", "utf-16-be"):
            with self.subTest(encoding):
                file = self.folder / "record.csv"
                file.write_bytes(table([f"{t:.2f}" for t in T]).encode(encoding))
                self.expect(file, ["50 Hz"])

    def test_arrays(self):
        for name, array, words in (("rows", np.asfortranarray(DATA), []), ("channels along rows", DATA.T, ["channels run along the rows"]),
                                   ("single precision", DATA.astype("f4"), []), ("big endian", DATA.astype(">f8"), []),
                                   ("time in the first column", np.column_stack([T, DATA]), ["50 Hz"])):
            with self.subTest(name):
                file = self.folder / "record.npy"
                np.save(file, array)
                if name == "big endian":
                    done = self.inspected(file)
                    self.assertEqual(done.returncode, 2)
                    self.assertIn(">f8", done.stderr)
                    np.save(file, np.load(file).astype("<f8"))  # the remedy
                self.expect(file, words)

    def test_missing_values(self):
        for word in ("", "NaN", "---", "***", "#N/A", "OVER", "no data", "-"):
            with self.subTest(word):
                lines = table([f"{t:.2f}" for t in T]).splitlines()
                lines[1000] = lines[1000].rsplit(",", 1)[0] + "," + word
                (self.folder / "record.csv").write_text("\n".join(lines) + "\n")
                done = self.inspected(self.folder / "record.csv")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn("6000 samples", done.stdout)
                self.assertIn("50 Hz", done.stdout)


if __name__ == "__main__":
    unittest.main()
