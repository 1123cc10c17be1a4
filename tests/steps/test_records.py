"""s3_identification on records as loggers write them: which column is which channel, stray lines, units, what is refused and how.

Oracle: the results of the same samples from an NPY file with the columns in order, byte for byte; the words of each refusal
(docs/my_records.md); the command line contract (exit code 2, one line, nothing written).
"""
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import scipy.io

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from test_identification import CHANNELS, RATE, ROOT, STEP, chain, identify, write_campaign  # noqa: E402

SAMPLES = 12000
SETTINGS = ("block_rows=12", "maximum_order=16", "welch_segment=512")


class Records(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.data = np.round(chain(SAMPLES, 3), 6)
        write_campaign(cls.folder / "in_order", cls.data)
        done = identify(cls.folder / "in_order", cls.folder / "in_order_out", *SETTINGS)
        if done.returncode:
            raise AssertionError(done.stderr)

    def campaign(self, name, file="record.npy", record="", channels=""):
        """A campaign of that name without its record, with lines `record` added to [[record]]."""
        folder = self.folder / name
        write_campaign(folder, self.data[:10], channels)
        toml = (folder / "campaign.toml").read_text().replace("record.npy", file)
        (folder / "campaign.toml").write_text(toml + record)
        return folder

    def csv(self, folder, names, order, header=True, strays=()):
        """record.csv with the columns of `order` under `names`; a number of `order` beyond the channels is a column of zeros."""
        columns = np.column_stack([self.data, np.arange(SAMPLES) % 7])
        lines = [",".join(f"{v:.6f}" for v in row) for row in columns[:, order]]
        lines = [f"{t / RATE:.2f}," + line for t, line in enumerate(lines)]
        for at, text in strays:
            lines.insert(at, text)
        (folder / "records/ST1/record.csv").write_text((",".join(["time_s", *names]) + "\n" if header else "") + "\n".join(lines) + "\n")

    def run_step(self, name):
        return identify(self.folder / name, self.folder / f"{name}_out", *SETTINGS)

    def same_as_in_order(self, name, *said):
        done = self.run_step(name)
        self.assertEqual(done.returncode, 0, done.stderr)
        for file in ("modes.csv", "shapes.csv", "poles.csv", "psd.csv"):
            self.assertEqual((self.folder / f"{name}_out" / file).read_bytes(), (self.folder / "in_order_out" / file).read_bytes(), file)
        for words in said:
            self.assertIn(words, done.stderr)
        return done.stderr

    def refused(self, name, *said):
        done = self.run_step(name)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for words in said:
            self.assertIn(words, done.stderr)
        self.assertFalse((self.folder / f"{name}_out").exists())
        self.assertNotIn("\x1b", done.stderr)
        return done.stderr


class Columns(Records):
    def test_names_bind_whatever_their_order(self):
        self.csv(self.campaign("permuted", "record.csv"), ["c04", "spare", "c01", "c02", "c03"], [3, 4, 0, 1, 2])
        said = self.same_as_in_order("permuted")
        self.assertNotIn("columns", said)

    def test_some_names_but_not_all_are_refused(self):
        self.csv(self.campaign("some", "record.csv"), ["c04", "c01", "c2", "c03"], [3, 0, 1, 2])
        self.refused("some", "record.csv: c02: is no channel of the file", "did you mean 'c2'?", "the file has c04, c01, c2, c03")

    def test_no_name_is_taken_by_position_with_a_word_or_refused(self):
        self.csv(self.campaign("other", "record.csv"), ["Ch 1", "Ch 2", "Ch 3", "Ch 4"], [0, 1, 2, 3])
        self.same_as_in_order("other", "record.csv: names none of its channels (it has Ch 1, Ch 2, Ch 3, Ch 4)", "`columns`")
        self.csv(self.campaign("more", "record.csv"), ["Ch 1", "Ch 2", "Ch 3", "Ch 4", "Ch 5"], [0, 1, 2, 3, 4])
        self.refused("more", "has 5 columns, but campaign.toml names 4 channels", "`columns`")
        self.csv(self.campaign("bare", "record.csv"), [], [0, 1, 2, 3], header=False)
        self.same_as_in_order("bare", "it has no line of names")

    def test_the_key_maps_them(self):
        folder = self.campaign("mapped", "record.csv", 'columns = ["Ch 9", "column 4", "Ch 2", "Ch 3"]\n')
        self.csv(folder, ["Ch 3", "Ch 2", "Ch 1", "spare", "Ch 9"], [3, 2, 1, 4, 0])
        self.same_as_in_order("mapped")
        self.campaign("short_key", record='columns = ["Ch 9"]\n')
        self.refused("short_key", "campaign.toml:8: columns: has 1 entries for 4 channels")

    def test_mat_files_uncompressed_and_not(self):
        for name, options in (("mat_4", {"format": "4"}), ("mat_5", {}), ("mat_5_compressed", {"do_compression": True})):
            folder = self.campaign(name, "record.mat")
            scipy.io.savemat(folder / "records/ST1/record.mat", {"acc": self.data, "fs": RATE}, **options)
            self.same_as_in_order(name)


class StrayLines(Records):
    def test_are_refused_with_their_number(self):
        for name, at, text in (("text", 61, "*** \x1b[31mrestarted\x1b[0m ***"), ("ragged", 8000, "80.00,1,2"), ("header", 70, "time_s,c04,c01,c02,c03")):
            self.csv(self.campaign(name, "record.csv"), ["c04", "c01", "c02", "c03"], [3, 0, 1, 2], strays=[(at, text)])
            self.refused(name, f"record.csv:{at + 2}: '", "is no row of the table", "skip_stray_lines = true")

    def test_are_skipped_and_counted_by_the_key(self):
        folder = self.campaign("skipped", "record.csv", "skip_stray_lines = true\n")
        self.csv(folder, ["c04", "c01", "c02", "c03"], [3, 0, 1, 2], strays=[(61, "restarted"), (4000, "1,2")])
        self.same_as_in_order("skipped", "record.csv: 2 lines are no rows of the table and are left out, the first is line 63")

    def test_inspect_tells_of_them(self):
        folder = self.campaign("told", "record.csv")
        self.csv(folder, ["c04", "c01\x1b[2J", "c02", "c03"], [3, 0, 1, 2], strays=[(61, "restarted")])
        done = subprocess.run([STEP, "--inspect", folder / "records/ST1/record.csv"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("line 63 is no row of the table", done.stdout)
        self.assertNotIn("\x1b", done.stdout)


def row(**cells):
    """A row of channels.csv for c04, the others as write_campaign has them."""
    order = ("channel", "point", "x_m", "y_m", "z_m", "dx", "dy", "dz", "quantity", "unit", "gain", "reference", "role")
    usual = dict(zip(order, ("", "", 0, 0, 0, 0, 0, 1, "acceleration", "m/s^2", 1, "", "response")))
    return "".join(",".join(str((usual | {"channel": c, "point": f"P{i}", "x_m": i} | (cells if c == "c04" else {}))[k]) for k in order) + "\n"
                   for i, c in enumerate(CHANNELS, 1))


class Channels(Records):
    def test_what_cannot_be_is_refused_on_its_line(self):
        for name, cells, said in (
                ("no_direction", {"dz": 0}, "channels.csv:5: dx: dx, dy, dz are all 0"),
                ("half_direction", {"dx": ""}, "channels.csv:5: dx: 2 of the direction cosines dx, dy, dz are given"),
                ("long_direction", {"dx": 3}, "channels.csv:5: dx: direction cosines have length 3.162, expected 1"),
                ("reference", {"reference": 2}, "channels.csv:5: reference: is 2, expected 0 or 1"),
                ("furlong", {"unit": "furlong"}, "channels.csv:5: unit: is 'furlong', which is no unit of a record"),
                ("no_unit", {"unit": ""}, "channels.csv:5: unit: is empty, expected the unit of the recorded numbers"),
                ("g", {"unit": "g"}, "channels.csv:5: gain: is 1, but the unit is 'g': recorded numbers in it take 9.80665 to SI units"),
                ("si_with_gain", {"gain": 9.80665}, "channels.csv:5: gain: is 9.80665, but the unit is 'm/s^2'"),
                ("quantity", {"unit": "mm/s", "gain": 0.001}, "channels.csv:5: unit: is 'mm/s', a unit of velocity, but the channel's quantity is acceleration"),
                ("escape", {"unit": "\x1b[31mV\x1b[0m"}, "is '\\x1b[31mV\\x1b[0m'")):
            with self.subTest(name):
                np.save(self.campaign(name, channels=row(**cells)) / "records/ST1/record.npy", self.data)
                self.refused(name, said)

    def test_the_gain_converts(self):
        for name, cells, factor in (("gal", {"unit": "Gal", "gain": 0.01}, 100.0), ("turned", {"gain": -1}, -1.0)):
            data = self.data.copy()
            data[:, 3] *= factor
            np.save(self.campaign(name, channels=row(**cells)) / "records/ST1/record.npy", data)
            self.assertEqual(self.run_step(name).returncode, 0)
            found, expected = ([float(line.split(",")[1]) for line in (self.folder / out / "modes.csv").read_text().splitlines()[1:]]
                               for out in (f"{name}_out", "in_order_out"))
            np.testing.assert_allclose(found, expected, rtol=1e-9)

    def test_volts_and_counts_are_read_with_a_word(self):
        for name, unit in (("volts", "V"), ("counts", "counts")):
            np.save(self.campaign(name, channels=row(unit=unit)) / "records/ST1/record.npy", self.data)
            self.same_as_in_order(name, f"channels.csv: recorded with gain 1 and no unit of motion: c04 in {unit}. Frequencies and damping need no scale")

    def test_another_unit_in_the_file_is_refused_unless_a_key_says_which_is_right(self):
        self.csv(self.campaign("mg", "record.csv"), [f"{c} [mg]" for c in CHANNELS], [0, 1, 2, 3])
        said = self.refused("mg", "record.csv: c01: says that c01 is in mg, but channels.csv has the quantity acceleration, the unit m/s^2 and the gain 1")
        self.assertIn('unit_from = "channels.csv"', said)  # the remedy, followed:
        self.csv(self.campaign("mg_table", "record.csv", 'unit_from = "channels.csv"\n'), [f"{c} [mg]" for c in CHANNELS], [0, 1, 2, 3])
        self.same_as_in_order("mg_table", "channels.csv is taken, as unit_from says")
        self.csv(self.campaign("mg_file", "record.csv", 'unit_from = "file"\n'), [f"{c} [mg]" for c in CHANNELS], [0, 1, 2, 3])
        self.assertEqual(self.run_step("mg_file").returncode, 0)
        rms = [[float(q["rms"]) for q in csv.DictReader((self.folder / out / "features/quality.csv").read_text().splitlines())] for out in ("mg_file_out", "in_order_out")]
        np.testing.assert_allclose(rms[0], 9.80665e-3 * np.array(rms[1]), rtol=1e-9)


class Lies(Records):
    """Channels that cannot be what they say. Oracle: the result without that channel (exclude), byte for byte."""

    def test_such_a_channel_is_left_out_with_its_reason(self):
        stuck, copy, dead = self.data.copy(), self.data.copy(), self.data.copy()
        stuck[4000:4700, 2] = stuck[4000, 2]  # 5.8 %
        held = self.data.copy()
        held[4000:4200, 2] = held[4000, 2]  # 1.7 %, and no other run of one value
        copy[:, 2] = copy[:, 0]
        dead[:, 2] = 1e-13 * np.random.default_rng(2).standard_normal(SAMPLES)
        np.save(self.campaign("without") / "records/ST1/record.npy", self.data)
        expected = identify(self.folder / "without", self.folder / "without_out", *SETTINGS, 'exclude=["c03"]')
        self.assertEqual(expected.returncode, 0, expected.stderr)
        for name, data, reason in (("stuck", stuck, "is stuck: it holds"), ("held", held, "is stuck: it holds"), ("copy", copy, "is a copy of c01"), ("dead", dead, "does not move: its RMS is")):
            with self.subTest(name):
                np.save(self.campaign(name) / "records/ST1/record.npy", data)
                done = self.run_step(name)
                self.assertEqual(done.returncode, 0, done.stderr)
                out = self.folder / f"{name}_out"
                self.assertEqual((out / "modes.csv").read_bytes(), (self.folder / "without_out/modes.csv").read_bytes())
                warning, = [w for w in json.loads((out / "manifest.json").read_text())["warnings"] if "left out" in w]
                self.assertIn("setup ST1: channel c03 is left out: ", warning)
                self.assertIn(reason, warning)
                quality = {q["channel"]: q["left_out"] for q in csv.DictReader((out / "features/quality.csv").read_text().splitlines())}
                self.assertIn(reason, quality["c03"])
                self.assertEqual({quality[c] for c in CHANNELS if c != "c03"}, {""})

    def test_a_reference_is_refused(self):
        data = self.data.copy()
        data[4000:4700, 2] = data[4000, 2]
        channels = "".join(f"{c},P{i},{i},0,0,0,0,1,acceleration,m/s^2,1,{int(c == 'c03')},response\n" for i, c in enumerate(CHANNELS, 1))
        np.save(self.campaign("reference_stuck", channels=channels) / "records/ST1/record.npy", data)
        self.refused("reference_stuck", "record.npy: c03: is stuck: it holds", "leave the channel out")
        self.assertEqual(identify(self.folder / "reference_stuck", self.folder / "reference_out", *SETTINGS, 'exclude=["c03"]').returncode, 0)  # the remedy


class Refusals(Records):
    def test_a_pipe_is_refused_and_not_waited_for(self):
        folder = self.campaign("pipe", "pipe.csv")
        os.mkfifo(folder / "records/ST1/pipe.csv")
        self.refused("pipe", "pipe.csv: is a pipe, a socket or a device, expected a regular file")
        os.remove(self.campaign("table_pipe") / "channels.csv")
        os.mkfifo(self.folder / "table_pipe" / "channels.csv")
        self.refused("table_pipe", "channels.csv: is a pipe")

    def test_damaged_arrays_end_in_one_line(self):
        folder = self.campaign("cut_mat", "record.mat")
        file = folder / "records/ST1/record.mat"
        scipy.io.savemat(file, {"acc": self.data, "fs": RATE})
        file.write_bytes(file.read_bytes()[:200000])
        self.refused("cut_mat", "record.mat: breaks off in variable number 1: ")
        folder = self.campaign("cut_hdf5", "record.h5")
        (folder / "records/ST1/record.h5").write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(range(256)) * 40)
        said = self.refused("cut_hdf5", "record.h5: is no HDF5 file that can be opened")
        self.assertNotIn("HDF5-DIAG", said)
        folder = self.campaign("mat_73", "record.mat")
        (folder / "records/ST1/record.mat").write_bytes(b"MATLAB 7.3 MAT-file".ljust(512) + b"\x89HDF\r\n\x1a\n" + bytes(4000))
        self.refused("mat_73", "record.mat: is no HDF5 file that can be opened")

    def test_absurd_numbers_are_refused(self):
        data = self.data.copy()
        data[5000, 2] = 1e300
        np.save(self.campaign("absurd") / "records/ST1/record.npy", data)
        self.refused("absurd", "record.npy: c03: holds 1e+300 in sample 5001, which no sensor gives")
        self.campaign("header")
        header = "{'descr': '<f8', 'fortran_order': False, 'shape': (900000000000, 4), }".ljust(117) + "\n"
        (self.folder / "header/records/ST1/record.npy").write_bytes(b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header.encode() + bytes(320))
        self.refused("header", "record.npy: holds 320 bytes of data, expected 28800000000000 for 900000000000 x 4 values")

    def test_numbers_without_their_sign_are_refused(self):
        counts = np.round(self.data / np.abs(self.data).max() * 20000).astype(int)
        np.save(self.campaign("unsigned") / "records/ST1/record.npy", (counts & 0xFFFF).astype(float))
        self.refused("unsigned", "record.npy: c01: lies at both ends of its range from 0 to 65535 and never in between", "subtract the full range")


del Records  # a base, no test of its own

if __name__ == "__main__":
    unittest.main()
