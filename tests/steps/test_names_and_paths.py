"""Names of the input that become parts of paths: a step writes below --out and nowhere else.

Oracle: the tree beside --out, listed before and after; the one rule of src/io/path_name.hpp, whose message names file and key.
"""
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
BAD = ("../../x", "/tmp/twindeck_x", "a/b", "..", ".x", "a\\\\b", "x" * 101)


class Names(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.out = self.folder / "deep" / "results" / "out"

    def refused(self, step, place, *arguments):
        """One line with exit code 2 that names file and key; nothing is written, beside --out neither."""
        before = [p for p in sorted(self.folder.rglob("*")) if "deep" not in p.parts]
        done = subprocess.run([BIN / step, *arguments, "--out", self.out], cwd=ROOT, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertRegex(done.stderr, place)
        self.assertIn("files are written under this name", done.stderr)
        self.assertEqual([p for p in sorted(self.folder.rglob("*")) if "deep" not in p.parts], before)
        self.assertEqual([p for p in self.folder.rglob("*") if p.is_file() and "deep" in p.parts], [])

    def campaign(self, name, setup="ST1", condition="calm"):
        folder = self.folder / name
        folder.mkdir()
        random = np.random.default_rng(1)
        records = ""
        for part, (s, c) in enumerate((("ST1", "calm"), (setup, condition))):
            np.save(folder / f"{part}.npy", random.standard_normal((2000, 2)))
            records += (f'[[record]]\nsetup = "{s}"\nfile = "{part}.npy"\nsampling_rate_Hz = 100.0\nchannels = ["a", "b"]\n'
                        f'condition = "{c}"\n')
        (folder / "campaign.toml").write_text(records)
        (folder / "channels.csv").write_text("channel,point,x_m,y_m,z_m,dx,dy,dz,quantity,unit\n"
                                             "a,1,0,0,0,0,0,1,acceleration,m/s^2\nb,2,1,0,0,0,0,1,acceleration,m/s^2\n")
        (folder / "conditions.toml").write_text(f'[calm]\n["{condition}"]\n' if condition != "calm" else "[calm]\n")
        return folder

    def test_a_condition_of_a_campaign(self):
        for i, name in enumerate(BAD):
            folder = self.campaign(f"c{i}", condition=name)
            self.refused("s3_identification", rf"{folder}/campaign\.toml:12: record\[1\]\.condition: ", "--campaign", folder)

    def test_a_setup_of_a_campaign(self):
        for i, name in enumerate(BAD):
            folder = self.campaign(f"s{i}", setup=name)
            self.refused("s3_identification", rf"{folder}/campaign\.toml:8: record\[1\]\.setup: ", "--campaign", folder)

    def test_setups_conditions_and_stays_of_the_virtual_campaign(self):
        text = (ROOT / "workflows/ponte_del_mare_virtual/s0_campaign.toml").read_text()
        study = self.folder / "study"
        study.mkdir()
        (study / "study.toml").write_text((ROOT / "workflows/smoke/study.toml").read_text())
        for key, table in (("setup", "record"), ("condition", "record"), ("name", "condition"), ("stay", "stay_test")):
            head, found, tail = text.partition(f"[[{table}]]")
            self.assertTrue(found, table)
            lines = tail.splitlines()
            at = next(i for i, line in enumerate(lines) if line.startswith(key + " "))
            lines[at] = f'{key} = "../../../x"'
            (study / "s0_campaign.toml").write_text(head + found + "\n".join(lines) + "\n")
            self.refused("s0_campaign", rf"{study}/s0_campaign\.toml:\d+: {table}\[0\]\.{key}: ", "--study", study)

    def test_a_matrix_element_of_a_model(self):
        model = self.folder / "model"
        model.mkdir()
        (model / "nodes.csv").write_text("node,x_m,y_m,z_m\n1,0,0,0\n2,1,0,0\n")
        (model / "materials.csv").write_text("material,youngs_modulus_Pa,density_kg_m3\nsteel,210e9,7850\n")
        (model / "sections.csv").write_text("section,area_m2,inertia_y_m4,inertia_z_m4,torsion_m4\nbox,0.01,1e-5,1e-5,1e-5\n")
        (model / "elements.csv").write_text("element,type,group,material,section,node1,node2\n1,beam,b,steel,box,1,2\n")
        (model / "supports.csv").write_text("support,node,x,y,z,rx,ry,rz\nwall,1,1,1,1,1,1,1\n")
        (model / "model.toml").write_text('title = "t"\n\n[[matrix_element]]\nname = "../../x"\ndofs = ["2:z"]\nstiffness = "k.mtx"\n')
        (model / "k.mtx").write_text("%%MatrixMarket matrix coordinate real symmetric\n1 1 1\n1 1 1000\n")
        self.refused("s1_model", rf"{model}/model\.toml:4: matrix_element\[0\]\.name: ", "--model", model)


if __name__ == "__main__":
    unittest.main()
