"""The layers hold: src/layers.toml is the truth, includes answer to it.

Oracle: the declared graph itself. The second class plants violations in a temporary tree and requires that they are found, so the
check is known to be able to fail.
"""
import graphlib
import pathlib
import re
import tempfile
import tomllib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)
CROSSING = re.compile(r"^(ceres|Spectra|cholmod|toml\+\+|nlohmann|openssl|CLI|fmt|fftw|hdf5|matio)")
MAX_MAIN_LINES = 80
MAX_FILE_LINES = 500


def library_of(parts):
    """The library of a file below src, or of an include: its folder; below some rooms each folder is one of its own."""
    return "/".join(parts[:2]) if parts[0] in ("steps", "diagnosis", "aero", "ponte") and len(parts) == 3 else parts[0]


def violations(src):
    """Every breach of the layer rules below the folder `src`, as sentences."""
    declared = tomllib.loads((src / "layers.toml").read_text())
    layer, uses = declared["layer"], declared["uses"]
    found, used = [], set()
    for name, targets in uses.items():
        for target in targets:
            if layer[target] > layer[name] or (layer[target] == layer[name] and target in uses and name in uses[target]):
                found.append(f"layers.toml: {name} (L{layer[name]}) uses {target} (L{layer[target]}), which climbs")
    for file in sorted(src.rglob("*.[hc]pp")):
        library = library_of(file.relative_to(src).parts)
        if library not in layer:
            found.append(f"{file.relative_to(src)}: folder {library} is not in layers.toml")
            continue
        text = file.read_text()
        for bracket, include in INCLUDE.findall(text):
            target = library_of(include.split("/"))
            if target == library or "/" not in include or (bracket == "<" and target not in layer and ".." not in include):
                continue
            used.add((library, target))
            if target not in uses[library]:
                found.append(f"{file.relative_to(src)}: includes {include}, an edge {library} -> {target} that layers.toml lacks")
        if file.suffix == ".hpp":
            for _, include in INCLUDE.findall(text):
                if CROSSING.match(include):
                    found.append(f"{file.relative_to(src)}: a third-party header ({include}) crosses a library's header")
    for name, targets in uses.items():
        for target in targets:
            if (src / name).is_dir() and any((src / name).iterdir()) and (name, target) not in used:
                found.append(f"layers.toml: the edge {name} -> {target} is not used")
    return found


def circle(uses):
    """Libraries that use each other in a circle; empty if none do."""
    try:
        graphlib.TopologicalSorter(uses).prepare()
    except graphlib.CycleError as found:
        return found.args[1]
    return []


def linked(cmake):
    """What src/CMakeLists.txt links: {library: libraries after USES}."""
    calls = re.findall(r"^twindeck_library\(([^)]*)\)", cmake, re.M)
    return {(words := call.split("LINKS")[0].split())[0]: sorted(words[2:]) for call in calls}


class Layers(unittest.TestCase):
    def test_includes_answer_to_the_declared_layers(self):
        self.assertEqual(violations(ROOT / "src"), [])

    def test_libraries_use_each_other_in_no_circle(self):
        self.assertEqual(circle(tomllib.loads((ROOT / "src/layers.toml").read_text())["uses"]), [])

    def test_cmake_links_what_is_declared(self):
        declared = tomllib.loads((ROOT / "src/layers.toml").read_text())["uses"]
        libraries = {name: sorted(used) for name, used in declared.items() if name != "steps"}  # executables
        self.assertEqual(linked((ROOT / "src/CMakeLists.txt").read_text()), libraries)

    def test_ceres_stays_in_one_file(self):
        files = [f.name for f in (ROOT / "src").rglob("*.[hc]pp") if re.search(r"#\s*include\s*<ceres", f.read_text())]
        self.assertEqual(len(files), 1, files)

    def test_parallel_regions_stay_in_one_file(self):
        """An exception that leaves a parallel region ends the program; core/parallel.cpp carries it out."""
        files = [str(f.relative_to(ROOT)) for part in ("src", "tests") for f in (ROOT / part).rglob("*.[hc]pp")
                 if re.search(r"#\s*pragma\s+omp\b|#\s*include\s*<omp\.h>|\bstd::j?thread\s+\w|std::async\b", f.read_text())]
        self.assertEqual(sorted(files), ["src/core/parallel.cpp", "src/runner/clean_interrupt.cpp",  # one waits for signals,
                                         "src/runner/heartbeat.hpp",  # one says that the step works on,
                                         "tests/unit/io/atomic_test.cpp"])  # and one is such a signal

    def test_libraries_neither_print_nor_exit(self):
        bad = []
        for file in (ROOT / "src").rglob("*.[hc]pp"):
            if file.relative_to(ROOT / "src").parts[0] in ("steps", "runner"):
                continue
            if re.search(r"std::c(out|err)\b|\bprintf\(|\bexit\(", file.read_text()):
                bad.append(str(file.relative_to(ROOT)))
        self.assertEqual(bad, [])

    def test_numerics_never_read_files(self):
        bad = []
        for library in ("linalg", "modal", "fe", "dynamics", "updating"):
            for file in (ROOT / "src" / library).rglob("*.[hc]pp"):
                if re.search(r"#\s*include\s*<(fstream|filesystem)>", file.read_text()):
                    bad.append(str(file.relative_to(ROOT)))
        self.assertEqual(bad, [])

    def test_mains_are_tables_of_contents(self):
        long = {f.name: n for f in (ROOT / "src/steps").glob("s[0-9]*_*.cpp")
                if (n := len(f.read_text().splitlines())) > MAX_MAIN_LINES}
        self.assertEqual(long, {})

    def test_files_stay_small(self):
        long = {str(f.relative_to(ROOT)): n for part in ("src", "tests", "paper", "python") for f in (ROOT / part).rglob("*")
                if f.suffix in (".cpp", ".hpp", ".py") and (n := len(f.read_text().splitlines())) > MAX_FILE_LINES}
        self.assertEqual(long, {})


