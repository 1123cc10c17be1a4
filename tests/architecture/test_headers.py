"""A source of the library has a header of its name, or an entry in exceptions.toml that says why.

A reader who looks for a thing opens the header of its name; a source without one hides behind another's. Mains have none.

Oracle: planted trees with and without the header, and with an entry that is no longer needed.
"""
import pathlib
import re
import tempfile
import tomllib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
MAX_ENTRIES = 20  # it only goes down; at 20 each is one that stays
MAIN = re.compile(r"^int main\(", re.M)


def without_header(root):
    """Sources below src that have no header of their name beside them and are no mains."""
    return [str(file.relative_to(root)) for file in sorted((root / "src").rglob("*.cpp"))
            if not file.with_suffix(".hpp").exists() and not MAIN.search(file.read_text())]


def complaints(root, entries):
    """Sources that lack a header and an entry that says why, and entries that no source needs."""
    found = without_header(root)
    return ([f"{file}: has no header of its name; merge it or give it one" for file in found if not entries.get(file, "").strip()]
            + [f"exceptions.toml: {file} needs no entry" for file in sorted(set(entries) - set(found))])


class Headers(unittest.TestCase):
    def entries(self):
        return tomllib.loads((ROOT / "tests/architecture/exceptions.toml").read_text())["sources_without_header"]

    def test_a_source_has_a_header_of_its_name(self):
        self.assertEqual(complaints(ROOT, self.entries()), [])

    def test_exceptions_stay_few(self):
        self.assertLessEqual(len(self.entries()), MAX_ENTRIES)


class TheCheckCanFail(unittest.TestCase):
    def tree(self, files):
        root = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (root / "src/a").mkdir(parents=True)
        for name, text in files.items():
            (root / "src/a" / name).write_text(text)
        return root

    def test_a_source_without_a_header_is_found(self):
        root = self.tree({"b.cpp": "int b();\n", "c.cpp": "int c();\n", "c.hpp": "int c();\n", "d.cpp": "int main(int, char**) {}\n"})
        self.assertEqual(complaints(root, {}), ["src/a/b.cpp: has no header of its name; merge it or give it one"])
        self.assertEqual(complaints(root, {"src/a/b.cpp": "Oracle of a test."}), [])

    def test_an_entry_without_a_reason_is_found(self):
        self.assertEqual(len(complaints(self.tree({"b.cpp": "int b();\n"}), {"src/a/b.cpp": " "})), 1)

    def test_an_entry_that_nothing_needs_is_found(self):
        self.assertEqual(complaints(self.tree({"b.cpp": "", "b.hpp": ""}), {"src/a/b.cpp": "Why."}),
                         ["exceptions.toml: src/a/b.cpp needs no entry"])


if __name__ == "__main__":
    unittest.main()
