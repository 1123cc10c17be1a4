"""`twindeck new NAME --from FILES`: reading what the step tells of a record, tables of sensors, nodes of a universal file, settings out of peaks; and a
whole study out of a logger's text file, where the executables are built.

Oracle: files as they are written here; closed forms of the settings (two periods of the lowest mode in a block, the highest mode below 0.4 of the rate).
"""
import contextlib
import csv
import io
import os
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest
import unittest.mock
import zipfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "paper"))

from twindeck_new import campaign, cli, inspection, model, places, sensors, settings, study  # noqa: E402
from twindeck_new.errors import InputError  # noqa: E402

BIN = Path(os.environ.get("TWINDECK_BIN", ROOT / "build/bin"))
INSPECTED = """format    text, separated by ';', decimal comma, latin-1, 3 header lines
channels  2, 30000 samples, 600 s
rate      50 Hz, from the time column
channel                  unit            samples   missing   longest  clipped         mean          rms
Acc A                    m/s²              30000         0         0        0  -0.00015969       1.1307
a name of more than twenty-four letters ?                 30000         0         0        0   0.00037108       5.4223  unit not given: m/s² or V, by the size
missing   positions and directions of the sensors (channels.csv)""".splitlines()
UNIVERSAL = """    -1
    15
         7         0         0        11  1.00000e+00  2.00000e+00  3.50000e+00
    -1
    -1
    58
title


date

    1         0    1         0 P1                 7  -3 NONE               0   0
    -1
"""


