"""The sources are formatted as .clang-format says.

Oracle: clang-format itself. A planted file with a space too many must be found, so the check is known to be able to fail.
"""
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = shutil.which("clang-format-14") or shutil.which("clang-format")


def unformatted(files):
    """Those of the files that clang-format would change."""
    run = subprocess.run([PROGRAM, "--style=file", "--dry-run", *map(str, files)], capture_output=True, text=True, cwd=ROOT)
    return sorted({line.split(":")[0] for line in run.stderr.splitlines() if "[-Wclang-format-violations]" in line})


@unittest.skipUnless(PROGRAM, "no clang-format here (Debian: apt-get install clang-format): how the sources are formatted is not checked")
class Format(unittest.TestCase):
    def test_every_source_is_formatted(self):
        files = [f for part in ("src", "tests") for f in sorted((ROOT / part).rglob("*.[hc]pp"))]
        self.assertGreater(len(files), 100)
        self.assertEqual(unformatted(files), [], "run `make format`")

    def test_a_file_with_a_space_too_many_is_found(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        shutil.copy(ROOT / ".clang-format", folder)
        planted = folder / "planted.cpp"
        planted.write_text("int  two_spaces;\n")
        self.assertEqual(unformatted([planted]), [str(planted)])


if __name__ == "__main__":
    unittest.main()
