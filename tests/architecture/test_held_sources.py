"""A source of the libraries has a test of its name, or an entry in held_by.toml says which tests hold it. Tests are named thing_test.cpp.

Who changes a source finds the test to run. Steps are held by the tests of tests/steps, and what is in `precompiled` by all.

Oracle: planted trees with and without the test, with an entry for a test that is not there, that does not use the room, or that nothing needs.
"""
import pathlib
import re
import tempfile
import tomllib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
NO_LIBRARIES = ("steps", "precompiled")
INCLUDE = re.compile(r'^#include "([^"]+)"', re.M)


def without_test(root):
    """Sources of the libraries that have no test of their name in the room's folder of tests/unit."""
    sources = [file.relative_to(root) for file in sorted((root / "src").rglob("*.cpp"))]
    return [file for file in sources if file.parts[1] not in NO_LIBRARIES
            and not (root / "tests/unit" / file.parent.relative_to("src") / f"{file.stem}_test.cpp").exists()]


def uses_room(root, test, room):
    """Whether a test includes a header of a room, itself or by a header of the tests beside it. A test in Python uses what the steps use."""
    if test.suffix == ".py":
        return True
    included = INCLUDE.findall(test.read_text())
    if any(name.startswith(f"{room}/") for name in included):
        return True
    helpers = [place / name for name in included for place in (test.parent, root / "tests") if (place / name).is_file()]
    return any(uses_room(root, helper, room) for helper in helpers)


def complaints(root, entries):
    """What is wrong with the sources without a test of their name, and with the entries. The first entry that matches a source holds it."""
    found, needed = [], set()
    for file in without_test(root):
        pattern = next((p for p in entries if file.match(p)), None)
        if pattern is None:
            found.append(f"{file}: has no test of its name; write one, or say in held_by.toml which tests hold it")
            continue
        needed.add(pattern)
        for name in entries[pattern]:
            if not (root / name).is_file():
                found.append(f"held_by.toml: {pattern}: {name} is not there")
            elif not uses_room(root, root / name, file.parts[1]):
                found.append(f"held_by.toml: {name} includes nothing of {file.parts[1]}, so it does not hold {file}")
    return list(dict.fromkeys(found)) + [f"held_by.toml: no source needs {p}" for p in entries if p not in needed]


def misnamed(root):
    """Sources of tests that hold GoogleTest's cases and are not named thing_test.cpp."""
    return [str(file.relative_to(root)) for file in sorted((root / "tests").rglob("*.cpp"))
            if re.search(r"^TEST(?:_[FP])?\(", file.read_text(), re.M) and not file.stem.endswith("_test")]


class Held(unittest.TestCase):
    def test_a_source_has_a_test_of_its_name_or_an_entry(self):
        self.assertEqual(complaints(ROOT, tomllib.loads((ROOT / "tests/architecture/held_by.toml").read_text())), [])

    def test_a_test_is_named_after_its_thing(self):
        self.assertEqual(misnamed(ROOT), [])


class TheCheckCanFail(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.write("src/a/b.cpp", "int b();\n")
        self.write("src/a/c.cpp", "int c();\n")
        self.write("tests/unit/a/b_test.cpp", '#include "a/b.hpp"\nTEST(B, IsOne) {}\n')

    def write(self, name, text):
        (self.root / name).parent.mkdir(parents=True, exist_ok=True)
        (self.root / name).write_text(text)

    def test_a_source_without_a_test_is_found(self):
        self.assertEqual(len(complaints(self.root, {})), 1)
        self.assertEqual(complaints(self.root, {"src/a/*.cpp": ["tests/unit/a/b_test.cpp"]}), [])

    def test_an_entry_for_a_test_that_is_not_there_is_found(self):
        self.assertEqual(complaints(self.root, {"src/a/c.cpp": ["tests/unit/a/d_test.cpp"]}), ["held_by.toml: src/a/c.cpp: tests/unit/a/d_test.cpp is not there"])

    def test_an_entry_for_a_test_of_another_room_is_found(self):
        self.write("tests/unit/z/z_test.cpp", '#include "z/z.hpp"\n')
        self.assertEqual(len(complaints(self.root, {"src/a/c.cpp": ["tests/unit/z/z_test.cpp"]})), 1)
        self.write("tests/unit/z/model.hpp", '#include "a/b.hpp"\n')
        self.write("tests/unit/z/z_test.cpp", '#include "model.hpp"\n')
        self.assertEqual(complaints(self.root, {"src/a/c.cpp": ["tests/unit/z/z_test.cpp"]}), [])

    def test_an_entry_that_nothing_needs_is_found(self):
        entries = {"src/a/c.cpp": ["tests/unit/a/b_test.cpp"], "src/a/b.cpp": ["tests/unit/a/b_test.cpp"], "src/*/c.cpp": ["tests/unit/a/b_test.cpp"]}
        self.assertEqual(complaints(self.root, entries), ["held_by.toml: no source needs src/a/b.cpp", "held_by.toml: no source needs src/*/c.cpp"])

    def test_a_test_by_another_name_is_found(self):
        self.write("tests/unit/a/test_c.cpp", "TEST(C, IsTwo) {}\n")
        self.assertEqual(misnamed(self.root), ["tests/unit/a/test_c.cpp"])