class TheCheckCanFail(unittest.TestCase):
    def tree(self, files):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        for name, text in files.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(text)
        return folder

    LAYERS = "[layer]\ncore = 0\nfe = 2\n[uses]\ncore = []\nfe = ['core']\n"
    USED = {"core/a.hpp": "", "fe/b.cpp": '#include "core/a.hpp"\n'}

    def test_a_sound_tree_passes(self):
        self.assertEqual(violations(self.tree({"layers.toml": self.LAYERS} | self.USED)), [])

    def test_a_climbing_include_is_found(self):
        found = violations(self.tree({"layers.toml": self.LAYERS} | self.USED | {"core/c.cpp": '#include "fe/x.hpp"\n'}))
        self.assertEqual(len(found), 1)
        self.assertIn("core -> fe", found[0])

    def test_a_climbing_include_in_angle_brackets_is_found(self):
        for include in ("<fe/x.hpp>", "<../fe/x.hpp>", '"../fe/x.hpp"'):
            found = violations(self.tree({"layers.toml": self.LAYERS} | self.USED | {"core/c.cpp": f"#include {include}\n"}))
            self.assertEqual(len(found), 1, found)
            self.assertIn("core/c.cpp: includes", found[0])

    def test_the_standard_library_and_foreign_headers_are_no_rooms(self):
        foreign = "#include <sys/stat.h>\n#include <toml++/toml.h>\n#include <vector>\n"
        self.assertEqual(violations(self.tree({"layers.toml": self.LAYERS} | self.USED | {"core/c.cpp": foreign})), [])

    def test_a_climbing_declaration_is_found(self):
        layers = self.LAYERS.replace("core = []", "core = ['fe']")
        found = violations(self.tree({"layers.toml": layers} | self.USED | {"core/c.cpp": '#include "fe/x.hpp"\n'}))
        self.assertTrue(any("climbs" in f for f in found), found)

    def test_an_unused_edge_is_found(self):
        found = violations(self.tree({"layers.toml": self.LAYERS, "core/a.hpp": "", "fe/b.cpp": "int x;\n"}))
        self.assertTrue(any("not used" in f for f in found), found)

    def test_a_third_party_header_in_a_header_is_found(self):
        found = violations(self.tree({"layers.toml": self.LAYERS} | self.USED | {"fe/c.hpp": "#include <ceres/ceres.h>\n"}))
        self.assertTrue(any("crosses" in f for f in found), found)

    def test_a_folder_of_the_steps_is_a_library_of_its_own(self):
        layers = "[layer]\n'steps/a' = 6\n'steps/b' = 6\nsteps = 7\n[uses]\n'steps/a' = []\n'steps/b' = []\nsteps = ['steps/a']\n"
        files = {"steps/s1_a.cpp": '#include "steps/a/x.hpp"\n', "steps/a/x.hpp": "", "steps/b/y.hpp": '#include "steps/a/x.hpp"\n'}
        found = violations(self.tree({"layers.toml": layers} | files))
        self.assertEqual(len(found), 1)
        self.assertIn("steps/b -> steps/a", found[0])

    def test_a_room_of_the_diagnosis_is_a_library_of_its_own(self):
        layers = "[layer]\n'diagnosis/a' = 4\ndiagnosis = 5\n[uses]\n'diagnosis/a' = []\ndiagnosis = ['diagnosis/a']\n"
        files = {"diagnosis/x.cpp": '#include "diagnosis/a/y.hpp"\n', "diagnosis/a/y.hpp": '#include "diagnosis/x.hpp"\n'}
        found = violations(self.tree({"layers.toml": layers} | files))
        self.assertEqual(len(found), 1)
        self.assertIn("diagnosis/a -> diagnosis", found[0])

    def test_a_circle_is_found(self):
        self.assertEqual(set(circle({"steps/a": ["steps/b"], "steps/b": ["steps/a"]})), {"steps/a", "steps/b"})

    def test_what_cmake_links_is_read(self):
        self.assertEqual(linked("twindeck_library(core)\ntwindeck_library(fe USES linalg\n core LINKS X::X)\n"),
                         {"core": [], "fe": ["core", "linalg"]})


if __name__ == "__main__":
    unittest.main()