class Pieces(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")
        return self.folder / name

    def test_what_the_step_tells_of_a_record(self):
        record = inspection.read(Path("x.csv"), INSPECTED)
        self.assertEqual((record.rate_Hz, record.samples), (50.0, 30000))
        self.assertEqual(record.columns, ("Acc A", "a name of more than twenty-four letters"))
        self.assertEqual(record.units, ("m/s²", "?"))
        self.assertTrue(record.named)
        self.assertIsNone(inspection.read(Path("x.npy"), [line.replace("rate      50 Hz, from the time column", "rate      unknown") for line in INSPECTED]).rate_Hz)

    def test_frequency_response_functions_have_no_rate(self):
        lines = ["format    universal file, 0 time series, 2 frequency response functions, 2 nodes, 0 lines, 0 shapes", "channels  2, 801 lines",
                 "functions 2 frequency response functions, 2 points, 1 references, 801 lines, 5 to 45 Hz", INSPECTED[3],
                 "7-z                      m/s^2               801         0         0        0            0            0",
                 "9+x                      ?                   801         0         0        0            0            0  unit not given"]
        record = inspection.read(Path("x.unv"), lines)
        self.assertEqual((record.rate_Hz, record.samples, record.columns, record.responses), (None, 801, ("7-z", "9+x"), True))
        missing = []
        entry = campaign._entry("ST1", record, ["7-z", "9_x"], "as_tested", "a.unv", missing)
        self.assertEqual(missing, [])
        self.assertIn('kind = "frf"', entry)
        self.assertFalse(any(line.startswith("sampling_rate_Hz") for line in entry.splitlines()))
        found = sensors.of_universal_file(self.write("r.unv", UNIVERSAL.replace("         7         0", "         9         0", 1) + UNIVERSAL), ("7-z", "9+x"))
        self.assertEqual([found.rows[c]["point"] for c in ("7-z", "9+x")], ["N7", "N9"])
        self.assertEqual([found.rows["7-z"]["dz"], found.rows["9+x"]["dx"]], ["-1", "1"])

    def test_a_remark_behind_a_row_does_not_shift_its_columns(self):
        row = "Acc A                    m/s²               6000         0         0        0            1            0  constant"
        record = inspection.read(Path("x.csv"), [*INSPECTED[:4], row])
        self.assertEqual((record.columns, record.units, record.samples), (("Acc A",), ("m/s²",), 6000))

    def test_a_deck_is_told_from_a_record_of_the_same_ending(self):
        for name, text in (("a.dat", "SOL 103\nCEND\nBEGIN BULK\nGRID,1,,0.,0.,0.\n"), ("b.dat", "/PREP7\nET,1,188\n"), ("c.mac", "finish\n/prep7\n"), ("D.INP", "*NODE\n")):
            self.assertTrue(model.is_deck(self.write(name, text)), name)
        for name, text in (("toa5.dat", '"TOA5","grid"\n"TIMESTAMP","a"\n"2023-05-01 10:00:00",1\n'), ("e.txt", "time a\n0 1\n"), ("f.csv", "GRID,1\n")):
            self.assertFalse(model.is_deck(self.write(name, text)), name)

    def test_a_table_of_sensors(self):
        found = sensors.table_of_sensors(self.write("s.csv", "Sensor;x;y;z;direction\nA;0;0;3,5;x\nB;1;;;-z\n"))
        self.assertEqual(found.rows["A"], {"x_m": "0", "y_m": "0", "z_m": "3.5", "dx": "1", "dy": "0", "dz": "0"})
        self.assertEqual(found.rows["B"], {"x_m": "1", "dx": "0", "dy": "0", "dz": "-1"})
        found = sensors.table_of_sensors(self.write("mm.csv", "Sensor;x [mm];y_cm;z (m)\nA;3500;25;-1,5\n"))
        self.assertEqual(found.rows["A"], {"x_m": "3.5", "y_m": "0.25", "z_m": "-1.5"})
        self.assertIsNone(sensors.table_of_sensors(self.write("r.csv", "time;A;B\n0;1;2\n0.1;2;3\n")), "a record is no table of sensors")
        for text, words in (("Sensor,x,direction\nA,0,sideways\n", "line 2: direction is 'sideways', expected x, y, z"), ("Sensor,x,y,z\nA,about 3,0,0\n", "line 2: x_m is 'about 3'")):
            with self.assertRaisesRegex(InputError, words):
                sensors.table_of_sensors(self.write("bad.csv", text))

    def test_a_spreadsheet_that_cannot_be_read(self):
        """Without the package its name is told; a file that is no workbook is left to step 3, which says so."""
        with unittest.mock.patch("pandas.read_excel", side_effect=ImportError("Missing optional dependency")), self.assertRaisesRegex(InputError, "apt-get install python3-openpyxl"):
            sensors.table_of_sensors(self.write("s.xlsx", "x"))
        with unittest.mock.patch("pandas.read_excel", side_effect=zipfile.BadZipFile("no zip")):
            self.assertIsNone(sensors.table_of_sensors(self.write("s.xlsx", "x")))

    def test_nodes_of_a_universal_file(self):
        found = sensors.of_universal_file(self.write("r.unv", UNIVERSAL), ("P1",))
        self.assertEqual({k: float(v) for k, v in found.rows["P1"].items() if k != "point"}, {"x_m": 1.0, "y_m": 2.0, "z_m": 3.5, "dx": 0.0, "dy": 0.0, "dz": -1.0})
        self.assertEqual(found.rows["P1"]["point"], "N7")
        self.assertIsNone(sensors.of_universal_file(self.folder / "r.unv", ("P1", "P2")), "another number of functions: nobody knows which is which")

    def test_settings_out_of_peaks(self):
        """Peaks at 2 and 8 Hz of 100 Hz, common motion up to 10 Hz: 0.4 * 100 / 10 = every fourth sample; two periods of 2 Hz at 25 Hz are 25 samples."""
        found = settings.from_peaks([2.0, 8.0], 100.0, 60000, 10.0)
        self.assertEqual((found.decimation, found.block_rows, found.blocks), (4, 25, 12))
        self.assertEqual(found.maximum_order % 2, 0)
        self.assertEqual(settings.from_peaks([2.0, 8.0], 100.0, 60000).decimation, 5)

    def test_nothing_is_written_where_nothing_is_known(self):
        """Keys of a trial that failed would stay when the records are mended."""
        self.assertEqual(study._configurations(None, [])["s3_identification"], ['kind = "ambient"'])

    def test_a_step_that_refuses_leaves_no_settings_and_names_the_users_files(self):
        """A program in the place of step 3 that refuses its campaign; one that runs and finds no peak has nothing to say either."""
        program, record = self.folder / "s3_identification", inspection.Record(Path("from/here/a.csv"), 100.0, ("p",), ("g",), 1000)
        place = self.folder / "tmp1/data/campaign"
        program.write_text('#!/bin/sh\necho "$2/records/a.csv: line 7: time runs backwards; see $2/campaign.toml and $2/records/a.csv.bak, records/a.csv" >&2\nexit 2\n', encoding="utf-8")
        program.chmod(0o755)
        told = io.StringIO()
        with contextlib.redirect_stderr(told):
            self.assertIsNone(cli._settings(self.folder, place, Path("data/mill/campaign"), [record]))
        self.assertIn("from/here/a.csv: line 7: time runs backwards; see data/mill/campaign/campaign.toml and data/mill/campaign/records/a.csv.bak, from/here/a.csv; ", told.getvalue())
        self.assertNotIn("tmp1", told.getvalue())
        program.write_text('#!/bin/sh\nmkdir -p "$4"\nprintf "setup,frequency_Hz,sv1\\nA,1,1\\nA,2,1\\n" >"$4/singular_values.csv"\n', encoding="utf-8")
        self.assertIsNone(cli._settings(self.folder, place, Path("data/mill/campaign"), [record]))

    def test_of_several_states_the_first_is_the_models(self):
        for conditions, line in ((["as_tested"], None), (["enero", "julio"], {"condition": "enero"})):
            found = study._configurations(None, conditions)
            for step in ("s4_refinement", "s6_updating"):
                self.assertEqual(tomllib.loads("\n".join(found[step])).get("condition"), line and line["condition"])
                self.assertEqual("one of: enero, julio" in "\n".join(found[step]), line is not None)
            self.assertNotIn("condition", "".join(found["s5_sensitivity"] + found["s9_diagnosis"]))

    def test_a_lone_peak_and_noise(self):
        """A resonance over flat noise is one peak; noise whose level scatters by a third has none."""
        f = np.arange(1000) * 0.02
        noise = 1.0 + 0.3 * np.sin(37.0 * np.arange(1000))
        self.assertEqual(settings.peaks_of(f, noise), [])
        self.assertEqual([round(p, 2) for p in settings.peaks_of(f, noise + 50.0 / (1.0 + ((f - 7.0) / 0.04) ** 2))], [7.0])

    def test_setups_of_two_states(self):
        """A column that all setups have by its name is one sensor, which ties them; nobody but the engineer knows which records belong together."""
        records = [inspection.Record(self.write(f"{name}.csv", ""), 100.0, columns, ("g",) * 2, 1000)
                   for name, columns in (("a24", ("ref", "p1")), ("b24", ("ref", "p2")), ("a25", ("ref", "p1")), ("b25", ("ref", "p2")))]
        written = campaign.write_campaign(records, [], self.folder / "out")
        told = [line.split(",") for line in (self.folder / "out/channels.csv").read_text().splitlines()[1:]]
        self.assertEqual([(row[0], row[campaign.HEADER.index("reference")]) for row in told], [("ref", "1"), ("p1", "0"), ("p2", "0")])
        self.assertEqual([line for line in written.missing if "`reference`" in line], [])
        self.assertEqual(len([line for line in written.missing if "one and the same `condition`" in line]), 1)

    def record(self, name, *columns, units="g", **told):
        (self.folder / name).parent.mkdir(exist_ok=True)
        return inspection.Record(self.write(name, ""), 100.0, columns, (units,) * len(columns), 1000, **told)

    def written(self, records, tables=(), nodes=None):
        """(what was written, channels.csv by channel, the records of campaign.toml, conditions.toml)"""
        folder = Path(self.enterContext(tempfile.TemporaryDirectory())) / "out"
        made = campaign.write_campaign(records, list(tables), folder, nodes)
        with (folder / "channels.csv").open(encoding="utf-8", newline="") as table:
            channels = {row["channel"]: row for row in csv.DictReader(table)}
        return made, channels, tomllib.loads((folder / "campaign.toml").read_text())["record"], tomllib.loads((folder / "conditions.toml").read_text())

    def test_a_channel_named_after_a_node_needs_no_line(self):
        """A named point, a node by its number, a direction behind the name; a lone hyphen may be a minus, and a logger's own number is no node."""
        for name, told in (("A3_z", ("A3", "z")), ("12z", ("12", "z")), ("P1+x", ("P1", "x")), ("Deck vertical", ("Deck", "vertical")), ("A3-z", ("A3-z", "")), ("max", ("max", "")), ("A3", ("A3", ""))):
            self.assertEqual(places.split_name(name), told)
        nodes = places.Nodes({"7": (1.0, 2.0, 3.0), "3": (4.0, 0.0, 0.0)}, {"a3": "7"})
        made, channels, _, _ = self.written([self.record("r.csv", "A3_z", "N3 y", "Kanal 3", "B_x")], nodes=nodes)
        self.assertEqual([channels["A3_z"][f] for f in ("point", *campaign.PLACE)], ["A3", "1", "2", "3", "0", "0", "1"])
        self.assertEqual([channels["N3_y"][f] for f in ("point", *campaign.PLACE)], ["3", "4", "0", "0", "0", "1", "0"])
        self.assertEqual([(r["x_m"], r["dx"]) for r in (channels["Kanal_3"], channels["B_x"])], [("", ""), ("", "1")])
        self.assertEqual(made.missing, ["channels.csv lines 4, 5: Kanal_3, B_x: position x_m, y_m, z_m", "channels.csv line 4: Kanal_3: direction dx, dy, dz"])
        self.assertEqual(made.read, ["places out of the model: A3_z at A3, N3_y at 3"])

    def test_units_in_any_spelling(self):
        for unit, name in (("[m/s²]", "m/s^2"), ("CM/S^2", "cm/s^2"), ("µg", "ug"), ("mm / s", "mm/s")):
            self.assertEqual(campaign.scale_of(unit)[0], name)
        self.assertIsNone(campaign.scale_of("?"))

    def test_one_line_a_sensor(self):
        """A table by nodes; a line for the two channels of one point; a place of one's own goes before the node of the name; a sensor far from all nodes."""
        table = sensors.table_of_sensors(self.write("s.csv", "Kanal;Knoten;Richtung;x;y;z\nA3;7;;;;\nK1;7;-z;;;\nA7_z;;;4,1;0;0\nK2;;x;4;0;9\n"))
        nodes = places.Nodes({"7": (1.0, 2.0, 3.0), "3": (4.0, 0.0, 0.0)}, {"a7": "7"})
        record = self.record("r.csv", "A3_x", "A3_z", "K1", "A7_z", "K2")
        made, channels, _, _ = self.written([record], [table], nodes)
        self.assertEqual([[channels[c][f] for f in campaign.PLACE] for c in ("A3_x", "A3_z", "K1", "A7_z")],
                         [["1", "2", "3", "1", "0", "0"], ["1", "2", "3", "0", "0", "1"], ["1", "2", "3", "0", "0", "-1"], ["4.1", "0", "0", "0", "0", "1"]])
        self.assertEqual(len(made.missing), 1)
        self.assertIn("channels.csv line 6: K2: lies 7.00 m from the nearest node (7), expected at most 0.5 m", made.missing[0])
        self.assertEqual(campaign.all_known([table], [record]), [])

    def test_the_logger_calls_other_sensors_the_same_in_the_next_setup(self):
        """K1 stays at its place, K2 moves from x = 1 m to 3 m: three sensors, of which one is the reference."""
        table = sensors.table_of_sensors(self.write("s.csv", "channel,setup,x,y,z,direction\nK1,1,0,0,0,z\nK2,1,1,0,0,z\nK1,2,0,0,0,z\nK2,2,3,0,0,z\n"))
        made, channels, entries, _ = self.written([self.record("S1.csv", "K1", "K2"), self.record("setup_02.csv", "K1", "K2")], [table])
        self.assertEqual([(c, r["x_m"], r["reference"], r["role"]) for c, r in channels.items()], [("K1", "0", "1", "response"), ("K2", "1", "0", "response"), ("K2_2", "3", "0", "response")])
        self.assertEqual([(e["setup"], e["channels"], e.get("columns")) for e in entries], [("1", ["K1", "K2"], None), ("2", ["K1", "K2_2"], ["K1", "K2"])])
        self.assertEqual((made.missing, made.read), ([], ["references, in all setups: K1"]))
        with self.assertRaisesRegex(InputError, "its name holds no setup of the sensor table's column setup"):
            self.written([self.record("monday.csv", "K1", "K2")], [table])

    def test_conditions_by_the_names_of_files_and_folders(self):
        names = ("S1_warm.csv", "S2_warm.csv", "S1_cold.csv", "S2_cold.csv")
        records = [self.record(name, "ref", f"p{name[1]}", temperature_C=21.26 if "warm" in name else None) for name in names]
        made, _, entries, conditions = self.written(records)
        self.assertEqual([e["condition"] for e in entries], ["warm", "cold", "warm", "cold"])
        self.assertEqual(conditions, {"warm": {"temperature_C": 21.26}, "cold": {}})
        self.assertNotIn("one and the same", "".join(made.missing))
        records = [self.record(f"{folder}/S{setup}.csv", "ref", f"p{setup}") for folder in ("july", "january") for setup in (1, 2)]
        _, _, entries, _ = self.written(records)
        self.assertEqual([(e["file"], e["condition"]) for e in entries], [(f"records/{f}_S{s}.csv", f) for s in (1, 2) for f in ("july", "january")])

    def test_a_column_of_temperatures_is_no_channel(self):
        lines = [*INSPECTED[:5], "T deck                   °C                  30000         0         0        0        18.25          0.1"]
        record = inspection.read(Path("x.csv"), lines)
        self.assertEqual((record.columns, record.temperature_C), (("Acc A",), 18.25))

    def test_names_of_columns_become_names_of_channels(self):
        self.assertEqual([campaign.channel_name(c, i) for i, c in enumerate(("Acc A [g]", "column 2", "ok_3", "µ"), 1)], ["Acc_A_g", "c2", "ok_3", "c4"])


class Help(unittest.TestCase):
    def test_make_lists_ten_targets_and_the_rest_on_request(self):
        def listed(*arguments):
            run = subprocess.run(["make", "--no-print-directory", *arguments], cwd=ROOT, capture_output=True, text=True, check=True)
            return [line.split()[1] for line in run.stdout.splitlines() if line.startswith("  make ") and line.split()[1] not in ("sN", "help-all")]

        users, every = listed(), listed("help-all")
        self.assertEqual(len(users), 10)
        self.assertLess(set(users), set(every))


@unittest.skipUnless((BIN / "s1_model").is_file(), f"no executables in {BIN}: set TWINDECK_BIN")
class Study(unittest.TestCase):
    """The template's frame and record as an engineer has them: a logger's text file, a table of sensors, a model folder."""

    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        samples = np.load(ROOT / "data/template/campaign/records/wind.npy")[:12000]
        rows = ["Zeit [s];Acc A [m/s²];Acc B [m/s²];Acc C [m/s²];Acc D [m/s²]"]
        rows += [";".join(f"{v:.6g}".replace(".", ",") for v in (i / 50.0, *r)) for i, r in enumerate(samples)]
        (self.folder / "logger.csv").write_text("\n".join(rows) + "\n", encoding="latin-1")
        (self.folder / "sensors.csv").write_text("Sensor;x;y;z;direction\nAcc A;0;0;3;x\nAcc B;0;0;6;x\nAcc C;2,5;0;3;z\nAcc D;2,5;0;6;\n", encoding="utf-8")

    def new(self, *arguments, **environment):
        return subprocess.run([str(ROOT / "workflows/new.sh"), *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              env={**os.environ, "TWINDECK_BIN": str(BIN), **environment}, check=False)

    def test_files_become_a_study_that_checks(self):
        run = self.new("mill_bridge", "--from", "logger.csv", "sensors.csv", ROOT / "data/template/model")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual([line for line in run.stdout.splitlines() if line.startswith("missing")], ["missing  channels.csv line 5: Acc_D: direction dx, dy, dz"])
        self.assertIn("50 Hz", run.stdout)
        told = tomllib.loads((self.folder / "workflows/mill_bridge/study.toml").read_text(encoding="utf-8"))
        self.assertEqual(told["title"], "Mill bridge")
        self.assertEqual(told["model"]["folder"], "data/mill_bridge/model")
        left = [p for p in (*self.folder.glob("workflows/mill_bridge/*"), *self.folder.glob("data/mill_bridge/campaign/*")) if p.is_file() and "template" in p.read_text(encoding="utf-8")]
        self.assertEqual(left + list(self.folder.rglob("frame.py")) + list(self.folder.rglob("README*")), [], "nothing of the template is left")
        record = tomllib.loads((self.folder / "data/mill_bridge/campaign/campaign.toml").read_text(encoding="utf-8"))["record"][0]
        self.assertEqual((record["sampling_rate_Hz"], record["columns"][0]), (50, "Acc A"))
        check = subprocess.run([str(BIN / "s3_identification"), "--study", "workflows/mill_bridge", "--results", "results/mill_bridge", "--out", "results/mill_bridge/s3_identification", "--check"],
                               cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(check.returncode, 0, check.stderr)
        table = self.folder / "data/mill_bridge/campaign/channels.csv"
        table.write_text(table.read_text(encoding="utf-8").replace("Acc_A,Acc_A,0,0,3,", "Acc_A,Acc_A,0,0,30,"), encoding="utf-8")
        first = subprocess.run([str(BIN / "s1_model"), "--study", "workflows/mill_bridge", "--results", "results/mill_bridge", "--out", "results/mill_bridge/s1_model", "--check"],
                               cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(first.returncode, 0, first.stderr)
        self.assertRegex(first.stderr, r"warning: data/mill_bridge/campaign/channels.csv: Acc_A: lies 24.00 m from the nearest node \(9\), expected at most 0.50 m")
        self.assertIn("Acc_D: is no direction", first.stderr)
        again = self.new("mill_bridge", "--from", "logger.csv")
        self.assertEqual(again.returncode, 2)
        self.assertIn("workflows/mill_bridge is there already", again.stderr)

    def test_a_deck_whose_units_stand_beside_it_gets_parameters_too(self):
        """A bar of steel in Nastran's form does not say its units; three lines beside it do. They are kept, modulus and density follow as a start."""
        (self.folder / "bar.bdf").write_text("SOL 103\nCEND\nSPC = 1\nBEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,2.,0.,0.\nCBAR,1,1,1,2,0.,0.,1.\nCBAR,2,1,2,3,0.,0.,1.\n"
                                             "PBAR,1,7,0.01,1.-5,1.-5,2.-5\nMAT1,7,210.E9,,0.3,7850.\nSPC1,1,123456,1\nENDDATA\n", encoding="utf-8")
        without = self.new("steel", "--from", "logger.csv", "sensors.csv", "bar.bdf")
        self.assertEqual(without.returncode, 0, without.stderr)
        self.assertIn('read     bar.toml: [units] length = "m" force = "N"', without.stdout)
        self.assertEqual(tomllib.loads((self.folder / "data/steel/bar.toml").read_text(encoding="utf-8"))["units"], {"length": "m", "force": "N"})
        (self.folder / "odd.bdf").write_text((self.folder / "bar.bdf").read_text(encoding="utf-8").replace("7850.", "3.1"), encoding="utf-8")
        odd = self.new("odd", "--from", "logger.csv", "sensors.csv", "odd.bdf")
        self.assertEqual(odd.returncode, 2, odd.stdout)
        self.assertIn("write [units]", odd.stderr)
        (self.folder / "bar.toml").write_text('[units]\nlength = "m"\nforce = "N"\n', encoding="utf-8")
        run = self.new("bar", "--from", "logger.csv", "sensors.csv", "bar.bdf")
        self.assertEqual(run.returncode, 0, run.stderr)
        told = tomllib.loads((self.folder / "data/bar/bar.toml").read_text(encoding="utf-8"))
        self.assertEqual((told["title"], told["units"]), ("Bar", {"length": "m", "force": "N"}))
        self.assertEqual([(p["target"], p["initial"]) for p in told["parameter"]], [("youngs_modulus", 210e9), ("density", 7850.0)])

    def test_groups_of_springs_and_masses_get_parameters(self):
        """The template's frame without its parameters has a group of springs and one of masses; of more than eight groups none gets any."""
        shutil.copytree(ROOT / "data/template/model", self.folder / "model")
        (self.folder / "model/model.toml").write_text('title = "frame"\n', encoding="utf-8")
        run = self.new("frame", "--from", "logger.csv", "sensors.csv", "model")
        self.assertEqual(run.returncode, 0, run.stderr)
        told = tomllib.loads((self.folder / "data/frame/model/model.toml").read_text(encoding="utf-8"))["parameter"]
        self.assertEqual([(p["target"], p["of"], p["initial"], p["lower"], p["upper"]) for p in told if p["unit"] == "-"],
                         [("spring_stiffness", ["base"], 1, 0.2, 5), ("point_mass", ["floor"], 1, 0.8, 1.25)])
        (self.folder / "masses.csv").write_text("group,node,mass_kg\n" + "".join(f"m{i},5,{i}\n" for i in range(9)), encoding="utf-8")
        (self.folder / "materials.csv").write_text("material,youngs_modulus_Pa,density_kg_m3\n", encoding="utf-8")
        text, missing = model._parameters(self.folder, "")
        self.assertEqual(text, "")
        self.assertIn("masses.csv has 9 groups: add those that may be wrong", missing[0])

    def test_what_cannot_be_read_writes_nothing(self):
        (self.folder / "prose.csv").write_text("Dear all,\nnothing here is a number.\n", encoding="utf-8")
        for arguments in (("--from", "prose.csv"), ("--from", "gone.csv"), ("--from",), ("logger.csv",), ("--from", "logger.csv", "logger.csv")):
            run = self.new("mill_bridge", *arguments)
            self.assertEqual(run.returncode, 2, arguments)
            self.assertEqual(len(run.stderr.strip().splitlines()), 1, run.stderr)
            self.assertEqual([p.name for p in self.folder.iterdir() if p.is_dir() and any(p.iterdir())], [], arguments)


if __name__ == "__main__":
    unittest.main()
