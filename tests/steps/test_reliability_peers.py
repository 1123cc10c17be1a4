"""The guide's table of published reliability problems.

Oracle: OpenTURNS itself, where it is installed (Debian: python3-openturns): its values and calls are those that the table tells. Our own columns
are held by tests/unit/reliability/published_problems_test.cpp.
"""
import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/bench"))
import reliability  # noqa: E402

VERSION = "1.20"  # Debian 12's


class Peers(unittest.TestCase):
    def test_the_guide_tells_what_openturns_finds(self):
        peer = reliability.peer()
        if peer is None:
            self.skipTest("OpenTURNS is not here (apt-get install python3-openturns)")
        if not peer.__version__.startswith(VERSION):
            self.skipTest(f"another version draws other samples: the table is of OpenTURNS {VERSION}")
        text = (ROOT / "docs/reliability.md").read_text(encoding="utf-8").split(reliability.MARKS[0])[1].split(reliability.MARKS[1])[0]
        rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines()[2:]]
        self.assertEqual({row[0] for row in rows}, set(reliability.PROBLEMS))
        for problem, method, published, _, value, _, calls, _ in rows:
            self.assertEqual(published, f"{reliability.PROBLEMS[problem][2]:.4e}", problem)
            found = reliability.theirs(peer, problem, method, 1)
            self.assertEqual(value, reliability.told(found), f"{problem}, {method}")
            self.assertEqual(calls, str(found[1]) if found else "", f"{problem}, {method}")


if __name__ == "__main__":
    unittest.main()
